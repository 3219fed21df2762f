//! A cladding function: which point of the end side belongs to which point of the start side.

use serde::{Deserialize, Serialize};

/// A strictly increasing function from the shares of the start side onto those of the end side,
/// with the shares 0 and 1 kept (paper, section 3.2). Between samples it is a cubic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CladdingFunction {
    /// (start, end, slope), increasing from (0, 0) to (1, 1).
    samples: Vec<[f64; 3]>,
}

impl CladdingFunction {
    /// Makes the function from samples (start, end, slope).
    ///
    /// Slopes are limited to three times those of the neighbouring chords, which keeps the cubic
    /// pieces increasing (Fritsch and Carlson 1980).
    ///
    /// Returns `None` unless both shares increase strictly from (0, 0) to (1, 1) and all slopes
    /// are positive.
    pub fn new(mut samples: Vec<[f64; 3]>) -> Option<Self> {
        let (first, last) = (samples.first()?, samples.last()?);
        let ends_right = first[..2] == [0.0, 0.0] && last[..2] == [1.0, 1.0];
        let increasing = samples
            .windows(2)
            .all(|w| w[0][0] < w[1][0] && w[0][1] < w[1][1]);
        if !(ends_right && increasing && samples.iter().all(|s| s[2] > 0.0)) {
            return None;
        }
        for i in 1..samples.len() {
            let chord = (samples[i][1] - samples[i - 1][1]) / (samples[i][0] - samples[i - 1][0]);
            samples[i - 1][2] = samples[i - 1][2].min(3.0 * chord);
            samples[i][2] = samples[i][2].min(3.0 * chord);
        }
        Some(Self { samples })
    }

    /// (start, end) shares from (0, 0) to (1, 1).
    pub fn samples(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.samples.iter().map(|s| [s[0], s[1]])
    }

    /// Smallest and largest slope: of the samples, and of the chords between them, which the
    /// function has somewhere on the way.
    pub fn slope_range(&self) -> [f64; 2] {
        let chords = self
            .samples
            .windows(2)
            .map(|w| (w[1][1] - w[0][1]) / (w[1][0] - w[0][0]));
        let slopes = self.samples.iter().map(|s| s[2]);
        slopes
            .chain(chords)
            .fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], slope: f64| {
                [low.min(slope), high.max(slope)]
            })
    }

    /// End share and slope at a start share in [0, 1].
    pub fn at(&self, start: f64) -> (f64, f64) {
        let i = self.piece(start, 0);
        let [a, b] = [self.samples[i], self.samples[i + 1]];
        let width = b[0] - a[0];
        let x = ((start - a[0]) / width).clamp(0.0, 1.0);
        let y = 1.0 - x;
        let rise = b[1] - a[1];
        let end = a[1] + x * x * (3.0 - 2.0 * x) * rise + width * x * y * (y * a[2] - x * b[2]);
        let slope =
            6.0 * x * y * rise / width + y * (1.0 - 3.0 * x) * a[2] + x * (3.0 * x - 2.0) * b[2];
        (end, slope)
    }

    /// Start share whose end share is `end`, in [0, 1], and the slope of the inverse there.
    pub fn inverse_at(&self, end: f64) -> (f64, f64) {
        let i = self.piece(end, 1);
        let (mut low, mut high) = (self.samples[i][0], self.samples[i + 1][0]);
        let share = (end - self.samples[i][1]) / (self.samples[i + 1][1] - self.samples[i][1]);
        let mut start = low + (high - low) * share.clamp(0.0, 1.0);
        // Newton steps kept inside the shrinking bracket of an increasing function.
        for _ in 0..60 {
            let (value, slope) = self.at(start);
            if value > end {
                high = start;
            } else {
                low = start;
            }
            let newton = start - (value - end) / slope;
            if (newton - start).abs() < 1e-15 {
                break;
            }
            start = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
        }
        (start, 1.0 / self.at(start).1)
    }

    fn piece(&self, share: f64, axis: usize) -> usize {
        self.samples
            .partition_point(|s| s[axis] <= share)
            .clamp(1, self.samples.len() - 1)
            - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The exact cladding function of developable patches.
    fn moebius(k: f64) -> CladdingFunction {
        let f = |x: f64| {
            [
                x,
                k * x / (1.0 + (k - 1.0) * x),
                k / (1.0 + (k - 1.0) * x).powi(2),
            ]
        };
        let mut samples: Vec<_> = (0..=64).map(|i| f(f64::from(i) / 64.0)).collect();
        samples[64][1] = 1.0;
        CladdingFunction::new(samples).unwrap()
    }

    proptest! {
        #[test]
        fn the_inverse_undoes_the_function(k in 0.3..3.0_f64, x in 0.0..=1.0_f64) {
            let f = moebius(k);
            let (end, slope) = f.at(x);
            let (back, inverse_slope) = f.inverse_at(end);
            prop_assert!((back - x).abs() < 1e-12);
            prop_assert!((slope * inverse_slope - 1.0).abs() < 1e-9);
            prop_assert!(slope > 0.0);
        }

        #[test]
        fn it_reproduces_a_smooth_function_and_its_slope(k in 0.5..2.0_f64, x in 0.0..=1.0_f64) {
            let (end, slope) = moebius(k).at(x);
            prop_assert!((end - k * x / (1.0 + (k - 1.0) * x)).abs() < 1e-7);
            prop_assert!((slope - k / (1.0 + (k - 1.0) * x).powi(2)).abs() < 1e-4);
        }
    }

    #[test]
    fn what_is_not_increasing_is_refused() {
        let ends = [[0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
        assert!(CladdingFunction::new(ends.to_vec()).is_some());
        assert!(CladdingFunction::new(vec![ends[0], [0.5, 0.0, 1.0], ends[1]]).is_none());
        assert!(CladdingFunction::new(vec![ends[0], [0.5, 0.5, -1.0], ends[1]]).is_none());
        assert!(CladdingFunction::new(vec![[0.0, 0.1, 1.0], ends[1]]).is_none());
        assert!(CladdingFunction::new(Vec::new()).is_none());
    }
}
