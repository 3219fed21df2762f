//! An oriented manifold triangle mesh with its adjacency.

use super::{Point3, Vector3};
use serde::{Deserialize, Serialize};

/// A directed edge of a face: `3 * face + corner`, from that corner to the next one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct HalfEdge(pub u32);

impl HalfEdge {
    const BORDER: u32 = u32::MAX;

    /// The half-edge of `face` that starts at its `corner` (0, 1, 2).
    pub fn new(face: u32, corner: u32) -> Self {
        Self(3 * face + corner)
    }

    /// The face it belongs to.
    pub fn face(self) -> u32 {
        self.0 / 3
    }

    /// The corner of the face at which it starts (0, 1, 2).
    pub fn corner(self) -> usize {
        (self.0 % 3) as usize
    }

    /// The next one around its face.
    #[must_use]
    pub fn next(self) -> Self {
        if self.0 % 3 == 2 {
            Self(self.0 - 2)
        } else {
            Self(self.0 + 1)
        }
    }

    /// The previous one around its face.
    #[must_use]
    pub fn prev(self) -> Self {
        if self.0 % 3 == 0 {
            Self(self.0 + 2)
        } else {
            Self(self.0 - 1)
        }
    }
}

/// Why faces and vertices are no oriented manifold mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MeshDefect {
    /// A face names a vertex that does not exist.
    IndexOutOfRange {
        /// The face.
        face: u32,
    },
    /// A face names a vertex twice.
    RepeatedVertex {
        /// The face.
        face: u32,
    },
    /// More than two faces at an edge, or two that run along it in the same direction.
    NonManifoldEdge {
        /// The edge's vertices.
        vertices: [u32; 2],
    },
    /// The faces around a vertex form more than one fan.
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
    },
    /// A vertex without faces.
    UnusedVertex {
        /// The vertex.
        vertex: u32,
    },
}

/// An oriented manifold triangle mesh, possibly with borders and several components.
///
/// Construction checks the topology; geometry (degenerate faces, several components) is judged
/// where meshes are read.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(try_from = "Parts", into = "Parts")]
pub struct Mesh {
    positions: Vec<Point3>,
    faces: Vec<[u32; 3]>,
    /// Per half-edge the opposite one, or `HalfEdge::BORDER`.
    twins: Vec<u32>,
    /// Per vertex the half-edge that starts there; on the border the one whose twin of its
    /// predecessor chain is complete, i.e. rotating counter-clockwise from it meets all faces.
    outgoing: Vec<u32>,
}

#[derive(Serialize, Deserialize, Clone)]
struct Parts {
    positions: Vec<Point3>,
    faces: Vec<[u32; 3]>,
}

impl From<Mesh> for Parts {
    fn from(mesh: Mesh) -> Self {
        Self {
            positions: mesh.positions,
            faces: mesh.faces,
        }
    }
}

impl TryFrom<Parts> for Mesh {
    type Error = String;

    fn try_from(parts: Parts) -> Result<Self, String> {
        Self::new(parts.positions, parts.faces).map_err(|defect| format!("{defect:?}"))
    }
}

