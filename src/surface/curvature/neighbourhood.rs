//! The vertices around a vertex, in discs of growing radius.
//!
//! Discs rather than rings of edges: on meshes of long thin triangles two rings reach far in one
//! direction and nowhere in the other.

use crate::surface::{Mesh, Vector3};

/// Radii in terms of the vertex's edge length. On an even triangulation they take in 2 rings (19
/// vertices), 3, 4, 5 and 7, and keep clear of the distances at which rings lie. The wide ones
/// serve borders, where half or a quarter of the disc is missing, and slivers.
const RADII: [f64; 7] = [2.3, 3.2, 4.3, 5.7, 7.5, 10.0, 13.0];
/// Most vertices of a neighbourhood: about the widest disc of an even triangulation.
const MOST: usize = 600;
/// Cosine of the largest angle between normals in a neighbourhood: beyond, the surface has turned
/// too far to be a height function over the tangent plane.
const STEEPEST: f64 = 0.3;

/// Gathers neighbourhoods; keeps its marks between vertices.
pub(super) struct Neighbourhood<'m> {
    mesh: &'m Mesh,
    normals: &'m [Vector3],
    /// Per vertex the number of the last gathering that met it.
    met: Vec<u32>,
    gathering: u32,
}

impl<'m> Neighbourhood<'m> {
    pub(super) fn new(mesh: &'m Mesh, normals: &'m [Vector3]) -> Self {
        Self {
            mesh,
            normals,
            met: vec![0; normals.len()],
            gathering: 0,
        }
    }

    /// First guess of a vertex's normal.
    pub(super) fn normal(&self, vertex: u32) -> Vector3 {
        self.normals[vertex as usize]
    }

    /// Root mean square of the lengths of the edges at a vertex.
    pub(super) fn edge_length(&self, vertex: u32) -> f64 {
        let at = self.mesh.position(vertex);
        let squares = self
            .mesh
            .neighbours(vertex)
            .map(|n| (self.mesh.position(n) - at).norm_squared());
        let (count, sum) = squares.fold((0.0, 0.0), |(count, sum), d| (count + 1.0, sum + d));
        (sum / f64::max(count, 1.0)).sqrt()
    }

    /// The discs around a vertex from narrow to wide, each as offsets from the vertex, itself
    /// first; in a fixed order.
    pub(super) fn widening(&mut self, vertex: u32) -> impl Iterator<Item = Vec<Vector3>> {
        let edge = self.edge_length(vertex);
        RADII
            .into_iter()
            .map(move |radius| self.gather(vertex, radius * edge))
    }

    /// The vertices within a distance that hang together with the vertex inside it.
    fn gather(&mut self, vertex: u32, radius: f64) -> Vec<Vector3> {
        self.gathering += 1;
        let centre = self.mesh.position(vertex);
        let normal = self.normal(vertex);
        self.met[vertex as usize] = self.gathering;
        let mut found = vec![vertex];
        let mut next = 0;
        while next < found.len() && found.len() < MOST {
            for n in self.mesh.neighbours(found[next]) {
                let new = self.met[n as usize] != self.gathering
                    && (self.mesh.position(n) - centre).norm() <= radius
                    && self.normals[n as usize].dot(&normal) > STEEPEST;
                if new {
                    self.met[n as usize] = self.gathering;
                    found.push(n);
                }
            }
            next += 1;
        }
        found
            .into_iter()
            .map(|v| self.mesh.position(v) - centre)
            .collect()
    }
}
