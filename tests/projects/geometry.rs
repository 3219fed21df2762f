//! Polylines on a surface and segments in the plane, from the written numbers of a plan.

use nalgebra::{Matrix2, Point2, Point3, Vector2, Vector3};

/// Half a unit of the last digit of a written length, metres.
pub(crate) const ROUND: f64 = 0.5e-9;
/// How far a written place may lie from the place that was computed, metres.
pub(crate) const PLACE: f64 = 0.87e-9;

/// Places joined by straight segments.
#[derive(Debug)]
pub(crate) struct Polyline {
    pub(crate) places: Vec<Point3<f64>>,
    /// Arc length at each place.
    arc: Vec<f64>,
}

impl Polyline {
    pub(crate) fn new(places: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let places: Vec<Point3<f64>> = places.into_iter().map(Point3::from).collect();
        let mut arc = vec![0.0];
        for pair in places.windows(2) {
            arc.push(arc[arc.len() - 1] + (pair[1] - pair[0]).norm());
        }
        Self { places, arc }
    }

    pub(crate) fn length(&self) -> f64 {
        self.arc[self.arc.len() - 1]
    }

    pub(crate) fn first(&self) -> Point3<f64> {
        self.places[0]
    }

    pub(crate) fn last(&self) -> Point3<f64> {
        self.places[self.places.len() - 1]
    }

    /// Whether a place lies on it, as far as written numbers tell.
    pub(crate) fn passes(&self, place: &Point3<f64>) -> bool {
        self.places.windows(2).any(|pair| {
            let along = pair[1] - pair[0];
            let share = (place - pair[0]).dot(&along) / along.norm_squared();
            (place - (pair[0] + along * share.clamp(0.0, 1.0))).norm() < 3.0 * PLACE
        })
    }

    /// Where two polylines meet: arc lengths on both.
    pub(crate) fn meetings(&self, other: &Self) -> Vec<[f64; 2]> {
        let mut found: Vec<[f64; 2]> = Vec::new();
        for (i, p) in self.places.windows(2).enumerate() {
            for (j, q) in other.places.windows(2).enumerate() {
                let Some([s, t]) = meeting([p[0], p[1]], [q[0], q[1]]) else {
                    continue;
                };
                let on = [
                    self.arc[i] + s * (self.arc[i + 1] - self.arc[i]),
                    other.arc[j] + t * (other.arc[j + 1] - other.arc[j]),
                ];
                // Neighbouring segments share a place: one meeting, found up to four times.
                let known = |hit: &[f64; 2]| (0..2).all(|k| (hit[k] - on[k]).abs() < 1e-7);
                if !found.iter().any(known) {
                    found.push(on);
                }
            }
        }
        found
    }
}

/// Shares at which two segments in space come as close as written numbers can tell.
fn meeting(first: [Point3<f64>; 2], second: [Point3<f64>; 2]) -> Option<[f64; 2]> {
    let (u, v, w): (Vector3<f64>, Vector3<f64>, Vector3<f64>) = (
        first[1] - first[0],
        second[1] - second[0],
        first[0] - second[0],
    );
    let (reach, apart) = (u.norm() + v.norm(), w.norm());
    if apart > reach + 1e-6 {
        return None;
    }
    let (uu, vv, uv) = (u.dot(&u), v.dot(&v), u.dot(&v));
    let det = uu * vv - uv * uv;
    let mut s = if det > 1e-12 * uu * vv {
        (uv * w.dot(&v) - vv * w.dot(&u)) / det
    } else {
        0.0
    };
    let mut t = 0.0;
    // The closest places of segments: clamp on one, then the other, then once more.
    for _ in 0..2 {
        s = s.clamp(0.0, 1.0);
        t = ((w.dot(&v) + s * uv) / vv).clamp(0.0, 1.0);
        s = ((t * uv - w.dot(&u)) / uu).clamp(0.0, 1.0);
    }
    ((w + u * s - v * t).norm() < 4.0 * PLACE).then_some([s, t])
}

/// Shares at which the lines through two planar segments cross.
pub(crate) fn crossing(first: [[f64; 2]; 2], second: [[f64; 2]; 2]) -> Option<Vector2<f64>> {
    let [a, b] = first.map(Point2::from);
    let [c, d] = second.map(Point2::from);
    let inverse = Matrix2::from_columns(&[b - a, c - d]).try_inverse()?;
    Some(inverse * (c - a))
}

pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (Point2::from(a) - Point2::from(b)).norm()
}
