//! The wavefront: windows swept over the mesh in batches, one half-edge at a time.
//!
//! Pending windows wait at the half-edge through which they enter its face, as one sorted list
//! without overlap. The half-edge with the nearest pending window is swept next: windows that a
//! path through a corner of the face beats are dropped (Xin, Wang, *Improving Chen and Han's
//! algorithm on the discrete geodesic problem*, 2009), the opposite corner gets its distance, and
//! what remains is carried to the two other edges. Vertices where a shortest path can bend, i.e.
//! saddles and the border, become sources of windows that fill their shadow.
//!
//! Nothing is kept of a window once it is swept; a path is found again from the arrival
//! directions at the vertices (see `trace`).

use super::aim::Aim;
use super::charts::{BORDER, Chart, Charts};
use super::front::{Front, Next};
use super::trim;
use super::window::{SOURCE, Window};
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
    pub(super) scratch: Scratch,
}

/// Lists that every step of a sweep uses again.
#[derive(Default)]
pub(super) struct Scratch {
    left: Vec<Window>,
    pub(super) right: Vec<Window>,
    /// Per window where its line to the opposite corner crosses the edge; NaN if it is beaten.
    crossings: Vec<f64>,
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
            scratch: Scratch::default(),
        }
    }

    /// Sweeps from a source.
    pub(super) fn run(mut self, source: &SurfacePoint, until: Until<'_>) -> Swept {
        if let Until::Beyond(radius) = until {
            self.bound = radius;
        }
        self.start(source);
        let mut since_bound = 0;
        while let Some((distance, next)) = self.front.pop(self.bound) {
            if let Until::Reached(vertices) = until {
                since_bound += 1;
                if since_bound == 16 {
                    since_bound = 0;
                    self.bound = self.farthest(vertices).min(self.aim.farthest());
                }
            }
            match next {
                Next::HalfEdge(h) => self.sweep(HalfEdge(h)),
                Next::Vertex(v) => self.bend_at(v, distance),
            }
        }
        if let Until::Reached(vertices) = until {
            self.bound = self.farthest(vertices);
        }
        self.front.clear();
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

    /// Carries the waiting windows of a half-edge across its face.
    fn sweep(&mut self, h: HalfEdge) {
        let Some((slot, windows)) = self.front.take(h.0) else {
            return;
        };
        let chart = self.charts.chart(h);
        let corners = self.mesh.faces()[h.face() as usize];
        let a = corners[h.corner()] as usize;
        let b = corners[(h.corner() + 1) % 3] as usize;
        let c = corners[(h.corner() + 2) % 3];
        let apex = chart.apex();
        let (at_a, at_b) = (self.distances[a], self.distances[b]);
        let mut crossings = std::mem::take(&mut self.scratch.crossings);
        crossings.clear();
        let mut nearest = f64::INFINITY;
        let mut best = 0;
        for (i, w) in windows.iter().enumerate() {
            let beaten_by_a = (at_a + w.b1) * CLEARLY < w.d1;
            let beaten_by_b = (at_b + (chart.length - w.b0)) * CLEARLY < w.d0;
            if beaten_by_a || beaten_by_b || w.nearest() > self.bound {
                crossings.push(f64::NAN);
                continue;
            }
            let to_c = w.crossing(apex);
            crossings.push(to_c);
            if let Some(distance) = straight(w, chart, apex, to_c)
                && distance < nearest
            {
                nearest = distance;
                best = i;
            }
        }
        if nearest < f64::INFINITY {
            self.reach(c, nearest, approach(h, &windows[best]));
        }
        self.meet_targets(h, &windows, &crossings);
        let known = [at_a, at_b, self.distances[c as usize]];
        if chart.left_exit != BORDER {
            let limit = self.aim.limit(self.mesh, h.prev(), chart.left_length);
            self.cross_left(&windows, &crossings, chart, known, limit);
            self.front.arrive(chart.left_exit, &mut self.scratch.left);
        }
        if chart.right_exit != BORDER {
            let limit = self.aim.limit(self.mesh, h.next(), chart.right_length);
            self.cross_right(&windows, &crossings, chart, known, limit);
            self.front.arrive(chart.right_exit, &mut self.scratch.right);
        }
        self.scratch.crossings = crossings;
        self.front.recycle(slot, windows);
    }

    /// Offers the targets in the face above `h` the straight lines through the windows there.
    fn meet_targets(&mut self, h: HalfEdge, windows: &[Window], crossings: &[f64]) {
        for i in self.targets_in(h.face()) {
            let target = &mut self.targets[self.targets_of_face[i].1 as usize];
            let Some(at) = self.charts.coordinates_above(self.mesh, h, &target.point) else {
                continue; // on the edge itself: met in the face before
            };
            let chart = self.charts.chart(h);
            for (w, _) in windows.iter().zip(crossings).filter(|(_, c)| !c.is_nan()) {
                if let Some(distance) = straight(w, chart, at, w.crossing(at))
                    && distance < target.distance
                {
                    target.distance = distance;
                    target.approach = approach(h, w);
                }
            }
        }
    }

    /// Windows on the edge A→C of the face beyond.
    fn cross_left(
        &mut self,
        windows: &[Window],
        crossings: &[f64],
        chart: &Chart,
        at: [f64; 3],
        limit: f64,
    ) {
        let bound = self.bound.min(limit);
        let list = &mut self.scratch.left;
        list.clear();
        let [at_a, _, at_c] = at;
        for (w, &to_c) in windows.iter().zip(crossings) {
            if to_c.is_nan() || to_c <= w.b0 {
                continue;
            }
            let end = (to_c > w.b1).then_some(w.b1);
            if let Some(child) = w.through_left(chart, w.b0, end)
                && (at_a + child.b1) * CLEARLY >= child.d1
                && (at_c + (chart.left_length - child.b0)) * CLEARLY >= child.d0
                && child.nearest() <= bound
            {
                trim::push(list, child);
            }
        }
    }

    /// Windows on the edge C→B of the face beyond.
    fn cross_right(
        &mut self,
        windows: &[Window],
        crossings: &[f64],
        chart: &Chart,
        at: [f64; 3],
        limit: f64,
    ) {
        let bound = self.bound.min(limit);
        let list = &mut self.scratch.right;
        list.clear();
        let [_, at_b, at_c] = at;
        for (w, &to_c) in windows.iter().zip(crossings) {
            if to_c.is_nan() || to_c >= w.b1 {
                continue;
            }
            let begin = (to_c < w.b0).then_some(w.b0);
            if let Some(child) = w.through_right(chart, begin, w.b1)
                && (at_c + child.b1) * CLEARLY >= child.d1
                && (at_b + (chart.right_length - child.b0)) * CLEARLY >= child.d0
                && child.nearest() <= bound
            {
                trim::push(list, child);
            }
        }
    }
}

fn approach(h: HalfEdge, w: &Window) -> Approach {
    Approach {
        entry: h.0,
        root: w.root,
        x: w.x,
        y: -w.depth,
    }
}

/// Distance of a point in the face above a window, if the straight line to it passes the window.
fn straight(w: &Window, chart: &Chart, point: [f64; 2], crossing: f64) -> Option<f64> {
    let rise = point[1] + w.depth;
    let tolerance = WIDENING * chart.length * (w.depth / rise);
    (crossing >= w.b0 - tolerance && crossing <= w.b1 + tolerance).then(|| {
        let dx = point[0] - w.x;
        w.sigma + (dx * dx + rise * rise).sqrt()
    })
}
