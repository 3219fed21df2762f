//! Straight lines through strips of faces laid out in the plane.

use super::charts::Charts;
use super::laid::{V2, along, cross, norm, placed, sub};
use crate::surface::{HalfEdge, Mesh, SurfacePoint, Tangent};

/// A straight line through a strip of faces.
pub(super) struct Line {
    /// Per crossed half-edge the share from its origin, in [0, 1].
    pub(super) crossings: Vec<f64>,
    /// Metres.
    pub(super) length: f64,
    /// Direction at the begin.
    pub(super) start: Tangent,
    /// Direction at the end, pointing onward.
    pub(super) end: Tangent,
}

/// The straight line from one point to another through a strip: `through` lists the half-edges
/// of the faces being left, in order. With an empty strip both points lie in `face`.
///
/// Returns `None` when a point is not in its end of the strip, the half-edges do not follow each
/// other, or the points coincide.
pub(super) fn line(
    mesh: &Mesh,
    charts: &Charts,
    from: &SurfacePoint,
    through: &[HalfEdge],
    to: &SurfacePoint,
    face: u32,
) -> Option<Line> {
    let first = through.first().copied().unwrap_or(HalfEdge::new(face, 0));
    let begin = charts.coordinates(mesh, first, from)?;
    // Origin and target of each crossed half-edge in the chart of the first one.
    let mut gates = Vec::with_capacity(through.len());
    let mut gate = [[0.0, 0.0], [charts.chart(first).length, 0.0]];
    let mut last = first;
    let mut frame = Frame {
        origin: [0.0; 2],
        axis: [1.0, 0.0],
    };
    for (i, &h) in through.iter().enumerate() {
        gates.push(gate);
        let twin = mesh.twin(h)?;
        frame = Frame::along(gate[1], gate[0]);
        last = twin;
        if let Some(&next) = through.get(i + 1) {
            let corner = frame.place(charts.chart(twin).apex());
            gate = if next == twin.next() {
                [gate[0], corner]
            } else if next == twin.prev() {
                [corner, gate[1]]
            } else {
                return None;
            };
        }
    }
    let end = frame.place(charts.coordinates(mesh, last, to)?);
    let along = sub(end, begin);
    let length = norm(along);
    if length <= 0.0 {
        return None;
    }
    let crossings = gates
        .iter()
        .map(|[p, q]| {
            let (at_p, at_q) = (cross(sub(*p, begin), along), cross(sub(*q, begin), along));
            let share = at_p / (at_p - at_q);
            if share.is_nan() {
                0.5
            } else {
                share.clamp(0.0, 1.0)
            }
        })
        .collect();
    Some(Line {
        crossings,
        length,
        start: Tangent {
            face: first.face(),
            direction: Charts::to_space(mesh, first, along),
        },
        end: Tangent {
            face: last.face(),
            direction: Charts::to_space(mesh, last, frame.turn_back(along)),
        },
    })
}

/// Where a chart lies in the plane of the strip.
struct Frame {
    origin: V2,
    axis: V2,
}

impl Frame {
    fn along(origin: V2, target: V2) -> Self {
        let along = sub(target, origin);
        let length = norm(along);
        Self {
            origin,
            axis: [along[0] / length, along[1] / length],
        }
    }

    fn place(&self, point: V2) -> V2 {
        placed(self.origin, self.axis, point)
    }

    fn turn_back(&self, direction: V2) -> V2 {
        along(self.axis, direction)
    }
}
