//! Faces within a margin of some surface points.

use super::{Mesh, SurfacePoint};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The faces with a corner within a distance of one of the seeds, measured along edges, and the
/// faces of the seeds themselves; ascending.
///
/// Ways along edges (Dijkstra) are longer than geodesics, by some tenths on even triangulations
/// and more on slivers, so the faces may fall short of the margin. Whether they suffice for what
/// is done on them, [`Clearance`](super::Clearance) tells.
pub fn grow(mesh: &Mesh, seeds: &[SurfacePoint], margin: f64) -> Vec<u32> {
    let mut taken = vec![false; mesh.faces().len()];
    let mut distance = vec![f64::INFINITY; mesh.positions().len()];
    let mut queue = BinaryHeap::new();
    for seed in seeds {
        let at = seed.position(mesh);
        for face in seed.faces(mesh) {
            taken[face as usize] = true;
            for v in mesh.faces()[face as usize] {
                reach(&mut distance, &mut queue, v, (mesh.position(v) - at).norm());
            }
        }
    }
    while let Some(Reverse((bits, v))) = queue.pop() {
        let here = f64::from_bits(bits);
        if here > margin {
            break;
        }
        if here > distance[v as usize] {
            continue;
        }
        for h in mesh.outgoing(v) {
            taken[h.face() as usize] = true;
        }
        for n in mesh.neighbours(v) {
            let step = (mesh.position(n) - mesh.position(v)).norm();
            reach(&mut distance, &mut queue, n, here + step);
        }
    }
    (0..mesh.face_count())
        .filter(|&face| taken[face as usize])
        .collect()
}

/// Distances as bits, which for positive numbers sort as the numbers do.
type Queue = BinaryHeap<Reverse<(u64, u32)>>;

fn reach(distance: &mut [f64], queue: &mut Queue, vertex: u32, new: f64) {
    if new < distance[vertex as usize] {
        distance[vertex as usize] = new;
        queue.push(Reverse((new.to_bits(), vertex)));
    }
}
