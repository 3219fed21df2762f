//! As few samples of a distance map as it takes.
//!
//! Squared distances are sampled at the Lobatto points of a Chebyshev series, 9 a side, then 17,
//! then 33, each with all earlier ones. It ends when the upper degrees add no more than noise does:
//! on smooth maps at the first or the second step. Where geodesics jump from one side of a hill to
//! the other (a cut locus crosses the map), distances have kinks, and no series ends: then a cubic
//! spline through the samples serves, whose error stays beside the kink.

use super::DistanceTable;
use super::series::{Series, chebyshev, lobatto};
use super::spline::spline;
use super::table::nodes;

/// Samples a side, step by step.
const STEPS: [usize; 3] = [9, 17, 33];

/// A series suffices if its upper quarter of degrees adds no more than this many times the noise,
/// root mean square. Noise itself adds two thirds; a series that is still falling has about as
/// much before it as its upper quarter holds.
const ENOUGH: f64 = 4.0;

/// A series that falls has so much less in its upper quarter with each step; where it does not, more
/// samples would only follow unevenness or kinks.
const FALLING: f64 = 0.1;

/// Cells of the table per degree of the series. Of a wave of the highest degree, which is as small
/// as the noise, cubics on these miss a thirtieth at most; of all others less.
const CELLS: usize = 4;

/// Rounding of squared distances, relative to the longest.
const ROUNDING: f64 = 1e-13;

/// The interpolant of a distance map, with the least number of samples, and that number.
///
/// `sample` gives the distances, metres, between start and end shares: a row per start share.
/// `noise` is the roughness of *squared* distances, square metres, root mean square.
pub(super) fn fit<E>(
    noise: f64,
    mut sample: impl FnMut(&[f64], &[f64]) -> Result<Vec<Vec<f64>>, E>,
) -> Result<(DistanceTable, usize), E> {
    let mut squares: Vec<Vec<f64>> = Vec::new();
    let mut before = f64::INFINITY;
    for n in STEPS {
        squares = grown(squares, n, &mut sample)?;
        let longest = squares.iter().flatten().copied().fold(0.0, f64::max);
        let series = Series::through(&squares);
        let noise = noise.max(ROUNDING * longest);
        let rest = series.above(3 * (n - 1) / 4);
        if rest <= ENOUGH * noise {
            // White noise leaves this in every coefficient but those at the rim.
            let degree = series.degree(2.0 * noise / (n - 1) as f64).max(2);
            let series = series.up_to(degree);
            let places: Vec<f64> = nodes(CELLS * degree + 1).collect();
            let basis = chebyshev(degree + 1, &places);
            return Ok((DistanceTable::new(&basis, series.terms()), n * n));
        }
        if rest > FALLING * before {
            break;
        }
        before = rest;
    }
    let n = squares.len();
    let places: Vec<f64> = nodes(2 * n - 1).collect();
    let basis = spline(&lobatto(n), &places);
    Ok((DistanceTable::new(&basis, &squares), n * n))
}

/// Samples at the Lobatto points of a step, given those of the step before.
fn grown<E>(
    before: Vec<Vec<f64>>,
    n: usize,
    sample: &mut impl FnMut(&[f64], &[f64]) -> Result<Vec<Vec<f64>>, E>,
) -> Result<Vec<Vec<f64>>, E> {
    let shares = lobatto(n);
    let mut squares = |starts: &[f64], ends: &[f64]| -> Result<_, E> {
        let rows = sample(starts, ends)?.into_iter();
        Ok(rows.map(|row| row.into_iter().map(|d| d * d)))
    };
    if before.is_empty() {
        return Ok(squares(&shares, &shares)?.map(Iterator::collect).collect());
    }
    let every_other =
        |first: usize| -> Vec<f64> { shares.iter().skip(first).step_by(2).copied().collect() };
    let (old, new) = (every_other(0), every_other(1));
    let between = squares(&old, &new)?;
    let woven = before.into_iter().zip(between).map(|(old, mut new)| {
        let pairs = old.into_iter().flat_map(|d| [Some(d), new.next()]);
        pairs.flatten().collect()
    });
    let old_rows: Vec<Vec<f64>> = woven.collect();
    let mut new_rows = squares(&new, &shares)?.map(Iterator::collect);
    let rows = old_rows
        .into_iter()
        .flat_map(|row| [Some(row), new_rows.next()]);
    Ok(rows.flatten().collect())
}

