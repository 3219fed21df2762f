//! Cubic splines through samples at increasing shares: local, so that a kink stays where it is.

use super::resample::Basis;

/// What unit values at each of at least four knots contribute at shares: the cubic spline with the
/// not-a-knot end condition (the first two and the last two pieces are one cubic), which keeps the
/// order of the interpolation up to the ends.
pub(super) fn spline(knots: &[f64], shares: &[f64]) -> Basis {
    let n = knots.len();
    let zeros = || vec![vec![0.0; n]; shares.len()];
    let mut basis = Basis {
        values: zeros(),
        slopes: zeros(),
    };
    for part in 0..n {
        let mut values = vec![0.0; n];
        values[part] = 1.0;
        let slopes = spline_slopes(knots, &values);
        for (place, share) in shares.iter().enumerate() {
            let i = knots.partition_point(|k| k <= share).clamp(1, n - 1) - 1;
            let step = knots[i + 1] - knots[i];
            let (value, slope) = hermite((share - knots[i]) / step, step);
            let sum = |weights: [[f64; 2]; 2]| {
                (0..2)
                    .map(|p| weights[p][0] * values[i + p] + weights[p][1] * slopes[i + p])
                    .sum()
            };
            basis.values[place][part] = sum(value);
            basis.slopes[place][part] = sum(slope);
        }
    }
    basis
}

/// Cubic Hermite basis on a cell of width `step` at the local coordinate `x` in [0, 1]: per end
/// the weights of value and slope, and their derivatives.
pub(super) fn hermite(x: f64, step: f64) -> ([[f64; 2]; 2], [[f64; 2]; 2]) {
    let (x2, y) = (x * x, 1.0 - x);
    let value = [
        [y * y * (1.0 + 2.0 * x), step * x * y * y],
        [x2 * (3.0 - 2.0 * x), -step * x2 * y],
    ];
    let bump = 6.0 * x * y / step;
    let slope = [[-bump, y * (1.0 - 3.0 * x)], [bump, x * (3.0 * x - 2.0)]];
    (value, slope)
}

/// Slopes at the knots of the spline through the values.
fn spline_slopes(knots: &[f64], values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let last = n - 1;
    let step: Vec<f64> = knots.windows(2).map(|k| k[1] - k[0]).collect();
    let rise = |i: usize| (values[i + 1] - values[i]) / step[i];
    let mut diagonal = vec![0.0; n];
    let mut upper = vec![0.0; n];
    let mut lower = vec![0.0; n];
    let mut slopes = vec![0.0; n];
    for i in 1..last {
        lower[i] = step[i];
        diagonal[i] = 2.0 * (step[i - 1] + step[i]);
        upper[i] = step[i - 1];
        slopes[i] = 3.0 * (step[i] * rise(i - 1) + step[i - 1] * rise(i));
    }
    // Third derivatives agree across the second and the last but one knot.
    let end = |near: usize, far: usize| {
        let both = step[near] + step[far];
        let side = (step[near] + 2.0 * both) * step[far] * rise(near);
        (both, (side + step[near] * step[near] * rise(far)) / both)
    };
    diagonal[0] = step[1];
    (upper[0], slopes[0]) = end(0, 1);
    diagonal[last] = step[last - 2];
    (lower[last], slopes[last]) = end(last - 1, last - 2);
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

    #[test]
    fn cubics_are_their_own_splines_whatever_the_knots() {
        let cubic = |x: f64| 1.0 + x * (2.0 - x * (3.0 - 1.5 * x));
        let slope = |x: f64| 2.0 - x * (6.0 - 4.5 * x);
        let knots = [0.0, 0.1, 0.35, 0.5, 0.9, 1.0];
        let shares = [0.0, 0.05, 0.35, 0.7, 1.0];
        let basis = spline(&knots, &shares);
        for (place, share) in shares.iter().enumerate() {
            let sum =
                |row: &[f64]| -> f64 { row.iter().zip(knots).map(|(w, k)| w * cubic(k)).sum() };
            assert!((sum(&basis.values[place]) - cubic(*share)).abs() < 1e-14);
            assert!((sum(&basis.slopes[place]) - slope(*share)).abs() < 1e-13);
        }
    }
}
