//! Paths of a walk, proven to be the shortest: there is no room for another geodesic, or all that
//! there is room for are compared.

use super::Geodesics;
use super::certificate::Grounds;
use super::heights::{Heights, PLACES, Trail};
use super::laid::{Laid, Side};
use super::rays::{Ends, Found};
use super::unrolled::Tight;
use super::walk::{Turn, Walk};
use crate::surface::{HalfEdge, Point3, SurfacePoint, Vector3};

/// Crossings of a path that are compared with a trail.
const COMPARED: usize = 8;

/// How far on the left and right of a path a shorter one may leave, radians.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room(pub(super) [f64; 2]);

impl Room {
    /// In any direction.
    pub(super) const ANY: Self = Self([f64::INFINITY; 2]);
}

impl Geodesics<'_> {
    /// The shortest path to a point, given one that a walk has just found, or the room that is left
    /// for a shorter one; `among` are the only fine cells that matter, if that is known.
    pub(super) fn prove(
        &self,
        walk: &mut Walk<'_>,
        path: &Tight,
        to: &SurfacePoint,
        among: Option<&[usize]>,
    ) -> Result<Tight, Room> {
        match self.grounds() {
            Grounds::Unique => Ok(*path),
            Grounds::Solved => Err(Room::ANY),
            Grounds::Compared => {
                let trail = walk.trail(path, to);
                let heights = match among {
                    Some(parts) => walk.bounds.among(&trail, self.masses(), parts),
                    None => walk.bounds.around(&trail, 0.0, self.masses()),
                };
                walk.proven(path, to, &heights)
            }
        }
    }
}

impl Walk<'_> {
    /// The shortest path to a point, given one that was just found and how far from it another
    /// one may run, or the room that this leaves.
    pub(super) fn proven(
        &mut self,
        path: &Tight,
        to: &SurfacePoint,
        heights: &[Heights; 2],
    ) -> Result<Tight, Room> {
        let surface = (self.mesh, self.charts);
        let mut turns = [0.0; 2];
        let mut known = true;
        for side in Side::BOTH {
            let heights = &heights[side as usize];
            let turn = self
                .near
                .turn(surface, &self.unrolled, path.length, side, heights);
            turns[side as usize] = turn.unwrap_or(heights.turn);
            known &= turn.is_some();
        }
        if !known {
            return Err(Room(turns));
        }
        if turns == [0.0; 2] {
            return Ok(*path);
        }
        let around = self.faces_around();
        let ends = Ends {
            from: &self.from,
            around: &around,
            to,
        };
        let found = self
            .rays
            .shorter(surface, &ends, path.ahead, turns, path.length);
        match found {
            Found::Nothing => Ok(*path),
            Found::Shorter(strip) => self.through(strip, to).ok_or(Room::ANY),
            Found::Unknown => Err(Room(turns)),
        }
    }

    /// The faces around the begin in the plane of the path that was found last, those in its
    /// direction first: what does not fit together at a curved vertex does not behind the path.
    pub(super) fn faces_around(&self) -> Vec<Laid> {
        let (mesh, charts) = (self.mesh, self.charts);
        let first = self.unrolled.first;
        let mut faces = vec![first];
        match self.from {
            SurfacePoint::Face { .. } => {}
            SurfacePoint::Edge { half_edge, .. } => {
                let shared = if first.entry.face() == half_edge.face() {
                    Some(half_edge)
                } else {
                    mesh.twin(half_edge)
                };
                faces.extend(shared.and_then(|h| first.across(mesh, charts, h)));
            }
            SurfacePoint::Vertex(v) => {
                let count = mesh.outgoing(v).count();
                let leaves = |h: &HalfEdge| mesh.origin(*h) == v;
                for (turn, most) in [(Turn::Left, 1 + count / 2), (Turn::Right, count)] {
                    let mut laid = first;
                    while faces.len() < most {
                        let corners = [laid.entry, laid.entry.next(), laid.entry.prev()];
                        let Some(spoke) = corners.into_iter().find(leaves) else {
                            break;
                        };
                        let exit = match turn {
                            Turn::Left => spoke.prev(),
                            Turn::Right => spoke,
                        };
                        let Some(next) = laid.across(mesh, charts, exit) else {
                            break;
                        };
                        laid = next;
                        faces.push(laid);
                    }
                }
            }
        }
        faces
    }

    /// Places along the path that was found last.
    pub(super) fn trail(&self, path: &Tight, to: &SurfacePoint) -> Trail {
        let mesh = self.mesh;
        let mut points = [self.from.position(mesh); PLACES + 1];
        let mut normals = [Vector3::zeros(); PLACES + 1];
        let step = path.length / PLACES as f64;
        let mut crossings = Vec::with_capacity(self.unrolled.faces.len() + 2);
        crossings.push((0.0, points[0]));
        let mut face = self.unrolled.first.entry.face();
        let mut next = 0;
        // Places up to a crossing lie on the straight piece from the crossing before.
        let mut go_on = |(along, at): (f64, Point3), into: u32| {
            let (passed, before) = crossings[crossings.len() - 1];
            while next <= PLACES && next as f64 * step <= along {
                let share = (next as f64 * step - passed) / (along - passed);
                let share = if share.is_finite() { share } else { 0.0 };
                points[next] = before + (at - before) * share;
                normals[next] = mesh.face_normal(face);
                next += 1;
            }
            crossings.push((along, at));
            face = into;
        };
        for (leg, crossed) in self.unrolled.legs() {
            for i in crossed {
                let crossing = self.unrolled.crossing(mesh, &leg, i);
                go_on(crossing, self.unrolled.faces[i].entry.face());
            }
        }
        // Rounding may leave the last place beyond the end.
        let last = self.unrolled.last().entry.face();
        go_on((path.length * (1.0 + 1e-9), to.position(mesh)), last);
        let sag = crossings.iter().map(|&(along, at)| {
            let i = ((along / step) as usize).min(PLACES - 1);
            let (chord, out) = (points[i + 1] - points[i], at - points[i]);
            let share = (out.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (out - chord * share).norm()
        });
        let sag = sag.fold(0.0, f64::max);
        Trail::new(&points, &normals, path.length, sag)
    }

    /// How far the path that was found last strays from a trail, metres.
    pub(super) fn strays(&self, path: &Tight, trail: &Trail) -> f64 {
        let mut farthest = 0.0_f64;
        let every = (self.unrolled.faces.len() / COMPARED).max(1);
        for (leg, crossed) in self.unrolled.legs() {
            for i in crossed.filter(|i| i % every == 0) {
                let (along, at) = self.unrolled.crossing(self.mesh, &leg, i);
                let near = (along / path.length * PLACES as f64).round() as usize;
                farthest = farthest.max(trail.distance(&at, near));
            }
        }
        farthest
    }
}
