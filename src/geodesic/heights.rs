//! How far from a geodesic another one with the same ends can run.
//!
//! Two geodesics with common ends enclose as much curvature as the sum of the angles between them,
//! or more (Gauss-Bonnet; bends at saddles and borders only add to it). So let y(x) bound the
//! distance between them over the arc length x of one of them, of length L: the other one turns
//! towards it only by the positive curvature below it, and
//!
//! ```text
//! y(x) <= Σ κ g(x, r),   g(x, r) = min(x, r) (L - max(x, r)) / L,
//! ```
//!
//! over the vertices of curvature κ > 0 at arc lengths r below y. Begun with all curvature within L,
//! this is applied again and again: every result is a bound. Where no
//! geodesic lies on that side it falls until nothing is below it; on smooth surfaces that is
//! Sturm's comparison. The sum is exact for narrow lenses; wide ones get the factor by which a
//! cone's lens is wider ([`widening`]).
//!
//! Curvature is gathered in cells here ([`Masses`]), which bounds a whole block of neighbouring
//! geodesics at once; `near` goes on with single vertices.

use super::laid::Side;
use super::masses::{Mass, Masses};
use super::trail::{PLACES, Trail};
use std::ops::RangeInclusive;

/// Rounds of the comparison.
const ROUNDS: usize = 40;

/// The comparison is of first order: what curvature adds to distances beside the path is some per
/// cent.
const MARGIN: f64 = 1.1;

/// A round that lowers the bound by less than this share is the last.
const SETTLED: f64 = 0.96;

/// What lies aside of a path by this share of its distance, and not above or below, is on one side
/// of it.
const ASIDE: f64 = 0.7;

/// So much curvature, radians, farther from a path than its length may be enclosed by another one
/// with the same ends: a cone must have more, twice the angle with the tangent 2.
const FARTHEST: f64 = 2.0;

/// Bounds of the distance of other geodesics from a path, on one side of it.
#[derive(Debug, Clone)]
pub(super) struct Heights {
    /// At the places of the path, metres.
    pub(super) at: [f64; PLACES + 1],
    /// The curvature that may be enclosed, radians.
    pub(super) turn: f64,
}

/// Curvature near a trail, on one side.
#[derive(Debug, Clone, Copy)]
struct Near {
    /// Number of the place below, with fractions between two; none where it may be below several.
    place: Option<f64>,
    /// Metres.
    height: f64,
    /// Radians.
    curvature: f64,
    /// As of a mass.
    rough: bool,
    /// Number of its fine cell.
    part: usize,
}

impl Near {
    /// Whether it lies below a bound.
    fn is_below(&self, heights: &Heights) -> bool {
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
        for whole in &masses.wholes {
            if !self.add(trail, (0, &whole.mass), 0..=PLACES, reach, within) {
                beyond += whole.net.max(0.0);
            }
        }
        if beyond > FARTHEST {
            return None;
        }
        for (heights, near) in heights.iter_mut().zip(&mut self.near) {
            heights.settle(near, longest);
        }
        let reach = within + heights[0].highest().max(heights[1].highest());
        let step = trail.length / PLACES as f64;
        self.clear();
        for whole in &masses.wholes {
            let mass = &whole.mass;
            let (i, far) = trail.nearest(&mass.at, 0..=PLACES);
            if far > reach + mass.radius + step {
                continue;
            }
            // What is close to the whole and to the trail is close to the same places.
            let around = 2 + (2.0 * mass.radius / step) as usize;
            let places = i.saturating_sub(around)..=(i + around).min(PLACES);
            for part in whole.parts.clone() {
                let mass = (part, &masses.parts[part]);
                self.add(trail, mass, places.clone(), reach, within);
            }
        }
        self.finish(&mut heights, longest);
        Some(heights)
    }

    /// The fine cells below the bounds that were found last: there is no curvature but theirs for any
    /// geodesic beside a path for which these hold.
    pub(super) fn parts(&self) -> Vec<usize> {
        let mut parts: Vec<usize> = self.near.iter().flatten().map(|near| near.part).collect();
        parts.sort_unstable();
        parts.dedup();
        parts
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
        for &part in parts {
            let mass = (part, &masses.parts[part]);
            self.add(trail, mass, 0..=PLACES, trail.length, 2.0 * trail.sag);
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

    /// Notes curvature within reach of the places of a trail, as if it were closer by a distance;
    /// whether it is.
    fn add(
        &mut self,
        trail: &Trail,
        (part, mass): (usize, &Mass),
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
            part,
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

impl Heights {
    /// What holds for all vertices that can matter.
    fn any(length: f64) -> Self {
        Self {
            at: [length; PLACES + 1],
            turn: f64::INFINITY,
        }
    }

    /// Applies the comparison until it changes little.
    fn settle(&mut self, near: &mut Vec<Near>, length: f64) {
        let step = length / PLACES as f64;
        for _ in 0..ROUNDS {
            let mut turns = [0.0; PLACES + 1];
            let (mut turn, mut anywhere) = (0.0, 0.0);
            let before = self.highest();
            // The bound only falls.
            near.retain(|n| n.is_below(self));
            for n in near.iter() {
                turn += n.curvature;
                let Some(place) = n.place else {
                    anywhere += n.curvature;
                    continue;
                };
                let i = (place as usize).min(PLACES - 1);
                let share = place - i as f64;
                turns[i] += n.curvature * (1.0 - share);
                turns[i + 1] += n.curvature * share;
            }
            self.turn = turn;
            // Falls off from place to place by the turns there, from zero to zero.
            let mut slope: f64 = (1..PLACES)
                .map(|i| turns[i] * (1.0 - i as f64 / PLACES as f64))
                .sum();
            let factor = MARGIN * widening(turn);
            let mut y = 0.0_f64;
            for i in 0..=PLACES {
                let around = turns[i.saturating_sub(1)..=(i + 1).min(PLACES)].iter();
                // Between two places it rises above both by no more than the turns there.
                let bound = y.max(0.0) + 0.25 * step * around.sum::<f64>();
                // The sum is greatest where the curvature is right below.
                let x = i as f64 * step;
                let bound = bound + anywhere * x * (length - x) / length;
                self.at[i] = self.at[i].min(factor * bound);
                if i > 0 {
                    slope -= turns[i];
                }
                y += slope * step;
            }
            if self.highest() > SETTLED * before {
                break;
            }
        }
    }

    /// Metres.
    pub(super) fn highest(&self) -> f64 {
        self.at.iter().fold(0.0, |a, &b| a.max(b))
    }

    /// The bound about a place and a fraction.
    fn between(&self, place: f64) -> f64 {
        let i = (place as usize).min(PLACES - 1);
        self.at[i].max(self.at[i + 1])
    }

    /// By places the bound between each and the next, times a factor, for this path or one beside
    /// it: places of two such paths may be one apart.
    pub(super) fn limits(&self, factor: f64) -> [f64; PLACES] {
        std::array::from_fn(|i| {
            let around = &self.at[i.saturating_sub(1)..=(i + 2).min(PLACES)];
            factor * around.iter().fold(0.0_f64, |a, &b| a.max(b))
        })
    }
}

/// A lens over this much curvature, radians, is wider by at most this factor than the sum says: that
/// of a cone, twice the tangent of half the angle over the angle.
pub(super) fn widening(turn: f64) -> f64 {
    if turn < 1e-4 {
        1.0
    } else if turn < 3.0 {
        2.0 * libm::tan(0.5 * turn) / turn
    } else {
        f64::INFINITY
    }
}
