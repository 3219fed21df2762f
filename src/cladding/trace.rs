//! Tracing a cladding function: the arc of equal distances that joins two corners of the map.
//!
//! Members that are as long in the plane as on the surface are the zeros of G = D - D̄ on the
//! square of shares (method notes, section 3). G vanishes at (0, 0) and (1, 1), the boundary
//! members. The arc between them is followed over the diagonal coordinate t = (start + end) / 2:
//! as long as both shares increase, the next zero lies between the point reached with the start
//! share kept and the one with the end share kept, so each step is a bracketed root. Squared
//! distances stand in for distances: the same zeros, and smoother functions.

use super::{CladdingFunction, DistanceTable, PlanarQuad};
use crate::project::model::Family;
use serde::{Deserialize, Serialize};

/// Steps along the arc.
const STEPS: usize = 96;

/// Least change of G, in lengths of a member per share, that the arc must be crossed with. Below
/// it an error of 1e-6 of the distance moves a member by 1e-4 of the side: the plan is nearly
/// congruent to the patch and defines no members.
const CONDITION: f64 = 0.01;

/// Why there is no cladding function.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum TraceFailure {
    /// The plan is (nearly) congruent to the patch there: every pair of points is as far apart in
    /// the plane as on the surface.
    Congruent {
        /// Start and end share.
        at: [f64; 2],
    },
    /// The arc leaves the corner or turns back: no members of equal length go on in order.
    TurnsBack {
        /// Start and end share up to which members exist.
        at: [f64; 2],
    },
}

/// Follows the cladding function of a family.
pub fn trace(
    table: &DistanceTable,
    quad: &PlanarQuad,
    family: Family,
) -> Result<CladdingFunction, TraceFailure> {
    let gap = Gap {
        table,
        quad,
        family,
    };
    let step = 1.0 / STEPS as f64;
    let mut samples = Vec::with_capacity(STEPS + 1);
    samples.push([0.0, 0.0, gap.slope(0.0, 0.0)]);
    let mut s = 0.0_f64;
    for k in 1..STEPS {
        let t = k as f64 * step;
        let reach = t.min(1.0 - t);
        let low = (s - step).max(-reach);
        let high = (s + step).min(reach);
        let reached = [t - step - s, t - step + s];
        let root = gap.root(t, low, high, s);
        s = match root {
            Some(root) => root,
            None if gap.is_flat(reached) => return Err(TraceFailure::Congruent { at: reached }),
            None => return Err(TraceFailure::TurnsBack { at: reached }),
        };
        let (start, end) = (t - s, t + s);
        if gap.condition(start, end) < CONDITION {
            return Err(TraceFailure::Congruent { at: [start, end] });
        }
        samples.push([start, end, gap.slope(start, end)]);
    }
    let last = samples[STEPS - 1];
    samples.push([1.0, 1.0, gap.slope(1.0, 1.0)]);
    let turned = samples
        .iter()
        .find(|s| s[2] <= 0.0 || !s[2].is_finite())
        .map_or([last[0], last[1]], |s| [s[0], s[1]]);
    CladdingFunction::new(samples).ok_or(TraceFailure::TurnsBack { at: turned })
}

/// Difference of the squared distance maps.
struct Gap<'a> {
    table: &'a DistanceTable,
    quad: &'a PlanarQuad,
    family: Family,
}

impl Gap<'_> {
    /// Value and gradient at a pair of shares.
    fn at(&self, start: f64, end: f64) -> (f64, [f64; 2]) {
        let (surface, gs) = self.table.distance_squared(start, end);
        let (plane, gp) = self.quad.distance_squared(self.family, start, end);
        (surface - plane, [gs[0] - gp[0], gs[1] - gp[1]])
    }

    /// Slope of the arc: implicit derivative.
    fn slope(&self, start: f64, end: f64) -> f64 {
        let (_, [by_start, by_end]) = self.at(start, end);
        -by_start / by_end
    }

    /// Whether D - D̄ hardly changes in any direction, so that equal lengths single out nothing.
    fn is_flat(&self, [start, end]: [f64; 2]) -> bool {
        let (_, [by_start, by_end]) = self.at(start, end);
        let (d2, _) = self.table.distance_squared(start, end);
        by_start.abs().max(by_end.abs()) < CONDITION * 2.0 * d2
    }

    /// How fast D - D̄ changes across the arc, in lengths of the member per share.
    fn condition(&self, start: f64, end: f64) -> f64 {
        let (_, [by_start, by_end]) = self.at(start, end);
        let (d2, _) = self.table.distance_squared(start, end);
        (by_end - by_start).abs() / (4.0 * d2)
    }

    /// Zero over s on the antidiagonal (t - s, t + s), bracketed: Newton's steps while they stay
    /// inside the bracket, bisection otherwise.
    fn root(&self, t: f64, mut low: f64, mut high: f64, guess: f64) -> Option<f64> {
        let value = |s: f64| self.at(t - s, t + s).0;
        let (at_low, at_high) = (value(low), value(high));
        if at_low == 0.0 || at_high == 0.0 || (at_low > 0.0) == (at_high > 0.0) {
            return None;
        }
        let mut s = guess.clamp(low, high);
        for _ in 0..100 {
            let (value, [by_start, by_end]) = self.at(t - s, t + s);
            if (value > 0.0) == (at_low > 0.0) {
                low = s;
            } else {
                high = s;
            }
            let newton = s - value / (by_end - by_start);
            if (newton - s).abs() < 1e-15 || high - low < 1e-15 {
                return Some(s);
            }
            s = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
        }
        Some(s)
    }
}

