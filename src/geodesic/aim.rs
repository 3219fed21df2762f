//! Goals with known ways: what cannot lie on a shorter one need not be swept.

use super::charts::Charts;
use super::laid::{Laid, Side, V2, cross, dot, norm, sub};
use crate::surface::{HalfEdge, Mesh, Point3, SurfacePoint};

/// Goals and the lengths of ways to them that are known already.
#[derive(Debug, Default)]
pub(super) struct Aim {
    goals: Vec<(Point3, f64)>,
    /// Per vertex how much of a known way is left there at most, were it straight in space; NaN
    /// where nobody has asked.
    left: Vec<f64>,
    /// The only directions in which shorter ways leave the source, where that is known.
    pub(super) range: Option<Range>,
}

/// A range of directions around a source, laid out in a plane with it at the origin.
#[derive(Debug)]
pub(super) struct Range {
    /// The faces around the source.
    pub(super) around: Vec<Laid>,
    /// The rightmost direction.
    pub(super) low: V2,
    /// The leftmost direction, less than half a turn from there.
    pub(super) high: V2,
}

/// What of an edge beside a source lies in a range of directions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Opening {
    /// The edge, entered from the source's side.
    pub(super) entry: HalfEdge,
    /// From the origin of the entry, metres.
    pub(super) interval: [f64; 2],
    /// The source in the frame of the entry: along it, and its depth, metres.
    pub(super) along: f64,
    pub(super) depth: f64,
    /// The ends of the edge that are in the range, with their distances, metres.
    pub(super) ends: [Option<(u32, f64)>; 2],
}

impl Range {
    /// The edges opposite the source, as far as they are in the range.
    pub(super) fn openings(&self, mesh: &Mesh, charts: &Charts) -> Vec<Opening> {
        let mut openings = Vec::new();
        for laid in &self.around {
            let corners = laid.corners(charts);
            for k in 0..3 {
                let (exit, right) = corners[k];
                let (_, left) = corners[(k + 1) % 3];
                openings.extend(self.opening(mesh, exit, left, right));
            }
        }
        openings
    }

    fn opening(&self, mesh: &Mesh, exit: HalfEdge, left: V2, right: V2) -> Option<Opening> {
        let entry = mesh.twin(exit)?;
        let edge = sub(right, left);
        let length = norm(edge);
        let depth = cross(right, left) / length;
        if depth <= 0.0 {
            return None;
        }
        let middle = [self.low[0] + self.high[0], self.low[1] + self.high[1]];
        let ahead = |v: V2| dot(middle, v) > 0.0;
        // A clipped end lies on an outermost direction, and ahead of the source.
        let meet = |ray: V2| {
            let (to_left, to_right) = (cross(ray, left), cross(ray, right));
            length * (to_left / (to_left - to_right)).clamp(0.0, 1.0)
        };
        let clip_left = cross(self.high, left) > 0.0 || !ahead(left);
        let clip_right = cross(self.low, right) < 0.0 || !ahead(right);
        let interval = [
            if clip_left { meet(self.high) } else { 0.0 },
            if clip_right { meet(self.low) } else { length },
        ];
        let at = |b: f64| [0, 1].map(|i| left[i] + edge[i] * b / length);
        let [first, last] = interval.map(at);
        if interval[0] >= interval[1] || !ahead(first) || !ahead(last) {
            return None;
        }
        let inside = |v: V2| cross(self.low, v) >= 0.0 && cross(v, self.high) >= 0.0 && ahead(v);
        let end = |side: Side, place: V2| {
            let vertex = match side {
                Side::Left => mesh.origin(entry),
                Side::Right => mesh.target(entry),
            };
            inside(place).then(|| (vertex, norm(place)))
        };
        Some(Opening {
            entry,
            interval,
            along: -dot(left, edge) / length,
            depth,
            ends: [end(Side::Left, left), end(Side::Right, right)],
        })
    }
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
            range: None,
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
        let ends = self.left_at(mesh, mesh.origin(h)) + self.left_at(mesh, mesh.target(h));
        0.5 * (ends + length)
    }

    /// The same for a vertex.
    pub(super) fn left_at(&mut self, mesh: &Mesh, v: u32) -> f64 {
        if self.goals.is_empty() {
            return f64::INFINITY;
        }
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
