//! The plan document: everything about the structure, in records sorted by id.
//!
//! Lengths in metres, angles in degrees, masses in kilograms. Numbers keep full precision here
//! and are rounded only when written.

use super::{openings, round};
use crate::diagnostics::Diagnostic;
use crate::project::model::{Family, SpliceKind, SupportKind};
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
    /// Kilograms, openings subtracted.
    #[serde(serialize_with = "round::kilograms")]
    pub mass: f64,
    /// Sorted along the lamella.
    #[serde(with = "openings")]
    #[schemars(with = "Vec<OpeningRecord>")]
    pub openings: Vec<OpeningRecord>,
    /// Pieces that are joined, from the start to the end; none for a lamella in one piece.
    pub pieces: Vec<PieceRecord>,
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

/// A panel with its parts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SheetRecord {
    /// `sheet-01`.
    pub id: String,
    /// Name of the material.
    pub material: String,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    pub thickness: f64,
    /// Along the parts, metres.
    #[serde(serialize_with = "round::metres")]
    pub length: f64,
    /// Across the parts, metres.
    #[serde(serialize_with = "round::metres")]
    pub width: f64,
    /// Share of the panel's area that becomes parts.
    #[serde(serialize_with = "round::share")]
    pub yield_share: f64,
    /// Width of the cut that the drawings compensate, metres; 0 for nominal geometry.
    #[serde(serialize_with = "round::metres")]
    pub kerf: f64,
    /// Parts by id.
    pub parts: Vec<PlacedPart>,
    /// Where the panel lies on the bed, step by step as it is pushed through the machine; none
    /// for a panel that the bed takes as a whole.
    pub windows: Vec<WindowRecord>,
}

/// A stretch of a panel that lies on the bed at one time, metres along the panel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WindowRecord {
    /// Where the bed begins; it is as far from the beginning of the window before as the panel
    /// is pushed.
    #[serde(serialize_with = "round::metres")]
    pub from: f64,
    /// Where the bed ends.
    #[serde(serialize_with = "round::metres")]
    pub to: f64,
}

/// What was needed of one material and thickness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NestingRecord {
    /// Name of the material.
    pub material: String,
    /// Metres.
    #[serde(serialize_with = "round::metres")]
    pub thickness: f64,
    /// Sheets to cut.
    pub sheets: u32,
    /// No nesting in rows can do with fewer sheets of this size.
    pub sheets_bound: u32,
    /// Rows of parts on all sheets.
    pub rows: u32,
    /// No nesting in rows can do with fewer rows.
    pub rows_bound: u32,
    /// Panels to buy.
    pub panels: u32,
    /// Area of parts over area of sheets.
    #[serde(serialize_with = "round::share")]
    pub yield_share: f64,
    /// The yield of a nesting that reaches both bounds: no nesting in rows has a higher one.
    #[serde(serialize_with = "round::share")]
    pub yield_bound: f64,
}

/// A part on a sheet: its lower left corner, metres; the part lies along the length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlacedPart {
    /// Id of the lamella, or of its piece.
    pub part: String,
    /// Metres from the left.
    #[serde(serialize_with = "round::metres")]
    pub x: f64,
    /// Metres from below.
    #[serde(serialize_with = "round::metres")]
    pub y: f64,
}

/// A foil on one face of a lamella at a crossing. Positions are arc lengths from the start of
/// the member, metres, as those of openings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StickerRecord {
    /// `west.u03-v05.u`: the crossing, and the family of the lamella that carries it.
    pub id: String,
    /// From 1, in the order of assembly.
    pub number: u32,
    /// Id of the crossing.
    pub crossing: String,
    /// Id of the lamella that carries it.
    pub lamella: String,
    /// The face that it covers.
    pub face: Face,
    /// Its four corners, counter-clockwise as seen on the top face of the lamella: along it, and
    /// across it from its middle line, metres. The first two lie on its right edge.
    #[serde(serialize_with = "round::metres")]
    pub outline: [[f64; 2]; 4],
    /// First and last centre of the bolt in its slot.
    #[serde(serialize_with = "round::metres")]
    pub slot: [f64; 2],
    /// Width of its slot, metres.
    #[serde(serialize_with = "round::metres")]
    pub diameter: f64,
}

/// A face of a lamella.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Face {
    /// The one with the labels, seen in the layout drawing.
    Top,
    /// The other one.
    Bottom,
}

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

/// One line of the shopping list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BomRow {
    /// Stable key: `bolt-m4x16`.
    pub id: String,
    /// `stock`, `fastener`, `sleeve`, `friction`, `support`, `consumable`.
    pub category: String,
    /// What it is.
    pub description: String,
    /// Material, if that says something.
    pub material: String,
    /// Standard or dimensions.
    pub specification: String,
    /// How many are used.
    #[serde(serialize_with = "round::quantity")]
    pub quantity: f64,
    /// `pcs`, `m`, `m2`, `kg`.
    pub unit: String,
    /// How many more to buy.
    #[serde(serialize_with = "round::quantity")]
    pub spare: f64,
    /// Kilograms each, where known.
    #[serde(serialize_with = "round::kilograms")]
    pub unit_mass: Option<f64>,
    /// Price each, where given.
    #[serde(serialize_with = "round::quantity")]
    pub unit_cost: Option<f64>,
}

/// A diagnostic as the plan keeps it: without spans, which belong to one text of the file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiagnosticRecord {
    /// `W0602`.
    pub code: String,
    /// `note`, `warning` or `error`.
    pub severity: String,
    /// What is said.
    pub message: String,
    /// Id of the thing it is about.
    pub subject: Option<String>,
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

impl From<&Diagnostic> for DiagnosticRecord {
    fn from(diagnostic: &Diagnostic) -> Self {
        Self {
            code: diagnostic.code.to_string(),
            severity: match diagnostic.severity {
                crate::diagnostics::Severity::Note => "note",
                crate::diagnostics::Severity::Warning => "warning",
                crate::diagnostics::Severity::Error => "error",
            }
            .to_owned(),
            message: diagnostic.message.clone(),
            subject: diagnostic.subject.clone(),
        }
    }
}
