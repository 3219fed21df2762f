//! What the structure stands on.

use crate::plan::round;
use crate::project::model::SupportKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A support: a point and a tangent plane that the structure is bolted to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SupportRecord {
    /// `support-a`, `support-west.u01-v03`.
    pub id: String,
    /// The anchor or crossing that it carries.
    pub at: String,
    /// Ids of the crossings whose bolt holds it.
    pub crossings: Vec<String>,
    /// What it is.
    pub kind: SupportKind,
    /// Middle of its contact face, metres: half the stack of lamellae below the surface.
    #[serde(serialize_with = "round::metres")]
    pub position: [f64; 3],
    /// Unit normal of the contact face, upwards.
    #[serde(serialize_with = "round::share")]
    pub normal: [f64; 3],
    /// Angle of the contact face to the horizontal, degrees.
    #[serde(serialize_with = "round::degrees")]
    pub tilt: f64,
    /// Direction in which the contact face falls, degrees counter-clockwise from x; 0 if it is
    /// level.
    #[serde(serialize_with = "round::degrees")]
    pub azimuth: f64,
    /// Middle of the contact face above the ground, metres.
    #[serde(serialize_with = "round::metres")]
    pub height: f64,
    /// Length of its bolt under the head, metres.
    #[serde(serialize_with = "round::metres")]
    pub bolt_length: f64,
    /// Shape of its body; none where the contact face is too steep for a foot below it.
    pub body: Option<SupportBody>,
}

/// The body of a support. Metres, cubic metres, kilograms, newtons.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SupportBody {
    /// Diameter of the contact face of a printed foot; side of a wedge or block, in plan.
    #[serde(serialize_with = "round::metres")]
    pub pad: f64,
    /// Diameter of a printed foot, side of a square block.
    #[serde(serialize_with = "round::metres")]
    pub foot: f64,
    /// Diameter of the hole for the bolt, square to the contact face.
    #[serde(serialize_with = "round::metres")]
    pub bore: f64,
    /// Depth of that hole.
    #[serde(serialize_with = "round::metres")]
    pub depth: f64,
    /// Height of the block at its middle; without a wedge, that of the support.
    #[serde(serialize_with = "round::metres")]
    pub block: f64,
    /// Volume, the wedge apart.
    #[serde(serialize_with = "round::cubic_metres")]
    pub volume: f64,
    /// Mass, the wedge apart; a printed foot is taken as solid.
    #[serde(serialize_with = "round::kilograms")]
    pub mass: f64,
    /// Horizontal thrust at the contact face that tips it over the nearest edge of its foot
    /// if nothing but its own weight holds it.
    #[serde(serialize_with = "round::quantity")]
    pub tipping_thrust: f64,
}
