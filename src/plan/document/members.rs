//! Members, the strips that they run through, and where they cross.

use crate::plan::round;
use crate::project::model::Family;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Families whose members run on from patch to patch, or depend on each other through T-junctions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StripRecord {
    /// Its first family: `west.v`.
    pub id: String,
    /// Its families, sorted.
    pub families: Vec<String>,
    /// How much more even its members are than if they were even on the side where they begin:
    /// the sum of squared distances (paper, Problem 3) before, over that after; at least 1.
    #[serde(serialize_with = "round::share")]
    pub evenness_gained: f64,
    /// If its patches go around and meet again.
    pub ring: Option<RingRecord>,
}

/// A ring of patches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RingRecord {
    /// Whether its members were asked to end where they began.
    pub closed: bool,
    /// How far beside its beginning a member ends at most, metres.
    #[serde(serialize_with = "round::metres")]
    pub drift: f64,
}

/// A grid curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MemberRecord {
    /// `west.u03`.
    pub id: String,
    /// Id of its patch.
    pub patch: String,
    /// Its family.
    pub family: Family,
    /// From 1, in the order of the start side.
    pub index: u32,
    /// Share of the start side.
    #[serde(serialize_with = "round::share")]
    pub start: f64,
    /// Share of the end side.
    #[serde(serialize_with = "round::share")]
    pub end: f64,
    /// Whether it is a side of the patch.
    pub boundary: bool,
    /// Exact shortest distance of its ends on the surface, metres.
    #[serde(serialize_with = "round::metres")]
    pub length_surface: f64,
    /// Distance of its ends in the plane, metres.
    #[serde(serialize_with = "round::metres")]
    pub length_planar: f64,
    /// Points where it crosses mesh edges, ends included.
    #[serde(serialize_with = "round::metres")]
    pub polyline: Vec<[f64; 3]>,
    /// Ends in the plane, metres.
    #[serde(serialize_with = "round::metres")]
    pub planar: [[f64; 2]; 2],
}

/// Where two members meet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CrossingRecord {
    /// `west.u03-v05`.
    pub id: String,
    /// Id of the u-member.
    pub u: String,
    /// Id of the v-member.
    pub v: String,
    /// On the surface, metres.
    #[serde(serialize_with = "round::metres")]
    pub position: [f64; 3],
    /// Unit surface normal.
    #[serde(serialize_with = "round::share")]
    pub normal: [f64; 3],
    /// In the plane, metres.
    #[serde(serialize_with = "round::metres")]
    pub planar: [f64; 2],
    /// Arc length from the start of the u-member.
    pub on_u: Positions,
    /// Arc length from the start of the v-member.
    pub on_v: Positions,
    /// Angle from the u- to the v-member on the surface, degrees.
    #[serde(serialize_with = "round::degrees")]
    pub angle_surface: f64,
    /// Angle from the u- to the v-member in the plane, degrees.
    #[serde(serialize_with = "round::degrees")]
    pub angle_planar: f64,
}

/// Arc length of a crossing on one member, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Positions {
    /// Deployed.
    #[serde(serialize_with = "round::metres")]
    pub surface: f64,
    /// Flat.
    #[serde(serialize_with = "round::metres")]
    pub planar: f64,
}
