//! Chebyshev series through samples of a smooth function of two shares, and where they end.
//!
//! The coefficients of a function that is smooth on the whole square fall geometrically with their
//! degree until they are lost in the noise of the samples; those of a function with a kink fall
//! like the square of the degree. So the coefficients themselves tell whether the samples suffice
//! (J. Boyd, *Chebyshev and Fourier spectral methods*, 2001).

use super::resample::{Basis, resample};
use std::f64::consts::PI;

/// The shares at which a series of degree `n - 1` is sampled: the Lobatto points, with both ends.
/// Those of `2n - 1` hold those of `n`, to the last bit.
pub(super) fn lobatto(n: usize) -> Vec<f64> {
    let last = n - 1;
    let share = |k: usize| {
        let from_middle = last as f64 - 2.0 * k as f64;
        0.5 * (1.0 - libm::sin(PI * from_middle / (2 * last) as f64))
    };
    (0..n).map(share).collect()
}

/// A polynomial of two shares as a sum of products of Chebyshev polynomials.
#[derive(Debug)]
pub(super) struct Series {
    /// Coefficients: by degree in the start share, then in the end share.
    terms: Vec<Vec<f64>>,
}

impl Series {
    /// The polynomial through values at the Lobatto points: a row per start share.
    pub(super) fn through(values: &[Vec<f64>]) -> Self {
        let last = values.len() - 1;
        let half = |k: usize| if k == 0 || k == last { 0.5 } else { 1.0 };
        // The cosine transform: degree, then point.
        let transform = |degree: usize| -> Vec<f64> {
            let wave = |point: usize| {
                let turn = (degree * (last - point)) % (2 * last);
                libm::cos(PI * turn as f64 / last as f64) * half(point)
            };
            let scale = 2.0 / last as f64 * half(degree);
            (0..=last).map(|point| scale * wave(point)).collect()
        };
        let transform: Vec<Vec<f64>> = (0..=last).map(transform).collect();
        Self {
            terms: resample(&transform, values, &transform),
        }
    }

    /// What the terms above a degree, in either share, add: root mean square.
    pub(super) fn above(&self, degree: usize) -> f64 {
        let rows = self.terms.iter().enumerate();
        let terms =
            rows.flat_map(|(i, row)| row.iter().enumerate().map(move |(j, c)| (i.max(j), c)));
        let squares = terms.filter(|(k, _)| *k > degree).map(|(_, c)| c * c);
        // A wave in both shares has a fourth of the square of its height in the mean.
        (0.25 * squares.sum::<f64>()).sqrt()
    }

    /// The highest degree with terms, in either share, that stand out of a level: whose root mean
    /// square exceeds it.
    pub(super) fn degree(&self, level: f64) -> usize {
        let stands_out = |&degree: &usize| {
            let squares = (0..=degree).map(|k| {
                let (row, column) = (self.terms[degree][k], self.terms[k][degree]);
                row * row + if k < degree { column * column } else { 0.0 }
            });
            let count = (2 * degree + 1) as f64;
            squares.sum::<f64>() > level * level * count
        };
        (0..self.terms.len()).rev().find(stands_out).unwrap_or(0)
    }

    /// The series without terms above a degree, which is at least one. What these contribute at
    /// the four corners is put back by a bilinear function, so that corners keep their values.
    pub(super) fn up_to(mut self, degree: usize) -> Self {
        let mut corners = [[0.0; 2]; 2];
        for (i, row) in self.terms.iter().enumerate() {
            for (j, term) in row.iter().enumerate().filter(|(j, _)| i.max(*j) > degree) {
                corners[i % 2][j % 2] += term;
            }
        }
        self.terms.truncate(degree + 1);
        for row in &mut self.terms {
            row.truncate(degree + 1);
        }
        // At the corners a term is one of even or odd degrees, whatever these are.
        for (row, corner) in self.terms.iter_mut().zip(corners) {
            for (term, corner) in row.iter_mut().zip(corner) {
                *term += corner;
            }
        }
        self
    }

    /// Coefficients: by degree in the start share, then in the end share.
    pub(super) fn terms(&self) -> &[Vec<f64>] {
        &self.terms
    }
}

/// The first `n` Chebyshev polynomials and their derivatives at shares.
pub(super) fn chebyshev(n: usize, shares: &[f64]) -> Basis {
    let mut basis = Basis::default();
    for share in shares {
        let x = 2.0 * share - 1.0;
        let (mut values, mut slopes) = (vec![1.0], vec![0.0]);
        // Of the first and the second kind.
        let (mut first, mut second) = ([1.0, x], [0.0, 1.0]);
        for degree in 1..n {
            values.push(first[1]);
            slopes.push(2.0 * degree as f64 * second[1]);
            first = [first[1], 2.0 * x * first[1] - first[0]];
            second = [second[1], 2.0 * x * second[1] - second[0]];
        }
        basis.values.push(values);
        basis.slopes.push(slopes);
    }
    basis
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(n: usize, f: impl Fn(f64, f64) -> f64) -> Vec<Vec<f64>> {
        let shares = lobatto(n);
        let row = |s: &f64| shares.iter().map(|e| f(*s, *e)).collect();
        shares.iter().map(row).collect()
    }

    fn value(series: &Series, s: f64, e: f64) -> f64 {
        let n = series.terms().len();
        let [s, e] = [s, e].map(|share| chebyshev(n, &[share]).values);
        resample(&s, series.terms(), &e)[0][0]
    }

    #[test]
    fn lobatto_points_are_nested_and_symmetric_to_the_last_bit() {
        let (coarse, fine) = (lobatto(9), lobatto(17));
        for (k, share) in coarse.iter().enumerate() {
            assert_eq!(share.to_bits(), fine[2 * k].to_bits());
            assert_eq!(1.0 - share, coarse[8 - k]);
        }
        assert_eq!([coarse[0], coarse[4], coarse[8]], [0.0, 0.5, 1.0]);
    }

    #[test]
    fn a_polynomial_is_its_own_series() {
        let f = |s: f64, e: f64| 1.0 + s * s * e - 3.0 * e * e * s + 0.5 * s;
        let series = Series::through(&samples(9, f));
        assert_eq!(series.degree(1e-14), 2);
        let series = series.up_to(2);
        for (s, e) in [(0.0, 0.0), (0.3, 0.9), (1.0, 0.4)] {
            assert!((value(&series, s, e) - f(s, e)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_shortened_series_keeps_the_corners() {
        let f = |s: f64, e: f64| libm::exp(1.3 * s - 0.7 * e);
        let whole = Series::through(&samples(9, f)).up_to(3);
        for (s, e) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)] {
            assert!((value(&whole, s, e) - f(s, e)).abs() < 1e-14);
        }
        assert!((value(&whole, 0.5, 0.4) - f(0.5, 0.4)).abs() > 1e-6);
    }
}
