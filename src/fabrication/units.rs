//! Units of drawings.

/// Millimetres in a metre: drawings are in millimetres, plans in metres.
pub const MM: f64 = 1000.0;

/// The largest of 1, 2 and 5 times a power of ten that is not above a length.
pub fn round_length(length: f64) -> f64 {
    if length.is_nan() || length <= 0.0 {
        return 1.0;
    }
    let power = libm::pow(10.0, libm::floor(libm::log10(length)));
    [5.0, 2.0, 1.0]
        .into_iter()
        .map(|digit| digit * power)
        .find(|round| *round <= length * (1.0 + 1e-12))
        .unwrap_or(power)
}
