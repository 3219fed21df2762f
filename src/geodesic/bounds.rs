//! The curvature near a path, gathered in cells, and the bounds that it allows.

use super::heights::Heights;
use super::laid::Side;
use super::masses::{Mass, Masses, Whole};
use super::trail::{PLACES, Trail};
use std::ops::RangeInclusive;

/// What lies aside of a path by this share of its distance, and not above or below, is on one side
/// of it.
const ASIDE: f64 = 0.7;

/// So much curvature, radians, farther from a path than its length may be enclosed by another one
/// with the same ends: a cone must have more, twice the angle with the tangent 2.
pub(super) const FARTHEST: f64 = 2.0;

/// Curvature near a trail, on one side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Number of the place below, with fractions between two; none where it may be below several.
    pub(super) place: Option<f64>,
    /// Metres.
    height: f64,
    /// Radians.
    pub(super) curvature: f64,
    /// As of a mass.
    rough: bool,
    /// Number of its cell.
    cell: usize,
}

impl Near {
    /// Whether it lies below a bound.
    pub(super) fn is_below(&self, heights: &Heights) -> bool {
        let bound = match self.place {
            Some(place) => heights.between(place),
            None => heights.highest(),
        };
        self.height < bound
    }
}

/// Finds bounds; keeps what it allocates.
#[derive(Default)]
pub(super) struct Bounds {
    near: [Vec<Near>; 2],
    /// Whether these are fine cells.
    fine: bool,
}

impl Bounds {
    /// Bounds on both sides (left, right) that hold for every geodesic which keeps within a
    /// distance of the trail, metres; `None` where there is too much curvature beyond its length.
    pub(super) fn around(
        &mut self,
        trail: &Trail,
        within: f64,
        masses: &Masses,
    ) -> Option<[Heights; 2]> {
        let mut heights = Side::BOTH.map(|_| Heights::any(trail.length));
        // The paths that keep within the distance are as uneven as the trail.
        let within = within + 2.0 * trail.sag;
        let longest = trail.length + 2.0 * within;
        let reach = longest + within;
        let mut beyond = 0.0;
        self.clear();
        for (w, whole) in masses.wholes.iter().enumerate() {
            if !self.add(trail, (w, &whole.mass), 0..=PLACES, reach, within) {
                beyond += whole.net.max(0.0);
            }
        }
        if beyond > FARTHEST {
            return None;
        }
        let mut thin = true;
        for (heights, near) in heights.iter_mut().zip(&mut self.near) {
            heights.settle(near, longest);
            let wholes = || near.iter().map(|near| &masses.wholes[near.cell]);
            thin &= near.iter().all(|near| !near.rough)
                && heights.thin(trail, wholes(), within, longest);
        }
        self.fine = !thin;
        if thin {
            return Some(heights);
        }
        let reach = within + heights[0].highest().max(heights[1].highest());
        self.clear();
        for whole in &masses.wholes {
            self.add_parts(trail, (whole, whole.parts.clone()), masses, reach, within);
        }
        self.finish(&mut heights, longest);
        Some(heights)
    }

    /// The fine cells below the bounds that were found last, if these were looked at: there is no
    /// curvature but theirs for any geodesic beside a path for which these hold.
    pub(super) fn parts(&self) -> Option<Vec<usize>> {
        if !self.fine {
            return None;
        }
        let mut parts: Vec<usize> = self.near.iter().flatten().map(|near| near.cell).collect();
        parts.sort_unstable();
        parts.dedup();
        Some(parts)
    }

    /// Bounds on both sides of a trail over these fine cells alone.
    pub(super) fn among(
        &mut self,
        trail: &Trail,
        masses: &Masses,
        parts: &[usize],
    ) -> [Heights; 2] {
        let mut heights = Side::BOTH.map(|_| Heights::any(trail.length));
        self.clear();
        let mut parts = parts;
        for whole in &masses.wholes {
            let count = parts.partition_point(|&part| part < whole.parts.end);
            let (own, rest) = parts.split_at(count);
            parts = rest;
            if !own.is_empty() {
                let own = (whole, own.iter().copied());
                self.add_parts(trail, own, masses, trail.length, 2.0 * trail.sag);
            }
        }
        self.finish(&mut heights, trail.length);
        heights
    }

    fn finish(&mut self, heights: &mut [Heights; 2], longest: f64) {
        for (heights, near) in heights.iter_mut().zip(&mut self.near) {
            heights.settle(near, longest);
            near.retain(|n| n.is_below(heights));
            if near.iter().any(|n| n.rough) {
                heights.turn = f64::INFINITY;
            }
        }
    }

    fn clear(&mut self) {
        for near in &mut self.near {
            near.clear();
        }
    }

    /// Notes fine cells of a coarse one.
    fn add_parts(
        &mut self,
        trail: &Trail,
        (whole, parts): (&Whole, impl Iterator<Item = usize>),
        masses: &Masses,
        reach: f64,
        within: f64,
    ) {
        let Mass { at, radius, .. } = whole.mass;
        let step = trail.length / PLACES as f64;
        let (i, far) = trail.nearest(&at, 0..=PLACES);
        if far > reach + radius + step {
            return;
        }
        // What is close to the whole and to the trail is close to the same places.
        let around = 2 + (2.0 * radius / step) as usize;
        let places = i.saturating_sub(around)..=(i + around).min(PLACES);
        for part in parts {
            let mass = (part, &masses.parts[part]);
            self.add(trail, mass, places.clone(), reach, within);
        }
    }

    /// Notes curvature within reach of the places of a trail, as if it were closer by a distance;
    /// whether it is.
    fn add(
        &mut self,
        trail: &Trail,
        (cell, mass): (usize, &Mass),
        places: RangeInclusive<usize>,
        reach: f64,
        within: f64,
    ) -> bool {
        let closer = within + mass.radius;
        let (i, _) = trail.nearest(&mass.at, places);
        let (begin, end) = (i.saturating_sub(1), (i + 1).min(PLACES));
        let chord = trail.points[end] - trail.points[begin];
        let out = mass.at - trail.points[i];
        let share = (out.dot(&chord) / chord.norm_squared()).clamp(-0.5, 0.5);
        let out = out - chord * share;
        let height = out.norm();
        if height - mass.radius > reach {
            return false;
        }
        let place = i as f64 + share * (end - begin) as f64;
        let near = Near {
            place: (mass.radius < trail.length / PLACES as f64)
                .then_some(place.clamp(0.0, PLACES as f64)),
            height: (height - closer).max(0.0),
            curvature: mass.curvature,
            rough: mass.rough,
            cell,
        };
        let aside = trail.normals[i].cross(&chord).dot(&out) / chord.norm();
        // Clearly on one side, or on both.
        let clear = height > closer
            && height < trail.flat[i]
            && !mass.rough
            && aside.abs() > ASIDE * height;
        for side in Side::BOTH {
            let aside = if side == Side::Left { aside } else { -aside };
            if !clear || aside > 0.0 {
                self.near[side as usize].push(near);
            }
        }
        true
    }
}
