//! Which vertices of the mesh lie inside a closed loop of curves.

use crate::surface::{HalfEdge, Mesh, SurfacePoint};

/// Vertices of a mesh as a closed loop of curves sees them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Unknown,
    On,
    Left,
    Right,
}

/// Vertices strictly inside a loop, ascending.
///
/// The loop is a list of points, each two neighbours (and the last and the first) in or on a
/// common face, that runs around the region once; `turns_left` says that the region is on its
/// left-hand side. Regions that contain no vertex give an empty list.
pub fn vertices_inside(mesh: &Mesh, ring: &[SurfacePoint], turns_left: bool) -> Vec<u32> {
    let inside = if turns_left { Side::Left } else { Side::Right };
    let mut sides = vec![Side::Unknown; mesh.positions().len()];
    for point in ring {
        if let SurfacePoint::Vertex(v) = *point {
            sides[v as usize] = Side::On;
        }
    }
    let cut = cut_edges(mesh, ring);
    let mut seeds = Vec::new();
    for &(edge, left, crossed) in &cut {
        // Where a loop cuts an edge more than once, its ends tell nothing about the middle.
        if crossed == 1 {
            let (target, origin) = (mesh.target(edge), mesh.origin(edge));
            let (on_left, on_right) = if left {
                (target, origin)
            } else {
                (origin, target)
            };
            seeds.push((on_left, Side::Left));
            seeds.push((on_right, Side::Right));
        }
    }
    seeds.extend(seeds_at_vertices(mesh, ring));
    let is_cut = |h: HalfEdge| {
        let edge = canonical(mesh, h);
        cut.binary_search_by_key(&edge, |&(e, _, _)| e).is_ok()
    };
    // Flood both sides at once, so that a vertex is claimed by the side that reaches it first. What
    // is left when nothing inside waits any more is outside, however much of the surface that is.
    let mut queue = std::collections::VecDeque::new();
    let mut waiting = 0_usize;
    for (vertex, side) in seeds {
        if sides[vertex as usize] == Side::Unknown {
            sides[vertex as usize] = side;
            waiting += usize::from(side == inside);
            queue.push_back(vertex);
        }
    }
    while waiting > 0
        && let Some(vertex) = queue.pop_front()
    {
        let side = sides[vertex as usize];
        waiting -= usize::from(side == inside);
        for h in spokes(mesh, vertex) {
            let next = if mesh.origin(h) == vertex {
                mesh.target(h)
            } else {
                mesh.origin(h)
            };
            if sides[next as usize] == Side::Unknown && !is_cut(h) {
                sides[next as usize] = side;
                waiting += usize::from(side == inside);
                queue.push_back(next);
            }
        }
    }
    (0..mesh.positions().len() as u32)
        .filter(|&v| sides[v as usize] == inside)
        .collect()
}

/// One half-edge for each edge at a vertex, in either direction.
fn spokes(mesh: &Mesh, vertex: u32) -> impl Iterator<Item = HalfEdge> + '_ {
    mesh.outgoing(vertex)
        .flat_map(move |h| [Some(h), mesh.twin(h.prev()).is_none().then(|| h.prev())])
        .flatten()
}

/// The half-edge that stands for an edge.
fn canonical(mesh: &Mesh, h: HalfEdge) -> HalfEdge {
    mesh.twin(h).map_or(h, |t| t.min(h))
}

/// Edges that the loop passes through, sorted: the edge, whether the target of its canonical
/// half-edge is on the left, and how often it is cut.
fn cut_edges(mesh: &Mesh, ring: &[SurfacePoint]) -> Vec<(HalfEdge, bool, u32)> {
    let mut cuts: Vec<(HalfEdge, bool, u32)> = Vec::new();
    for (i, point) in ring.iter().enumerate() {
        let SurfacePoint::Edge { half_edge, .. } = *point else {
            continue;
        };
        let edge = canonical(mesh, half_edge);
        let before = &ring[(i + ring.len() - 1) % ring.len()];
        let after = &ring[(i + 1) % ring.len()];
        // Leaving a face across its half-edge, the target of the half-edge is on the left.
        let touches = |other: &SurfacePoint, face: u32| other.bary_in(mesh, face).is_some();
        let Some(twin) = mesh.twin(edge) else {
            continue;
        };
        let out = touches(before, edge.face()) && touches(after, twin.face());
        let back = touches(before, twin.face()) && touches(after, edge.face());
        if out != back {
            cuts.push((edge, out, 1));
        }
    }
    cuts.sort_unstable();
    cuts.dedup_by(|b, a| {
        let same = a.0 == b.0;
        if same {
            a.2 += 1;
        }
        same
    });
    cuts
}

/// Neighbours of the vertices that the loop passes, by side.
fn seeds_at_vertices(mesh: &Mesh, ring: &[SurfacePoint]) -> Vec<(u32, Side)> {
    let mut seeds = Vec::new();
    for (i, point) in ring.iter().enumerate() {
        let SurfacePoint::Vertex(vertex) = *point else {
            continue;
        };
        let fan: Vec<HalfEdge> = mesh.outgoing(vertex).collect();
        let before = fan_position(mesh, vertex, &fan, &ring[(i + ring.len() - 1) % ring.len()]);
        let after = fan_position(mesh, vertex, &fan, &ring[(i + 1) % ring.len()]);
        let (Some(before), Some(after)) = (before, after) else {
            continue;
        };
        if before == after {
            continue;
        }
        // On the border the fan is open: one more step leads across the outside.
        let turn = fan.len() as f64
            + if mesh.is_border_vertex(vertex) {
                1.0
            } else {
                0.0
            };
        for (k, h) in fan.iter().enumerate() {
            let ends = [
                (k as f64, mesh.target(*h)),
                (k as f64 + 1.0, mesh.origin(h.prev())),
            ];
            for (position, neighbour) in ends {
                // Counter-clockwise from the way out to the way in lies the left-hand side.
                let from_after = (position - after).rem_euclid(turn);
                let whole = (before - after).rem_euclid(turn);
                if from_after > 0.0 && from_after != whole {
                    let side = if from_after < whole {
                        Side::Left
                    } else {
                        Side::Right
                    };
                    seeds.push((neighbour, side));
                }
            }
        }
    }
    seeds
}

