//! Lamellae: the parts to cut, their openings and the pieces that they are joined from.

use crate::plan::{openings, round};
use crate::project::model::SpliceKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A part to cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LamellaRecord {
    /// The same as its member's.
    pub id: String,
    /// Id of its member.
    pub member: String,
    /// Name of the material.
    pub material: String,
    /// Metres, end margins included.
    #[serde(serialize_with = "round::metres")]
    pub length: f64,
    /// From the end of the lamella to the start of the member, metres: openings are measured
    /// from the start of the member.
    #[serde(serialize_with = "round::metres")]
    pub end_margin: f64,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    pub width: f64,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    pub thickness: f64,
    /// Kilograms, round ends, openings and holes for screws subtracted; of all pieces together.
    #[serde(serialize_with = "round::kilograms")]
    pub mass: f64,
    /// Sorted along the lamella.
    #[serde(with = "openings")]
    #[schemars(with = "Vec<OpeningRecord>")]
    pub openings: Vec<OpeningRecord>,
    /// Pieces that are joined, from the start to the end; none for a lamella in one piece.
    pub pieces: Vec<PieceRecord>,
}

/// An opening of a lamella. Positions are arc lengths from the start of the member, metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum OpeningRecord {
    /// A round hole.
    Hole {
        /// Centre.
        #[serde(serialize_with = "round::metres")]
        at: f64,
        /// Cut diameter, metres.
        #[serde(serialize_with = "round::metres")]
        diameter: f64,
        /// Id of the crossing it serves.
        crossing: String,
    },
    /// An elongated hole: the bolt slides from `from` (flat) to `to` (deployed).
    Notch {
        /// Centre of the bolt in the flat state.
        #[serde(serialize_with = "round::metres")]
        from: f64,
        /// Centre of the bolt in the deployed state.
        #[serde(serialize_with = "round::metres")]
        to: f64,
        /// Cut width, metres; the cut is longer than |to - from| by this.
        #[serde(serialize_with = "round::metres")]
        diameter: f64,
        /// Id of the crossing it serves.
        crossing: String,
    },
}

impl OpeningRecord {
    /// Id of the crossing it serves.
    pub fn crossing(&self) -> &str {
        match self {
            Self::Hole { crossing, .. } | Self::Notch { crossing, .. } => crossing,
        }
    }
}

/// A piece of a spliced lamella. Positions are metres from the start of the lamella.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PieceRecord {
    /// `west.u03a`.
    pub id: String,
    /// Middle of the joint at its start, or the start of the lamella.
    #[serde(serialize_with = "round::metres")]
    pub from: f64,
    /// Middle of the joint at its end, or the end of the lamella.
    #[serde(serialize_with = "round::metres")]
    pub to: f64,
    /// The joint to the next piece; none at the last.
    pub joint: Option<JointRecord>,
}

/// How two pieces are joined.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointRecord {
    /// Fingers, scarf or plate.
    pub kind: SpliceKind,
    /// Length that the joint takes along the lamella, metres: of the fingers, the scarf or the
    /// plate.
    #[serde(serialize_with = "round::metres")]
    pub length: f64,
    /// Fingers of each of the two pieces; none for other joints.
    pub fingers: u32,
    /// Screws through lamella and plate, from the start of the lamella; none for other joints.
    #[serde(serialize_with = "round::metres")]
    pub screws: Vec<f64>,
    /// Cut diameter of the holes for the screws, metres; 0 without screws.
    #[serde(serialize_with = "round::metres")]
    pub hole: f64,
}