#[cfg(test)]
mod tests {
    use super::super::nodes;
    use super::*;
    use crate::layout::SideLengths;
    use proptest::prelude::*;

    /// A table of a plane quadrilateral with its own angle at A.
    fn plane(quad: &PlanarQuad, family: Family) -> DistanceTable {
        let rows: Vec<Vec<f64>> = nodes(9)
            .map(|s| {
                nodes(9)
                    .map(|e| quad.distance_squared(family, s, e).0.sqrt())
                    .collect()
            })
            .collect();
        DistanceTable::new(&rows)
    }

    /// The exact cladding function of a developable patch (method notes, section 3).
    fn moebius(surface: &PlanarQuad, plan: &PlanarQuad, family: Family, share: f64) -> f64 {
        let opening = |quad: &PlanarQuad| {
            let angles = quad.angles();
            let (at_start, at_end) = match family {
                Family::U => (angles[0], angles[3]),
                Family::V => (angles[0], angles[1]),
            };
            (
                libm::cos(at_start),
                libm::cos(at_end),
                -libm::cos(at_start + at_end),
            )
        };
        let length = |t: f64, a: f64| plan.distance_squared(family, t, a).0.sqrt();
        let d = length(0.0, 0.0);
        let start_side = (plan.start(family, 1.0) - plan.start(family, 0.0)).norm();
        let end_side = (plan.end(family, 1.0) - plan.end(family, 0.0)).norm();
        let (ca, cd, cf) = opening(surface);
        let (pa, pd, pf) = opening(plan);
        let u1 = share * start_side;
        -u1 * d * (ca - pa) / (d * (cd - pd) + u1 * (cf - pf)) / end_side
    }

    proptest! {
        #[test]
        fn on_developable_patches_it_is_the_moebius_function(
            lengths in [0.8..1.25_f64, 0.8..1.25, 0.8..1.25, 0.8..1.25],
            at in 0.35..0.65_f64,
            to in prop_oneof![0.05..0.3_f64, 0.7..0.95],
        ) {
            let [ab, bc, cd, da] = lengths;
            let sides = SideLengths { ab, bc, cd, da };
            let (low, high) = sides.convex_range().unwrap();
            let surface = PlanarQuad::new(sides, low + (high - low) * at).unwrap();
            let plan = PlanarQuad::new(sides, low + (high - low) * to).unwrap();
            for family in [Family::U, Family::V] {
                let table = plane(&surface, family);
                if let Ok(f) = trace(&table, &plan, family) {
                    for [start, end] in f.samples() {
                        let exact = moebius(&surface, &plan, family, start);
                        prop_assert!((end - exact).abs() < 1e-9, "{start}: {end} {exact}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_sheared_square_keeps_even_shares() {
        let sides = SideLengths {
            ab: 1.0,
            bc: 1.0,
            cd: 1.0,
            da: 1.0,
        };
        let surface = PlanarQuad::new(sides, 1.5).unwrap();
        let plan = PlanarQuad::new(sides, 0.6).unwrap();
        for family in [Family::U, Family::V] {
            let f = trace(&plane(&surface, family), &plan, family).unwrap();
            assert!(f.samples().all(|[start, end]| (start - end).abs() < 1e-12));
            assert!(
                f.slope_range()
                    .iter()
                    .all(|slope| (slope - 1.0).abs() < 1e-9)
            );
        }
    }

    #[test]
    fn a_congruent_plan_is_refused() {
        let sides = SideLengths {
            ab: 1.0,
            bc: 1.1,
            cd: 0.9,
            da: 1.0,
        };
        let quad = PlanarQuad::new(sides, 1.3).unwrap();
        let close = PlanarQuad::new(sides, 1.302).unwrap();
        let table = plane(&quad, Family::U);
        for plan in [quad, close] {
            let failure = trace(&table, &plan, Family::U).unwrap_err();
            assert!(
                matches!(failure, TraceFailure::Congruent { .. }),
                "{failure:?}"
            );
        }
    }

    /// Dome on the unit square over a flat plan of the same outline: no members in between.
    #[test]
    fn a_plan_in_the_forbidden_gap_turns_back() {
        let sides = SideLengths {
            ab: 1.0,
            bc: 1.0,
            cd: 1.0,
            da: 1.0,
        };
        let plan = PlanarQuad::new(sides, std::f64::consts::FRAC_PI_2).unwrap();
        let bulge = |s: f64, e: f64| {
            let flat = libm::hypot(1.0, s - e);
            let middle = 0.5 * (s + e);
            flat * (1.0 + 0.2 * middle * (1.0 - middle))
        };
        let rows: Vec<Vec<f64>> = nodes(17)
            .map(|s| nodes(17).map(|e| bulge(s, e)).collect())
            .collect();
        let failure = trace(&DistanceTable::new(&rows), &plan, Family::U).unwrap_err();
        assert!(matches!(failure, TraceFailure::TurnsBack { .. }));
    }
}
