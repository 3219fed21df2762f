//! Exact shortest geodesics on a triangle mesh between arbitrary surface points.
//!
//! Distances are those of the polyhedral surface itself, exact up to rounding: no graph, no
//! discretisation. Source and targets lie anywhere: inside faces, on edges, at vertices, on the
//! border.
//!
//! | to get | use | cost at 20,000 faces, milliseconds |
//! |---|---|---|
//! | distances from a point, near or everywhere | [`Geodesics::field`], [`Field`] | 15 to 30 |
//! | one path | [`Geodesics::shortest`] | 0.1 to 0.2 where it can be proven, else 2 to 8 |
//! | all pairs of two rows of points | [`Geodesics::table`], [`Table`] | 0.01 a pair; on both sides of a hill 0.1 |
//! | a path whose end moves | [`Geodesics::follow`], [`Follow`] | 0.01 a step |
//!
//! [`Geodesics`] is built once per mesh and shared by threads. A [`Path`] lists every crossing, so
//! that points on it lie on the surface; its end directions are the gradient of its length
//! ([`derivative_along`], the first variation). `cargo bench --bench geodesic` measures, beside an
//! independent program. Lengths are in metres, angles in radians.
//!
//! # Exact fields
//! A *window* is an interval of an edge that straight lines from one root (the source, or a vertex
//! where paths bend) reach through one sequence of faces (J. Mitchell, D. Mount, C. Papadimitriou
//! 1987). Windows are swept over the faces in batches, all that wait at a half-edge at a time, the
//! nearest first (Y. Qin, X. Han, H. Yu, Y. Yu, J. Zhang 2016). On the way nearly all of them only run on: so
//! they are kept as *beams*, a root and two directions in a plane in which the faces ahead are laid
//! out one after the other, and crossing a face leaves them as they are (`beam`). Only the corner
//! ahead is looked at: the beams of an edge pass it on one side or the other, the nearest is divided
//! there, and two lists from both sides of a corner are joined (`sheaf`). Every few faces beams are
//! laid out as windows, of which the nearer one stays where two cover the same points (`trim`,
//! `window`); those that a path through a corner beats are dropped (S. Xin, G. Wang 2009). Saddles
//! and border vertices become roots for their shadow (`source`). A beam is forgotten once it has
//! been swept: a solve holds the wave and not the surface behind it (`front`), some tens of bytes a
//! face in all. Paths are followed back from the directions in which they arrive (`trace`) and laid
//! straight in the strip of their faces (`strip`).
//!
//! Where lengths of some ways to the targets are known, windows that cannot lie on shorter ones,
//! were the rest of the way straight in space, are not swept (`aim`).
//!
//! # Locally shortest paths
//! A straight line is shot at where the target is when the faces on the way are laid flat (`shoot`).
//! If it arrives, it is a geodesic (`unrolled`). Otherwise the strip of its faces is pulled tight
//! (`funnel`) and turned round every vertex at which the path bends without need (`relax`): each turn
//! makes it strictly shorter, so this ends. A path is followed from pair to pair with the last image
//! as the aim of the next shot (`walk`); a first one is aimed at where the target lies in space, or
//! found by a search over faces (`seed`).
//!
//! # Proofs
//! A path that is shortest among its neighbours need not be the shortest. Another geodesic with the
//! same ends would enclose positive curvature with it, as much as the sum of the angles between
//! them (Gauss-Bonnet). So it can run only as far from the path as the curvature below it allows,
//! which is bounded by comparison again and again (`heights`): with the greatest density of curvature
//! on the mesh; if that leaves too much, with the curvature near the path gathered in cells, for a
//! block of neighbouring paths at once (`masses`, `bounds`, `blocks`); then with the single vertices
//! beside each path (`near`). Mostly nothing is left; else all geodesics that leave within the angle
//! that is left are followed and compared, of which there are few (`rays`; J. Chen, Y. Han 1990). A
//! row of a table is followed from both of its ends where need be, since behind a hill each leads to
//! a way on another side (`draft`). What is still open goes to the exact solver, with the shorter of
//! both as a length to beat (`proof`, `table`).
//!
//! | [`Grounds`] of the mesh | pairs |
//! |---|---|
//! | a disc without positive curvature | geodesics are unique: nothing to prove |
//! | a disc | proven one by one, else solved: where a hill has ways on both sides |
//! | not a disc | solved, since paths may pass on both sides of what is missing |
//!
//! [`Certificate`] and [`Known`] tell how many and which pairs were solved. The comparison holds for
//! narrow lenses; for wide ones it has the factor of a cone, and margins for what the bounds leave
//! out (folds, uneven trails, curvature beyond the length of the path). These margins were set by
//! trial. Of 30 million pairs on random surfaces, most of them far rougher than a design surface and
//! most of the paths laid closely past a vertex, none differed from the exact solver.
//!
//! # Accuracy
//! Distances are those of the polyhedron, to about 1e-14 of their length (against brute force on
//! small meshes and an independent program on large ones: below 1e-12). A polyhedron inscribed in a
//! smooth surface errs by the square of its edges: 3e-5 for 20,000 faces of a cap.
//!
//! # Limits
//! The border is part of the surface: paths run along it and bend round its inner corners. There is
//! no path between components: [`GeodesicError::Unreachable`]. A face with a side of no length has
//! no directions: [`GeodesicError::DegenerateFace`]. What is not known is an error and never a
//! number. A [`Follow`] stays on its branch, and says nothing of others until it is asked
//! ([`Follow::proven`]).
//!
//! The room knows meshes and points on them (`surface`) and nothing else of egg.