/// Where a neighbouring point lies in the fan of a vertex: `k` on the k-th outgoing half-edge,
/// between `k` and `k + 1` inside the face after it.
fn fan_position(
    mesh: &Mesh,
    vertex: u32,
    fan: &[HalfEdge],
    neighbour: &SurfacePoint,
) -> Option<f64> {
    fan.iter().enumerate().find_map(|(k, h)| {
        let bary = neighbour.bary_in(mesh, h.face())?;
        let (on_first, on_second) = (bary[h.next().corner()], bary[h.prev().corner()]);
        debug_assert_eq!(mesh.origin(*h), vertex);
        let sum = on_first + on_second;
        (sum > 0.0).then(|| k as f64 + on_second / sum)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Squares of a grid cut along their rising diagonal.
    fn plane(n: u32) -> Mesh {
        let at = |i: u32, j: u32| j * (n + 1) + i;
        let positions = (0..=n)
            .flat_map(|j| (0..=n).map(move |i| [f64::from(i), f64::from(j), 0.0].into()))
            .collect();
        let faces = (0..n)
            .flat_map(|j| {
                (0..n).flat_map(move |i| {
                    [
                        [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
                        [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
                    ]
                })
            })
            .collect();
        Mesh::new(positions, faces).unwrap()
    }

    /// A rectangle between half-integers as a loop: crossings of all edges on the way.
    fn rectangle(mesh: &Mesh, corners: &[[f64; 2]]) -> Vec<SurfacePoint> {
        let locate = |p: [f64; 2]| {
            let (i, j) = (p[0].floor().min(4.0), p[1].floor().min(4.0));
            let (x, y) = (p[0] - i, p[1] - j);
            let square = 2 * (j as u32 * 5 + i as u32);
            if x >= y {
                SurfacePoint::in_face(mesh, square, [1.0 - x, x - y, y]).unwrap()
            } else {
                SurfacePoint::in_face(mesh, square + 1, [1.0 - y, x, y - x]).unwrap()
            }
        };
        let mut ring = Vec::new();
        for (k, a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            let mut cuts = vec![0.0];
            for line in 0..60 {
                let c = f64::from(line - 20) * 0.5;
                for (value, rate) in [
                    (a[0], b[0] - a[0]),
                    (a[1], b[1] - a[1]),
                    (a[0] - a[1], b[0] - a[0] - b[1] + a[1]),
                ] {
                    let t = (c - value) / rate;
                    if c.fract() == 0.0 && t > 1e-9 && t < 1.0 - 1e-9 {
                        cuts.push(t);
                    }
                }
            }
            cuts.sort_by(f64::total_cmp);
            cuts.dedup_by(|x, y| (*x - *y).abs() < 1e-9);
            ring.extend(cuts.iter().map(|t| {
                let p = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
                locate(p.map(|x| {
                    if (x - x.round()).abs() < 1e-9 {
                        x.round()
                    } else {
                        x
                    }
                }))
            }));
        }
        ring
    }

    fn expected(inside: impl Fn(u32, u32) -> bool) -> Vec<u32> {
        (0..36).filter(|v| inside(v % 6, v / 6)).collect()
    }

    #[test]
    fn a_loop_through_faces_holds_the_vertices_within_whichever_way_it_runs() {
        let mesh = plane(5);
        let mut ring = rectangle(&mesh, &[[0.6, 0.3], [3.4, 0.7], [3.7, 3.2], [0.4, 4.6]]);
        let within =
            expected(|i, j| (1..=3).contains(&i) && (1..=3).contains(&j) || (i, j) == (1, 4));
        assert_eq!(vertices_inside(&mesh, &ring, true), within);
        ring.reverse();
        assert_eq!(vertices_inside(&mesh, &ring, false), within);
    }

    #[test]
    fn a_loop_along_mesh_edges_excludes_the_vertices_on_it() {
        let mesh = plane(5);
        let ring = rectangle(&mesh, &[[1.0, 1.0], [4.0, 1.0], [4.0, 4.0], [1.0, 4.0]]);
        let within = expected(|i, j| (2..=3).contains(&i) && (2..=3).contains(&j));
        assert_eq!(vertices_inside(&mesh, &ring, true), within);
    }

    #[test]
    fn a_loop_along_the_border_holds_everything_else() {
        let mesh = plane(5);
        let ring = rectangle(&mesh, &[[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0]]);
        let within = expected(|i, j| (1..=4).contains(&i) && (1..=4).contains(&j));
        assert_eq!(vertices_inside(&mesh, &ring, true), within);
        let small = rectangle(&mesh, &[[2.1, 2.05], [2.6, 2.05], [2.6, 2.09], [2.2, 2.09]]);
        assert_eq!(vertices_inside(&mesh, &small, true), Vec::<u32>::new());
    }
}
