//! Paths of straight segments and true circular arcs.
//!
//! An arc is kept as the *bulge* of the segment that starts at a vertex, the tangent of a quarter
//! of the swept angle: 0 is straight, 1 a half circle counter-clockwise, -1 one clockwise. It is
//! the form of DXF polylines, and the only one in which a slot keeps exact half circles under
//! translation. Millimetres, x right, y up.

use super::Bounds;

/// tan(pi / 8): the bulge of a quarter circle, counter-clockwise.
pub const QUARTER: f64 = 0.414_213_562_373_095_05;

/// A corner of a path and the shape of the segment that leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Millimetres to the right.
    pub x: f64,
    /// Millimetres up.
    pub y: f64,
    /// Bulge of the segment to the next vertex.
    pub bulge: f64,
}

/// A chain of segments.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// Its corners; the bulge of the last one matters only if the path is closed.
    pub vertices: Vec<Vertex>,
    /// Whether the last vertex is joined to the first.
    pub closed: Closure,
}

/// Whether a path comes back to its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Closure {
    /// The last vertex is joined to the first.
    Closed,
    /// It ends at the last vertex.
    Open,
}

/// One piece of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Where it starts.
    pub from: [f64; 2],
    /// Where it ends.
    pub to: [f64; 2],
    /// Bulge; 0 is straight.
    pub bulge: f64,
}

/// The circle of an arc segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Its centre.
    pub centre: [f64; 2],
    /// Its radius.
    pub radius: f64,
    /// Direction from the centre to the start, radians.
    pub start: f64,
    /// Swept angle, radians, positive counter-clockwise.
    pub sweep: f64,
}

impl Path {
    /// A chain of straight segments.
    pub fn polyline(points: &[[f64; 2]], closed: Closure) -> Self {
        let vertices = points
            .iter()
            .map(|&[x, y]| Vertex { x, y, bulge: 0.0 })
            .collect();
        Self { vertices, closed }
    }

    /// A rectangle, counter-clockwise from its lower left corner.
    pub fn rectangle([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Self {
        Self::polyline(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], Closure::Closed)
    }

    /// A slot along x: everything within `radius` of the points between (`x0`, `y`) and
    /// (`x1`, `y`), counter-clockwise, with two half circles as ends. `x0 < x1`.
    pub fn slot(x0: f64, x1: f64, y: f64, radius: f64) -> Self {
        let vertex = |x, y, bulge| Vertex { x, y, bulge };
        Self {
            vertices: vec![
                vertex(x0, y - radius, 0.0),
                vertex(x1, y - radius, 1.0),
                vertex(x1, y + radius, 0.0),
                vertex(x0, y + radius, 1.0),
            ],
            closed: Closure::Closed,
        }
    }

    /// Its pieces in order, the closing one included.
    pub fn segments(&self) -> impl Iterator<Item = Segment> + '_ {
        let count = match self.closed {
            Closure::Closed => self.vertices.len(),
            Closure::Open => self.vertices.len().saturating_sub(1),
        };
        let next = self.vertices.iter().cycle().skip(1);
        self.vertices
            .iter()
            .zip(next)
            .take(count)
            .map(|(a, b)| Segment {
                from: [a.x, a.y],
                to: [b.x, b.y],
                bulge: a.bulge,
            })
    }

    /// Moved by (`dx`, `dy`).
    #[must_use]
    pub fn translated(&self, [dx, dy]: [f64; 2]) -> Self {
        self.mapped(|[x, y]| [x + dx, y + dy])
    }

    /// Each vertex mapped by a rotation, translation or uniform scaling, which keep bulges.
    #[must_use]
    pub fn mapped(&self, similarity: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let vertices = self
            .vertices
            .iter()
            .map(|v| {
                let [x, y] = similarity([v.x, v.y]);
                Vertex { x, y, ..*v }
            })
            .collect();
        Self {
            vertices,
            closed: self.closed,
        }
    }

    /// Smallest box around it, arcs included.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for v in &self.vertices {
            bounds.add([v.x, v.y]);
        }
        for arc in self.segments().filter_map(|s| s.arc()) {
            for quarter in 0..4 {
                let direction = f64::from(quarter) * core::f64::consts::FRAC_PI_2;
                if arc.passes(direction) {
                    bounds.add(arc.at(direction));
                }
            }
        }
        bounds
    }

    /// Enclosed area of a closed path, positive if it runs counter-clockwise: the polygon of its
    /// vertices and the circular segments over its bulges.
    pub fn area(&self) -> f64 {
        self.segments()
            .map(|s| {
                let chord = 0.5 * (s.from[0] * s.to[1] - s.to[0] * s.from[1]);
                let cap = s.arc().map_or(0.0, |arc| {
                    0.5 * arc.radius * arc.radius * (arc.sweep - libm::sin(arc.sweep))
                });
                chord + cap
            })
            .sum()
    }

    /// Length of all segments.
    pub fn length(&self) -> f64 {
        self.segments().map(|s| s.length()).sum()
    }

    /// The same curve with arcs replaced by chords that stay within `tolerance` of them.
    pub fn flattened(&self, tolerance: f64) -> Vec<[f64; 2]> {
        let mut points = Vec::with_capacity(self.vertices.len());
        for segment in self.segments() {
            points.push(segment.from);
            if let Some(arc) = segment.arc() {
                let ratio = (tolerance / arc.radius).clamp(1e-9, 1.0);
                let step = 2.0 * libm::acos(1.0 - ratio);
                let count = libm::ceil(arc.sweep.abs() / step).max(1.0) as usize;
                points.extend(
                    (1..count).map(|i| arc.at(arc.start + arc.sweep * i as f64 / count as f64)),
                );
            }
        }
        if self.closed == Closure::Open
            && let Some(last) = self.vertices.last()
        {
            points.push([last.x, last.y]);
        }
        points
    }
}

