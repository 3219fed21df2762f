//! Parts of a mesh, so that the work on a patch stays local to it, with the way back.

use super::segment::closest_on_segment;
use super::{HalfEdge, Mesh, Point3, SurfacePoint, Tangent};
use serde::{Deserialize, Serialize};

/// Some faces of a mesh as a mesh of their own, with the maps both ways.
///
/// Vertices and faces keep their order and faces their corners, so half-edges correspond corner by
/// corner.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SubMesh {
    mesh: Mesh,
    /// Vertices in the parent, ascending.
    vertices: Vec<u32>,
    /// Faces in the parent, ascending.
    faces: Vec<u32>,
    /// Half-edges on the part's border that are inside the parent.
    cut: Vec<HalfEdge>,
}

impl SubMesh {
    /// Extracts faces, given in any order.
    ///
    /// Where the faces around a vertex would form several fans, the rest of the faces around that
    /// vertex is taken in as well, until every vertex has one fan. So the part is a manifold and
    /// has at least the faces asked for: what was proved about them stays true.
    pub fn new(parent: &Mesh, faces: &[u32]) -> Self {
        let mut taken = vec![false; parent.faces().len()];
        for &face in faces {
            taken[face as usize] = true;
        }
        close_fans(parent, &mut taken);
        let faces: Vec<u32> = (0..parent.face_count())
            .filter(|&face| taken[face as usize])
            .collect();
        let (vertices, mesh) = extract(parent, &faces);
        let mut part = Self {
            mesh,
            vertices,
            faces,
            cut: Vec::new(),
        };
        part.cut = part
            .mesh
            .half_edges()
            .filter(|&h| part.mesh.twin(h).is_none())
            .filter(|&h| parent.twin(part.half_edge_to_parent(h)).is_some())
            .collect();
        part
    }

    /// The part as a mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Half-edges along which the part was cut out: on its border, but inside the parent.
    pub fn cut(&self) -> &[HalfEdge] {
        &self.cut
    }

    /// A vertex of the part in the parent.
    pub fn vertex_to_parent(&self, vertex: u32) -> u32 {
        self.vertices[vertex as usize]
    }

    /// A face of the part in the parent.
    pub fn face_to_parent(&self, face: u32) -> u32 {
        self.faces[face as usize]
    }

    /// A half-edge of the part in the parent.
    pub fn half_edge_to_parent(&self, h: HalfEdge) -> HalfEdge {
        HalfEdge::new(self.face_to_parent(h.face()), h.corner() as u32)
    }

    /// A point of the part in the parent.
    pub fn point_to_parent(&self, point: &SurfacePoint) -> SurfacePoint {
        match *point {
            SurfacePoint::Vertex(v) => SurfacePoint::Vertex(self.vertex_to_parent(v)),
            SurfacePoint::Edge { half_edge, at } => SurfacePoint::Edge {
                half_edge: self.half_edge_to_parent(half_edge),
                at,
            },
            SurfacePoint::Face { face, bary } => SurfacePoint::Face {
                face: self.face_to_parent(face),
                bary,
            },
        }
    }

    /// A direction on the part in the parent.
    pub fn tangent_to_parent(&self, tangent: &Tangent) -> Tangent {
        Tangent {
            face: self.face_to_parent(tangent.face),
            direction: tangent.direction,
        }
    }

    /// A vertex of the parent in the part, if it is there.
    pub fn vertex_from_parent(&self, vertex: u32) -> Option<u32> {
        Some(self.vertices.binary_search(&vertex).ok()? as u32)
    }

    /// A face of the parent in the part, if it is there.
    pub fn face_from_parent(&self, face: u32) -> Option<u32> {
        Some(self.faces.binary_search(&face).ok()? as u32)
    }

    /// A half-edge of the parent in the part, if its face is there.
    pub fn half_edge_from_parent(&self, h: HalfEdge) -> Option<HalfEdge> {
        let face = self.face_from_parent(h.face())?;
        Some(HalfEdge::new(face, h.corner() as u32))
    }

