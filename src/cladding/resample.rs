//! Linear interpolation schemes of one share as matrices, and their products over two shares.

/// What the parts of an interpolant contribute at some places.
#[derive(Debug, Default)]
pub(super) struct Basis {
    /// A row per place, a column per part: to the value.
    pub(super) values: Vec<Vec<f64>>,
    /// To the derivative by the share.
    pub(super) slopes: Vec<Vec<f64>>,
}

/// `start * parts * endᵀ`: what parts over two shares amount to at pairs of places.
pub(super) fn resample(start: &[Vec<f64>], parts: &[Vec<f64>], end: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    // Per place of the end share and part of the start share.
    let along_end: Vec<Vec<f64>> = end
        .iter()
        .map(|weights| parts.iter().map(|row| dot(row, weights)).collect())
        .collect();
    start
        .iter()
        .map(|weights| {
            along_end
                .iter()
                .map(|column| dot(weights, column))
                .collect()
        })
        .collect()
}