impl Segment {
    /// Distance of its ends.
    pub fn chord(&self) -> f64 {
        libm::hypot(self.to[0] - self.from[0], self.to[1] - self.from[1])
    }

    /// Length along the curve.
    pub fn length(&self) -> f64 {
        self.arc()
            .map_or_else(|| self.chord(), |arc| arc.radius * arc.sweep.abs())
    }

    /// Its circle, if it is an arc.
    pub fn arc(&self) -> Option<Arc> {
        let chord = self.chord();
        if self.bulge == 0.0 || chord == 0.0 {
            return None;
        }
        let b = self.bulge;
        // The centre lies on the bisector of the chord at (1 - b^2) / (4 b) chords to its left.
        let offset = (1.0 - b * b) / (4.0 * b);
        let [dx, dy] = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let centre = [
            0.5 * (self.from[0] + self.to[0]) - offset * dy,
            0.5 * (self.from[1] + self.to[1]) + offset * dx,
        ];
        Some(Arc {
            centre,
            radius: chord * (1.0 + b * b) / (4.0 * b.abs()),
            start: libm::atan2(self.from[1] - centre[1], self.from[0] - centre[0]),
            sweep: 4.0 * libm::atan(b),
        })
    }

    /// The segment cut at the middle of its curve: two segments that together are the same.
    pub fn halves(&self) -> [Self; 2] {
        let [dx, dy] = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        // The sagitta is half the chord times the bulge, to the right of the chord.
        let middle = [
            0.5 * (self.from[0] + self.to[0] + self.bulge * dy),
            0.5 * (self.from[1] + self.to[1] - self.bulge * dx),
        ];
        // tan(x / 2) from tan(x).
        let bulge = self.bulge / (1.0 + (1.0 + self.bulge * self.bulge).sqrt());
        [
            Self {
                to: middle,
                bulge,
                ..*self
            },
            Self {
                from: middle,
                bulge,
                ..*self
            },
        ]
    }
}

impl Arc {
    /// The point of its circle in a direction from the centre.
    pub fn at(&self, direction: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(direction);
        [
            self.centre[0] + self.radius * cos,
            self.centre[1] + self.radius * sin,
        ]
    }

    /// Whether the arc passes its circle's point in a direction.
    fn passes(&self, direction: f64) -> bool {
        let turn = core::f64::consts::TAU;
        let along = if self.sweep > 0.0 {
            direction - self.start
        } else {
            self.start - direction
        };
        along - turn * libm::floor(along / turn) <= self.sweep.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    #[test]
    fn a_slot_has_the_area_length_and_bounds_of_two_half_discs_and_a_rectangle() {
        let slot = Path::slot(1.0, 6.0, 2.0, 0.5);
        assert!((slot.area() - (5.0 + PI * 0.25)).abs() < 1e-12);
        assert!((slot.length() - (10.0 + PI)).abs() < 1e-12);
        let bounds = slot.bounds();
        assert!((bounds.min[0] - 0.5).abs() < 1e-12 && (bounds.max[0] - 6.5).abs() < 1e-12);
        assert!((bounds.min[1] - 1.5).abs() < 1e-12 && (bounds.max[1] - 2.5).abs() < 1e-12);
    }

    #[test]
    fn a_quarter_circle_has_its_centre_and_radius_from_the_bulge() {
        let quarter = Segment {
            from: [1.0, 0.0],
            to: [0.0, 1.0],
            bulge: QUARTER,
        };
        let arc = quarter.arc().expect("a bulge is an arc");
        assert!(arc.centre[0].abs() < 1e-12 && arc.centre[1].abs() < 1e-12);
        assert!((arc.radius - 1.0).abs() < 1e-12);
        assert!((arc.sweep - PI / 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_halves_of_an_arc_lie_on_its_circle() {
        for bulge in [1.0, -1.0, 0.3, -2.5] {
            let segment = Segment {
                from: [1.0, 2.0],
                to: [4.0, -1.0],
                bulge,
            };
            let whole = segment.arc().expect("a bulge is an arc");
            for half in segment.halves() {
                let arc = half.arc().expect("half an arc is an arc");
                assert!((arc.radius - whole.radius).abs() < 1e-12);
                assert!((arc.centre[0] - whole.centre[0]).abs() < 1e-12);
                assert!((arc.sweep - whole.sweep / 2.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn flattening_stays_within_its_tolerance() {
        let slot = Path::slot(0.0, 3.0, 0.0, 2.0);
        for [x, y] in slot.flattened(0.01) {
            let dx = (x - x.clamp(0.0, 3.0)).abs();
            assert!((libm::hypot(dx, y) - 2.0).abs() < 1e-9);
        }
        let polygon = Path::polyline(&slot.flattened(0.01), Closure::Closed);
        assert!(slot.area() - polygon.area() < 0.01 * slot.length());
    }
}
