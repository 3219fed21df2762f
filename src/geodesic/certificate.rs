//! Why the paths of a table are shortest on the whole mesh and not only among their neighbours.

use super::charts::Charts;
use crate::surface::{HalfEdge, Mesh};

/// What a table's distances rest on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grounds {
    /// The mesh is a disc without positive curvature: two geodesics with common ends would enclose
    /// some (Gauss-Bonnet), so the geodesic between two points is unique.
    Unique,
    /// The mesh is no disc, and paths may pass on either side of what is missing: every pair is
    /// solved exactly.
    Solved,
    /// The mesh is a disc. Paths are proven one by one: beside them is no curvature for another
    /// geodesic to enclose, or all geodesics that could are compared. Pairs that are not proven so
    /// are solved exactly.
    Compared,
}

/// How the pairs of a table are known to be shortest, and at what cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Certificate {
    /// What distances of pairs rest on that were not solved exactly.
    pub grounds: Grounds,
    /// Solves of the exact solver.
    pub solves: usize,
    /// Pairs from these.
    pub exact: usize,
    /// Pairs beside whose path there is no room for another geodesic, or only for such that were
    /// compared.
    pub proven: usize,
}

/// Positive curvature, radians, that is rounding. Geodesics around so much of it differ
/// in length by a share below its square.
pub(super) const NO_CURVATURE: f64 = 1e-7;

/// What tables on a mesh can rest on.
pub(super) fn grounds(mesh: &Mesh, charts: &Charts) -> Grounds {
    let positive: f64 = charts.curvatures.iter().map(|k| k.max(0.0)).sum();
    if !is_disc(mesh) {
        Grounds::Solved
    } else if positive <= NO_CURVATURE {
        Grounds::Unique
    } else {
        Grounds::Compared
    }
}

/// Connected, with one border and no handle.
fn is_disc(mesh: &Mesh) -> bool {
    let faces = mesh.face_count() as usize;
    if faces == 0 {
        return false;
    }
    let mut seen = vec![false; faces];
    let mut waiting = vec![0_u32];
    seen[0] = true;
    let mut count = 0;
    while let Some(face) = waiting.pop() {
        count += 1;
        for corner in 0..3 {
            if let Some(beyond) = mesh.twin(HalfEdge::new(face, corner)).map(HalfEdge::face)
                && !std::mem::replace(&mut seen[beyond as usize], true)
            {
                waiting.push(beyond);
            }
        }
    }
    let (vertices, edges) = (mesh.vertex_count() as usize, mesh.edges().count());
    count == faces && vertices + faces == edges + 1
}
