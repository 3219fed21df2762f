//! Distance maps of a surface patch as tables, interpolated by splines.
//!
//! A table holds the *squared* distance. On developable patches it is a polynomial of degree two,
//! like the planar one (method notes, sections 2 and 3), and a cubic spline reproduces it to
//! rounding; on curved patches it is as smooth as the distance itself.

use serde::{Deserialize, Serialize};

/// Shares at which a distance map is sampled: `0, 1/(n-1), …, 1`.
pub fn nodes(n: usize) -> impl Iterator<Item = f64> {
    (0..n).map(move |i| i as f64 / (n - 1) as f64)
}

/// Squared surface distances between two opposite sides, interpolated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DistanceTable {
    n: usize,
    /// Row major: `start * n + end`. Value, derivative by start, by end, mixed.
    nodes: Vec<[f64; 4]>,
}

impl DistanceTable {
    /// Interpolates `n * n` distances, metres, row `i` holding those from the start share
    /// `i/(n-1)` to all end shares.
    ///
    /// # Panics
    /// If there are fewer than four rows or they are not of equal length.
    pub fn new(distances: &[Vec<f64>]) -> Self {
        let n = distances.len();
        assert!(
            n >= 4 && distances.iter().all(|row| row.len() == n),
            "a square table"
        );
        let mut nodes = vec![[0.0; 4]; n * n];
        for (i, row) in distances.iter().enumerate() {
            for (j, d) in row.iter().enumerate() {
                nodes[i * n + j][0] = d * d;
            }
        }
        let step = 1.0 / (n - 1) as f64;
        let mut differentiate = |from: usize, to: usize, stride: usize, other: usize| {
            for line in 0..n {
                let values: Vec<f64> = (0..n)
                    .map(|k| nodes[line * other + k * stride][from])
                    .collect();
                for (k, slope) in spline_slopes(&values, step).into_iter().enumerate() {
                    nodes[line * other + k * stride][to] = slope;
                }
            }
        };
        differentiate(0, 1, n, 1);
        differentiate(0, 2, 1, n);
        differentiate(1, 3, 1, n);
        Self { n, nodes }
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

/// Cubic Hermite basis on a cell of width `step` at the local coordinate `x` in [0, 1]: per end
/// the weights of value and slope, and their derivatives.
fn hermite(x: f64, step: f64) -> ([[f64; 2]; 2], [[f64; 2]; 2]) {
    let (x2, y) = (x * x, 1.0 - x);
    let value = [
        [y * y * (1.0 + 2.0 * x), step * x * y * y],
        [x2 * (3.0 - 2.0 * x), -step * x2 * y],
    ];
    let bump = 6.0 * x * y / step;
    let slope = [[-bump, y * (1.0 - 3.0 * x)], [bump, x * (3.0 * x - 2.0)]];
    (value, slope)
}

/// Slopes at equidistant nodes of the cubic spline through the values, with the not-a-knot end
/// condition (the first two and the last two pieces are one cubic), which keeps the order of the
/// interpolation up to the ends.
fn spline_slopes(values: &[f64], step: f64) -> Vec<f64> {
    let n = values.len();
    let last = n - 1;
    let difference = |i: usize| (values[i + 1] - values[i]) / step;
    let mut diagonal = vec![4.0; n];
    let mut upper = vec![1.0; n];
    let mut lower = vec![1.0; n];
    let mut slopes = vec![0.0; n];
    for (i, slope) in slopes.iter_mut().enumerate().take(last).skip(1) {
        *slope = 3.0 * (difference(i - 1) + difference(i));
    }
    // Third derivatives agree across the second and the last but one node.
    diagonal[0] = 1.0;
    upper[0] = 2.0;
    slopes[0] = 0.5 * (5.0 * difference(0) + difference(1));
    diagonal[last] = 1.0;
    lower[last] = 2.0;
    slopes[last] = 0.5 * (5.0 * difference(last - 1) + difference(last - 2));
    for i in 1..n {
        let factor = lower[i] / diagonal[i - 1];
        diagonal[i] -= factor * upper[i - 1];
        slopes[i] -= factor * slopes[i - 1];
    }
    slopes[last] /= diagonal[last];
    for i in (0..last).rev() {
        slopes[i] = (slopes[i] - upper[i] * slopes[i + 1]) / diagonal[i];
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(n: usize, f: impl Fn(f64, f64) -> f64) -> DistanceTable {
        let rows: Vec<Vec<f64>> = nodes(n)
            .map(|s| nodes(n).map(|e| f(s, e)).collect())
            .collect();
        DistanceTable::new(&rows)
    }

    #[test]
    fn squared_distances_in_the_plane_are_reproduced_to_rounding() {
        let plane = |s: f64, e: f64| libm::hypot(2.0 * s - 1.7 * e - 0.1, 3.0 - 0.4 * s + 0.3 * e);
        let t = table(9, plane);
        for (s, e) in [(0.03, 0.9), (0.5, 0.51), (0.77, 0.2), (1.0, 0.0)] {
            let (d2, _) = t.distance_squared(s, e);
            assert!((d2 - plane(s, e).powi(2)).abs() < 1e-13);
        }
    }

    #[test]
    fn smooth_maps_converge_with_the_fourth_order() {
        let smooth = |s: f64, e: f64| 2.0 + libm::sin(2.0 * s + 0.3) * libm::cos(1.5 * e - s);
        let error = |n| {
            let t = table(n, smooth);
            nodes(57)
                .flat_map(|s| nodes(43).map(move |e| (s, e)))
                .map(|(s, e)| (t.distance_squared(s, e).0.sqrt() - smooth(s, e)).abs())
                .fold(0.0, f64::max)
        };
        let ratio = error(9) / error(17);
        assert!(ratio > 11.0, "{ratio}");
    }

    #[test]
    fn the_gradient_is_the_derivative_of_the_value() {
        let t = table(7, |s, e| 2.0 + libm::sin(2.0 * s) * libm::cos(1.5 * e - s));
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
