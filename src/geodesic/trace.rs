//! Paths found again from the directions in which they arrive.
//!
//! The last leg of a shortest path is a straight line of known direction and length. Followed
//! backward over the faces it ends at its root: a vertex with an approach of its own, or the source.

use super::charts::{BORDER, Charts};
use super::path::{Leg, Path};
use super::solve::{Approach, Swept};
use super::window::SOURCE;
use crate::surface::{HalfEdge, Mesh, SurfacePoint};

/// A line that passes a vertex closer than this share of the edge may go through it.
const PASSING: f64 = 1e-9;

/// The way through a vertex is taken if it is as long up to rounding.
const EQUAL: f64 = 1.0 + 1e-13;

/// A solved field and what it was solved on.
pub(super) struct Tracer<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) charts: &'a Charts,
    pub(super) source: &'a SurfacePoint,
    pub(super) swept: &'a Swept,
}

impl Tracer<'_> {
    /// The path from the source to a point with this distance and approach. `None` if the line
    /// is lost in rounding or the point is the source.
    pub(super) fn path(
        &self,
        target: SurfacePoint,
        distance: f64,
        approach: Approach,
    ) -> Option<Path> {
        let mut legs = Vec::new();
        let (mut to, mut distance, mut approach) = (target, distance, approach);
        while approach.entry != BORDER {
            let (from, through) = self.leg(to, distance, approach)?;
            let face = HalfEdge(approach.entry).face();
            legs.push(Leg {
                from,
                through,
                to,
                face,
            });
            let SurfacePoint::Vertex(v) = from else {
                break;
            };
            if from == *self.source {
                break;
            }
            to = from;
            distance = self.swept.distances[v as usize];
            approach = self.swept.approaches[v as usize];
        }
        legs.reverse();
        Path::through(self.mesh, self.charts, &legs)
    }

    /// The last straight leg to a point: where it starts, and the half-edges it crosses in order.
    fn leg(
        &self,
        to: SurfacePoint,
        distance: f64,
        approach: Approach,
    ) -> Option<(SurfacePoint, Vec<HalfEdge>)> {
        let mut h = HalfEdge(approach.entry);
        let mut at = self.charts.coordinates(self.mesh, h, &to)?;
        let mut root = [approach.x, approach.y];
        let mut through = Vec::new();
        // A shortest path meets a face once.
        for _ in 0..=self.mesh.faces().len() {
            if let Some(root) = self.root_in(h.face(), approach.root) {
                through.reverse();
                return Some((root, through));
            }
            let length = self.charts.chart(h).length;
            let share = at[1] / (at[1] - root[1]);
            let crossing = (at[0] + (root[0] - at[0]) * share) / length;
            let passed = if crossing < PASSING {
                Some((self.mesh.origin(h), 0.0))
            } else if crossing > 1.0 - PASSING {
                Some((self.mesh.target(h), length))
            } else if crossing.is_nan() {
                return None;
            } else {
                None
            };
            if let Some((v, x)) = passed {
                let (dx, dy) = (x - at[0], at[1]);
                let through_vertex = self.swept.distances[v as usize] + (dx * dx + dy * dy).sqrt();
                if through_vertex <= distance * EQUAL && to != SurfacePoint::Vertex(v) {
                    through.reverse();
                    return Some((SurfacePoint::Vertex(v), through));
                }
            }
            let twin = self.mesh.twin(h)?;
            through.push(twin);
            (h, at, root) = self.across(twin, at, root, length);
        }
        None
    }

    /// The root, if it lies in or on a face.
    fn root_in(&self, face: u32, root: u32) -> Option<SurfacePoint> {
        let point = if root == SOURCE {
            *self.source
        } else {
            SurfacePoint::Vertex(root)
        };
        point.bary_in(self.mesh, face).map(|_| point)
    }

    /// Carries the line from the chart of a half-edge's twin over the face above the half-edge to
    /// the chart of the edge where it leaves that face.
    fn across(
        &self,
        h: HalfEdge,
        at: [f64; 2],
        root: [f64; 2],
        length: f64,
    ) -> (HalfEdge, [f64; 2], [f64; 2]) {
        let turned = |[x, y]: [f64; 2]| [length - x, -y];
        let (at, root) = (turned(at), turned(root));
        let chart = self.charts.chart(h);
        let [cx, cy] = chart.apex();
        let side = (root[0] - at[0]) * (cy - at[1]) - (root[1] - at[1]) * (cx - at[0]);
        if side > 0.0 {
            // C lies left of the line, which leaves through B→C.
            let [ux, uy] = chart.right;
            let to_chart = |[x, y]: [f64; 2]| {
                let (x, y) = (x - length, y);
                [-(x * ux + y * uy), x * uy - y * ux]
            };
            (h.next(), to_chart(at), to_chart(root))
        } else {
            let [ux, uy] = chart.left;
            let to_chart =
                |[x, y]: [f64; 2]| [chart.left_length - (x * ux + y * uy), x * uy - y * ux];
            (h.prev(), to_chart(at), to_chart(root))
        }
    }
}
