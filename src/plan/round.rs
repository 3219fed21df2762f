//! Rounding of numbers when a plan is written: one rule per quantity, far below what a machine
//! can cut and far above the last bits of a computation.
//!
//! Only notations for people and scripts (RON, JSON) are rounded. The binary form of the cache
//! keeps every bit, so that what is made from a plan does not depend on whether it was computed
//! or read back.
//!
//! The functions are for `#[serde(serialize_with)]` on the fields of records.

use serde::{Serialize, Serializer};

/// Values that consist of numbers.
pub(super) trait Numbers {
    /// What rounding gives.
    type Rounded: Serialize;

    /// Applies a function to each number.
    fn map(&self, f: &dyn Fn(f64) -> f64) -> Self::Rounded;
}

impl Numbers for f64 {
    type Rounded = f64;

    fn map(&self, f: &dyn Fn(f64) -> f64) -> f64 {
        f(*self)
    }
}

impl<T: Numbers> Numbers for Vec<T> {
    type Rounded = Vec<T::Rounded>;

    fn map(&self, f: &dyn Fn(f64) -> f64) -> Self::Rounded {
        self.iter().map(|x| x.map(f)).collect()
    }
}

impl<T: Numbers> Numbers for Option<T> {
    type Rounded = Option<T::Rounded>;

    fn map(&self, f: &dyn Fn(f64) -> f64) -> Self::Rounded {
        self.as_ref().map(|x| x.map(f))
    }
}

impl<T: Numbers> Numbers for [T; 2] {
    type Rounded = [T::Rounded; 2];

    fn map(&self, f: &dyn Fn(f64) -> f64) -> Self::Rounded {
        self.each_ref().map(|x| x.map(f))
    }
}

impl Numbers for [f64; 3] {
    type Rounded = [f64; 3];

    fn map(&self, f: &dyn Fn(f64) -> f64) -> Self::Rounded {
        self.each_ref().map(|x| x.map(f))
    }
}

impl Numbers for [f64; 4] {
    type Rounded = [f64; 4];

    fn map(&self, f: &dyn Fn(f64) -> f64) -> Self::Rounded {
        self.each_ref().map(|x| x.map(f))
    }
}

impl Numbers for [[f64; 2]; 4] {
    type Rounded = [[f64; 2]; 4];

    fn map(&self, f: &dyn Fn(f64) -> f64) -> Self::Rounded {
        self.each_ref().map(|x| x.map(f))
    }
}

/// Writes a value, rounded where the notation is one that people read.
fn written<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    rounded: &dyn Fn(f64) -> f64,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    if serializer.is_human_readable() {
        value.map(rounded).serialize(serializer)
    } else {
        value.serialize(serializer)
    }
}

fn to_decimals(decimals: i32) -> impl Fn(f64) -> f64 {
    let scale = libm::pow(10.0, f64::from(decimals));
    move |x| {
        let rounded = (x * scale).round() / scale;
        // No negative zero, and numbers too large for the scale stay as they are.
        if rounded.is_finite() {
            rounded + 0.0
        } else {
            x
        }
    }
}

/// Lengths and coordinates in metres: to the nanometre, so that conditions of 1e-6 of a length
/// can be checked on a written plan.
pub(super) fn metres<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    written(value, &to_decimals(9), serializer)
}

/// Shares, slopes, ratios and components of unit vectors: to 1e-9.
pub(super) fn share<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    written(value, &to_decimals(9), serializer)
}

/// Angles in degrees: to 1e-6.
pub(super) fn degrees<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    written(value, &to_decimals(6), serializer)
}

/// Masses in kilograms: to the milligram.
pub(super) fn kilograms<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    written(value, &to_decimals(6), serializer)
}

/// Areas and quantities of a bill: to 1e-6.
pub(super) fn quantity<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    written(value, &to_decimals(6), serializer)
}

/// Volumes in cubic metres: to the cubic millimetre.
pub(super) fn cubic_metres<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    written(value, &to_decimals(9), serializer)
}

/// Curvatures: to six significant digits, the estimate has no more.
pub(super) fn curvature<T: Numbers + Serialize, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let significant = |x: f64| {
        if x == 0.0 || !x.is_finite() {
            return x + 0.0;
        }
        let magnitude = libm::floor(libm::log10(x.abs())) as i32;
        to_decimals(5 - magnitude)(x)
    };
    written(value, &significant, serializer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize)]
    struct Record {
        #[serde(serialize_with = "metres")]
        length: f64,
        #[serde(serialize_with = "metres")]
        polyline: Vec<[f64; 3]>,
        #[serde(serialize_with = "curvature")]
        bend: Option<f64>,
    }

    #[test]
    fn numbers_are_written_shortest_after_rounding() {
        let record = Record {
            length: 0.1 + 0.2,
            polyline: vec![[-1e-12, 1.0 / 3.0, 12_345.678_912_345_678]],
            bend: Some(-0.001_234_567_89),
        };
        let text = ron::to_string(&record).unwrap();
        assert_eq!(
            text,
            "(length:0.3,polyline:[(0.0,0.333333333,12345.678912346)],bend:Some(-0.00123457))"
        );
    }

    #[test]
    fn the_binary_form_keeps_every_bit() {
        #[derive(Serialize)]
        struct Exact(#[serde(serialize_with = "metres")] f64);
        let third = 1.0 / 3.0;
        assert_eq!(
            postcard::to_stdvec(&Exact(third)),
            postcard::to_stdvec(&third)
        );
    }
}
