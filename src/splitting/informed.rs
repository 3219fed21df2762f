//! Workflow 2 (paper, Algorithm 2), within the outlines that the patches of the project draw.
//!
//! The infeasible patch of highest curvature comes first. The circle around its peak with radius
//! π/√K says how large a patch there can be. Where a patch with its corners on the circle leaves
//! room around it, it is cut out. Otherwise a corner goes on the peak, with sides along the
//! principal directions to the sides of the outline: four patches as large as the outline allows.
//! Patches whose members bunch are made smaller, from the side where the curvature is. At the end
//! neighbours are merged wherever the merged patch is feasible: that undoes the cuts which were not
//! needed, and leaves large patches where the curvature is low.

use super::appraise::{Appraisal, Limits};
use super::automatic::even_out;
use super::proposal::over_peak;
use super::split::{NoSplit, Workshop};
use super::{JudgedPeak, Proposal, merging};
use crate::geodesic::{Geodesics, Reach};
use crate::layout::Side;
use crate::project::model::Family;
use crate::surface::{Curvature, SurfacePoint};

/// Cuts after which nothing new is to be expected.
const CUTS: usize = 200;
/// A patch on the circle has to leave this much of its own size around it to be one of its own.
const ROOM: f64 = 1.5;
/// A peak whose distances from both ends differ by less than this share of their sum is in the
/// middle: a cut on one side of it would make two unlike parts of a symmetric patch.
const CENTRED: f64 = 0.2;
/// Parts of a patch whose members bunch are tried in these sizes, the largest first.
const SIZES: [f64; 2] = [0.7, 0.5];
/// Places of a side to which sides along principal directions may run.
const FEET: usize = 33;
/// Principal curvatures that differ by less than this share have no directions.
const UMBILIC: f64 = 0.1;

/// Cuts until all patches are feasible or stuck, then merges.
pub(super) fn run(workshop: &mut Workshop<'_>) -> Result<(), NoSplit> {
    let limits = workshop.limits();
    for _ in 0..CUTS {
        let measured = workshop.appraise()?;
        let remaining = workshop
            .draft
            .patches
            .iter()
            .zip(&measured)
            .filter(|(patch, _)| !workshop.stuck.contains_key(&patch.name))
            .filter_map(|(patch, m)| Some((patch.name.clone(), m.as_ref().ok()?.clone())))
            .filter(|(_, appraisal)| !appraisal.feasible(&limits))
            .reduce(|highest, next| {
                let k = |a: &Appraisal| a.feasibility.curvature_max;
                if k(&next.1) > k(&highest.1) {
                    next
                } else {
                    highest
                }
            });
        let Some((name, appraisal)) = remaining else {
            break;
        };
        let proposal = match uncovered(&appraisal, &limits) {
            Some(peak) => Some(around(
                workshop.appraiser.curvature,
                &appraisal,
                peak,
                &limits,
            )),
            None => even_out(&appraisal, &limits),
        };
        let Some(proposal) = proposal else {
            workshop.give_up(&name);
            continue;
        };
        if appraisal.covered(&limits) {
            shrink(workshop, &name, &appraisal, proposal)?;
        } else {
            workshop.cut(&[(name, proposal)])?;
        }
    }
    merging::run(workshop)
}

fn uncovered<'a>(appraisal: &'a Appraisal, limits: &Limits) -> Option<&'a JudgedPeak> {
    let over = |peak: &&JudgedPeak| over_peak(peak, limits.eta_max).is_some();
    appraisal.feasibility.peaks.iter().find(over)
}

/// The cut for a peak that is not covered: beside the circle around it if there is room, a corner
/// on the peak otherwise.
fn around(
    curvature: &Curvature,
    appraisal: &Appraisal,
    peak: &JudgedPeak,
    limits: &Limits,
) -> Proposal {
    if let Some(beside) = beside_circle(appraisal, peak, limits) {
        return beside;
    }
    let [[ab, dc], [ad, bc]] = peak.coverage.map(|c| [c.start, c.end]);
    let feet = principal_feet(curvature, appraisal, peak);
    Proposal::Corner {
        at: peak.place,
        shares: feet.unwrap_or([ab, bc, dc, ad]),
    }
}

/// An edge that bounds a patch with its corners on the circle of radius π/√K, on the side of the
/// peak where there is more room; `None` where a family that fails has no such room on both sides,
/// or the same.
fn beside_circle(appraisal: &Appraisal, peak: &JudgedPeak, limits: &Limits) -> Option<Proposal> {
    let half = std::f64::consts::PI / peak.gaussian.sqrt() / std::f64::consts::SQRT_2;
    let failing = peak.eta().map(|eta| eta > limits.eta_max);
    let roomy = |i: usize| peak.coverage[i].arms.iter().all(|arm| *arm > ROOM * half);
    if !(0..2).filter(|&i| failing[i]).all(roomy) {
        return None;
    }
    let (family, along) = if failing[0] {
        (0, Family::V)
    } else {
        (1, Family::U)
    };
    let [ab, bc, dc, ad] = appraisal.side_lengths();
    let sides = match along {
        Family::U => [ab, dc],
        Family::V => [ad, bc],
    };
    let [before, after] = peak.coverage[family].arms;
    if (before - after).abs() < CENTRED * (before + after) {
        return None;
    }
    let sign = if after >= before { 1.0 } else { -1.0 };
    let over = &peak.coverage[1 - family];
    Some(Proposal::Edge {
        along,
        from: over.start + sign * half / sides[0],
        to: over.end + sign * half / sides[1],
    })
}

