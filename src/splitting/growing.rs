//! Growing (paper, Algorithm 2): a block around a peak starts with the size that the curvature
//! allows and grows towards the sides of its outline, until a patch of it would not be feasible
//! any more, would be larger than the designer wants, or the side is reached.
//!
//! Opposite sides that are about as far away move together, so that what is symmetric stays so.

use super::block::{Carved, Extent, Shape, Site, WHOLE, carve};
use super::split::{NoSplit, Workshop};
use crate::project::model::Family;
use std::f64::consts::{PI, SQRT_2};

/// Halvings of the way between what is feasible and what is not: a side is found to a sixteenth of
/// it.
const HALVINGS: usize = 4;
/// Arms whose lengths differ by less than this share of their sum are alike.
const CENTRED: f64 = 0.2;

/// Whether a place is in the middle between two sides: a cut on one side of it would make two
/// unlike parts of a symmetric patch.
pub(super) fn centred(before: f64, after: f64) -> bool {
    (before - after).abs() < CENTRED * (before + after)
}

/// The extent of a block as large as the circle of radius π/√K around a peak: a single patch has its
/// corners on the circle, patches around a side or a corner are as large each.
pub(super) fn circle(site: &Site, shape: Shape, gaussian: f64) -> Extent {
    let side = SQRT_2 * PI / gaussian.sqrt();
    // Towards AB, BC, DC, AD.
    let reach = match shape {
        Shape::One => [0.5; 4],
        Shape::Two(Family::U) => [0.5, 1.0, 0.5, 1.0],
        Shape::Two(Family::V) => [1.0, 0.5, 1.0, 0.5],
        Shape::Four => [1.0; 4],
    };
    std::array::from_fn(|i| (reach[i] * side / site.arms[i]).min(1.0))
}

/// The largest block that is found feasible, grown from `start`, which is made smaller first if it
/// has to be; `None` if no size of it is. Sides where `start` is 1 stay where they are.
pub(super) fn grow(
    workshop: &mut Workshop<'_>,
    outline: usize,
    site: &Site,
    shape: Shape,
    start: &Extent,
) -> Result<Option<Carved>, NoSplit> {
    let mut growth = Growth {
        workshop,
        outline,
        site,
        shape,
    };
    if let Some(whole) = growth.attempt(&WHOLE)? {
        return Ok(Some(whole));
    }
    let Some((mut extent, mut best)) = growth.shrink(start)? else {
        return Ok(None);
    };
    let groups = growth.groups(&extent);
    // A side that can reach the outline leaves nothing beyond it: that comes first.
    for group in &groups {
        let mut next = extent;
        for &side in group {
            next[side] = 1.0;
        }
        if let Some(grown) = growth.attempt(&next)? {
            (extent, best) = (next, grown);
        }
    }
    for group in &groups {
        if group.iter().any(|&side| extent[side] >= 1.0) {
            continue;
        }
        let from = extent;
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let mut next = from;
            for &side in group {
                next[side] = from[side] + middle * (1.0 - from[side]);
            }
            if let Some(grown) = growth.attempt(&next)? {
                (extent, best) = (next, grown);
                low = middle;
            } else {
                high = middle;
            }
        }
    }
    Ok(Some(best))
}

struct Growth<'w, 'a, 's> {
    workshop: &'w mut Workshop<'a>,
    outline: usize,
    site: &'s Site,
    shape: Shape,
}

impl Growth<'_, '_, '_> {
    /// The block of an extent, if its patches are feasible and no larger than wanted.
    fn attempt(&mut self, extent: &Extent) -> Result<Option<Carved>, NoSplit> {
        // A whole outline as one patch is what cannot be built.
        if self.shape == Shape::One && *extent == WHOLE {
            return Ok(None);
        }
        let carved = carve(self.workshop, self.outline, self.site, self.shape, extent);
        let Ok(carved) = carved else {
            return Ok(None);
        };
        let limits = self.workshop.limits();
        let measured = self.workshop.measure(&carved.draft, &carved.block)?;
        let settled = measured
            .iter()
            .all(|m| m.as_ref().is_ok_and(|a| a.settled(&limits)));
        Ok(settled.then_some(carved))
    }

    /// The start, or the largest feasible block of its proportions. Sides on the outline stay there.
    fn shrink(&mut self, start: &Extent) -> Result<Option<(Extent, Carved)>, NoSplit> {
        if let Some(carved) = self.attempt(start)? {
            return Ok(Some((*start, carved)));
        }
        let (mut low, mut high, mut best) = (0.0, 1.0, None);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let extent = start.map(|reach| if reach < 1.0 { middle * reach } else { reach });
            if let Some(carved) = self.attempt(&extent)? {
                best = Some((extent, carved));
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(best)
    }

    /// Sides that move together, the nearest first.
    fn groups(&self, extent: &Extent) -> Vec<Vec<usize>> {
        let arms = self.site.arms;
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for [one, other] in [[3, 1], [0, 2]] {
            let open: Vec<usize> = [one, other]
                .into_iter()
                .filter(|&s| extent[s] < 1.0)
                .collect();
            if open.len() == 2 && centred(arms[one], arms[other]) {
                groups.push(open);
            } else {
                groups.extend(open.into_iter().map(|side| vec![side]));
            }
        }
        groups.sort_by(|a, b| arms[a[0]].total_cmp(&arms[b[0]]));
        groups
    }
}
