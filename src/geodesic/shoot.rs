//! Strips of faces towards a point whose direction is roughly known: a straight line is shot at
//! the image that the point has when the faces on the way are laid flat.
//!
//! A line shot at the image passes every vertex on the side that its direction says, so one shot
//! corrects all sides at once; a few shots find the strip that holds the straight line, if there
//! is one, and a close one where the path bends.

use super::charts::{BORDER, Charts};
use super::laid::{Laid, V2, apex, cross, sub};
use super::unrolled::{Strip, Unrolled};
use crate::surface::{HalfEdge, Mesh, SurfacePoint};

/// Faces that are searched around the end of a line for its target.
const NEAR: usize = 400;

/// Shoots lines from points of a mesh; keeps what it allocates.
pub(super) struct Shooter<'a> {
    mesh: &'a Mesh,
    charts: &'a Charts,
    /// Faces met by a search, each with the one it was met from.
    seen: Vec<(Laid, u32)>,
    /// Those not yet left, with their squared distance from the target.
    open: Vec<(f64, u32)>,
}

impl<'a> Shooter<'a> {
    pub(super) fn new(mesh: &'a Mesh, charts: &'a Charts) -> Self {
        Self {
            mesh,
            charts,
            seen: Vec::new(),
            open: Vec::new(),
        }
    }

    /// Follows the straight line from `base`'s origin towards an image of the target, then the
    /// shortest way over faces to the target itself. The strip is left laid flat, but not pulled
    /// tight; whether the straight line to the target passes through all of it.
    ///
    /// `None` where the target is not found near the end of the line.
    pub(super) fn shoot(
        &mut self,
        (from, base): (&SurfacePoint, &Laid),
        at: V2,
        target: &SurfacePoint,
        strip: &mut Strip,
        unrolled: &mut Unrolled,
    ) -> Option<bool> {
        strip.through.clear();
        unrolled.faces.clear();
        unrolled.bends.clear();
        unrolled.first = self.first_face(from, base, at);
        strip.face = unrolled.first.entry.face();
        self.fly(at, strip, unrolled);
        self.search(target, strip, unrolled)?;
        unrolled.image = unrolled.last().image(self.mesh, self.charts, target)?;
        Some(unrolled.is_straight())
    }

    /// Follows a straight line from the origin, which lies in or on a face, to its end or to the
    /// border.
    fn fly(&self, at: V2, strip: &mut Strip, unrolled: &mut Unrolled) {
        let (mesh, charts) = (self.mesh, self.charts);
        let first = unrolled.first;
        let ends_before = |left: V2, right: V2| cross(sub(right, left), sub(at, left)) <= 0.0;
        let corner = first.apex(charts);
        let exit = first_exit(&first, corner, at);
        let (left, right) = gate(&first, corner, exit);
        if ends_before(left, right) {
            return;
        }
        let Some(second) = first.across(mesh, charts, exit) else {
            return;
        };
        strip.through.push(exit);
        unrolled.faces.push(second);
        let mut here = second;
        // A straight line may meet a face more than once, but not without end.
        for _ in 0..4 * mesh.faces().len() {
            let step = &charts.steps[here.entry.0 as usize];
            let corner = apex(here.left, here.right, step);
            let (next, exit) = if cross(at, corner) > 0.0 {
                let entry = HalfEdge(step.right_exit);
                let next = Laid {
                    entry,
                    left: corner,
                    ..here
                };
                (next, here.entry.next())
            } else {
                let entry = HalfEdge(step.left_exit);
                let next = Laid {
                    entry,
                    right: corner,
                    ..here
                };
                (next, here.entry.prev())
            };
            if ends_before(next.left, next.right) || next.entry.0 == BORDER {
                break;
            }
            strip.through.push(exit);
            unrolled.faces.push(next);
            here = next;
        }
    }

    /// Image of a target seen over the faces near the end of a strip.
    pub(super) fn image_near(&mut self, end: &Laid, target: &SurfacePoint) -> Option<V2> {
        let found = self.find(*end, target)?;
        self.seen[found].0.image(self.mesh, self.charts, target)
    }

