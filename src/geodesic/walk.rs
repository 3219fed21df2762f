//! Paths from one point while their other end moves in small steps.

use super::charts::Charts;
use super::laid::{Laid, V2};
use super::lens::Lens;
use super::relax::{EQUAL, Relaxer, Tight, face_at};
use super::shoot::{Shooter, Strip, base};
use super::{Arrival, Geodesics, Path};
use crate::surface::{HalfEdge, Mesh, SurfacePoint, Tangent};

/// Lines shot for one path before its strip is turned by hand.
const SHOTS: usize = 2;

/// Promising branches that are followed from one path.
const TRIALS: usize = 4;

/// Changes from branch to branch of one path.
const MOST_BRANCHES: usize = 16;

/// A shortest path whose end can be moved: where it goes in small steps, each costs little more than
/// the crossings of the path.
///
/// The path stays the shortest among all those around it. Whether it is the shortest of all is for
/// [`Geodesics::shortest`] to say.
pub struct Follow<'g> {
    walk: Walk<'g>,
    last: Laid,
}

impl<'g> Geodesics<'g> {
    /// Takes up a path to move its end; `None` if its start is no point of the mesh.
    pub fn follow(&'g self, path: &Path) -> Option<Follow<'g>> {
        let start = self.checked(path.points.first()?).ok()?;
        let mut walk = Walk::new(self.mesh, &self.charts, &start)?;
        let last = walk.take_up(&path.reversed())?;
        Some(Follow { walk, last })
    }
}

impl Follow<'_> {
    /// The path to a point close to the end of the last one; `None` where it is lost.
    pub fn to(&mut self, point: &SurfacePoint) -> Option<Arrival> {
        let tight = self.walk.step(&self.last, point)?;
        self.last = tight.last;
        Some(tight.arrival())
    }
}

/// Follows paths from a point.
pub(super) struct Walk<'a> {
    mesh: &'a Mesh,
    charts: &'a Charts,
    from: SurfacePoint,
    base: Laid,
    shooter: Shooter<'a>,
    relaxer: Relaxer<'a>,
    lens: Lens,
    strip: Strip,
}

impl<'a> Walk<'a> {
    /// Paths from a checked point.
    pub(super) fn new(mesh: &'a Mesh, charts: &'a Charts, from: &SurfacePoint) -> Option<Self> {
        Some(Self {
            mesh,
            charts,
            from: *from,
            base: base(mesh, charts, from)?,
            shooter: Shooter::new(mesh, charts),
            relaxer: Relaxer::new(mesh, charts),
            lens: Lens::default(),
            strip: Strip::default(),
        })
    }

    /// Takes up a path that ends at the walk's point, from there to where it begins; where it ends
    /// in the plane.
    pub(super) fn take_up(&mut self, path: &Path) -> Option<Laid> {
        self.strip = Strip::along(self.mesh, path)?;
        let (base, strip) = (&self.base, &mut self.strip);
        let begin = path.points.first()?;
        let tight = self.relaxer.relax(&self.from, base, strip, begin)?;
        Some(tight.last)
    }

    /// The path to a point close to the end of the path before.
    pub(super) fn step(&mut self, last: &Laid, to: &SurfacePoint) -> Option<Tight> {
        let image = self.shooter.image_near(last, to)?;
        self.towards(image, to)
    }

    /// The path to a point close to the end of a path that leaves in a known direction.
    pub(super) fn leap(
        &mut self,
        start: &Tangent,
        length: f64,
        end: &SurfacePoint,
        to: &SurfacePoint,
    ) -> Option<Tight> {
        let (mesh, charts) = (self.mesh, self.charts);
        let laid = face_at(mesh, charts, &self.from, &self.base, start.face)?;
        let along = Charts::from_space(mesh, laid.entry, &start.direction);
        let at = laid.in_plane(charts, along.map(|x| x * length));
        let (base, strip) = (&self.base, &mut self.strip);
        let shot = self.shooter.shoot(&self.from, base, at, end, strip)?;
        self.step(&shot.end, to)
    }

    /// The shortest path to a point among those with about this image and the branches around.
    fn towards(&mut self, image: V2, to: &SurfacePoint) -> Option<Tight> {
        let best = self.locally_towards(image, to)?;
        Some(self.improve(best, to))
    }

