//! Flat coordinates of every face, one chart per half-edge.
//!
//! The chart of a half-edge A→B has its origin at A, its first axis along the edge, and the
//! face above: corners A = (0, 0), B = (length, 0) and the opposite corner C. Neighbouring charts
//! are related by the unit vectors A→C and C→B alone, so that unfolding needs neither angles
//! nor trigonometry.

use crate::surface::{HalfEdge, Mesh, Point3, SurfacePoint, Vector3};

/// No half-edge: the border.
pub(super) const BORDER: u32 = u32::MAX;

/// The flat face above a half-edge A→B, seen from that edge. One cache line.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Chart {
    /// |AB|, metres.
    pub(super) length: f64,
    /// Unit vector A→C.
    pub(super) left: [f64; 2],
    /// |AC|, metres.
    pub(super) left_length: f64,
    /// Unit vector C→B.
    pub(super) right: [f64; 2],
}

impl Chart {
    /// The opposite corner C.
    pub(super) fn apex(&self) -> [f64; 2] {
        [
            self.left[0] * self.left_length,
            self.left[1] * self.left_length,
        ]
    }
}

/// What it takes to lay the face above a half-edge A→B beside the one below.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    /// The opposite corner C: along and across AB, in shares of it.
    pub(super) apex: [f64; 2],
    /// The half-edge A→C of the face beyond, or `BORDER`.
    pub(super) left_exit: u32,
    /// The half-edge C→B of the face beyond, or `BORDER`.
    pub(super) right_exit: u32,
}

/// What the solver knows of a mesh: charts, corner angles and the vertices that bend paths.
pub(super) struct Charts {
    /// Per half-edge.
    pub(super) of: Vec<Chart>,
    /// Per half-edge.
    pub(super) steps: Vec<Step>,
    /// Per half-edge the angle of its face at its origin, radians.
    pub(super) angles: Vec<f64>,
    /// Per vertex the sum of angles around it, radians.
    pub(super) total_angles: Vec<f64>,
    /// Per vertex what its angles lack to the full turn, radians; none at the border.
    pub(super) curvatures: Vec<f64>,
    /// Per vertex the least height of the faces about it, over any of their sides, metres.
    pub(super) least_heights: Vec<f64>,
    /// Per vertex whether a shortest path can bend there.
    pub(super) bends: Vec<bool>,
    /// The first face without directions.
    pub(super) degenerate: Option<u32>,
}

/// A vertex whose angles exceed the full turn by less lets paths pass straight: even behind a row of
/// such vertices its shadow stays narrower than what a target is widened by anyway
/// (`solve::WIDENING`). A shadow grows with the way, so this is little more than rounding.
const FLAT: f64 = 1e-14;

