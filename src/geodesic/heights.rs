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
//! The curvature is known here by its greatest density or gathered in cells ([`Masses`]), which bounds
//! a whole block of neighbouring geodesics at once; `near` goes on with single vertices.

use super::bounds::{FARTHEST, Near};
use super::masses::{Masses, Whole};
use super::trail::{PLACES, Trail};

/// Rounds of the comparison.
const ROUNDS: usize = 40;

/// The comparison is of first order: what curvature adds to distances beside the path is some per
/// cent.
const MARGIN: f64 = 1.1;

/// A round that lowers the bound by less than this share is the last.
const SETTLED: f64 = 0.96;

/// Bounds below this share of what a third of a face reaches leave only vertices next to a path.
const THIN: f64 = 0.7;

/// Bounds of the distance of other geodesics from a path, on one side of it.
#[derive(Debug, Clone)]
pub(super) struct Heights {
    /// At the places of the path, metres.
    pub(super) at: [f64; PLACES + 1],
    /// The curvature that may be enclosed, radians.
    pub(super) turn: f64,
}

impl Heights {
    /// What holds for all vertices that can matter.
    pub(super) fn any(length: f64) -> Self {
        Self {
            at: [length; PLACES + 1],
            turn: f64::INFINITY,
        }
    }

    /// Bounds for a path of a length anywhere on a mesh, on both sides, where its curvature leaves no
    /// more room than beside the faces of the path: the comparison of [`Heights::thin`] with the
    /// greatest density of all, which is at most
    ///
    /// ```text
    /// Y = λ f / (1 - λ),   λ = ρ (L² / 8 + c (L + 2 c))
    /// ```
    pub(super) fn calm(masses: &Masses, length: f64) -> Option<Self> {
        let all = masses.all?;
        if all.curvature > FARTHEST {
            return None;
        }
        let (cell, rim) = (all.cell, 2.0 * all.cell);
        let factor = MARGIN * widening(all.curvature);
        let reach = length + 2.0 * cell;
        let share = factor * all.densest * (length * length / 8.0 + cell * reach);
        let highest = share * rim / (1.0 - share);
        let turn = all.densest * reach * (highest + rim);
        let low = share < 1.0 && highest <= THIN * all.cell;
        low.then(|| Self {
            at: std::array::from_fn(|i| {
                let x = i.min(PLACES - i) as f64 / PLACES as f64 * length;
                highest.min(factor * turn * x)
            }),
            turn,
        })
    }

    /// Applies the comparison until it changes little.
    pub(super) fn settle(&mut self, near: &mut Vec<Near>, length: f64) {
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

    /// Applies the comparison with the density of curvature ρ near a trail instead of single masses,
    /// and tells whether what is left is as low as the faces.
    ///
    /// The third of the faces about a vertex reaches c from it at most. Those about the vertices of a
    /// strip of width y are no larger than the strip and f = 2 c beside it, so they have no more
    /// curvature than ρ (y + f) by length, though each has it in one place, c aside:
    ///
    /// ```text
    /// y(x) <= ∫ ρ (y + f) (g(x, r) + c) dr,   y(x) <= min(x, L - x) ∫ ρ (y + f) dr
    /// ```
    pub(super) fn thin<'m>(
        &mut self,
        trail: &Trail,
        wholes: impl Iterator<Item = &'m Whole>,
        within: f64,
        length: f64,
    ) -> bool {
        let step = length / PLACES as f64;
        let mut densities = [0.0_f64; PLACES];
        let (mut cell, mut least) = (0.0_f64, f64::INFINITY);
        for whole in wholes {
            let mass = &whole.mass;
            let far: [f64; PLACES + 1] =
                std::array::from_fn(|i| (trail.points[i] - mass.at).norm());
            for (k, density) in densities.iter_mut().enumerate() {
                let height = self.at[k].max(self.at[k + 1]);
                let reach = height + within + mass.radius + whole.cell + step;
                if far[k].min(far[k + 1]) < reach {
                    *density = density.max(whole.densest);
                    cell = cell.max(whole.cell);
                    least = least.min(whole.cell);
                }
            }
        }
        let rim = 2.0 * cell;
        for _ in 0..ROUNDS {
            let before = self.highest();
            let mut pulls = [0.0; PLACES];
            for (k, pull) in pulls.iter_mut().enumerate() {
                *pull = densities[k] * step * (self.at[k].max(self.at[k + 1]) + rim);
            }
            // Those beyond the ends reach over them.
            let beyond = cell / step * (pulls[0] + pulls[PLACES - 1]);
            let turn = pulls.iter().sum::<f64>() + beyond;
            self.turn = self.turn.min(turn);
            let factor = MARGIN * widening(turn);
            let middle = |k: usize| (k as f64 + 0.5) * step;
            let mut passed = 0.0;
            let mut rest: f64 = (0..PLACES).map(|k| pulls[k] * (length - middle(k))).sum();
            for k in 0..=PLACES {
                let x = k as f64 * step;
                // What lies about a place counts at the middle of its stretch: a quarter too little.
                let about = &pulls[k.saturating_sub(1)..(k + 1).min(PLACES)];
                let about = 0.25 * step * about.iter().sum::<f64>();
                let bound = (passed * (length - x) + rest.max(0.0) * x) / length + about;
                let bound = (bound + cell * turn).min(turn * x.min(length - x));
                self.at[k] = self.at[k].min(factor * bound);
                if k < PLACES {
                    passed += pulls[k] * middle(k);
                    rest -= pulls[k] * (length - middle(k));
                }
            }
            if self.highest() > SETTLED * before {
                break;
            }
        }
        self.highest() <= THIN * least
    }

    /// Metres.
    pub(super) fn highest(&self) -> f64 {
        self.at.iter().fold(0.0, |a, &b| a.max(b))
    }

    /// The bound about a place and a fraction.
    pub(super) fn between(&self, place: f64) -> f64 {
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
