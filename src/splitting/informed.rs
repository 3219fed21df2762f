//! Workflow 2 (paper, Algorithm 2), within the outlines that the patches of the project draw.
//!
//! The unsettled patch of highest curvature comes first. Around its peak grows a block (`block`,
//! `growing`): one patch with its corners on the circle of radius π/√K where there is room for it, two
//! with a side over the peak where one family does not cover it, or four with a corner on the peak
//! and sides along the principal directions. What lies beyond the block is a patch like any other,
//! and has its turn when its curvature is the highest that remains. Patches whose members bunch are
//! made smaller in the same way, from the side where the curvature is.
//!
//! Of the blocks that can be grown that one is taken which leads to the fewest patches. At the end
//! neighbours are merged wherever the merged patch is feasible.

use super::appraise::Appraisal;
use super::automatic::{downsize, even_out, twins};
use super::block::{Carved, Extent, Shape, Site, WHOLE, carve};
use super::growing::{centred, circle, grow};
use super::principal::principal_feet;
use super::proposal::{over_peak, shares_at};
use super::split::{NoSplit, Workshop};
use super::{JudgedPeak, Proposal, merging};
use crate::project::model::Family;
use std::sync::Arc;

/// Blocks after which nothing new is to be expected.
const BLOCKS: usize = 200;
/// A patch on the circle has to leave this much of its own size beside it to be one of its own.
const ROOM: f64 = 1.5;

/// Grows blocks until all patches are settled or stuck, then merges.
pub(super) fn run(workshop: &mut Workshop<'_>) -> Result<(), NoSplit> {
    for _ in 0..BLOCKS {
        let Some((name, appraisal)) = highest(workshop)? else {
            break;
        };
        let limits = workshop.limits();
        let uncovered = |peak: &&JudgedPeak| over_peak(peak, limits.eta_max).is_some();
        let peak = appraisal.feasibility.peaks.iter().find(uncovered).copied();
        if let Some(between) = twins(&appraisal, &limits) {
            workshop.cut(&[(name, between)])?;
        } else if let Some(peak) = peak {
            around(workshop, &name, &peak)?;
        } else if let Some(proposal) = even_out(&appraisal, &limits) {
            smaller(workshop, &name, &appraisal, &proposal)?;
        } else if let Some(proposal) = downsize(&appraisal, &limits) {
            workshop.cut(&[(name, proposal)])?;
        } else {
            workshop.give_up(&name);
        }
    }
    merging::run(workshop)?;
    workshop.draft.number_parts(&mut workshop.stuck);
    Ok(())
}

/// The unsettled patch of highest curvature.
fn highest(workshop: &mut Workshop<'_>) -> Result<Option<(String, Arc<Appraisal>)>, NoSplit> {
    let limits = workshop.limits();
    let measured = workshop.appraise()?;
    Ok(workshop
        .draft
        .patches
        .iter()
        .zip(measured)
        .filter(|(patch, _)| !workshop.stuck.contains_key(&patch.name))
        .filter_map(|(patch, m)| Some((patch.name.clone(), m.ok()?)))
        .filter(|(_, appraisal)| !appraisal.settled(&limits))
        .reduce(|highest, next| {
            let k = |a: &Appraisal| a.feasibility.curvature_max;
            if k(&next.1) > k(&highest.1) {
                next
            } else {
                highest
            }
        }))
}

/// Covers a peak by the block that leads to the fewest patches.
fn around(workshop: &mut Workshop<'_>, name: &str, peak: &JudgedPeak) -> Result<(), NoSplit> {
    let limits = workshop.limits();
    let Some(outline) = workshop.index(name) else {
        return Ok(());
    };
    let Some(proposal) = over_peak(peak, limits.eta_max) else {
        return Ok(());
    };
    let [u, v] = peak.coverage;
    let mut site = Site {
        at: peak.place,
        feet: [u.start, v.end, u.end, v.start],
        arms: [u.arms[0], v.arms[1], u.arms[1], v.arms[0]],
    };
    let shape = match proposal {
        Proposal::Edge { along, .. } => Shape::Two(along),
        Proposal::Corner { .. } => {
            let domain = workshop.domain(outline);
            let curvature = workshop.appraiser.curvature;
            let feet = domain.and_then(|domain| principal_feet(curvature, &domain, peak));
            site.feet = feet.unwrap_or(site.feet);
            Shape::Four
        }
    };
    let mut choice = Choice::new(outline);
    let failing = peak.eta().map(|eta| eta > limits.eta_max);
    let on_circle = circle(&site, Shape::One, peak.gaussian);
    let [south, east, north, west] = site.arms;
    let roomy = |i: usize| [i, i + 2].iter().any(|&side| on_circle[side] * ROOM < 1.0);
    // u-members run from AB to DC, v-members from AD to BC.
    let room = (!failing[0] || roomy(0)) && (!failing[1] || roomy(1));
    let middle = (failing[0] && centred(south, north)) || (failing[1] && centred(west, east));
    // Off the middle a patch on the circle may have nothing but one patch beside it; in the middle it
    // has at least two.
    if room && !middle {
        choice.grown(workshop, &site, Shape::One, &on_circle)?;
    }
    let start = circle(&site, shape, peak.gaussian);
    choice.grown(workshop, &site, shape, &start)?;
    if !choice.has_at_most(shape.parts()) {
        choice.carved(workshop, &site, shape)?;
        if shape != Shape::Four {
            let start = circle(&site, Shape::Four, peak.gaussian);
            choice.grown(workshop, &site, Shape::Four, &start)?;
        }
    }
    if room && middle && !choice.has_at_most(3) {
        choice.grown(workshop, &site, Shape::One, &on_circle)?;
    }
    choice.take(workshop, name, &proposal)
}