impl Charts {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let count = mesh.faces().len() as u32;
        let mut charts = Vec::with_capacity(3 * count as usize);
        let mut angles = Vec::with_capacity(3 * count as usize);
        let mut total_angles = vec![0.0; mesh.positions().len()];
        let mut least_heights = vec![f64::INFINITY; mesh.positions().len()];
        let mut degenerate = None;
        for face in 0..count {
            let corners = mesh.corners(face);
            let double_area = double_area(&corners);
            let sides = [0, 1, 2].map(|i| (corners[(i + 1) % 3] - corners[i]).norm());
            let height = double_area / sides.into_iter().fold(0.0, f64::max);
            for &v in &mesh.faces()[face as usize] {
                let least = &mut least_heights[v as usize];
                *least = least.min(height);
            }
            for corner in 0..3 {
                let h = HalfEdge::new(face, corner);
                let [a, b, c] = [0, 1, 2].map(|i| corners[(corner as usize + i) % 3]);
                let (ab, ac, cb) = (b - a, c - a, b - c);
                let (length, left, right) = (ab.norm(), ac.norm(), cb.norm());
                let smallest = length.min(left).min(right);
                let whole = smallest > 0.0 && (length + left + right).is_finite();
                if !whole && degenerate.is_none() {
                    degenerate = Some(face);
                }
                charts.push(Chart {
                    length,
                    left: unit(ab.dot(&ac), double_area),
                    left_length: left,
                    right: unit(ab.dot(&cb), -double_area),
                });
                let angle = libm::atan2(double_area, ab.dot(&ac));
                angles.push(angle);
                total_angles[mesh.origin(h) as usize] += angle;
            }
        }
        let beyond = |side: HalfEdge| mesh.twin(side).map_or(BORDER, |t| t.0);
        let step = |(h, chart): (u32, &Chart)| Step {
            apex: chart.apex().map(|x| x / chart.length),
            left_exit: beyond(HalfEdge(h).prev()),
            right_exit: beyond(HalfEdge(h).next()),
        };
        let steps = (0..).zip(&charts).map(step).collect();
        let full = 2.0 * std::f64::consts::PI;
        let vertices = || 0..mesh.vertex_count();
        let bends = vertices()
            .map(|v| mesh.is_border_vertex(v) || total_angles[v as usize] > full + FLAT)
            .collect();
        let curvatures = vertices()
            .map(|v| {
                if mesh.is_border_vertex(v) {
                    0.0
                } else {
                    full - total_angles[v as usize]
                }
            })
            .collect();
        Self {
            of: charts,
            steps,
            angles,
            total_angles,
            curvatures,
            least_heights,
            bends,
            degenerate,
        }
    }

    pub(super) fn chart(&self, h: HalfEdge) -> &Chart {
        &self.of[h.0 as usize]
    }

    /// Coordinates of a point in the chart of a half-edge, if it lies in or on its face.
    pub(super) fn coordinates(
        &self,
        mesh: &Mesh,
        h: HalfEdge,
        point: &SurfacePoint,
    ) -> Option<[f64; 2]> {
        let bary = point.bary_in(mesh, h.face())?;
        let chart = self.chart(h);
        let [cx, cy] = chart.apex();
        let along = bary[h.next().corner()];
        let above = bary[h.prev().corner()];
        Some([along * chart.length + above * cx, above * cy])
    }

    /// Coordinates of a point in the chart of a half-edge, if it lies in or on its face and not on
    /// the half-edge itself.
    pub(super) fn coordinates_above(
        &self,
        mesh: &Mesh,
        h: HalfEdge,
        point: &SurfacePoint,
    ) -> Option<[f64; 2]> {
        let bary = point.bary_in(mesh, h.face())?;
        (bary[h.prev().corner()] > 0.0).then(|| self.coordinates(mesh, h, point))?
    }

    /// The vector in space of a direction in the chart of a half-edge.
    pub(super) fn to_space(mesh: &Mesh, h: HalfEdge, direction: [f64; 2]) -> Vector3 {
        let [along, across] = axes(mesh, h);
        (along * direction[0] + across * direction[1]).normalize()
    }

    /// The direction in the chart of a half-edge of a vector in the plane of its face.
    pub(super) fn from_space(mesh: &Mesh, h: HalfEdge, vector: &Vector3) -> [f64; 2] {
        axes(mesh, h).map(|axis| axis.dot(vector))
    }
}

/// The axes of a half-edge's chart in space.
fn axes(mesh: &Mesh, h: HalfEdge) -> [Vector3; 2] {
    let corners = mesh.corners(h.face());
    let [a, b, c] = [0, 1, 2].map(|i| corners[(h.corner() + i) % 3]);
    let along = (b - a).normalize();
    let out = c - a;
    [along, (out - along * out.dot(&along)).normalize()]
}

/// A face lower than this share of its longest side gets this height: its corners lie in line up
/// to rounding, and windows need a side to come from.
const LOWEST: f64 = 1e-14;

/// Twice the area of a triangle from its two shortest sides, which is accurate for needles.
fn double_area(corners: &[Point3; 3]) -> f64 {
    let sides = [0, 1, 2].map(|i| corners[(i + 1) % 3] - corners[i]);
    let squares = sides.map(|s| s.norm_squared());
    let longest = if squares[0] >= squares[1] && squares[0] >= squares[2] {
        0
    } else if squares[1] >= squares[2] {
        1
    } else {
        2
    };
    sides[(longest + 1) % 3]
        .cross(&sides[(longest + 2) % 3])
        .norm()
        .max(LOWEST * squares[longest])
}

fn unit(along: f64, across: f64) -> [f64; 2] {
    let norm = (along * along + across * across).sqrt();
    if norm > 0.0 {
        [along / norm, across / norm]
    } else {
        [1.0, 0.0]
    }
}