mod aim;
mod beam;
mod blocks;
mod bounds;
mod certificate;
mod charts;
mod crossing;
mod draft;
mod error;
mod field;
mod front;
mod funnel;
mod heights;
mod laid;
mod masses;
mod near;
mod path;
mod proof;
mod rays;
mod relax;
mod room;
mod seed;
mod sheaf;
mod shoot;
mod solve;
mod source;
mod strip;
mod table;
mod trace;
mod trail;
mod trim;
mod unrolled;
mod variation;
mod walk;
mod window;

pub use certificate::{Certificate, Grounds};
pub use crossing::{Curve, Hit, crossings};
pub use error::GeodesicError;
pub use field::{Arrival, Field};
pub use path::Path;
pub use table::{Known, Table};
pub use variation::{angle_between, derivative_along};
pub use walk::Follow;

use crate::surface::{HalfEdge, Mesh, SurfacePoint};
use aim::{Aim, Range};
use charts::Charts;
use front::Front;
use masses::Masses;
use seed::Shorter;
use solve::{Sweep, Swept, Until};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Exact geodesics on a mesh: what is computed once, shared by all solves and threads.
pub struct Geodesics<'m> {
    mesh: &'m Mesh,
    charts: Charts,
    /// Workspaces of finished solves, for the next ones; what is in them is never read.
    fronts: Mutex<Vec<Front>>,
    grounds: OnceLock<Grounds>,
    masses: OnceLock<Masses>,
}

/// How far a field is solved.
#[derive(Debug, Clone, Copy)]
pub enum Reach<'a> {
    /// Over the whole component.
    Everywhere,
    /// Until these points are known.
    Targets(&'a [SurfacePoint]),
    /// To all points within a distance, metres.
    Radius(f64),
}

/// Coordinates closer to 0 than this are 0: the point is on the edge or at the vertex.
const SNAP: f64 = 1e-12;

/// Lengths that agree to this share belong to one path.
const SAME: f64 = 1e-12;

/// Barycentric coordinates that were scaled to the sum 1 miss it by less.
const ROUNDED_SUM: f64 = 1e-14;

