//! Patches: their sides, flat shape, curvature and cladding functions.

use crate::plan::round;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A geodesic quadrilateral.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatchRecord {
    /// The user's name.
    pub id: String,
    /// Ids of its corners in order.
    pub corners: [String; 4],
    /// Sides 1-2, 2-3, 3-4, 4-1.
    pub sides: [SideRecord; 4],
    /// Surface angle at the first corner, degrees.
    #[serde(serialize_with = "round::degrees")]
    pub alpha_surface: f64,
    /// Planar angle at the first corner, degrees.
    #[serde(serialize_with = "round::degrees")]
    pub alpha_planar: f64,
    /// The flat quadrilateral, metres, in the order of `corners`.
    #[serde(serialize_with = "round::metres")]
    pub planar_corners: [[f64; 2]; 4],
    /// Diagonals.
    pub diagonals: Diagonals,
    /// Coverage of the worst curvature peak by each family (paper, section 4.1); 1 is full, and
    /// 1 is said where there is no peak.
    pub eta: Eta,
    /// Curvature inside the patch.
    pub curvature: PatchCurvature,
    /// Cladding functions.
    pub cladding: Cladding,
    /// Whether every check of the patch passed.
    pub feasible: bool,
}

/// One side of a patch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SideRecord {
    /// Ids of its edges, from corner to corner.
    pub edges: Vec<String>,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    pub length: f64,
}

/// Diagonals of a patch, metres: `e` from the first to the third corner, `f` from the second to
/// the fourth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Diagonals {
    /// On the surface, 1-3.
    #[serde(serialize_with = "round::metres")]
    pub e: f64,
    /// On the surface, 2-4.
    #[serde(serialize_with = "round::metres")]
    pub f: f64,
    /// In the plane, 1-3.
    #[serde(serialize_with = "round::metres")]
    pub e_planar: f64,
    /// In the plane, 2-4.
    #[serde(serialize_with = "round::metres")]
    pub f_planar: f64,
}

/// Coverage per family.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Eta {
    /// u-family.
    #[serde(serialize_with = "round::share")]
    pub u: f64,
    /// v-family.
    #[serde(serialize_with = "round::share")]
    pub v: f64,
}

/// Curvature of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatchCurvature {
    /// Largest Gaussian curvature inside, 1/m^2.
    #[serde(serialize_with = "round::curvature")]
    pub max: f64,
    /// Where it is.
    #[serde(serialize_with = "round::metres")]
    pub peak: [f64; 3],
    /// pi / sqrt(max): shorter geodesics are unique (paper, Expression 1); none where max <= 0.
    #[serde(serialize_with = "round::metres")]
    pub injectivity_bound: Option<f64>,
    /// Longest member or diagonal, metres.
    #[serde(serialize_with = "round::metres")]
    pub longest_geodesic: f64,
}

/// Cladding functions of both families.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cladding {
    /// u-family: share of side 1-2 to share of side 4-3.
    pub u: CladdingFunction,
    /// v-family: share of side 1-4 to share of side 2-3.
    pub v: CladdingFunction,
}

/// A cladding function.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CladdingFunction {
    /// (start, end) shares of the two sides, increasing from (0, 0) to (1, 1).
    #[serde(serialize_with = "round::share")]
    pub samples: Vec<[f64; 2]>,
    /// Smallest slope.
    #[serde(serialize_with = "round::share")]
    pub slope_min: f64,
    /// Largest slope.
    #[serde(serialize_with = "round::share")]
    pub slope_max: f64,
}
