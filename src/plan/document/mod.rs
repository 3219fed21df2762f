//! The plan document: everything about the structure, in records sorted by id.
//!
//! Lengths in metres, angles in degrees, masses in kilograms. Numbers keep full precision here
//! and are rounded only when written.

mod lamella;
mod members;
mod patch;
mod remarks;
mod sheets;
mod skeleton;
mod supports;

pub use lamella::{JointRecord, LamellaRecord, OpeningRecord, PieceRecord};
pub use members::{CrossingRecord, MemberRecord, Positions, RingRecord, StripRecord};
pub use patch::{
    Cladding, CladdingFunction, Diagonals, Eta, PatchCurvature, PatchRecord, SideRecord,
};
pub use remarks::{BomRow, DiagnosticRecord};
pub use sheets::{Face, NestingRecord, PlacedPart, SheetRecord, StickerRecord, WindowRecord};
pub use skeleton::{EdgeRecord, PointRecord, Range, SurfaceRecord};
pub use supports::{SupportBody, SupportRecord};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A whole structure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Version of this format.
    pub format: u32,
    /// The project's name.
    pub name: String,
    /// The design surface.
    pub surface: SurfaceRecord,
    /// Anchors.
    pub points: Vec<PointRecord>,
    /// Shortest geodesics between anchors.
    pub edges: Vec<EdgeRecord>,
    /// Geodesic quadrilaterals.
    pub patches: Vec<PatchRecord>,
    /// Families that members run through one after the other.
    pub strips: Vec<StripRecord>,
    /// Grid curves.
    pub members: Vec<MemberRecord>,
    /// Where a u-member meets a v-member.
    pub crossings: Vec<CrossingRecord>,
    /// Parts to cut.
    pub lamellae: Vec<LamellaRecord>,
    /// Panels with their parts.
    pub sheets: Vec<SheetRecord>,
    /// What was needed of each material and thickness, and how good that is.
    pub nesting: Vec<NestingRecord>,
    /// Foils between lamellae, in the order of assembly.
    pub stickers: Vec<StickerRecord>,
    /// Sheets of foil with their stickers; the places are those of the stickers' cards.
    pub foils: Vec<SheetRecord>,
    /// What the structure stands on.
    pub supports: Vec<SupportRecord>,
    /// What to buy.
    pub bill_of_materials: Vec<BomRow>,
    /// What the compiler had to say.
    pub diagnostics: Vec<DiagnosticRecord>,
}

impl Default for Plan {
    /// An empty plan of the current format.
    fn default() -> Self {
        Self {
            format: super::FORMAT,
            name: String::new(),
            surface: SurfaceRecord::default(),
            points: Vec::new(),
            edges: Vec::new(),
            patches: Vec::new(),
            strips: Vec::new(),
            members: Vec::new(),
            crossings: Vec::new(),
            lamellae: Vec::new(),
            stickers: Vec::new(),
            foils: Vec::new(),
            supports: Vec::new(),
            sheets: Vec::new(),
            nesting: Vec::new(),
            bill_of_materials: Vec::new(),
            diagnostics: Vec::new(),
        }
    }
}