impl Mesh {
    /// Builds the adjacency.
    ///
    /// # Errors
    /// The first defect in the order of faces, then vertices.
    pub fn new(positions: Vec<Point3>, faces: Vec<[u32; 3]>) -> Result<Self, MeshDefect> {
        let count = positions.len() as u32;
        let mut edges = Vec::with_capacity(3 * faces.len());
        for (f, face) in faces.iter().enumerate() {
            if face.iter().any(|&v| v >= count) {
                return Err(MeshDefect::IndexOutOfRange { face: f as u32 });
            }
            if face[0] == face[1] || face[1] == face[2] || face[2] == face[0] {
                return Err(MeshDefect::RepeatedVertex { face: f as u32 });
            }
            for i in 0..3 {
                let (a, b) = (face[i], face[(i + 1) % 3]);
                edges.push((a.min(b), a.max(b), a > b, (3 * f + i) as u32));
            }
        }
        edges.sort_unstable();
        let mut twins = vec![HalfEdge::BORDER; 3 * faces.len()];
        for group in edges.chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
            match group {
                [_] => {}
                [p, q] if p.2 != q.2 => {
                    twins[p.3 as usize] = q.3;
                    twins[q.3 as usize] = p.3;
                }
                _ => {
                    return Err(MeshDefect::NonManifoldEdge {
                        vertices: [group[0].0, group[0].1],
                    });
                }
            }
        }
        let mut mesh = Self {
            positions,
            faces,
            twins,
            outgoing: Vec::new(),
        };
        mesh.outgoing = mesh.find_outgoing()?;
        Ok(mesh)
    }

    /// Picks each vertex's first half-edge and checks that its faces form one fan.
    fn find_outgoing(&self) -> Result<Vec<u32>, MeshDefect> {
        let mut outgoing = vec![HalfEdge::BORDER; self.positions.len()];
        let mut degree = vec![0_u32; self.positions.len()];
        for h in 0..self.twins.len() as u32 {
            let v = self.origin(HalfEdge(h)) as usize;
            degree[v] += 1;
            // The clockwise end of a border fan is the half-edge on the border.
            if outgoing[v] == HalfEdge::BORDER || self.twins[h as usize] == HalfEdge::BORDER {
                outgoing[v] = h;
            }
        }
        for v in 0..self.positions.len() {
            if outgoing[v] == HalfEdge::BORDER {
                return Err(MeshDefect::UnusedVertex { vertex: v as u32 });
            }
            let first = HalfEdge(outgoing[v]);
            let mut met = 1;
            let mut h = first;
            while let Some(next) = self.twin(h.prev()) {
                if next == first {
                    break;
                }
                h = next;
                met += 1;
            }
            if met != degree[v] {
                return Err(MeshDefect::NonManifoldVertex { vertex: v as u32 });
            }
        }
        Ok(outgoing)
    }

    /// Vertex positions, metres.
    pub fn positions(&self) -> &[Point3] {
        &self.positions
    }

    /// Vertices of each face, counter-clockwise from outside.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Position of a vertex, metres.
    pub fn position(&self, vertex: u32) -> Point3 {
        self.positions[vertex as usize]
    }

    /// Corner positions of a face, metres.
    pub fn corners(&self, face: u32) -> [Point3; 3] {
        self.faces[face as usize].map(|v| self.position(v))
    }

    /// The half-edge on the other side, or `None` on the border.
    pub fn twin(&self, h: HalfEdge) -> Option<HalfEdge> {
        let twin = self.twins[h.0 as usize];
        (twin != HalfEdge::BORDER).then_some(HalfEdge(twin))
    }

    /// The vertex at which a half-edge starts.
    pub fn origin(&self, h: HalfEdge) -> u32 {
        self.faces[h.face() as usize][h.corner()]
    }

    /// The vertex at which a half-edge ends.
    pub fn target(&self, h: HalfEdge) -> u32 {
        self.origin(h.next())
    }

    /// Vector from the origin of a half-edge to its target, metres.
    pub fn edge_vector(&self, h: HalfEdge) -> Vector3 {
        self.position(self.target(h)) - self.position(self.origin(h))
    }

    /// Half-edges that start at a vertex, counter-clockwise; at a border vertex from the border
    /// on, so that every face is met.
    pub fn outgoing(&self, vertex: u32) -> impl Iterator<Item = HalfEdge> + '_ {
        let first = HalfEdge(self.outgoing[vertex as usize]);
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let h = next?;
            next = self.twin(h.prev()).filter(|&n| n != first);
            Some(h)
        })
    }

    /// Whether a vertex lies on the border.
    pub fn is_border_vertex(&self, vertex: u32) -> bool {
        self.twin(HalfEdge(self.outgoing[vertex as usize]))
            .is_none()
    }

    /// Cross product of two sides of a face: twice its area along its normal, square metres.
    pub fn face_cross(&self, face: u32) -> Vector3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(&(c - a))
    }

    /// Unit normal of a face.
    pub fn face_normal(&self, face: u32) -> Vector3 {
        self.face_cross(face).normalize()
    }

    /// Total area, square metres.
    pub fn area(&self) -> f64 {
        (0..self.faces.len() as u32)
            .map(|f| 0.5 * self.face_cross(f).norm())
            .sum()
    }

    /// Smallest and largest coordinates, metres.
    pub fn bounding_box(&self) -> (Point3, Point3) {
        let mut low = Point3::from([f64::INFINITY; 3]);
        let mut high = Point3::from([f64::NEG_INFINITY; 3]);
        for p in &self.positions {
            low = low.inf(p);
            high = high.sup(p);
        }
        (low, high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(points: &[[f64; 3]], faces: &[[u32; 3]]) -> Result<Mesh, MeshDefect> {
        Mesh::new(points.iter().map(|&p| p.into()).collect(), faces.to_vec())
    }

    const SQUARE: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];

    #[test]
    fn a_square_has_one_inner_edge_and_full_fans() {
        let mesh = grid(&SQUARE, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        let inner = (0..6).filter(|&h| mesh.twin(HalfEdge(h)).is_some()).count();
        assert_eq!(inner, 2);
        assert_eq!(mesh.outgoing(0).count(), 2);
        assert_eq!(mesh.outgoing(1).count(), 1);
        assert_eq!(mesh.area(), 1.0);
        assert!((0..4).all(|v| mesh.is_border_vertex(v)));
    }

    #[test]
    fn defects_are_named() {
        assert_eq!(
            grid(&SQUARE, &[[0, 1, 4]]).unwrap_err(),
            MeshDefect::IndexOutOfRange { face: 0 }
        );
        assert_eq!(
            grid(&SQUARE, &[[0, 1, 2], [0, 1, 3]]).unwrap_err(),
            MeshDefect::NonManifoldEdge { vertices: [0, 1] }
        );
        assert_eq!(
            grid(&SQUARE, &[[0, 1, 2]]).unwrap_err(),
            MeshDefect::UnusedVertex { vertex: 3 }
        );
    }

    #[test]
    fn two_fans_at_a_vertex_are_refused() {
        let points = [
            [0., 0., 0.],
            [1., 0., 0.],
            [1., 1., 0.],
            [-1., 0., 0.],
            [-1., -1., 0.],
        ];
        assert_eq!(
            grid(&points, &[[0, 1, 2], [0, 3, 4]]).unwrap_err(),
            MeshDefect::NonManifoldVertex { vertex: 0 }
        );
    }
}
