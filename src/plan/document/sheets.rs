//! Sheets with their parts, how good the nesting is, and the stickers of the foils.

use crate::plan::round;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