    /// Goes over to shorter branches, from the path that was relaxed last.
    pub(super) fn improve(&mut self, mut best: Tight, to: &SurfacePoint) -> Tight {
        let mut kept = Strip::default();
        'branches: for _ in 0..MOST_BRANCHES {
            let around = self.relaxer.last();
            let promising = self.lens.shorter(self.mesh, self.charts, around, &best);
            let images: Vec<V2> = promising.iter().take(TRIALS).map(|p| p.1).collect();
            for image in images {
                std::mem::swap(&mut kept, &mut self.strip);
                match self.locally_towards(image, to) {
                    Some(other) if other.length < best.length * (1.0 - EQUAL) => {
                        best = other;
                        continue 'branches;
                    }
                    _ => {
                        std::mem::swap(&mut kept, &mut self.strip);
                        best.doubtful = true;
                    }
                }
            }
            break;
        }
        best
    }

    /// A locally shortest path to a point with about this image.
    fn locally_towards(&mut self, mut image: V2, to: &SurfacePoint) -> Option<Tight> {
        let (from, base, strip) = (&self.from, &self.base, &mut self.strip);
        for _ in 0..SHOTS {
            let shot = self.shooter.shoot(from, base, image, to, strip)?;
            image = shot.image;
            if shot.straight {
                break;
            }
        }
        self.relaxer.relax(from, base, strip, to)
    }

    /// The best path through a strip that leads to a point.
    pub(super) fn path_through(&mut self, strip: Strip, to: &SurfacePoint) -> Option<Path> {
        self.strip = strip;
        let (from, base, strip) = (&self.from, &self.base, &mut self.strip);
        let tight = self.relaxer.relax(from, base, strip, to)?;
        self.improve(tight, to);
        self.relaxer.path(&self.from, &self.base, &self.strip, to)
    }
}

impl Tight {
    /// Seen from its end.
    pub(super) fn arrival_reversed(&self) -> Arrival {
        let turned = |tangent: Tangent| Tangent {
            face: tangent.face,
            direction: -tangent.direction,
        };
        Arrival {
            length: self.length,
            start: turned(self.end),
            end: turned(self.start),
        }
    }

    /// Seen from its begin.
    pub(super) fn arrival(&self) -> Arrival {
        Arrival {
            length: self.length,
            start: self.start,
            end: self.end,
        }
    }
}

impl Strip {
    /// The faces along a path, from its end to its begin.
    pub(super) fn along(mesh: &Mesh, path: &Path) -> Option<Self> {
        let mut faces = path.faces.iter().rev();
        let first = *faces.next()?;
        let mut strip = Self {
            through: Vec::new(),
            face: first,
        };
        let mut here = first;
        for (&face, point) in faces.zip(path.points[1..].iter().rev().skip(1)) {
            if face == here {
                continue;
            }
            let exits = [0, 1, 2].map(|corner| HalfEdge::new(here, corner));
            let crossed = exits
                .into_iter()
                .find(|&h| mesh.twin(h).map(HalfEdge::face) == Some(face));
            match (crossed, *point) {
                (Some(exit), _) => strip.through.push(exit),
                (None, SurfacePoint::Vertex(v)) => {
                    // Round the vertex, counter-clockwise or else the other way.
                    let begin = strip.through.len();
                    if !round(mesh, v, here, face, Turn::Left, &mut strip.through) {
                        strip.through.truncate(begin);
                        if !round(mesh, v, here, face, Turn::Right, &mut strip.through) {
                            return None;
                        }
                    }
                }
                _ => return None,
            }
            here = face;
        }
        Some(strip)
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Turn {
    /// Counter-clockwise around a vertex.
    Left,
    /// Clockwise.
    Right,
}

/// Half-edges left on the way around a vertex from one face to another; whether the border lets
/// pass.
fn round(mesh: &Mesh, v: u32, from: u32, to: u32, turn: Turn, through: &mut Vec<HalfEdge>) -> bool {
    let Some(mut spoke) = mesh.outgoing(v).find(|h| h.face() == from) else {
        return false;
    };
    for _ in 0..mesh.faces().len() {
        if spoke.face() == to {
            return true;
        }
        let exit = match turn {
            Turn::Left => spoke.prev(),
            Turn::Right => spoke,
        };
        let Some(twin) = mesh.twin(exit) else {
            return false;
        };
        through.push(exit);
        spoke = match turn {
            Turn::Left => twin,
            Turn::Right => twin.next(),
        };
    }
    false
}
