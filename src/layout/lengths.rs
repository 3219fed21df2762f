//! Lengths of the sides of a patch: all that its flat state needs to know of it beside distances.

use serde::{Deserialize, Serialize};

/// Lengths of the sides of a patch with corners A, B, C, D in order, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SideLengths {
    /// A to B: where the u-family starts.
    pub ab: f64,
    /// B to C: where the v-family ends.
    pub bc: f64,
    /// C to D: where the u-family ends.
    pub cd: f64,
    /// D to A: where the v-family starts.
    pub da: f64,
}

impl SideLengths {
    /// The four lengths in the order AB, BC, CD, DA.
    pub fn to_array(self) -> [f64; 4] {
        [self.ab, self.bc, self.cd, self.da]
    }

    /// The longest side, metres.
    pub fn longest(self) -> f64 {
        self.to_array().into_iter().fold(0.0, f64::max)
    }
}
