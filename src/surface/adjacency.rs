//! Which half-edges lie opposite each other and where the fan of each vertex begins: the topology
//! behind [`Mesh`](super::Mesh), built in linear time and refused where it is no oriented manifold.

use super::HalfEdge;
use std::fmt;

/// Why faces and vertices are no oriented manifold mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MeshDefect {
    /// More faces than half-edge ids, or more vertices than vertex ids.
    TooLarge,
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

impl fmt::Display for MeshDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge => write!(f, "too many faces or vertices"),
            Self::IndexOutOfRange { face } => {
                write!(f, "face {face} names a vertex that does not exist")
            }
            Self::RepeatedVertex { face } => write!(f, "face {face} names a vertex twice"),
            Self::NonManifoldEdge { vertices: [a, b] } => {
                write!(f, "the faces at the edge {a}-{b} form no oriented pair")
            }
            Self::NonManifoldVertex { vertex } => {
                write!(f, "the faces at vertex {vertex} form more than one fan")
            }
            Self::UnusedVertex { vertex } => write!(f, "vertex {vertex} has no face"),
        }
    }
}

impl std::error::Error for MeshDefect {}

/// The topology of an oriented manifold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Adjacency {
    /// Per half-edge the opposite one, or [`HalfEdge::BORDER`].
    pub(super) twins: Vec<u32>,
    /// Per vertex a half-edge that starts there; at a border vertex the clockwise-most one, which
    /// has no twin, so that rotating counter-clockwise from it meets all faces.
    pub(super) outgoing: Vec<u32>,
}

impl Adjacency {
    /// Builds and checks; the first defect in the order of faces, edges (by their lower vertex),
    /// vertices.
    pub(super) fn build(vertices: usize, faces: &[[u32; 3]]) -> Result<Self, MeshDefect> {
        // `BORDER` is no half-edge and no vertex.
        if faces.len() > (HalfEdge::BORDER / 3) as usize || vertices >= HalfEdge::BORDER as usize {
            return Err(MeshDefect::TooLarge);
        }
        for (face, corners) in (0..).zip(faces) {
            if corners.iter().any(|&v| v as usize >= vertices) {
                return Err(MeshDefect::IndexOutOfRange { face });
            }
            let [a, b, c] = *corners;
            if a == b || b == c || c == a {
                return Err(MeshDefect::RepeatedVertex { face });
            }
        }
        let twins = find_twins(vertices, faces)?;
        let outgoing = find_outgoing(vertices, faces, &twins)?;
        Ok(Self { twins, outgoing })
    }
}

/// Pairs half-edges: buckets them by their lower vertex (a counting sort, linear in the faces),
/// then looks at each bucket, which is as small as a vertex's degree, in the order of the higher.
fn find_twins(vertices: usize, faces: &[[u32; 3]]) -> Result<Vec<u32>, MeshDefect> {
    let mut starts = vec![0_u32; vertices + 1];
    for h in half_edges(faces) {
        starts[h.low as usize + 1] += 1;
    }
    for v in 0..vertices {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut bucketed = vec![(0_u32, false, 0_u32); 3 * faces.len()];
    for h in half_edges(faces) {
        let slot = &mut next[h.low as usize];
        bucketed[*slot as usize] = (h.high, h.descends, h.id);
        *slot += 1;
    }
    let mut twins = vec![HalfEdge::BORDER; 3 * faces.len()];
    for low in 0..vertices {
        let bucket = &mut bucketed[starts[low] as usize..starts[low + 1] as usize];
        bucket.sort_unstable();
        for group in bucket.chunk_by(|p, q| p.0 == q.0) {
            match *group {
                [_] => {}
                [(_, false, p), (_, true, q)] => {
                    twins[p as usize] = q;
                    twins[q as usize] = p;
                }
                _ => {
                    return Err(MeshDefect::NonManifoldEdge {
                        vertices: [low as u32, group[0].0],
                    });
                }
            }
        }
    }
    Ok(twins)
}

struct Directed {
    low: u32,
    high: u32,
    /// Runs from the higher vertex to the lower.
    descends: bool,
    id: u32,
}

fn half_edges(faces: &[[u32; 3]]) -> impl Iterator<Item = Directed> + '_ {
    (0..).zip(faces).flat_map(|(face, &[a, b, c])| {
        [(a, b, 0), (b, c, 1), (c, a, 2)].map(|(from, to, corner)| Directed {
            low: from.min(to),
            high: from.max(to),
            descends: from > to,
            id: HalfEdge::new(face, corner).0,
        })
    })
}