/// Barycentric coordinates may miss the sum 1 by so much.
const UNIT_SUM: f64 = 1e-9;

impl<'m> Geodesics<'m> {
    /// Lays every face flat.
    pub fn new(mesh: &'m Mesh) -> Self {
        Self {
            mesh,
            charts: Charts::new(mesh),
            fronts: Mutex::default(),
            grounds: OnceLock::new(),
            masses: OnceLock::new(),
        }
    }

    /// The mesh.
    pub fn mesh(&self) -> &'m Mesh {
        self.mesh
    }

    /// Distances and paths from a source.
    pub fn field<'g>(
        &'g self,
        source: &SurfacePoint,
        reach: Reach<'_>,
    ) -> Result<Field<'g>, GeodesicError> {
        if let Some(face) = self.charts.degenerate {
            return Err(GeodesicError::DegenerateFace { face });
        }
        let source = self.checked(source)?;
        let swept = match reach {
            Reach::Everywhere => self.sweep(&source, &[], Until::Done, Aim::default()),
            Reach::Radius(radius) => {
                if !(radius >= 0.0 && radius.is_finite()) {
                    return Err(GeodesicError::InvalidRadius { radius });
                }
                self.sweep(&source, &[], Until::Beyond(radius), Aim::default())
            }
            Reach::Targets(targets) => {
                let targets = self.all_checked(targets)?;
                self.sweep_to(&source, &targets, Aim::default())
            }
        };
        Ok(Field::new(self, source, swept))
    }

    /// The shortest path between two points.
    ///
    /// A path that is shortest among its neighbours is found first; where the mesh does not say
    /// that it is the only one, the exact solver looks for shorter ones, and only where these could
    /// be.
    pub fn shortest(&self, from: &SurfacePoint, to: &SurfacePoint) -> Result<Path, GeodesicError> {
        if let Some(face) = self.charts.degenerate {
            return Err(GeodesicError::DegenerateFace { face });
        }
        let (from, to) = (self.checked(from)?, self.checked(to)?);
        let near = if from == to {
            None
        } else {
            self.near_path(&from, &to)
        };
        match near {
            None => self.field(&from, Reach::Targets(&[to]))?.path_to(&to),
            Some((path, Shorter::None)) => Ok(path),
            Some((path, Shorter::Within(range))) => {
                let known = [(to, path.length)];
                let shorter = self.shorter(&from, &known, range)?.pop().flatten();
                Ok(shorter.unwrap_or(path))
            }
        }
    }

    /// Exact paths from a point that are shorter than known ones, looked for in all directions or
    /// in a range; `None` where there is none.
    fn shorter(
        &self,
        from: &SurfacePoint,
        known: &[(SurfacePoint, f64)],
        range: Option<Range>,
    ) -> Result<Vec<Option<Path>>, GeodesicError> {
        let targets: Vec<SurfacePoint> = known.iter().map(|k| k.0).collect();
        let mut aim = Aim::new(self.mesh, known);
        aim.range = range;
        let swept = self.sweep_to(from, &targets, aim);
        let field = Field::new(self, *from, swept);
        let shorter = |(to, length): &(SurfacePoint, f64)| match field.distance(to) {
            Ok(distance) if distance < length * (1.0 - SAME) => field.path_to(to).map(Some),
            // Whatever leads there was too long to be followed.
            Ok(_) | Err(GeodesicError::Unreachable { .. }) => Ok(None),
            Err(error) => Err(error),
        };
        known.iter().map(shorter).collect()
    }

    /// What is known of all geodesics of the mesh.
    fn grounds(&self) -> Grounds {
        *self
            .grounds
            .get_or_init(|| certificate::grounds(self.mesh, &self.charts))
    }

    /// The positive curvature of the mesh.
    fn masses(&self) -> &Masses {
        self.masses
            .get_or_init(|| Masses::new(self.mesh, &self.charts))
    }

    fn sweep_to(&self, source: &SurfacePoint, targets: &[SurfacePoint], aim: Aim) -> Swept {
        let mut vertices = Vec::new();
        let mut others = Vec::new();
        for target in targets {
            match *target {
                SurfacePoint::Vertex(v) => vertices.push(v),
                other => others.push(other),
            }
        }
        self.sweep(source, &others, Until::Reached(&vertices), aim)
    }

    /// Solves in a workspace that was used before, if one is free.
    fn sweep(
        &self,
        source: &SurfacePoint,
        others: &[SurfacePoint],
        until: Until<'_>,
        aim: Aim,
    ) -> Swept {
        let fronts = || self.fronts.lock().unwrap_or_else(PoisonError::into_inner);
        let free = fronts().pop();
        let mut front = free.unwrap_or_else(|| Front::new(self.charts.of.len()));
        let sweep = Sweep::new(self.mesh, &self.charts, &mut front, others, aim);
        let swept = sweep.run(source, until);
        fronts().push(front);
        swept
    }

    fn all_checked(&self, points: &[SurfacePoint]) -> Result<Vec<SurfacePoint>, GeodesicError> {
        points.iter().map(|point| self.checked(point)).collect()
    }

    /// A point with its ids and coordinates checked, named in one way only: snapped to the edge
    /// or vertex it lies on, an edge by the smaller of its half-edges.
    fn checked(&self, point: &SurfacePoint) -> Result<SurfacePoint, GeodesicError> {
        let mesh = self.mesh;
        let faces = mesh.faces().len();
        let invalid = Err(GeodesicError::InvalidPoint { point: *point });
        match *point {
            SurfacePoint::Vertex(v) => {
                if (v as usize) < mesh.positions().len() {
                    Ok(*point)
                } else {
                    invalid
                }
            }
            SurfacePoint::Edge { half_edge, at } => {
                if half_edge.0 as usize >= 3 * faces || !(0.0..=1.0).contains(&at) {
                    return invalid;
                }
                Ok(self.on_edge(half_edge, at))
            }
            SurfacePoint::Face { face, bary } => {
                let sum: f64 = bary.iter().sum();
                let inside = bary.iter().all(|&b| b >= -SNAP && b.is_finite());
                if face as usize >= faces || !inside || (sum - 1.0).abs() > UNIT_SUM {
                    return invalid;
                }
                // A sum that is 1 up to rounding stays, so that a checked point checks as itself.
                let scale = if (sum - 1.0).abs() > ROUNDED_SUM {
                    sum
                } else {
                    1.0
                };
                let bary = bary.map(|b| b.max(0.0) / scale);
                let corner = (0..3).find(|&i| bary[i] >= 1.0 - 2.0 * SNAP);
                let side = (0..3).find(|&i| bary[i] < SNAP);
                Ok(match (corner, side) {
                    (Some(corner), _) => SurfacePoint::Vertex(mesh.faces()[face as usize][corner]),
                    (None, Some(opposite)) => {
                        let h = HalfEdge::new(face, (opposite as u32 + 1) % 3);
                        let (from, to) = (bary[h.corner()], bary[h.next().corner()]);
                        self.on_edge(h, to / (from + to))
                    }
                    (None, None) => SurfacePoint::Face { face, bary },
                })
            }
        }
    }

    fn on_edge(&self, half_edge: HalfEdge, at: f64) -> SurfacePoint {
        let (half_edge, at) = match self.mesh.twin(half_edge) {
            Some(twin) if twin < half_edge => (twin, 1.0 - at),
            _ => (half_edge, at),
        };
        if at < SNAP {
            SurfacePoint::Vertex(self.mesh.origin(half_edge))
        } else if at > 1.0 - SNAP {
            SurfacePoint::Vertex(self.mesh.target(half_edge))
        } else {
            SurfacePoint::Edge { half_edge, at }
        }
    }
}
