//! Units of drawings.

/// Millimetres in a metre: drawings are in millimetres, plans in metres.
pub const MM: f64 = 1000.0;