    /// A point of the parent in the part, if it is there.
    pub fn point_from_parent(&self, parent: &Mesh, point: &SurfacePoint) -> Option<SurfacePoint> {
        match *point {
            SurfacePoint::Vertex(v) => self.vertex_from_parent(v).map(SurfacePoint::Vertex),
            SurfacePoint::Edge { half_edge, at } => {
                let here = self.half_edge_from_parent(half_edge).map(|h| (h, at));
                let across = || {
                    let twin = parent.twin(half_edge)?;
                    Some((self.half_edge_from_parent(twin)?, 1.0 - at))
                };
                let (half_edge, at) = here.or_else(across)?;
                Some(SurfacePoint::Edge { half_edge, at })
            }
            SurfacePoint::Face { face, bary } => {
                let face = self.face_from_parent(face)?;
                Some(SurfacePoint::Face { face, bary })
            }
        }
    }

    /// What it takes to leave the part.
    pub fn clearance(&self) -> Clearance {
        let ends = |&h: &HalfEdge| {
            let [a, b] = [self.mesh.origin(h), self.mesh.target(h)];
            [self.mesh.position(a), self.mesh.position(b)]
        };
        Clearance {
            cut: self.cut.iter().map(ends).collect(),
        }
    }
}

/// Vertices and mesh of faces whose fans are closed, both ascending.
fn extract(parent: &Mesh, faces: &[u32]) -> (Vec<u32>, Mesh) {
    let corners = |face: &u32| parent.faces()[*face as usize];
    let mut used = vec![false; parent.positions().len()];
    for v in faces.iter().flat_map(corners) {
        used[v as usize] = true;
    }
    let vertices: Vec<u32> = (0..parent.vertex_count())
        .filter(|&v| used[v as usize])
        .collect();
    let mut own = vec![0; parent.positions().len()];
    for (new, &v) in (0..).zip(&vertices) {
        own[v as usize] = new;
    }
    let positions = vertices.iter().map(|&v| parent.position(v)).collect();
    let own_faces = faces
        .iter()
        .map(|face| corners(face).map(|v| own[v as usize]))
        .collect();
    let mesh =
        Mesh::new(positions, own_faces).expect("faces of a manifold, one fan at each vertex");
    (vertices, mesh)
}

/// Takes in faces until the taken ones around every vertex form one fan.
fn close_fans(parent: &Mesh, taken: &mut [bool]) {
    let mut touched = vec![false; parent.positions().len()];
    for (corners, _) in parent
        .faces()
        .iter()
        .zip(&*taken)
        .filter(|(_, taken)| **taken)
    {
        for &v in corners {
            touched[v as usize] = true;
        }
    }
    let mut waiting: Vec<u32> = (0..parent.vertex_count())
        .filter(|&v| touched[v as usize])
        .collect();
    while let Some(v) = waiting.pop() {
        let around = || parent.outgoing(v).map(HalfEdge::face);
        let starts_fan = |h: HalfEdge| {
            let before = parent.twin(h).map(HalfEdge::face);
            taken[h.face() as usize] && before.is_none_or(|face| !taken[face as usize])
        };
        if parent.outgoing(v).filter(|&h| starts_fan(h)).count() > 1 {
            for face in around() {
                if !taken[face as usize] {
                    taken[face as usize] = true;
                    waiting.extend(parent.faces()[face as usize]);
                }
            }
        }
    }
}

/// Lower bounds for paths that leave a part of a mesh, by which a shortest path that was found in
/// the part is proved shortest in the whole.
///
/// A path that leaves crosses a cut edge; to get from one point to the other over any point of
/// that edge takes at least the sum of both points' straight distances from the edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    cut: Vec<[Point3; 2]>,
}

impl Clearance {
    /// Straight distances of a point from all cut edges, metres; for [`Clearance::detour`].
    pub fn distances(&self, from: &Point3) -> Vec<f64> {
        self.cut
            .iter()
            .map(|[a, b]| closest_on_segment(a - from, b - from).1.norm())
            .collect()
    }

    /// Straight distance of a point from the cut, metres; infinite if there is none. No path
    /// shorter than this leaves the part.
    pub fn distance(&self, from: &Point3) -> f64 {
        self.distances(from)
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }

    /// Least length of a path between two points that leaves the part, metres, from the points'
    /// distances; infinite if there is no cut. A path in the part that is no longer than this is a
    /// shortest one of the whole mesh if it is one of the part.
    pub fn detour(from: &[f64], to: &[f64]) -> f64 {
        from.iter()
            .zip(to)
            .map(|(a, b)| a + b)
            .fold(f64::INFINITY, f64::min)
    }
}