/// The table of a distance that is known at all places.
#[cfg(test)]
pub(super) fn smooth(distance: impl Fn(f64, f64) -> f64) -> DistanceTable {
    fitted(0.0, distance).0
}

/// A table with noise, and its number of samples.
#[cfg(test)]
pub(super) fn fitted(noise: f64, distance: impl Fn(f64, f64) -> f64) -> (DistanceTable, usize) {
    let sample = |starts: &[f64], ends: &[f64]| {
        let row = |s: &f64| ends.iter().map(|e| distance(*s, *e)).collect();
        Ok::<_, std::convert::Infallible>(starts.iter().map(row).collect())
    };
    let Ok(fitted) = fit(noise, sample);
    fitted
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest error of the distance.
    fn error(table: &DistanceTable, exact: impl Fn(f64, f64) -> f64) -> f64 {
        nodes(41)
            .flat_map(|s| nodes(37).map(move |e| (s, e)))
            .map(|(s, e)| (table.distance_squared(s, e).0.sqrt() - exact(s, e)).abs())
            .fold(0.0, f64::max)
    }

    /// Great circles between two parallels of a unit sphere, 20° from the equator.
    fn sphere(s: f64, e: f64) -> f64 {
        let (sin, cos) = libm::sincos(0.35);
        libm::acos(cos * cos * libm::cos(0.8 * (s - e)) - sin * sin)
    }

    /// A number in [-1, 1] that depends on the bits of both shares.
    fn rough(s: f64, e: f64) -> f64 {
        let bits = (s.to_bits() ^ e.to_bits().rotate_left(17)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    #[test]
    fn developable_maps_take_the_fewest_samples() {
        let plane = |s: f64, e: f64| libm::hypot(1.1 * s - 0.9 * e, 1.0 + 0.2 * s);
        let (table, samples) = fitted(0.0, plane);
        assert_eq!(samples, 81);
        assert!(error(&table, plane) < 1e-14);
    }

    #[test]
    fn smooth_maps_take_more_samples_the_less_noise_they_have() {
        let mut before = 0;
        // Below 1e-8 the cells of the table are what errs.
        for (noise, most, most_error) in [(1e-5, 81, 4e-5), (1e-7, 289, 4e-7), (1e-12, 1089, 1e-8)]
        {
            let (table, samples) = fitted(noise, sphere);
            assert!((before..=most).contains(&samples), "{noise}: {samples}");
            before = samples;
            let error = error(&table, sphere);
            assert!(error < most_error, "{noise}: {error}");
        }
    }

    #[test]
    fn noise_takes_no_more_samples_and_is_not_amplified() {
        let noise = 1e-5;
        let noisy = |s: f64, e: f64| (sphere(s, e).powi(2) + noise * rough(s, e)).sqrt();
        // Evenly distributed in [-1, 1]: a third is the mean square.
        let (table, samples) = fitted(noise, noisy);
        assert_eq!(samples, 81);
        let error = error(&table, sphere);
        assert!(error < 4.0 * noise, "{error}");
    }

    #[test]
    fn beside_a_kink_a_spline_takes_over_and_errs_nowhere_else() {
        // Geodesics that pass a hill on the one side or on the other.
        let kinked = |s: f64, e: f64| 1.0 + 0.3 * (s + e - 0.9).abs();
        let (table, samples) = fitted(1e-6, kinked);
        assert_eq!(samples, 289);
        let far: Vec<(f64, f64)> = nodes(41)
            .flat_map(|s| nodes(37).map(move |e| (s, e)))
            .filter(|(s, e)| (s + e - 0.9).abs() > 0.4)
            .collect();
        assert!(far.len() > 400, "{}", far.len());
        for (s, e) in far {
            let found = table.distance_squared(s, e).0.sqrt();
            assert!((found - kinked(s, e)).abs() < 2e-4, "{s} {e}: {found}");
        }
        assert!(error(&table, kinked) < 0.3 * 0.1);
    }
}
