//! What the patches stand on: the surface, its anchors and the lines between them.

use crate::plan::round;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The design surface.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceRecord {
    /// Number of vertices.
    pub vertices: u32,
    /// Number of triangles.
    pub faces: u32,
    /// Square metres.
    #[serde(serialize_with = "round::quantity")]
    pub area: f64,
    /// Smallest and largest coordinates.
    #[serde(serialize_with = "round::metres")]
    pub bounding_box: [[f64; 3]; 2],
    /// Gaussian curvature away from the border, 1/m^2.
    pub gaussian_curvature: Range,
}

/// An interval.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// Lower end.
    #[serde(serialize_with = "round::curvature")]
    pub min: f64,
    /// Upper end.
    #[serde(serialize_with = "round::curvature")]
    pub max: f64,
}

/// An anchor on the surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointRecord {
    /// The user's name.
    pub id: String,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    pub position: [f64; 3],
    /// Unit surface normal.
    #[serde(serialize_with = "round::share")]
    pub normal: [f64; 3],
}

/// A shortest geodesic between two anchors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EdgeRecord {
    /// `a-b`.
    pub id: String,
    /// First anchor.
    pub from: String,
    /// Second anchor.
    pub to: String,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    pub length: f64,
    /// Points where it crosses mesh edges, ends included.
    #[serde(serialize_with = "round::metres")]
    pub polyline: Vec<[f64; 3]>,
}
