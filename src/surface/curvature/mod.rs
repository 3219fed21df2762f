//! Gaussian and mean curvature with principal directions at the vertices of a mesh.
//!
//! Around each vertex a cubic height function over the tangent plane is fitted to the vertices
//! nearby (an osculating jet; Cazals and Pouget, *Estimating differential quantities using
//! polynomial fitting of osculating jets*, 2005), and its second derivatives give the curvatures.
//! Fits of degree n err by O(h^(n-1)) in the curvatures, here O(h²), on irregular meshes too; the
//! tests measure it.
//!
//! Deliberately not: angle defects, which do not converge on irregular meshes.
//!
//! A border vertex sees its surroundings on one side only. It gets the same fit over a wider
//! neighbourhood: the order is the same, the error some times larger. Peaks within
//! [`BORDER_RINGS`] rings of the border are not significant and are left out where peaks and
//! ranges are asked for.

mod jet;
mod neighbourhood;
mod peaks;

use super::{Mesh, SurfacePoint, Vector3};
use jet::Jet;
use neighbourhood::Neighbourhood;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use peaks::{Peak, PeakOptions, peaks};

/// Curvature this many rings of edges from the border is uncertain.
pub const BORDER_RINGS: u32 = 2;

/// How the surface bends at a vertex.
///
/// Principal curvatures are positive where the surface bends towards its normal: with normals up,
/// a bowl has positive ones and a dome negative ones, and both have positive Gaussian curvature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct VertexCurvature {
    /// The greater and the lesser principal curvature, 1/m.
    pub principal: [f64; 2],
    /// Their directions, unit vectors; with the normal a right-handed frame. Where both curvatures
    /// are equal every direction is principal and these are any two.
    pub directions: [Vector3; 2],
    /// Unit normal of the fitted surface.
    pub normal: Vector3,
}

impl VertexCurvature {
    /// Gaussian curvature, 1/m².
    pub fn gaussian(&self) -> f64 {
        self.principal[0] * self.principal[1]
    }

    /// Mean curvature, 1/m.
    pub fn mean(&self) -> f64 {
        0.5 * (self.principal[0] + self.principal[1])
    }
}

/// Curvature at all vertices of a mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curvature {
    vertices: Vec<VertexCurvature>,
}

impl Curvature {
    /// Estimates the curvature at every vertex; vertices are independent of each other.
    ///
    /// A vertex that sees too few others for a quadratic fit (a mesh of some five vertices) is
    /// taken as flat.
    pub fn estimate(mesh: &Mesh) -> Self {
        let normals: Vec<Vector3> = (0..mesh.vertex_count())
            .map(|v| mesh.vertex_normal(v))
            .collect();
        let vertices = (0..mesh.vertex_count())
            .into_par_iter()
            .map_init(
                || Neighbourhood::new(mesh, &normals),
                |neighbourhood, vertex| estimate_at(neighbourhood, vertex),
            )
            .collect();
        Self { vertices }
    }

    /// Curvature at a vertex.
    pub fn vertex(&self, vertex: u32) -> &VertexCurvature {
        &self.vertices[vertex as usize]
    }

    /// Gaussian curvature at a surface point, 1/m²: between vertices linear over the face or edge.
    pub fn gaussian_at(&self, mesh: &Mesh, point: &SurfacePoint) -> f64 {
        let at = |v: u32| self.vertex(v).gaussian();
        match *point {
            SurfacePoint::Vertex(v) => at(v),
            SurfacePoint::Edge {
                half_edge,
                at: share,
            } => at(mesh.origin(half_edge)) * (1.0 - share) + at(mesh.target(half_edge)) * share,
            SurfacePoint::Face { face, bary } => mesh.faces()[face as usize]
                .iter()
                .zip(bary)
                .map(|(&v, share)| at(v) * share)
                .sum(),
        }
    }

    /// Least and greatest Gaussian curvature further inside than [`BORDER_RINGS`], 1/m²; of all
    /// vertices if there are none further inside.
    pub fn gaussian_range(&self, mesh: &Mesh) -> [f64; 2] {
        let rings = mesh.rings_from_border(BORDER_RINGS);
        let all = || self.vertices.iter().map(VertexCurvature::gaussian);
        let inner = all()
            .zip(rings)
            .filter(|&(_, ring)| ring > BORDER_RINGS)
            .map(|(k, _)| k);
        let [low, high] = range(inner);
        if low <= high {
            [low, high]
        } else {
            range(all())
        }
    }
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
        [low.min(x), high.max(x)]
    })
}

/// The first disc, from narrow to wide, in which a cubic is well determined. Failing that the first
/// in which a quadratic is; failing that the best determined quadratic; failing that a plane.
fn estimate_at(neighbourhood: &mut Neighbourhood<'_>, vertex: u32) -> VertexCurvature {
    let normal = neighbourhood.normal(vertex);
    let edge = neighbourhood.edge_length(vertex);
    let mut fallback = Jet::flat(normal);
    for points in neighbourhood.widening(vertex) {
        if let Some(jet) = Jet::cubic(&points, edge, normal) {
            return jet.curvature();
        }
        if !fallback.is_well_determined()
            && let Some(jet) = fallback.better_quadratic(&points, edge, normal)
        {
            fallback = jet;
        }
    }
    fallback.curvature()
}
