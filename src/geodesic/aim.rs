//! Goals with known ways: what cannot lie on a shorter one need not be swept.

use crate::surface::{HalfEdge, Mesh, Point3, SurfacePoint};

/// Goals and the lengths of ways to them that are known already.
#[derive(Debug, Default)]
pub(super) struct Aim {
    goals: Vec<(Point3, f64)>,
    /// Per vertex how much of a known way is left there at most, were it straight in space; NaN
    /// where nobody has asked.
    left: Vec<f64>,
}

/// Known lengths are exact to less than this share.
const ROUNDING: f64 = 1e-12;

impl Aim {
    pub(super) fn new(mesh: &Mesh, goals: &[(SurfacePoint, f64)]) -> Self {
        let known = |&(point, length): &(SurfacePoint, f64)| {
            (point.position(mesh), length * (1.0 + ROUNDING))
        };
        Self {
            goals: goals.iter().map(known).collect(),
            left: vec![f64::NAN; mesh.positions().len()],
        }
    }

    /// The longest known way, metres; infinite without goals.
    pub(super) fn farthest(&self) -> f64 {
        if self.goals.is_empty() {
            return f64::INFINITY;
        }
        self.goals.iter().map(|g| g.1).fold(0.0, f64::max)
    }

    /// How far from the source, metres, a point of an edge may be to lie on a shorter way to any
    /// goal.
    ///
    /// What is left of a way changes no faster than one walks, so along the edge it is at most the
    /// mean of its ends' and half the edge.
    pub(super) fn limit(&mut self, mesh: &Mesh, h: HalfEdge, length: f64) -> f64 {
        if self.goals.is_empty() {
            return f64::INFINITY;
        }
        let ends = self.left_at(mesh, mesh.origin(h)) + self.left_at(mesh, mesh.target(h));
        0.5 * (ends + length)
    }

    fn left_at(&mut self, mesh: &Mesh, v: u32) -> f64 {
        let known = self.left[v as usize];
        if !known.is_nan() {
            return known;
        }
        let at = mesh.position(v);
        let left = self
            .goals
            .iter()
            .map(|(goal, way)| way - (goal - at).norm());
        let left = left.fold(f64::NEG_INFINITY, f64::max);
        self.left[v as usize] = left;
        left
    }
}
