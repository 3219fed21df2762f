//! Paths of a walk, proven to be the shortest: there is no room for another geodesic, or all that
//! there is room for are compared.

use super::Geodesics;
use super::certificate::Grounds;
use super::heights::Heights;
use super::laid::{Laid, Side, Turn};
use super::rays::{Ends, Found};
use super::room::Room;
use super::unrolled::Tight;
use super::walk::Walk;
use crate::surface::SurfacePoint;

impl Geodesics<'_> {
    /// The shortest path to a point, given one that a walk has just found, or the room that is left
    /// for a shorter one.
    pub(super) fn prove(
        &self,
        walk: &mut Walk<'_>,
        path: &Tight,
        to: &SurfacePoint,
    ) -> Result<Tight, Room> {
        let known = self.prove_at_once(walk, path, to);
        known.unwrap_or_else(|| self.prove_beside(walk, path, to, None))
    }

    /// The same where the mesh as a whole tells it.
    pub(super) fn prove_at_once(
        &self,
        walk: &mut Walk<'_>,
        path: &Tight,
        to: &SurfacePoint,
    ) -> Option<Result<Tight, Room>> {
        match self.grounds() {
            Grounds::Unique => Some(Ok(*path)),
            Grounds::Solved => Some(Err(Room::ANY)),
            Grounds::Compared => {
                let heights = Heights::calm(self.masses(), path.length)?;
                let proven = walk.proven(path, to, &[heights.clone(), heights]);
                proven.ok().map(Ok)
            }
        }
    }

    /// The same by the curvature near the path; `among` are the only fine cells of it that matter, if
    /// that is known.
    pub(super) fn prove_beside(
        &self,
        walk: &mut Walk<'_>,
        path: &Tight,
        to: &SurfacePoint,
        among: Option<&[usize]>,
    ) -> Result<Tight, Room> {
        let trail = walk.trail(path, to);
        let heights = if let Some(parts) = among {
            walk.bounds.among(&trail, self.masses(), parts)
        } else {
            let bounds = walk.bounds.around(&trail, 0.0, self.masses());
            bounds.ok_or(Room::ANY)?
        };
        walk.proven(path, to, &heights)
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
        let known = self
            .near
            .turns(surface, &self.unrolled, path.length, heights);
        let turns = Side::BOTH.map(|side| {
            let side = side as usize;
            known[side].unwrap_or(heights[side].turn)
        });
        if known.contains(&None) {
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
                for (turn, most) in [(Turn::Left, 1 + count / 2), (Turn::Right, count)] {
                    let mut laid = first;
                    while faces.len() < most
                        && let Some(next) = laid.beside(mesh, charts, v, turn)
                    {
                        laid = next;
                        faces.push(laid);
                    }
                }
            }
        }
        faces
    }
}
