//! The shortest geodesic between two anchors, found on the part of the surface that it can reach.
//!
//! A point of a way from a to b that is no longer than L has straight distances from a and from b
//! that add up to L at most. So once some way is known, here one along edges, all shortest ways lie
//! on the faces that this ellipsoid meets, and what is shortest there is shortest on the surface.

use crate::geodesic::{GeodesicError, Geodesics, Path};
use crate::surface::{Mesh, Point3, SubMesh, SurfacePoint};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// A part with more of the surface than this is taken as the whole: nothing would be saved.
const WHOLE: f64 = 0.7;
/// Lengths are compared with this much to spare, far above rounding.
const SPARE: f64 = 1e-9;

/// The shortest geodesic between two points of a surface. What it costs depends on how far apart
/// they are, not on the surface around them.
pub fn shortest_line(
    surface: &Mesh,
    from: &SurfacePoint,
    to: &SurfacePoint,
) -> Result<Path, GeodesicError> {
    let local = way_along_edges(surface, from, to).and_then(|length| {
        let faces = within(surface, from, to, length * (1.0 + SPARE))?;
        let part = SubMesh::new(surface, &faces);
        let ends = [from, to].map(|point| part.point_from_parent(surface, point));
        let [Some(from), Some(to)] = ends else {
            return None;
        };
        // What is wrong is told of the whole surface.
        let path = Geodesics::new(part.mesh()).shortest(&from, &to).ok()?;
        Some((part, path))
    });
    let Some((part, path)) = local else {
        return Geodesics::new(surface).shortest(from, to);
    };
    Ok(Path {
        points: path
            .points
            .iter()
            .map(|p| part.point_to_parent(p))
            .collect(),
        faces: path.faces.iter().map(|&f| part.face_to_parent(f)).collect(),
        length: path.length,
        start: part.tangent_to_parent(&path.start),
        end: part.tangent_to_parent(&path.end),
    })
}

/// Distances as bits, which for positive numbers sort as the numbers do, and vertices.
type Queue = BinaryHeap<Reverse<(u64, u32)>>;

/// The length of a way along edges (Dijkstra), metres; `None` where there is none.
fn way_along_edges(mesh: &Mesh, from: &SurfacePoint, to: &SurfacePoint) -> Option<f64> {
    let [a, b] = [from, to].map(|point| point.position(mesh));
    // The rest of the way from a vertex beside the end; in a common face there is nothing else.
    let mut rest: BTreeMap<u32, f64> = BTreeMap::new();
    for face in to.faces(mesh) {
        if from.bary_in(mesh, face).is_some() {
            return Some((b - a).norm());
        }
        for v in mesh.faces()[face as usize] {
            rest.insert(v, (b - mesh.position(v)).norm());
        }
    }
    let mut reached: BTreeMap<u32, f64> = BTreeMap::new();
    let mut queue = Queue::new();
    let mut reach = |queue: &mut Queue, v: u32, length: f64| {
        let known = reached.entry(v).or_insert(f64::INFINITY);
        if length < *known {
            *known = length;
            queue.push(Reverse((length.to_bits(), v)));
        }
    };
    for face in from.faces(mesh) {
        for v in mesh.faces()[face as usize] {
            reach(&mut queue, v, (mesh.position(v) - a).norm());
        }
    }
    let mut best = f64::INFINITY;
    while let Some(Reverse((bits, v))) = queue.pop() {
        let here = f64::from_bits(bits);
        if here >= best {
            break;
        }
        if let Some(rest) = rest.get(&v) {
            best = best.min(here + rest);
        }
        for n in mesh.neighbours(v) {
            reach(
                &mut queue,
                n,
                here + (mesh.position(n) - mesh.position(v)).norm(),
            );
        }
    }
    (best < f64::INFINITY).then_some(best)
}

/// The faces around the first point that a way of this length between both can meet, ascending;
/// `None` where these are most of the surface.
fn within(mesh: &Mesh, from: &SurfacePoint, to: &SurfacePoint, length: f64) -> Option<Vec<u32>> {
    let [a, b] = [from, to].map(|point| point.position(mesh));
    let sum = |p: &Point3| (p - a).norm() + (p - b).norm();
    // No point of a face is further from one of its corners than the longest edge there, and the sum
    // changes by at most twice that.
    let meets = |face: u32| {
        let corners = mesh.corners(face);
        (0..3).any(|i| {
            let [p, q, r] = [0, 1, 2].map(|k| corners[(i + k) % 3]);
            sum(&p) - 2.0 * (q - p).norm().max((r - p).norm()) <= length
        })
    };
    let most = (WHOLE * f64::from(mesh.face_count())) as usize;
    let mut taken: Vec<u32> = from.faces(mesh);
    let mut known = vec![false; mesh.faces().len()];
    for &face in &taken {
        known[face as usize] = true;
    }
    let mut next = 0;
    while let Some(&face) = taken.get(next) {
        next += 1;
        // Through its corners, so that a way through a vertex is followed too.
        for v in mesh.faces()[face as usize] {
            for h in mesh.outgoing(v) {
                let other = h.face();
                if !known[other as usize] {
                    known[other as usize] = true;
                    if meets(other) {
                        taken.push(other);
                    }
                }
            }
        }
        if taken.len() > most {
            return None;
        }
    }
    taken.sort_unstable();
    Some(taken)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A bumpy sheet of 2 n² faces over a square of side 2.
    fn sheet(n: u32) -> Mesh {
        let at = |i: u32, j: u32| j * (n + 1) + i;
        let positions = (0..=n).flat_map(|j| {
            (0..=n).map(move |i| {
                let [x, y] = [i, j].map(|k| 2.0 * f64::from(k) / f64::from(n));
                Point3::new(x, y, 0.3 * libm::sin(2.5 * x) * libm::cos(3.0 * y))
            })
        });
        let faces = (0..n).flat_map(|j| {
            (0..n).flat_map(move |i| {
                [
                    [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
                    [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
                ]
            })
        });
        Mesh::new(positions.collect(), faces.collect()).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn it_is_the_shortest_way_of_the_whole_surface(
            from in 0_u32..1800, to in 0_u32..1800, at in [0.1..1.0_f64, 0.1..1.0, 0.1..1.0],
        ) {
            prop_assume!(from != to);
            let mesh = sheet(30);
            let sum: f64 = at.iter().sum();
            let [from, to] = [from, to]
                .map(|face| SurfacePoint::in_face(&mesh, face, at.map(|x| x / sum)).unwrap());
            let local = shortest_line(&mesh, &from, &to).unwrap();
            let whole = Geodesics::new(&mesh).shortest(&from, &to).unwrap();
            prop_assert!((local.length - whole.length).abs() < 1e-12 * whole.length);
            prop_assert!((local.arc_lengths(&mesh).last().unwrap() - local.length).abs() < 1e-12);
            prop_assert_eq!(local.points[0].position(&mesh), from.position(&mesh));
        }
    }

    #[test]
    fn points_that_are_close_need_little_of_the_surface() {
        let mesh = sheet(60);
        let points = [1740, 1790].map(SurfacePoint::Vertex);
        let length = way_along_edges(&mesh, &points[0], &points[1]).unwrap();
        let faces = within(&mesh, &points[0], &points[1], length).unwrap();
        assert!(faces.len() < 7200 / 4, "{}", faces.len());
    }
}
