//! The planar patch: a convex quadrilateral with straight sides as long as those of the surface
//! patch. One angle is free.

use crate::layout::SideLengths;
use crate::project::model::Family;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A point in the plane, metres.
pub type Point2 = nalgebra::Point2<f64>;

impl SideLengths {
    /// Open interval of the angle at A, radians, for which the planar quadrilateral exists and
    /// is convex (method notes, section 3); `None` when there is none.
    pub fn convex_range(self) -> Option<(f64, f64)> {
        let Self {
            ab: a,
            bc: b,
            cd: c,
            da: d,
        } = self;
        // A straight angle at B, then at D, bounds from below; one at C bounds from above.
        let low = opposite_angle(a + b, d, c).max(opposite_angle(c + d, a, b));
        let high = opposite_angle(a, d, b + c);
        (low < high).then_some((low, high))
    }
}

/// Angle between two sides of a triangle, opposite to the third; 0 or pi where the third side is
/// too short or too long to close it.
fn opposite_angle(p: f64, q: f64, opposite: f64) -> f64 {
    let cos = (p * p + q * q - opposite * opposite) / (2.0 * p * q);
    libm::acos(cos.clamp(-1.0, 1.0))
}

/// A convex planar quadrilateral A, B, C, D, counter-clockwise, with A at the origin and B on the
/// positive x-axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PlanarQuad {
    /// Corners A, B, C, D, metres.
    pub corners: [Point2; 4],
}

impl PlanarQuad {
    /// The quadrilateral with these sides and the angle `alpha` at A, radians; `None` where it
    /// does not exist or is not strictly convex.
    pub fn new(sides: SideLengths, alpha: f64) -> Option<Self> {
        let (low, high) = sides.convex_range()?;
        if !(alpha > low && alpha < high) {
            return None;
        }
        let a = Point2::origin();
        let b = Point2::new(sides.ab, 0.0);
        let d = Point2::new(sides.da * libm::cos(alpha), sides.da * libm::sin(alpha));
        // C is where the circles around B and D meet on the far side of BD.
        let bd = d - b;
        let f2 = bd.norm_squared();
        let along = (f2 + sides.bc * sides.bc - sides.cd * sides.cd) / (2.0 * f2);
        let height2 = sides.bc * sides.bc / f2 - along * along;
        if height2 <= 0.0 {
            return None;
        }
        let away = nalgebra::Vector2::new(bd.y, -bd.x);
        let c = b + bd * along + away * height2.sqrt();
        Some(Self {
            corners: [a, b, c, d],
        })
    }

    /// The side on which a family starts, at the share `t` of its length.
    pub fn start(&self, family: Family, t: f64) -> Point2 {
        let [a, b, _, d] = self.corners;
        a + (if family == Family::U { b } else { d } - a) * t
    }

    /// The side on which a family ends, at the share `t` of its length.
    pub fn end(&self, family: Family, t: f64) -> Point2 {
        let [_, b, c, d] = self.corners;
        let from = if family == Family::U { d } else { b };
        from + (c - from) * t
    }

    /// Squared length of the straight member with these shares, and its derivatives by them:
    /// the planar distance map (method notes, section 2), a polynomial of degree two.
    pub fn distance_squared(&self, family: Family, start: f64, end: f64) -> (f64, [f64; 2]) {
        let v = self.end(family, end) - self.start(family, start);
        let along_start = self.start(family, 1.0) - self.start(family, 0.0);
        let along_end = self.end(family, 1.0) - self.end(family, 0.0);
        (
            v.norm_squared(),
            [-2.0 * v.dot(&along_start), 2.0 * v.dot(&along_end)],
        )
    }

    /// Interior angles at A, B, C, D, radians.
    pub fn angles(&self) -> [f64; 4] {
        std::array::from_fn(|i| {
            let p = self.corners[i];
            let next = self.corners[(i + 1) % 4] - p;
            let previous = self.corners[(i + 3) % 4] - p;
            libm::atan2(next.perp(&previous), next.dot(&previous))
        })
    }

