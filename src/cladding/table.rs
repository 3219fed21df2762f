//! Distance maps of a surface patch as tables.
//!
//! A table holds the *squared* distance. On developable patches it is a polynomial of degree two,
//! like the planar one (method notes, sections 2 and 3), and every interpolation here reproduces it
//! to rounding; on curved patches it is as smooth as the distance itself.

use super::resample::{Basis, resample};
use super::spline::hermite;
use serde::{Deserialize, Serialize};

/// Evenly spaced shares: `0, 1/(n-1), …, 1`.
pub fn nodes(n: usize) -> impl Iterator<Item = f64> {
    (0..n).map(move |i| i as f64 / (n - 1) as f64)
}

/// Squared surface distances between two opposite sides, bicubic in even cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DistanceTable {
    n: usize,
    /// Row major: `start * n + end`. Value, derivative by start, by end, mixed.
    nodes: Vec<[f64; 4]>,
}

impl DistanceTable {
    /// Takes values and derivatives from an interpolant of squared distances, square metres, that
    /// consists of parts over both shares; `basis` holds what these contribute at evenly spaced
    /// shares, at least two.
    pub(super) fn new(basis: &Basis, parts: &[Vec<f64>]) -> Self {
        let Basis { values, slopes } = basis;
        let n = values.len();
        let [value, by_start, by_end, mixed] = [
            (values, values),
            (slopes, values),
            (values, slopes),
            (slopes, slopes),
        ]
        .map(|(start, end)| resample(start, parts, end));
        let node = |i: usize, j: usize| [value[i][j], by_start[i][j], by_end[i][j], mixed[i][j]];
        Self {
            n,
            nodes: (0..n)
                .flat_map(|i| (0..n).map(move |j| (i, j)))
                .map(|(i, j)| node(i, j))
                .collect(),
        }
    }

    /// Squared distance, square metres, and its derivatives by the start and the end share.
    pub fn distance_squared(&self, start: f64, end: f64) -> (f64, [f64; 2]) {
        let (i, x) = self.cell(start);
        let (j, y) = self.cell(end);
        let step = 1.0 / (self.n - 1) as f64;
        let (px, dx) = hermite(x, step);
        let (py, dy) = hermite(y, step);
        let (mut value, mut by_start, mut by_end) = (0.0, 0.0, 0.0);
        for p in 0..2 {
            for q in 0..2 {
                let node = self.nodes[(i + p) * self.n + j + q];
                let along_end = [node[0] * py[q][0] + node[2] * py[q][1]];
                let along_end_slope = node[0] * dy[q][0] + node[2] * dy[q][1];
                let slope_along_end = node[1] * py[q][0] + node[3] * py[q][1];
                let slope_along_end_slope = node[1] * dy[q][0] + node[3] * dy[q][1];
                value += px[p][0] * along_end[0] + px[p][1] * slope_along_end;
                by_start += dx[p][0] * along_end[0] + dx[p][1] * slope_along_end;
                by_end += px[p][0] * along_end_slope + px[p][1] * slope_along_end_slope;
            }
        }
        (value, [by_start, by_end])
    }

    /// The longest distance of the table, metres.
    pub fn longest(&self) -> f64 {
        let squares = self.nodes.iter().map(|node| node[0]);
        squares.fold(0.0, f64::max).sqrt()
    }

    fn cell(&self, share: f64) -> (usize, f64) {
        let scaled = share.clamp(0.0, 1.0) * (self.n - 1) as f64;
        let cell = (scaled as usize).min(self.n - 2);
        (cell, scaled - cell as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::super::fit::smooth;

    #[test]
    fn squared_distances_in_the_plane_are_reproduced_to_rounding() {
        let plane = |s: f64, e: f64| libm::hypot(2.0 * s - 1.7 * e - 0.1, 3.0 - 0.4 * s + 0.3 * e);
        let t = smooth(plane);
        for (s, e) in [(0.03, 0.9), (0.5, 0.51), (0.77, 0.2), (1.0, 0.0)] {
            let (d2, _) = t.distance_squared(s, e);
            assert!((d2 - plane(s, e).powi(2)).abs() < 1e-13);
        }
        assert!((t.longest() - plane(0.0, 1.0).max(plane(1.0, 0.0))).abs() < 1e-13);
    }

    #[test]
    fn the_gradient_is_the_derivative_of_the_value() {
        let t = smooth(|s, e| 2.0 + libm::sin(2.0 * s) * libm::cos(1.5 * e - s));
        let h = 1e-6;
        for (s, e) in [(0.31, 0.62), (0.9, 0.11)] {
            let (_, g) = t.distance_squared(s, e);
            let by_start =
                (t.distance_squared(s + h, e).0 - t.distance_squared(s - h, e).0) / (2.0 * h);
            let by_end =
                (t.distance_squared(s, e + h).0 - t.distance_squared(s, e - h).0) / (2.0 * h);
            assert!((g[0] - by_start).abs() < 1e-7 && (g[1] - by_end).abs() < 1e-7);
        }
    }
}