/// Picks each vertex's first half-edge and checks that its faces form one fan.
fn find_outgoing(
    vertices: usize,
    faces: &[[u32; 3]],
    twins: &[u32],
) -> Result<Vec<u32>, MeshDefect> {
    let (outgoing, split) = fans(vertices, faces, twins);
    if let Some(v) = outgoing.iter().position(|&h| h == HalfEdge::BORDER) {
        return Err(MeshDefect::UnusedVertex { vertex: v as u32 });
    }
    match split.first() {
        Some(&vertex) => Err(MeshDefect::NonManifoldVertex { vertex }),
        None => Ok(outgoing),
    }
}

/// Per vertex the half-edge from which rotating counter-clockwise meets its whole fan, and the
/// vertices that have several fans.
fn fans(vertices: usize, faces: &[[u32; 3]], twins: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut first = vec![HalfEdge::BORDER; vertices];
    let mut degree = vec![0_u32; vertices];
    for h in 0..twins.len() as u32 {
        let v = faces[h as usize / 3][h as usize % 3] as usize;
        degree[v] += 1;
        if first[v] == HalfEdge::BORDER || twins[h as usize] == HalfEdge::BORDER {
            first[v] = h;
        }
    }
    let split = (0..vertices)
        .filter(|&v| first[v] != HalfEdge::BORDER && fan_size(twins, first[v]) != degree[v])
        .map(|v| v as u32)
        .collect();
    (first, split)
}

/// Faces met rotating counter-clockwise from a half-edge to the border or back to it.
fn fan_size(twins: &[u32], first: u32) -> u32 {
    // The rotation is injective, so it cannot run into a cycle that misses its start.
    let mut met = 1;
    let mut h = twins[HalfEdge(first).prev().0 as usize];
    while h != HalfEdge::BORDER && h != first {
        met += 1;
        h = twins[HalfEdge(h).prev().0 as usize];
    }
    met
}

/// Vertices whose faces form several fans, in oriented faces without defects of the edges.
pub(super) fn split_vertices(vertices: usize, faces: &[[u32; 3]]) -> Result<Vec<u32>, MeshDefect> {
    let twins = find_twins(vertices, faces)?;
    Ok(fans(vertices, faces, &twins).1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// By definition: at most one face on each side of an edge, and the faces at each vertex hang
    /// together over edges at that vertex.
    fn is_manifold(vertices: u32, faces: &[[u32; 3]]) -> bool {
        let edges = |f: &[u32; 3]| [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])];
        let directed: Vec<_> = faces.iter().flat_map(edges).collect();
        let once = directed
            .iter()
            .all(|e| directed.iter().filter(|d| *d == e).count() == 1);
        let sound = faces
            .iter()
            .all(|f| f[0] != f[1] && f[1] != f[2] && f[2] != f[0]);
        let one_fan = (0..vertices).all(|v| {
            let at: Vec<_> = faces.iter().filter(|f| f.contains(&v)).collect();
            let mut met = vec![false; at.len()];
            if let Some(first) = met.first_mut() {
                *first = true;
            }
            for _ in 0..at.len() {
                for i in 0..at.len() {
                    let joined = (0..at.len()).any(|j| {
                        met[j]
                            && at[i].iter().any(|w| *w != v && at[j].contains(w))
                            && edges(at[i])
                                .iter()
                                .filter(|e| e.0 == v || e.1 == v)
                                .any(|e| edges(at[j]).contains(&(e.1, e.0)))
                    });
                    met[i] |= joined;
                }
            }
            !at.is_empty() && met.iter().all(|&met| met)
        });
        once && sound && one_fan
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 3000, ..Default::default() })]

        #[test]
        fn exactly_oriented_manifolds_are_accepted(
            faces in prop::collection::vec(prop::array::uniform3(0..6_u32), 1..9),
            whole in any::<bool>(),
        ) {
            // Random faces are rarely manifold: the faces of an octahedron often are.
            let octahedron = [
                [0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [5, 2, 1], [5, 3, 2], [5, 4, 3], [5, 1, 4],
            ];
            let mut faces: Vec<[u32; 3]> = if whole {
                faces.iter().map(|f| octahedron[(f[0] + f[1]) as usize % 8]).collect()
            } else {
                faces
            };
            faces.dedup();
            let mut used: Vec<u32> = faces.iter().flatten().copied().collect();
            used.sort_unstable();
            used.dedup();
            for v in faces.iter_mut().flatten() {
                *v = used.binary_search(v).unwrap() as u32;
            }
            let built = Adjacency::build(used.len(), &faces);
            prop_assert_eq!(built.is_ok(), is_manifold(used.len() as u32, &faces), "{:?}", faces);
            if let Ok(Adjacency { twins, outgoing }) = built {
                for (h, &twin) in (0..).zip(&twins).filter(|(_, twin)| **twin != HalfEdge::BORDER) {
                    prop_assert_eq!(twins[twin as usize], h);
                }
                for (v, &h) in (0..).zip(&outgoing) {
                    prop_assert_eq!(faces[h as usize / 3][h as usize % 3], v);
                }
            }
        }
    }
}
