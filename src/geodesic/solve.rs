//! The wavefront: sheaves of beams swept over the mesh, one half-edge at a time.
//!
//! Pending beams wait at the half-edge through which they enter its face. The half-edge with about
//! the nearest of them is swept next: the opposite corner gets its distance, the beams part there
//! and wait at the two other edges, but for those that a path through a corner beats (Xin, Wang,
//! *Improving Chen and Han's algorithm on the discrete geodesic problem*, 2009). Vertices where a
//! shortest path can bend, i.e. saddles and the border, become sources of beams that fill their
//! shadow.
//!
//! Nothing is kept of a beam once it is swept; a path is found again from the arrival
//! directions at the vertices (see `trace`).

use super::aim::Aim;
use super::beam::{Beam, Gate};
use super::charts::{BORDER, Charts};
use super::front::{Front, Next};
use super::laid::{self, V2};
use super::sheaf::{Parting, Sheaf};
use super::window::SOURCE;
use crate::surface::{HalfEdge, Mesh, SurfacePoint};

/// A target counts as inside a window that misses it by less than this share of the edge,
/// measured at the target. The bend that such a path would need lengthens it by the square.
const WIDENING: f64 = 1e-10;

/// A window is beaten only by a path that is shorter by more than rounding; a tie may be the
/// same path.
pub(super) const CLEARLY: f64 = 1.0 + 1e-14;

/// Where the shortest path to a point comes from: straight from `root`, whose unfolded place is
/// (x, y) in the chart of the half-edge `entry`, above which the point lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Approach {
    pub(super) entry: u32,
    pub(super) root: u32,
    pub(super) x: f64,
    pub(super) y: f64,
}

impl Approach {
    pub(super) const NONE: Self = Self {
        entry: BORDER,
        root: SOURCE,
        x: 0.0,
        y: 0.0,
    };
}

/// A point that is no vertex and whose distance is wanted.
#[derive(Debug, Clone)]
pub(super) struct Target {
    pub(super) point: SurfacePoint,
    pub(super) distance: f64,
    pub(super) approach: Approach,
}

/// What a sweep yields.
pub(super) struct Swept {
    /// Per vertex, infinite where not reached.
    pub(super) distances: Vec<f64>,
    /// Per vertex.
    pub(super) approaches: Vec<Approach>,
    /// In the order asked for.
    pub(super) targets: Vec<Target>,
    /// Distances up to here are final.
    pub(super) horizon: f64,
}

/// What ends a sweep early.
#[derive(Debug, Clone, Copy)]
pub(super) enum Until<'a> {
    /// Nothing: the whole component is swept.
    Done,
    /// All targets, and these vertices, are final.
    Reached(&'a [u32]),
    /// All points within a distance, metres, are final.
    Beyond(f64),
}

/// A solve in progress.
pub(super) struct Sweep<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) charts: &'a Charts,
    pub(super) distances: Vec<f64>,
    pub(super) approaches: Vec<Approach>,
    pub(super) targets: Vec<Target>,
    /// Per face the first target in or on it and per entry the next one; empty without targets.
    pub(super) targets_of_face: Vec<(u32, u32)>,
    /// Windows nearer than this are still wanted.
    bound: f64,
    pub(super) aim: Aim,
    pub(super) front: &'a mut Front,
    parting: Parting,
}

impl<'a> Sweep<'a> {
    pub(super) fn new(
        mesh: &'a Mesh,
        charts: &'a Charts,
        front: &'a mut Front,
        targets: &[SurfacePoint],
        aim: Aim,
    ) -> Self {
        let targets: Vec<Target> = targets
            .iter()
            .map(|&point| Target {
                point,
                distance: f64::INFINITY,
                approach: Approach::NONE,
            })
            .collect();
        let mut targets_of_face = Vec::new();
        for (i, target) in targets.iter().enumerate() {
            for face in target.point.faces(mesh) {
                targets_of_face.push((face, i as u32));
            }
        }
        targets_of_face.sort_unstable();
        let vertices = mesh.positions().len();
        Self {
            mesh,
            charts,
            distances: vec![f64::INFINITY; vertices],
            approaches: vec![Approach::NONE; vertices],
            targets,
            targets_of_face,
            bound: aim.farthest(),
            aim,
            front,
            parting: Parting::default(),
        }
    }

    /// Sweeps from a source.
    pub(super) fn run(mut self, source: &SurfacePoint, until: Until<'_>) -> Swept {
        if let Until::Beyond(radius) = until {
            self.bound = radius;
        }
        self.start(source);
        let mut since_bound = 0;
        // Keys of sheaves are not exact: whether one is beyond the bound is seen when its turn comes.
        while let Some((distance, next)) = self.front.pop() {
            if let Until::Reached(vertices) = until {
                since_bound += 1;
                if since_bound == 16 {
                    since_bound = 0;
                    self.bound = self.farthest(vertices).min(self.aim.farthest());
                }
            }
            match next {
                Next::HalfEdge(h) => self.sweep(HalfEdge(h), distance),
                Next::Vertex(v) => {
                    if distance <= self.bound.min(self.aim.left_at(self.mesh, v)) {
                        self.bend_at(v, distance);
                    }
                }
            }
        }
        if let Until::Reached(vertices) = until {
            self.bound = self.farthest(vertices);
        }
        Swept {
            distances: self.distances,
            approaches: self.approaches,
            targets: self.targets,
            horizon: self.bound,
        }
    }

