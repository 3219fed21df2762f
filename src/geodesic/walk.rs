//! Paths from one point while their other end moves in small steps.

use super::bounds::Bounds;
use super::charts::Charts;
use super::laid::{Laid, Turn, V2, norm};
use super::near::Near;
use super::rays::Rays;
use super::relax::{FEW_TURNS, MOST_TURNS, Relaxer, face_at};
use super::shoot::{Shooter, base};
use super::unrolled::{Strip, Tight, Unrolled};
use super::{Arrival, Geodesics, Path};
use crate::surface::{HalfEdge, Mesh, SurfacePoint, Tangent, Vector3};

/// Lines shot for one path before its strip is turned by hand.
const SHOTS: usize = 2;

/// A path whose end can be moved: where it goes in small steps, each costs little more than the
/// crossings of the path.
///
/// The path is shortest among its neighbours; [`Follow::proven`] says whether it is the shortest
/// of all.
pub struct Follow<'g> {
    geodesics: &'g Geodesics<'g>,
    walk: Walk<'g>,
    last: Laid,
}

impl<'g> Geodesics<'g> {
    /// Takes up a path to move its end; `None` if its start is no point of the mesh.
    pub fn follow(&'g self, path: &Path) -> Option<Follow<'g>> {
        let start = self.checked(path.points.first()?).ok()?;
        let mut walk = Walk::new(self.mesh, &self.charts, &start)?;
        let last = walk.take_up(&path.reversed())?;
        Some(Follow {
            geodesics: self,
            walk,
            last,
        })
    }
}

impl Follow<'_> {
    /// The path to a point close to the end of the last one; `None` where it is lost.
    pub fn to(&mut self, point: &SurfacePoint) -> Option<Arrival> {
        let tight = self.walk.step(&self.last, point)?;
        self.last = tight.last;
        Some(tight.arrival())
    }

    /// The shortest path of all to a point close to the end of the last one, proven so; `None`
    /// where that cannot be told without [`Geodesics::shortest`].
    pub fn proven(&mut self, point: &SurfacePoint) -> Option<Path> {
        let near = self.walk.step(&self.last, point)?;
        let proven = self.geodesics.prove(&mut self.walk, &near, point);
        let tight = proven.ok()?;
        self.last = tight.last;
        self.walk.path(point)
    }
}

/// Follows paths from a point; keeps what it allocates.
pub(super) struct Walk<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) charts: &'a Charts,
    pub(super) from: SurfacePoint,
    pub(super) base: Laid,
    /// The strip of the path that was found last, laid flat.
    pub(super) unrolled: Unrolled,
    pub(super) bounds: Bounds,
    pub(super) near: Near,
    pub(super) rays: Rays,
    strip: Strip,
    shooter: Shooter<'a>,
    relaxer: Relaxer<'a>,
}

impl<'a> Walk<'a> {
    /// Paths from a checked point.
    pub(super) fn new(mesh: &'a Mesh, charts: &'a Charts, from: &SurfacePoint) -> Option<Self> {
        let base = base(mesh, charts, from)?;
        Some(Self {
            mesh,
            charts,
            from: *from,
            base,
            unrolled: Unrolled::new(base),
            bounds: Bounds::default(),
            near: Near::default(),
            rays: Rays::default(),
            strip: Strip::default(),
            shooter: Shooter::new(mesh, charts),
            relaxer: Relaxer::new(mesh, charts),
        })
    }

    /// Takes up a path that ends at the walk's point, from there to where it begins; where it ends
    /// in the plane.
    pub(super) fn take_up(&mut self, path: &Path) -> Option<Laid> {
        let strip = Strip::along(self.mesh, path)?;
        Some(self.through(strip, path.points.first()?)?.last)
    }

    /// The locally shortest path that a strip leads to.
    pub(super) fn through(&mut self, strip: Strip, to: &SurfacePoint) -> Option<Tight> {
        self.strip = strip;
        self.relax(to, MOST_TURNS)
    }

    /// The locally shortest path to a point close to the end of a path before.
    pub(super) fn step(&mut self, last: &Laid, to: &SurfacePoint) -> Option<Tight> {
        let image = self.shooter.image_near(last, to)?;
        self.towards(image, to, MOST_TURNS)
    }

    /// The same, on the branch of the path before: `None` where that ends.
    pub(super) fn step_on(&mut self, last: &Laid, to: &SurfacePoint) -> Option<Tight> {
        let image = self.shooter.image_near(last, to)?;
        self.towards(image, to, FEW_TURNS)
    }

    /// Where a path ends in the plane that leaves in a known direction.
    pub(super) fn shot(
        &mut self,
        start: &Tangent,
        length: f64,
        end: &SurfacePoint,
    ) -> Option<Laid> {
        let (mesh, charts) = (self.mesh, self.charts);
        let laid = face_at(mesh, charts, &self.from, &self.base, start.face)?;
        let along = Charts::from_space(mesh, laid.entry, &start.direction);
        let at = laid.in_plane(charts, along.map(|x| x * length));
        self.shoot(at, end)?;
        Some(*self.unrolled.last())
    }

    /// A locally shortest path to a point that lies ahead in space.
    pub(super) fn cast(&mut self, ahead: &Vector3, to: &SurfacePoint) -> Option<Tight> {
        let (mesh, charts) = (self.mesh, self.charts);
        // Leaning to the face that the line would begin in, as far as the target is away.
        let along = Charts::from_space(mesh, self.base.entry, ahead);
        let stretch = ahead.norm() / norm(along);
        let image = self.base.in_plane(charts, along.map(|x| x * stretch));
        image
            .iter()
            .all(|x| x.is_finite())
            .then(|| self.towards(image, to, MOST_TURNS))?
    }

    /// A locally shortest path to a point with about this image.
    fn towards(&mut self, mut image: V2, to: &SurfacePoint, turns: usize) -> Option<Tight> {
        for _ in 0..SHOTS {
            if self.shoot(image, to)? {
                // No line through this strip is shorter than the straight one.
                return self.unrolled.tight(self.mesh, self.charts);
            }
            image = self.unrolled.image;
        }
        self.relax(to, turns)
    }

    fn shoot(&mut self, at: V2, to: &SurfacePoint) -> Option<bool> {
        let from = (&self.from, &self.base);
        self.shooter
            .shoot(from, at, to, &mut self.strip, &mut self.unrolled)
    }

    fn relax(&mut self, to: &SurfacePoint, turns: usize) -> Option<Tight> {
        let from = (&self.from, &self.base);
        self.relaxer
            .relax(from, &mut self.strip, to, &mut self.unrolled, turns)?;
        self.unrolled.tight(self.mesh, self.charts)
    }

    /// The path that was found last, with all its crossings.
    pub(super) fn path(&mut self, to: &SurfacePoint) -> Option<Path> {
        // A strip that was shot may begin and end with edges that the path only touches.
        self.relax(to, MOST_TURNS)?;
        self.relaxer
            .path(&self.from, &self.strip, to, &self.unrolled)
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
