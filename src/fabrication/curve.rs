//! How a lamella runs in space: where a place of it is, how much it bends and how much it twists
//! there. Metres from the start of the member.

use crate::plan::{CrossingRecord, MemberRecord};
use nalgebra::{Point3, Vector3};

/// A member in the deployed state.
pub(super) struct Curve {
    points: Vec<Point3<f64>>,
    /// Arc length to each point.
    along: Vec<f64>,
    /// Surface normals at its crossings, by arc length.
    normals: Vec<(f64, Vector3<f64>)>,
}

impl Curve {
    pub(super) fn new<'a>(
        member: &MemberRecord,
        crossings: impl Iterator<Item = &'a CrossingRecord>,
    ) -> Self {
        let points: Vec<Point3<f64>> = member.polyline.iter().map(|p| (*p).into()).collect();
        let mut along = Vec::with_capacity(points.len());
        let mut sum = 0.0;
        for (i, point) in points.iter().enumerate() {
            if i > 0 {
                sum += (point - points[i - 1]).norm();
            }
            along.push(sum);
        }
        let mut normals: Vec<(f64, Vector3<f64>)> = crossings
            .map(|crossing| {
                let on = if crossing.u == member.id {
                    crossing.on_u
                } else {
                    crossing.on_v
                };
                (on.surface, crossing.normal.into())
            })
            .collect();
        normals.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            points,
            along,
            normals,
        }
    }

    pub(super) fn length(&self) -> f64 {
        self.along.last().copied().unwrap_or(0.0)
    }

    /// The place at an arc length; before and after the member, its ends.
    pub(super) fn at(&self, s: f64) -> Point3<f64> {
        let after = self.along.partition_point(|a| *a <= s);
        match (after.checked_sub(1), self.points.get(after)) {
            (None, Some(first)) => *first,
            (Some(i), Some(next)) => {
                let share = (s - self.along[i]) / (self.along[after] - self.along[i]);
                self.points[i] + share * (next - self.points[i])
            }
            (_, None) => self.points.last().copied().unwrap_or_default(),
        }
    }

    /// Curvature around a place, 1/m: the angle between the chords of length `h` before and after
    /// it, which the edges of the mesh do not roughen.
    pub(super) fn bend(&self, s: f64, h: f64) -> f64 {
        let h = h.min(0.5 * self.length());
        if h <= 0.0 {
            return 0.0;
        }
        let s = s.clamp(h, self.length() - h);
        let middle = self.at(s);
        (middle - self.at(s - h)).angle(&(self.at(s + h) - middle)) / h
    }

    /// Largest curvature on a stretch, 1/m, by chords of length `h`.
    pub(super) fn sharpest(&self, [from, to]: [f64; 2], h: f64) -> f64 {
        let steps = libm::ceil((to - from) / (0.5 * h).max(1e-3)).clamp(1.0, 1e4) as u32;
        let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(steps);
        (0..=steps).map(|i| self.bend(at(i), h)).fold(0.0, f64::max)
    }

    /// Twist around a place, rad/m: how the normals of the crossings before and after it turn
    /// about the member.
    pub(super) fn twist(&self, s: f64) -> f64 {
        let after = self.normals.partition_point(|(at, _)| *at <= s);
        let after = after.clamp(1, self.normals.len().max(1));
        let (Some(a), Some(b)) = (self.normals.get(after - 1), self.normals.get(after)) else {
            return 0.0;
        };
        let chord = self.at(b.0) - self.at(a.0);
        let length = chord.norm();
        if length <= 0.0 {
            return 0.0;
        }
        let axis = chord / length;
        let across = |n: Vector3<f64>| n - axis * n.dot(&axis);
        across(a.1).angle(&across(b.1)) / length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Positions;
    use crate::project::model::Family;

    /// A member around a cylinder of a radius, of a length.
    fn arch(radius: f64, length: f64) -> MemberRecord {
        let point = |i: u32| {
            let angle = length * f64::from(i) / 200.0 / radius;
            [radius * libm::sin(angle), 0.0, radius * libm::cos(angle)]
        };
        MemberRecord {
            id: "w.u02".to_owned(),
            patch: "w".to_owned(),
            family: Family::U,
            index: 2,
            start: 0.0,
            end: 0.0,
            boundary: false,
            length_surface: length,
            length_planar: length,
            polyline: (0..=200).map(point).collect(),
            planar: [[0.0; 2]; 2],
        }
    }

    fn crossing(at: f64, normal: [f64; 3]) -> CrossingRecord {
        let on = Positions {
            surface: at,
            planar: at,
        };
        CrossingRecord {
            id: String::new(),
            u: "w.u02".to_owned(),
            v: String::new(),
            position: [0.0; 3],
            normal,
            planar: [0.0; 2],
            on_u: on,
            on_v: on,
            angle_surface: 90.0,
            angle_planar: 60.0,
        }
    }

    #[test]
    fn an_arch_bends_by_one_over_its_radius_everywhere() {
        let curve = Curve::new(&arch(2.0, 1.5), std::iter::empty());
        assert!((curve.length() - 1.5).abs() < 1e-4);
        for s in [0.0, 0.4, 1.0, 1.5] {
            assert!(
                (curve.bend(s, 0.05) - 0.5).abs() < 2e-2,
                "{}",
                curve.bend(s, 0.05)
            );
        }
        assert!((curve.sharpest([-0.1, 1.6], 0.05) - 0.5).abs() < 2e-2);
        assert_eq!(curve.at(-1.0), curve.at(0.0));
        assert_eq!(curve.at(9.0), curve.at(1.5));
    }

    #[test]
    fn twist_is_the_turn_of_normals_about_the_member() {
        let flat = arch(1e6, 1.0);
        let (sin, cos) = libm::sincos(0.3);
        let crossings = [
            crossing(0.2, [0.0, 0.0, 1.0]),
            crossing(0.7, [0.0, sin, cos]),
        ];
        let curve = Curve::new(&flat, crossings.iter());
        assert!((curve.twist(0.4) - 0.3 / 0.5).abs() < 1e-3);
        // A normal that leans along the member does not twist it.
        let leaning = [
            crossing(0.2, [0.0, 0.0, 1.0]),
            crossing(0.7, [sin, 0.0, cos]),
        ];
        assert!(Curve::new(&flat, leaning.iter()).twist(0.4) < 1e-3);
        assert_eq!(Curve::new(&flat, std::iter::empty()).twist(0.4), 0.0);
    }
}
