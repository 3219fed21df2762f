//! Points and directions on a mesh.

use super::{HalfEdge, Mesh, Point3, Vector3};
use serde::{Deserialize, Serialize};

/// A point on a mesh. Its kind is topology, not a tolerance: a point on an edge has no third
/// coordinate that could be a little wrong.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum SurfacePoint {
    /// At a vertex.
    Vertex(u32),
    /// Inside an edge.
    Edge {
        /// Either half-edge of the edge.
        half_edge: HalfEdge,
        /// Share of the edge from the origin of `half_edge`, inside (0, 1).
        at: f64,
    },
    /// Inside a face.
    Face {
        /// The face.
        face: u32,
        /// Barycentric coordinates, all positive, summing to 1.
        bary: [f64; 3],
    },
}

/// Barycentric coordinates below this share count as zero: a point that close to an edge or a
/// vertex is that point of the edge or the vertex (1e-10 of an edge of 10 mm is a picometre).
const SNAP: f64 = 1e-10;

impl SurfacePoint {
    /// The point of a face with these barycentric coordinates, snapped to the edge or vertex
    /// that it lies on. Negative coordinates are taken as zero, the sum need not be 1.
    ///
    /// Returns `None` when the coordinates are not finite or all vanish.
    pub fn in_face(mesh: &Mesh, face: u32, bary: [f64; 3]) -> Option<Self> {
        let clamped = bary.map(|b| b.max(0.0));
        let sum: f64 = clamped.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) || bary.iter().any(|b| !b.is_finite()) {
            return None;
        }
        let bary = clamped.map(|b| b / sum);
        let zero = bary.map(|b| b < SNAP);
        Some(match zero {
            [false, false, false] => Self::Face { face, bary },
            [true, false, false] => Self::on_half_edge(mesh, HalfEdge::new(face, 1), bary[2]),
            [false, true, false] => Self::on_half_edge(mesh, HalfEdge::new(face, 2), bary[0]),
            [false, false, true] => Self::on_half_edge(mesh, HalfEdge::new(face, 0), bary[1]),
            _ => {
                let corner = if bary[0] >= bary[1] && bary[0] >= bary[2] {
                    0
                } else if bary[1] >= bary[2] {
                    1
                } else {
                    2
                };
                Self::Vertex(mesh.faces()[face as usize][corner])
            }
        })
    }

    /// The point of an edge at the share `at` from the origin of a half-edge, snapped to its
    /// ends.
    pub fn on_half_edge(mesh: &Mesh, half_edge: HalfEdge, at: f64) -> Self {
        if at < SNAP {
            Self::Vertex(mesh.origin(half_edge))
        } else if at > 1.0 - SNAP {
            Self::Vertex(mesh.target(half_edge))
        } else {
            Self::Edge { half_edge, at }
        }
    }

    /// Position in space, metres.
    pub fn position(&self, mesh: &Mesh) -> Point3 {
        match *self {
            Self::Vertex(v) => mesh.position(v),
            Self::Edge { half_edge, at } => {
                let a = mesh.position(mesh.origin(half_edge));
                a + (mesh.position(mesh.target(half_edge)) - a) * at
            }
            Self::Face { face, bary } => {
                let [a, b, c] = mesh.corners(face);
                Point3::from(a.coords * bary[0] + b.coords * bary[1] + c.coords * bary[2])
            }
        }
    }

    /// Unit normal: of the face, or of the angle-free area average of the faces around.
    pub fn normal(&self, mesh: &Mesh) -> Vector3 {
        let mut sum = Vector3::zeros();
        for face in self.faces(mesh) {
            sum += mesh.face_cross(face);
        }
        sum.normalize()
    }

    /// The faces that the point lies in or on.
    pub fn faces(&self, mesh: &Mesh) -> Vec<u32> {
        match *self {
            Self::Vertex(v) => mesh.outgoing(v).map(HalfEdge::face).collect(),
            Self::Edge { half_edge, .. } => std::iter::once(half_edge.face())
                .chain(mesh.twin(half_edge).map(HalfEdge::face))
                .collect(),
            Self::Face { face, .. } => vec![face],
        }
    }

    /// Barycentric coordinates in a given face, if the point lies in or on it.
    pub fn bary_in(&self, mesh: &Mesh, face: u32) -> Option<[f64; 3]> {
        let mut bary = [0.0; 3];
        match *self {
            Self::Vertex(v) => {
                let corner = mesh.faces()[face as usize].iter().position(|&w| w == v)?;
                bary[corner] = 1.0;
            }
            Self::Edge { half_edge, at } => {
                let (h, at) = if half_edge.face() == face {
                    (half_edge, at)
                } else {
                    (mesh.twin(half_edge).filter(|t| t.face() == face)?, 1.0 - at)
                };
                bary[h.corner()] = 1.0 - at;
                bary[h.next().corner()] = at;
            }
            Self::Face {
                face: own,
                bary: own_bary,
            } => {
                if own != face {
                    return None;
                }
                bary = own_bary;
            }
        }
        Some(bary)
    }
}

/// A direction on the surface at a point: a unit vector in the plane of one face there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tangent {
    /// The face whose plane holds the vector; the point lies in or on it.
    pub face: u32,
    /// Unit vector in space.
    pub direction: Vector3,
}
