//! The cladding functions of one patch as a document of their own, for whoever wants to work on
//! with them and nothing else.

use super::write::{FORMAT, ron_to_depth};
use super::{CladdingFunction, MemberRecord, PatchRecord, Plan, round};
use crate::project::model::Family;
use serde::Serialize;

/// What stands in `cladding/PATCH.ron`.
#[derive(Serialize)]
struct CladdingFile<'a> {
    format: u32,
    patch: &'a str,
    corners: &'a [String; 4],
    /// Lengths of the sides 1-2, 2-3, 3-4, 4-1, metres.
    #[serde(serialize_with = "round::metres")]
    sides: [f64; 4],
    /// At the first corner, degrees.
    #[serde(serialize_with = "round::degrees")]
    alpha_surface: f64,
    #[serde(serialize_with = "round::degrees")]
    alpha_planar: f64,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    planar_corners: [[f64; 2]; 4],
    u: FamilyFile<'a>,
    v: FamilyFile<'a>,
}

#[derive(Serialize)]
struct FamilyFile<'a> {
    function: &'a CladdingFunction,
    members: Vec<MemberShares<'a>>,
}

/// Where a member begins and ends, as shares of the sides' lengths.
#[derive(Serialize)]
struct MemberShares<'a> {
    id: &'a str,
    #[serde(serialize_with = "round::share")]
    start: f64,
    #[serde(serialize_with = "round::share")]
    end: f64,
}

/// The cladding functions of a patch of a plan with its members, as RON: a sample a line.
pub fn cladding_to_ron(plan: &Plan, patch: &PatchRecord) -> String {
    let family = |family: Family, function| FamilyFile {
        function,
        members: plan
            .members
            .iter()
            .filter(|m| m.patch == patch.id && m.family == family)
            .map(|MemberRecord { id, start, end, .. }| MemberShares {
                id,
                start: *start,
                end: *end,
            })
            .collect(),
    };
    let file = CladdingFile {
        format: FORMAT,
        patch: &patch.id,
        corners: &patch.corners,
        sides: patch.sides.each_ref().map(|side| side.length),
        alpha_surface: patch.alpha_surface,
        alpha_planar: patch.alpha_planar,
        planar_corners: patch.planar_corners,
        u: family(Family::U, &patch.cladding.u),
        v: family(Family::V, &patch.cladding.v),
    };
    ron_to_depth(&file, 4)
}