    /// The largest distance still wanted.
    fn farthest(&self, vertices: &[u32]) -> f64 {
        let targets = self.targets.iter().map(|t| t.distance);
        let vertices = vertices.iter().map(|&v| self.distances[v as usize]);
        targets.chain(vertices).fold(0.0, f64::max)
    }

    pub(super) fn targets_in(&self, face: u32) -> std::ops::Range<usize> {
        if self.targets_of_face.is_empty() {
            return 0..0;
        }
        let begin = self.targets_of_face.partition_point(|t| t.0 < face);
        let count = self.targets_of_face[begin..]
            .iter()
            .take_while(|t| t.0 == face)
            .count();
        begin..begin + count
    }

    /// Lowers the distance of a vertex.
    pub(super) fn reach(&mut self, v: u32, distance: f64, approach: Approach) {
        let known = self.distances[v as usize];
        if distance >= known {
            return;
        }
        self.distances[v as usize] = distance;
        self.approaches[v as usize] = approach;
        // A gain within rounding casts the same shadow again.
        if self.charts.bends[v as usize] && distance * CLEARLY < known && distance < self.bound {
            self.front.push_vertex(v, distance);
        }
    }

    /// Carries the waiting sheaf of a half-edge across its face.
    fn sweep(&mut self, h: HalfEdge, nearest: f64) {
        let Some(mut sheaf) = self.front.take(h.0) else {
            return;
        };
        let corners = self.mesh.faces()[h.face() as usize];
        let [a, b, c] = [0, 1, 2].map(|i| corners[(h.corner() + i) % 3]);
        let at = |v: u32| self.distances[v as usize];
        if nearest > self.bound && !sheaf.settle([at(a), at(b)], self.bound) {
            self.front.recycle(sheaf.beams);
            return;
        }
        let gate = sheaf.gate;
        let step = &self.charts.steps[h.0 as usize];
        let corner = laid::apex(gate.left, gate.right, step);
        let slack = WIDENING * gate.length;
        let mut parting = std::mem::take(&mut self.parting);
        let first = parting.at(&sheaf.beams, corner, slack, gate.length);
        if let Some((distance, beam)) = first {
            self.reach(c, distance, approach(h, &gate, &beam));
        }
        self.meet_targets(h, &sheaf);
        let [left, right] = parting.divide(sheaf.beams, self.front.spare());
        self.parting = parting;
        let age = sheaf.age;
        self.enter(
            step.left_exit,
            h.prev(),
            left,
            [gate.left, corner],
            [a, c],
            age,
        );
        self.enter(
            step.right_exit,
            h.next(),
            right,
            [corner, gate.right],
            [c, b],
            age,
        );
    }

    /// Beams on one of the other edges of a face: they wait at the half-edge of the face beyond.
    fn enter(
        &mut self,
        entry: u32,
        exit: HalfEdge,
        beams: Vec<Beam>,
        places: [V2; 2],
        ends: [u32; 2],
        age: u32,
    ) {
        if entry == BORDER || beams.is_empty() {
            self.front.recycle(beams);
            return;
        }
        let mut sheaf = Sheaf {
            beams,
            gate: Gate::new(places[0], places[1]),
            covers: [0.0; 2],
            nearest: 0.0,
            age,
        };
        let limit = self.aim.limit(self.mesh, exit, sheaf.gate.length);
        sheaf.age(&mut self.front.lists);
        let at = ends.map(|v| self.distances[v as usize]);
        if sheaf.settle(at, limit.min(self.bound)) {
            self.front.arrive(entry, sheaf);
        } else {
            self.front.recycle(sheaf.beams);
        }
    }

    /// Offers the targets in the face above `h` the straight lines of the sheaf there.
    fn meet_targets(&mut self, h: HalfEdge, sheaf: &Sheaf) {
        let gate = &sheaf.gate;
        for i in self.targets_in(h.face()) {
            let target = &mut self.targets[self.targets_of_face[i].1 as usize];
            let Some(at) = self.charts.coordinates_above(self.mesh, h, &target.point) else {
                continue; // on the edge itself: met in the face before
            };
            let place = gate.place(at);
            let slack = WIDENING * gate.length;
            for beam in &sheaf.beams {
                if beam.covers(place, slack) {
                    let distance = beam.distance(place);
                    if distance < target.distance {
                        target.distance = distance;
                        target.approach = approach(h, gate, beam);
                    }
                }
            }
        }
    }
}

fn approach(h: HalfEdge, gate: &Gate, beam: &Beam) -> Approach {
    let [x, y] = gate.in_chart(beam.from);
    Approach {
        entry: h.0,
        root: beam.root,
        x,
        y,
    }
}