/// Makes a patch smaller whose members bunch.
fn smaller(
    workshop: &mut Workshop<'_>,
    name: &str,
    appraisal: &Appraisal,
    proposal: &Proposal,
) -> Result<(), NoSplit> {
    let Some(outline) = workshop.index(name) else {
        return Ok(());
    };
    let site = site_of(appraisal);
    let mut choice = Choice::new(outline);
    let cuts = match proposal {
        Proposal::Edge { along, .. } => vec![*along],
        Proposal::Corner { .. } => vec![Family::U, Family::V],
    };
    for along in cuts {
        // Sides that a cut along the family moves away from.
        let [before, after] = match along {
            Family::U => [3, 1],
            Family::V => [0, 2],
        };
        choice.carved(workshop, &site, Shape::Two(along))?;
        if centred(site.arms[before], site.arms[after]) || choice.has_at_most(2) {
            continue;
        }
        let far = if site.arms[before] < site.arms[after] {
            after
        } else {
            before
        };
        let mut start: Extent = WHOLE;
        start[far] = 0.5;
        choice.grown(workshop, &site, Shape::One, &start)?;
    }
    if matches!(proposal, Proposal::Corner { .. }) && !choice.has_at_most(2) {
        choice.grown(workshop, &site, Shape::Four, &[0.5; 4])?;
        choice.carved(workshop, &site, Shape::Four)?;
    }
    choice.take(workshop, name, proposal)
}

/// The highest peak, or the middle of a patch without one.
fn site_of(appraisal: &Appraisal) -> Site {
    let (at, [[ab, dc], [ad, bc]]) = shares_at(&appraisal.feasibility);
    let [south, east, north, west] = appraisal.side_lengths();
    // Lengths of the arms matter as to which is longer: shares of the sides beside them will do.
    let v = 0.25 * (ad + bc) * (east + west);
    let u = 0.25 * (ab + dc) * (south + north);
    Site {
        at,
        feet: [ab, bc, dc, ad],
        arms: [v, 0.5 * (south + north) - u, 0.5 * (east + west) - v, u],
    }
}

/// Ways to cut an outline, of which the best is kept.
struct Choice {
    outline: usize,
    best: Option<(Score, Carved)>,
}

/// How many patches a way leads to at least, and how many of them are not settled yet.
type Score = (usize, usize);

impl Choice {
    fn new(outline: usize) -> Self {
        Self {
            outline,
            best: None,
        }
    }

    /// Whether a way is known that settles the outline with so many patches.
    fn has_at_most(&self, patches: usize) -> bool {
        self.best
            .as_ref()
            .is_some_and(|((all, open), _)| *all <= patches && *open == 0)
    }

    /// A block grown as far as it goes.
    fn grown(
        &mut self,
        workshop: &mut Workshop<'_>,
        site: &Site,
        shape: Shape,
        start: &Extent,
    ) -> Result<(), NoSplit> {
        match grow(workshop, self.outline, site, shape, start)? {
            Some(carved) => self.weigh(workshop, carved),
            None => Ok(()),
        }
    }

    /// A block that reaches the outline everywhere, whether its patches are feasible or not.
    fn carved(
        &mut self,
        workshop: &mut Workshop<'_>,
        site: &Site,
        shape: Shape,
    ) -> Result<(), NoSplit> {
        match carve(workshop, self.outline, site, shape, &WHOLE) {
            Ok(carved) => self.weigh(workshop, carved),
            Err(_) => Ok(()),
        }
    }

    /// Keeps a way that is better than the best so far.
    fn weigh(&mut self, workshop: &mut Workshop<'_>, carved: Carved) -> Result<(), NoSplit> {
        let limits = workshop.limits();
        let parts: Vec<usize> = [carved.block.as_slice(), &carved.beyond].concat();
        let measured = workshop.measure(&carved.draft, &parts)?;
        if measured.iter().any(Result::is_err) {
            return Ok(());
        }
        let open = measured
            .iter()
            .filter(|m| m.as_ref().is_ok_and(|a| !a.settled(&limits)))
            .count();
        // What is not settled will be two patches at least.
        let score = (parts.len() + open, open);
        if self.best.as_ref().is_none_or(|(best, _)| score < *best) {
            self.best = Some((score, carved));
        }
        Ok(())
    }

    /// Goes on with the best way; with the plain cut if there is none, which knows why not.
    fn take(
        self,
        workshop: &mut Workshop<'_>,
        name: &str,
        proposal: &Proposal,
    ) -> Result<(), NoSplit> {
        if let Some((_, carved)) = self.best {
            workshop.draft = carved.draft;
        } else {
            workshop.cut(&[(name.to_owned(), *proposal)])?;
        }
        Ok(())
    }
}
