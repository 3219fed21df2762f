//! Where windows begin: at the source, and at vertices where shortest paths bend.

use super::aim::Opening;
use super::sheaf::Sheaf;
use super::solve::{Approach, CLEARLY, Sweep};
use super::window::{SOURCE, Window};
use crate::surface::{HalfEdge, SurfacePoint};

/// A side is in a shadow that begins with it, up to this angle, radians.
const ALONG: f64 = 1e-9;

/// Straight from the origin of a half-edge.
fn from_origin(h: HalfEdge, root: u32) -> Approach {
    Approach {
        entry: h.0,
        root,
        x: 0.0,
        y: 0.0,
    }
}

impl Sweep<'_> {
    /// First windows and distances around the source.
    pub(super) fn start(&mut self, source: &SurfacePoint) {
        let range = self.aim.range.as_ref();
        if let Some(openings) = range.map(|range| range.openings(self.mesh, self.charts)) {
            self.start_in(source, &openings);
            return;
        }
        if let SurfacePoint::Vertex(v) = *source {
            self.distances[v as usize] = 0.0;
            self.fill_around(v, 0.0, SOURCE);
            return;
        }
        for face in source.faces(self.mesh) {
            for corner in 0..3 {
                let h = HalfEdge::new(face, corner);
                let Some([x, y]) = self.charts.coordinates(self.mesh, h, source) else {
                    continue;
                };
                let [cx, cy] = self.charts.chart(h).apex();
                let (dx, dy) = (cx - x, cy - y);
                let approach = Approach {
                    entry: h.0,
                    root: SOURCE,
                    x,
                    y,
                };
                let opposite = self.mesh.origin(h.prev());
                self.reach(opposite, (dx * dx + dy * dy).sqrt(), approach);
                // A source on this very edge sees the face beyond from that face's own charts.
                let on_edge = matches!(source, SurfacePoint::Edge { .. }) && y <= 0.0;
                if let (Some(twin), false) = (self.mesh.twin(h), on_edge) {
                    let length = self.charts.chart(h).length;
                    self.emit(twin, [0.0, length], length - x, y, 0.0, SOURCE);
                }
            }
            self.reach_targets_inside(face, source);
        }
    }

    /// First windows and distances in a range of directions.
    fn start_in(&mut self, source: &SurfacePoint, openings: &[Opening]) {
        for opening in openings {
            let Opening { along, depth, .. } = *opening;
            self.emit(opening.entry, opening.interval, along, depth, 0.0, SOURCE);
            let inner = self.mesh.twin(opening.entry);
            for (vertex, distance) in opening.ends.into_iter().flatten() {
                // Seen from the side of its face that is opposite.
                let opposite = inner.map(|h| {
                    if self.mesh.origin(h) == vertex {
                        h.next()
                    } else {
                        h.prev()
                    }
                });
                let Some(entry) = opposite else { continue };
                let Some([x, y]) = self.charts.coordinates(self.mesh, entry, source) else {
                    continue;
                };
                let approach = Approach {
                    entry: entry.0,
                    root: SOURCE,
                    x,
                    y,
                };
                self.reach(vertex, distance, approach);
            }
        }
        for face in source.faces(self.mesh) {
            self.reach_targets_inside(face, source);
        }
    }

    /// Straight lines inside the source's own face.
    fn reach_targets_inside(&mut self, face: u32, source: &SurfacePoint) {
        let h = HalfEdge::new(face, 0);
        let Some([x, y]) = self.charts.coordinates(self.mesh, h, source) else {
            return;
        };
        let approach = Approach {
            entry: h.0,
            root: SOURCE,
            x,
            y,
        };
        self.reach_straight(h, approach, 0.0);
    }

    /// Offers all targets in the face above `h` a straight line inside that face.
    fn reach_straight(&mut self, h: HalfEdge, approach: Approach, sigma: f64) {
        for i in self.targets_in(h.face()) {
            let target = &mut self.targets[self.targets_of_face[i].1 as usize];
            let Some([px, py]) = self.charts.coordinates(self.mesh, h, &target.point) else {
                continue;
            };
            let (dx, dy) = (px - approach.x, py - approach.y);
            let distance = sigma + (dx * dx + dy * dy).sqrt();
            if distance < target.distance {
                target.distance = distance;
                target.approach = approach;
            }
        }
    }

    /// A vertex as source of windows in all directions.
    fn fill_around(&mut self, v: u32, sigma: f64, root: u32) {
        let mesh = self.mesh;
        for h in mesh.outgoing(v) {
            let opposite = h.next();
            if let Some(twin) = mesh.twin(opposite) {
                let chart = self.charts.chart(opposite);
                let (length, [x, y]) = (chart.length, chart.apex());
                self.emit(twin, [0.0, length], length - x, y, sigma, root);
            }
            self.reach_neighbours(h, sigma, root);
        }
    }

    /// Offers the two other corners of the face above `h` the way along its sides, and targets
    /// in the face the straight line from the origin of `h`.
    fn reach_neighbours(&mut self, h: HalfEdge, sigma: f64, root: u32) {
        self.reach_far_end(h, sigma, root);
        self.reach_end(h, sigma, root);
        self.reach_straight(h, from_origin(h, root), sigma);
    }

    /// Offers the corner opposite a half-edge the way along the side from its origin.
    fn reach_far_end(&mut self, h: HalfEdge, sigma: f64, root: u32) {
        let length = self.charts.chart(h).left_length;
        self.reach(
            self.mesh.origin(h.prev()),
            sigma + length,
            from_origin(h, root),
        );
    }

    /// Offers the end of a half-edge the way along it.
    fn reach_end(&mut self, h: HalfEdge, sigma: f64, root: u32) {
        let chart = self.charts.chart(h);
        let from_end = Approach {
            entry: h.prev().0,
            root,
            x: chart.left_length,
            y: 0.0,
        };
        self.reach(self.mesh.target(h), sigma + chart.length, from_end);
    }

    /// A vertex where paths bend becomes a source for the directions in its shadow: those that
    /// make an angle of π or more with the arrival on either side.
    pub(super) fn bend_at(&mut self, v: u32, distance: f64) {
        if distance > self.distances[v as usize] * CLEARLY {
            return; // reached nearer since it was queued
        }
        let approach = self.approaches[v as usize];
        let sigma = self.distances[v as usize];
        let entry = HalfEdge(approach.entry);
        let chart = self.charts.chart(entry);
        let [cx, cy] = chart.apex();
        let (ax, ay) = (approach.x - cx, approach.y - cy);
        // From C: counter-clockwise from C→A to the arrival, both pointing down.
        let inside = libm::atan2(cx * -ay + cy * ax, -(cx * ax + cy * ay));
        let first = entry.prev();
        let pi = std::f64::consts::PI;
        let full = if self.mesh.is_border_vertex(v) {
            f64::INFINITY
        } else {
            self.charts.total_angles[v as usize]
        };
        // The sides are ways in any case: where the border is straight the shadow is a line. From a
        // range of directions only those in the shadow lead on.
        let ranged = self.aim.range.is_some();
        for h in self.mesh.outgoing(v) {
            if ranged {
                self.reach_straight(h, from_origin(h, v), sigma);
            } else {
                self.reach_neighbours(h, sigma, v);
            }
        }
        // Counter-clockwise from the arrival.
        let mut angle = -inside;
        let mut h = first;
        loop {
            let span = self.charts.angles[h.0 as usize];
            if ranged && angle > pi - ALONG && angle < full - pi + ALONG {
                self.reach_end(h, sigma, v);
            }
            self.fill_sector(h, [pi - angle, full - pi - angle], sigma, v);
            angle += span;
            if ranged && angle > pi - ALONG && angle < full - pi + ALONG {
                self.reach_far_end(h, sigma, v);
            }
            match self.mesh.twin(h.prev()) {
                Some(next) if angle < full - pi && next != first => h = next,
                _ => break,
            }
        }
        if full.is_finite() {
            return;
        }
        // Clockwise, to the other end of the border's fan.
        let mut angle = inside;
        let mut h = first;
        loop {
            if ranged && angle > pi - ALONG {
                self.reach_end(h, sigma, v);
            }
            self.fill_sector(h, [f64::NEG_INFINITY, angle - pi], sigma, v);
            match self.mesh.twin(h) {
                Some(twin) => {
                    h = twin.next();
                    angle += self.charts.angles[h.0 as usize];
                }
                None => break,
            }
        }
    }

    /// Windows of a vertex into the face above `h`, for the angles from `h` that lie in the
    /// range.
    fn fill_sector(&mut self, h: HalfEdge, range: [f64; 2], sigma: f64, v: u32) {
        let span = self.charts.angles[h.0 as usize];
        let (from, to) = (range[0].max(0.0), range[1].min(span));
        if from >= to {
            return;
        }
        let opposite = h.next();
        let Some(twin) = self.mesh.twin(opposite) else {
            return;
        };
        let chart = *self.charts.chart(h);
        let seen = self.charts.chart(opposite);
        let (length, [x, y]) = (seen.length, seen.apex());
        let [cx, cy] = chart.apex();
        // Where the ray at an angle meets B→C, measured from C.
        let meets = |angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            let share = chart.length * sine / (cy * cosine + (chart.length - cx) * sine);
            (length * (1.0 - share)).clamp(0.0, length)
        };
        let begin = if to < span { meets(to) } else { 0.0 };
        let end = if from > 0.0 { meets(from) } else { length };
        self.emit(twin, [begin, end], length - x, y, sigma, v);
    }

    /// A first window at a half-edge.
    fn emit(&mut self, h: HalfEdge, b: [f64; 2], x: f64, depth: f64, sigma: f64, root: u32) {
        if b[1] > b[0] && depth > 0.0 {
            let window = Window::new(b, x, depth, sigma, root);
            let length = self.charts.chart(h).length;
            let sheaf = Sheaf::single(self.front.spare(), &window, length);
            self.front.arrive(h.0, sheaf);
        }
    }
}
