//! A first path between two points: a line is cast in the direction in which the target lies in
//! space. Where that does not lead to it, faces in between are found by a search that goes towards the
//! target, and their strip is pulled tight and turned until it is locally shortest.

use super::aim::Range;
use super::unrolled::Strip;
use super::walk::Walk;
use super::{Geodesics, Path};
use crate::surface::{HalfEdge, Point3, SurfacePoint};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// Ways over the middles of faces zigzag; so much longer than straight, they lose no time.
const GREED: f64 = 1.25;

/// Where paths leave that are shorter than a known one.
pub(super) enum Shorter {
    /// There are none.
    None,
    /// In a range, or in any direction.
    Within(Option<Range>),
}

impl Geodesics<'_> {
    /// A locally shortest path between two checked points, and where shorter ones can leave; `None`
    /// where none is found this way.
    pub(super) fn near_path(
        &self,
        from: &SurfacePoint,
        to: &SurfacePoint,
    ) -> Option<(Path, Shorter)> {
        let mut walk = Walk::new(self.mesh, &self.charts, from)?;
        let ahead = to.position(self.mesh) - from.position(self.mesh);
        let near = match walk.cast(&ahead, to) {
            Some(near) => near,
            None => walk.through(self.faces_between(from, to)?, to)?,
        };
        let shorter = match self.prove(&mut walk, &near, to) {
            Ok(_) => Shorter::None,
            Err(room) => Shorter::Within(room.range(&walk, &near)),
        };
        Some((walk.path(to)?, shorter))
    }

    /// A strip of faces between two points, found best first (A*) by the ways over the middles of
    /// faces.
    fn faces_between(&self, from: &SurfacePoint, to: &SurfacePoint) -> Option<Strip> {
        let mesh = self.mesh;
        let goal = to.position(mesh);
        let middle = |face: u32| {
            let [a, b, c] = mesh.corners(face);
            Point3::from((a.coords + b.coords + c.coords) / 3.0)
        };
        // Per face the way to its middle and the half-edge over which it was entered.
        let mut met: BTreeMap<u32, (f64, Option<HalfEdge>)> = BTreeMap::new();
        let mut queue = BinaryHeap::new();
        let start = from.position(mesh);
        for face in from.faces(mesh) {
            let way = (middle(face) - start).norm();
            met.insert(face, (way, None));
            let whole = way + GREED * (middle(face) - goal).norm();
            queue.push(Reverse((whole.to_bits(), way.to_bits(), face)));
        }
        while let Some(Reverse((_, way, face))) = queue.pop() {
            let way = f64::from_bits(way);
            if way > met[&face].0 {
                continue;
            }
            if to.bary_in(mesh, face).is_some() {
                let mut through = Vec::new();
                let mut at = face;
                while let Some(exit) = met[&at].1 {
                    through.push(exit);
                    at = exit.face();
                }
                through.reverse();
                return Some(Strip { through, face: at });
            }
            let here = middle(face);
            for corner in 0..3 {
                let exit = HalfEdge::new(face, corner);
                let Some(next) = mesh.twin(exit).map(HalfEdge::face) else {
                    continue;
                };
                let at = middle(next);
                let way = way + (at - here).norm();
                let known = met.get(&next).map_or(f64::INFINITY, |m| m.0);
                if way < known {
                    met.insert(next, (way, Some(exit)));
                    let whole = way + GREED * (at - goal).norm();
                    queue.push(Reverse((whole.to_bits(), way.to_bits(), next)));
                }
            }
        }
        None
    }
}
