//! Segments, in the plan and in space.

use nalgebra::SVector;

/// The point of a segment that is closest to the origin: its share of the way and its position.
pub(super) fn closest_on_segment<const D: usize>(
    from: SVector<f64, D>,
    to: SVector<f64, D>,
) -> (f64, SVector<f64, D>) {
    let along = to - from;
    let length = along.norm_squared();
    let share = if length > 0.0 {
        (-from.dot(&along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (share, from + along * share)
}
