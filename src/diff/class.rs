//! How much a change matters to the people who cut and assemble.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a change asks for, from nothing to new wood.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Class {
    /// Below the tolerance: nobody can see it.
    Noise,
    /// Drawings, labels, sheets or prices change, parts do not.
    Redraw,
    /// Parts stay as they are cut, but go to another place, in another order, or with other
    /// hardware.
    Reassemble,
    /// A part has to be cut, again or for the first time.
    Recut,
}

impl Class {
    /// The classes that a reviewer looks at, worst first.
    pub const REVIEWED: [Self; 3] = [Self::Recut, Self::Reassemble, Self::Redraw];

    /// The word that users type and read.
    pub fn word(self) -> &'static str {
        match self {
            Self::Noise => "noise",
            Self::Redraw => "redraw",
            Self::Reassemble => "reassemble",
            Self::Recut => "recut",
        }
    }

    /// What it asks for, as the head of a list.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Noise => "Below tolerance",
            Self::Redraw => "To redraw",
            Self::Reassemble => "To reassemble",
            Self::Recut => "To cut",
        }
    }
}
