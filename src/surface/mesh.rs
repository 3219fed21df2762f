//! An oriented manifold triangle mesh with its adjacency.

use super::adjacency::{Adjacency, MeshDefect};
use super::{Point3, Vector3};
use serde::ser::SerializeStruct;
use serde::{Deserialize, Serialize, Serializer};

/// A directed edge of a face: `3 * face + corner`, from that corner to the next one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct HalfEdge(pub u32);

impl HalfEdge {
    pub(super) const BORDER: u32 = u32::MAX;

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
        if self.0.is_multiple_of(3) {
            Self(self.0 + 2)
        } else {
            Self(self.0 - 1)
        }
    }
}

/// An oriented manifold triangle mesh, possibly with borders and several components.
///
/// Construction checks the topology; geometry (degenerate faces, several components) is judged
/// where meshes are read. Its content is positions and faces, and only these are serialised.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Parts")]
pub struct Mesh {
    positions: Vec<Point3>,
    faces: Vec<[u32; 3]>,
    adjacency: Adjacency,
}

#[derive(Deserialize)]
#[serde(rename = "Mesh")]
struct Parts {
    positions: Vec<Point3>,
    faces: Vec<[u32; 3]>,
}

impl TryFrom<Parts> for Mesh {
    type Error = MeshDefect;

    fn try_from(parts: Parts) -> Result<Self, MeshDefect> {
        Self::new(parts.positions, parts.faces)
    }
}

impl Serialize for Mesh {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut parts = serializer.serialize_struct("Mesh", 2)?;
        parts.serialize_field("positions", &self.positions)?;
        parts.serialize_field("faces", &self.faces)?;
        parts.end()
    }
}

impl Mesh {
    /// Builds the adjacency, in linear time.
    ///
    /// # Errors
    /// The first defect in the order of faces, edges, vertices.
    pub fn new(positions: Vec<Point3>, faces: Vec<[u32; 3]>) -> Result<Self, MeshDefect> {
        let adjacency = Adjacency::build(positions.len(), &faces)?;
        Ok(Self {
            positions,
            faces,
            adjacency,
        })
    }

    /// BLAKE3 hash of the content: positions (by their bits) and faces. Meshes with equal
    /// fingerprints are equal to every stage.
    pub fn fingerprint(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&u64::from(self.vertex_count()).to_le_bytes());
        for p in &self.positions {
            for c in p.iter() {
                hasher.update(&c.to_le_bytes());
            }
        }
        for v in self.faces.iter().flatten() {
            hasher.update(&v.to_le_bytes());
        }
        hasher.finalize().into()
    }

    /// Number of vertices; their ids are `0..vertex_count()`.
    pub fn vertex_count(&self) -> u32 {
        self.positions.len() as u32
    }

    /// Number of faces; their ids are `0..face_count()`.
    pub fn face_count(&self) -> u32 {
        self.faces.len() as u32
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
        let twin = self.adjacency.twins[h.0 as usize];
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

    fn first_outgoing(&self, vertex: u32) -> HalfEdge {
        HalfEdge(self.adjacency.outgoing[vertex as usize])
    }

    /// Half-edges that start at a vertex, counter-clockwise; at a border vertex from the border
    /// on, so that every face is met.
    pub fn outgoing(&self, vertex: u32) -> impl Iterator<Item = HalfEdge> + '_ {
        let first = self.first_outgoing(vertex);
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let h = next?;
            next = self.twin(h.prev()).filter(|&n| n != first);
            Some(h)
        })
    }

    /// Vertices joined to a vertex by an edge, counter-clockwise; at a border vertex from one end
    /// of the fan to the other.
    pub fn neighbours(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.outgoing(vertex).flat_map(move |h| {
            let last = h.prev();
            let closes = self.twin(last).is_none().then(|| self.origin(last));
            std::iter::once(self.target(h)).chain(closes)
        })
    }

    /// The half-edge from one vertex to another, if they share an edge whose face lies to the left
    /// of that direction.
    pub fn half_edge_between(&self, from: u32, to: u32) -> Option<HalfEdge> {
        self.outgoing(from).find(|&h| self.target(h) == to)
    }

    /// One half-edge of every edge: the lower of the two, or the only one on the border.
    pub fn edges(&self) -> impl Iterator<Item = HalfEdge> + '_ {
        self.half_edges()
            .filter(|&h| self.twin(h).is_none_or(|twin| h < twin))
    }

    /// All half-edges.
    pub fn half_edges(&self) -> impl Iterator<Item = HalfEdge> {
        (0..3 * self.face_count()).map(HalfEdge)
    }

    /// Whether a vertex lies on the border.
    pub fn is_border_vertex(&self, vertex: u32) -> bool {
        self.twin(self.first_outgoing(vertex)).is_none()
    }

    /// Per vertex how many edges it is away from the border, counted up to `limit + 1`.
    pub fn rings_from_border(&self, limit: u32) -> Vec<u32> {
        let mut rings = vec![limit + 1; self.positions.len()];
        let mut ring: Vec<u32> = (0..self.vertex_count())
            .filter(|&v| self.is_border_vertex(v))
            .collect();
        for distance in 0..=limit {
            for &v in &ring {
                rings[v as usize] = distance;
            }
            let mut next: Vec<u32> = ring
                .iter()
                .flat_map(|&v| self.neighbours(v))
                .filter(|&v| rings[v as usize] > limit)
                .collect();
            next.sort_unstable();
            next.dedup();
            ring = next;
        }
        rings
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

    /// Unit normal at a vertex: of the faces around it, weighted by their areas.
    pub fn vertex_normal(&self, vertex: u32) -> Vector3 {
        let mut sum = Vector3::zeros();
        for h in self.outgoing(vertex) {
            sum += self.face_cross(h.face());
        }
        sum.normalize()
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
    fn neighbours_and_edges_are_met_once() {
        let mesh = grid(&SQUARE, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        assert_eq!(mesh.neighbours(0).collect::<Vec<_>>(), [1, 2, 3]);
        assert_eq!(mesh.neighbours(1).collect::<Vec<_>>(), [2, 0]);
        assert_eq!(mesh.edges().count(), 5);
        let diagonal = mesh.half_edge_between(2, 0).unwrap();
        assert_eq!((diagonal.face(), diagonal.corner()), (0, 2));
        assert_eq!(mesh.half_edge_between(1, 0), None);
        assert_eq!(mesh.half_edge_between(1, 3), None);
        assert_eq!(mesh.vertex_normal(2), Vector3::z());
    }

    #[test]
    fn rings_count_edges_from_the_border() {
        let mesh = crate::surface::generate::sphere_cap(1.0, 1.0, 4);
        // Rings of 1, 6, 12, 18 and 24 vertices from the top to the rim.
        let rings = mesh.rings_from_border(2);
        let count = |ring| rings.iter().filter(|&&r| r == ring).count();
        assert_eq!([0, 1, 2, 3].map(count), [24, 18, 12, 7]);
    }

    #[test]
    fn only_positions_and_faces_are_stored_and_both_are_checked() {
        let mesh = grid(&SQUARE, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        let text = ron::to_string(&mesh).unwrap();
        assert_eq!(ron::from_str::<Mesh>(&text).unwrap(), mesh);
        let broken = text.replace("(0,2,3)", "(0,1,3)");
        assert!(ron::from_str::<Mesh>(&broken).is_err());
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