    /// The face around a point into which a direction of the plane points.
    fn first_face(&self, from: &SurfacePoint, base: &Laid, at: V2) -> Laid {
        let (mesh, charts) = (self.mesh, self.charts);
        match *from {
            SurfacePoint::Face { .. } => *base,
            SurfacePoint::Edge { .. } => {
                let along = sub(base.right, base.left);
                if cross(along, at) >= 0.0 {
                    *base
                } else {
                    base.across(mesh, charts, base.entry).unwrap_or(*base)
                }
            }
            SurfacePoint::Vertex(v) => {
                // `spoke` leaves the vertex; its face lies left of it.
                let (mut laid, mut spoke) = (*base, base.entry);
                let faces = mesh.outgoing(v).count();
                for _ in 0..faces {
                    let apex = laid.apex(charts);
                    let image = |h: HalfEdge| {
                        // The end of a spoke that is not the vertex.
                        if h == laid.entry {
                            laid.right
                        } else if h == laid.entry.next() {
                            apex
                        } else {
                            laid.left
                        }
                    };
                    let (right, left) = (image(spoke), image(spoke.next()));
                    let exit = if cross(right, at) < 0.0 {
                        spoke
                    } else if cross(at, left) < 0.0 {
                        spoke.prev()
                    } else {
                        return laid;
                    };
                    let Some(next) = laid.across(mesh, charts, exit) else {
                        return laid;
                    };
                    spoke = if exit == spoke {
                        next.entry.next()
                    } else {
                        next.entry
                    };
                    laid = next;
                }
                laid
            }
        }
    }

    /// Goes on from the end of a strip, face by face towards the target, to one that holds it.
    fn search(
        &mut self,
        target: &SurfacePoint,
        strip: &mut Strip,
        unrolled: &mut Unrolled,
    ) -> Option<()> {
        let mut at = self.find(*unrolled.last(), target)?;
        let first = strip.through.len();
        while self.seen[at].1 != u32::MAX {
            let laid = self.seen[at].0;
            strip.through.push(self.mesh.twin(laid.entry)?);
            unrolled.faces.push(laid);
            at = self.seen[at].1 as usize;
        }
        strip.through[first..].reverse();
        unrolled.faces[first..].reverse();
        Some(())
    }

    /// The place among those seen of a face near another one that holds the target.
    fn find(&mut self, from: Laid, target: &SurfacePoint) -> Option<usize> {
        let (mesh, charts) = (self.mesh, self.charts);
        let holds = |face: u32| target.bary_in(mesh, face).is_some();
        self.seen.clear();
        self.seen.push((from, u32::MAX));
        if holds(from.entry.face()) {
            return Some(0);
        }
        let goal = target.position(mesh);
        let far = |h: HalfEdge| (mesh.position(mesh.origin(h.prev())) - goal).norm_squared();
        self.open.clear();
        self.open.push((far(from.entry), 0));
        loop {
            // The face whose far corner is nearest to the target goes first.
            let nearest =
                (0..self.open.len()).min_by(|&a, &b| self.open[a].0.total_cmp(&self.open[b].0))?;
            let (_, at) = self.open.swap_remove(nearest);
            let laid = self.seen[at as usize].0;
            let entry = laid.entry;
            for exit in [entry.next(), entry.prev(), entry] {
                let Some(next) = laid.across(mesh, charts, exit) else {
                    continue;
                };
                let face = next.entry.face();
                if self.seen.iter().any(|(laid, _)| laid.entry.face() == face) {
                    continue;
                }
                self.open.push((far(next.entry), self.seen.len() as u32));
                self.seen.push((next, at));
                if holds(face) {
                    return Some(self.seen.len() - 1);
                }
                if self.seen.len() >= NEAR {
                    return None;
                }
            }
        }
    }
}

/// The face around a point from which directions are measured, with the point at the origin.
pub(super) fn base(mesh: &Mesh, charts: &Charts, point: &SurfacePoint) -> Option<Laid> {
    let entry = match *point {
        SurfacePoint::Face { face, .. } => HalfEdge::new(face, 0),
        SurfacePoint::Edge { half_edge, .. } => half_edge,
        SurfacePoint::Vertex(v) => mesh.outgoing(v).next()?,
    };
    Laid::around(mesh, charts, entry, point)
}

/// Left and right end of a half-edge of a laid face for who leaves through it.
fn gate(laid: &Laid, apex: V2, exit: HalfEdge) -> (V2, V2) {
    if exit == laid.entry {
        (laid.right, laid.left)
    } else if exit == laid.entry.next() {
        (apex, laid.right)
    } else {
        (laid.left, apex)
    }
}

/// Where the line from the origin, which lies in or on the face, leaves it.
fn first_exit(laid: &Laid, apex: V2, at: V2) -> HalfEdge {
    let entry = laid.entry;
    let exits = [entry.next(), entry.prev(), entry];
    let passes = |&&exit: &&HalfEdge| {
        let (left, right) = gate(laid, apex, exit);
        cross(right, at) >= 0.0 && cross(at, left) >= 0.0 && cross(right, left) > 0.0
    };
    *exits.iter().find(passes).unwrap_or(&exits[0])
}