/// Shares of the sides AB, BC, DC, AD at which shortest paths from the peak arrive that leave it
/// along the principal directions; `None` at a peak without directions.
fn principal_feet(
    curvature: &Curvature,
    appraisal: &Appraisal,
    peak: &JudgedPeak,
) -> Option<[f64; 4]> {
    let domain = &appraisal.domain;
    let SurfacePoint::Vertex(vertex) = peak.coverage[0].peak else {
        return None;
    };
    let bend = curvature.vertex(domain.part.vertex_to_parent(vertex));
    let [k1, k2] = bend.principal;
    if (k1 - k2).abs() < UMBILIC * k1.abs().max(k2.abs()) {
        return None;
    }
    let [e1, e2] = bend.directions;
    // Counter-clockwise around the normal, as the sides of a patch that turns left.
    let mut directions = [e1, e2, -e1, -e2];
    if !domain.turns_left() {
        directions.reverse();
    }
    let share = |i: usize| i as f64 / (FEET - 1) as f64;
    let feet = |side: &Side| -> Vec<SurfacePoint> {
        (0..FEET)
            .map(|i| side.at(domain.mesh(), share(i)))
            .collect()
    };
    let sides = [&domain.ab, &domain.bc, &domain.dc, &domain.ad].map(feet);
    let all: Vec<SurfacePoint> = sides.iter().flatten().copied().collect();
    let geodesics = Geodesics::new(domain.mesh());
    let field = geodesics
        .field(&SurfacePoint::Vertex(vertex), Reach::Targets(&all))
        .ok()?;
    // How well the best path to each side keeps to each direction, and where it arrives.
    let mut fits = [[(f64::NEG_INFINITY, 0.5); 4]; 4];
    for (fit, side) in fits.iter_mut().zip(&sides) {
        for (i, foot) in side.iter().enumerate() {
            let leaves = field.path_to(foot).ok()?.start.direction;
            for (best, direction) in fit.iter_mut().zip(&directions) {
                let along = leaves.dot(direction);
                if along > best.0 {
                    *best = (along, share(i));
                }
            }
        }
    }
    // The sides AB, BC, CD, DA lie around the peak in the order of the directions.
    let turn = |k: usize| (0..4).map(|side| fits[side][(side + k) % 4].0).sum::<f64>();
    let best = (1..4).fold(0, |best, k| if turn(k) > turn(best) { k } else { best });
    Some(std::array::from_fn(|side| fits[side][(side + best) % 4].1))
}

/// Cuts a patch whose members bunch so that the part at its highest curvature is the largest
/// feasible one of a few sizes; in the middle if none is.
fn shrink(
    workshop: &mut Workshop<'_>,
    name: &str,
    appraisal: &Appraisal,
    proposal: Proposal,
) -> Result<(), NoSplit> {
    let limits = workshop.limits();
    if let Proposal::Edge { along, .. } = proposal {
        let crossing = match along {
            Family::U => Family::V,
            Family::V => Family::U,
        };
        let at_start = starts_at_peak(appraisal, crossing);
        for size in SIZES {
            let share = if at_start { size } else { 1.0 - size };
            let cut = Proposal::Edge {
                along,
                from: share,
                to: share,
            };
            let before = workshop.draft.clone();
            let position = before.patches.iter().position(|p| p.name == name);
            if !workshop.cut(&[(name.to_owned(), cut)])? {
                return Ok(());
            }
            let part = position.map_or(0, |at| at + usize::from(!at_start));
            let measured = workshop.appraise()?;
            if measured[part].as_ref().is_ok_and(|a| a.feasible(&limits)) {
                return Ok(());
            }
            workshop.draft = before;
        }
    }
    workshop.cut(&[(name.to_owned(), proposal)])?;
    Ok(())
}

/// Whether the highest curvature is closer to the side where a family starts than to that where it
/// ends.
fn starts_at_peak(appraisal: &Appraisal, family: Family) -> bool {
    let domain = &appraisal.domain;
    let peak = appraisal.feasibility.peak;
    let distance = |side: &Side| {
        (0..FEET)
            .map(|i| side.at(domain.mesh(), i as f64 / (FEET - 1) as f64))
            .map(|at| (at.position(domain.mesh()) - peak).norm())
            .fold(f64::INFINITY, f64::min)
    };
    distance(domain.start(family)) <= distance(domain.end(family))
}
