//! Why the paths of a table are shortest on the whole mesh and not only among their neighbours.

use super::charts::Charts;
use crate::surface::{HalfEdge, Mesh};

/// What a table's distances rest on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grounds {
    /// The mesh is a disc without positive curvature: two geodesics with common ends would enclose
    /// some (Gauss-Bonnet), so the geodesic between two points is unique.
    Unique,
    /// Rows of pairs at intervals are solved exactly, and shortest paths with a common end do not
    /// cross: a path from a point between two solved ones runs between their paths. Paths are
    /// followed from both, and to either side of every vertex close enough to matter.
    Bracketed,
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
    /// Pairs to which all solved neighbours lead by the same path.
    pub agreed: usize,
    /// Pairs to which they lead by different paths, of which the shortest is taken.
    pub chosen: usize,
}

/// Rows that are solved exactly where geodesics need not be unique.
const SOLVED: usize = 5;

/// Positive curvature of a mesh, radians, that is rounding. Geodesics around so much of it differ
/// in length by a share below its square.
const NO_CURVATURE: f64 = 1e-7;

/// Which of so many rows to solve exactly, ascending.
pub(super) fn exact_rows(rows: usize, grounds: Grounds) -> Vec<usize> {
    match grounds {
        Grounds::Unique if rows > 0 => vec![rows / 2],
        _ if rows <= SOLVED => (0..rows).collect(),
        _ => (0..SOLVED).map(|k| k * (rows - 1) / (SOLVED - 1)).collect(),
    }
}

/// Whether all geodesics of a mesh are unique: it is a disc, and no vertex inside has less than the
/// full angle around it.
pub(super) fn unique(mesh: &Mesh, charts: &Charts) -> bool {
    let positive: f64 = charts.curvatures.iter().map(|k| k.max(0.0)).sum();
    positive <= NO_CURVATURE && is_disc(mesh)
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