    /// Square metres.
    pub fn area(&self) -> f64 {
        let [e, f] = self.diagonal_vectors();
        0.5 * e.perp(&f)
    }

    /// Lengths of the diagonals AC and BD, metres.
    pub fn diagonals(&self) -> [f64; 2] {
        self.diagonal_vectors().map(|v| v.norm())
    }

    fn diagonal_vectors(&self) -> [nalgebra::Vector2<f64>; 2] {
        let [a, b, c, d] = self.corners;
        [c - a, d - b]
    }

    /// How far the quadrilateral is from a corner being straight, radians.
    pub fn convexity_margin(&self) -> f64 {
        self.angles()
            .into_iter()
            .map(|angle| PI - angle)
            .fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sides() -> impl Strategy<Value = SideLengths> {
        [0.2..3.0_f64, 0.2..3.0, 0.2..3.0, 0.2..3.0].prop_map(|[ab, bc, cd, da]| SideLengths {
            ab,
            bc,
            cd,
            da,
        })
    }

    proptest! {
        #[test]
        fn the_convex_range_is_exactly_where_a_convex_quad_exists(s in sides(), t in 0.001..0.999_f64) {
            if let Some((low, high)) = s.convex_range() {
                let inside = PlanarQuad::new(s, low + (high - low) * t).unwrap();
                prop_assert!(inside.convexity_margin() > 0.0);
                prop_assert!(inside.angles().iter().all(|&x| x > 0.0));
                let [a, b, c, d] = inside.corners;
                for (p, q, length) in [(a, b, s.ab), (b, c, s.bc), (c, d, s.cd), (d, a, s.da)] {
                    prop_assert!(((q - p).norm() - length).abs() < 1e-9 * length.max(1.0));
                }
                // Both ends of the range are where a corner becomes straight or folds.
                for end in [low, high] {
                    let near = PlanarQuad::new(s, end + (0.5 * (low + high) - end) * 1e-7);
                    let angles = near.map_or([0.0; 4], |quad| quad.angles());
                    let extreme = angles
                        .iter()
                        .map(|x| x.min(PI - x))
                        .fold(f64::INFINITY, f64::min);
                    prop_assert!(extreme < 0.02, "{extreme}");
                }
            }
        }

        #[test]
        fn the_planar_distance_has_the_gradient_it_says(s in sides(), t in 0.05..0.95_f64, u in [0.0..1.0_f64, 0.0..1.0]) {
            if let Some((low, high)) = s.convex_range() {
                let quad = PlanarQuad::new(s, low + (high - low) * t).unwrap();
                for family in [Family::U, Family::V] {
                    let (_, g) = quad.distance_squared(family, u[0], u[1]);
                    let h = 1e-6;
                    let by_start = (quad.distance_squared(family, u[0] + h, u[1]).0
                        - quad.distance_squared(family, u[0] - h, u[1]).0) / (2.0 * h);
                    let by_end = (quad.distance_squared(family, u[0], u[1] + h).0
                        - quad.distance_squared(family, u[0], u[1] - h).0) / (2.0 * h);
                    prop_assert!((g[0] - by_start).abs() < 1e-6 && (g[1] - by_end).abs() < 1e-6);
                }
            }
        }
    }

    #[test]
    fn a_square_has_its_diagonals_and_area() {
        let s = SideLengths {
            ab: 1.0,
            bc: 1.0,
            cd: 1.0,
            da: 1.0,
        };
        assert_eq!(s.convex_range(), Some((0.0, PI)));
        let quad = PlanarQuad::new(s, PI / 3.0).unwrap();
        assert!((quad.diagonals()[0] - 3.0_f64.sqrt()).abs() < 1e-12);
        assert!((quad.area() - 0.75_f64.sqrt()).abs() < 1e-12);
    }
}
