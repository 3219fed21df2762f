//! Cutting files: everything that a workshop needs, made from the plan and the project's
//! fabrication values.
//!
//! | module | makes |
//! |---|---|
//! | [`nesting`] | sheets of the plan from the sizes of its lamellae |
//! | [`stickers`] | stickers and sheets of foil of the plan, and their cut files |
//! | [`supports`] | supports of the plan, their solids, drawings and the plan of the ground |
//! | [`bom`], [`summary`] | the bill of materials of the plan, and what it adds up to |
//! | [`part`], [`labels`] | a lamella as the shapes that cut it |
//! | [`lints`], [`hardware`] | what a workshop would object to |
//! | [`sheet`] | cut file and overview of a sheet |
//! | [`layout`], [`from_above`], [`cladding_plot`] | drawings of patches for people |
//! | [`tables`], [`workbook`] | CSV and XLSX |
//! | [`assembly`] | the step list |
//! | [`drawing`], [`stroke_font`] | the neutral drawing and its letters |
//! | [`dxf`], [`svg`] | the two writers, one file a drawing |
//!
//! Sheets, stickers, supports and bill are records of the plan, so they are made first
//! ([`nesting::nest`], [`stickers::records`], [`supports::records`], [`bom::rows`]); files are made
//! from the finished plan. [`outputs`] makes all of them; each
//! kind has a function of its own with the small input that it needs, for incremental builds.
//! Plans are in metres, drawings in millimetres.

pub mod assembly;
pub mod bom;
pub mod cladding_plot;
pub mod drawing;
pub mod dxf;
pub mod from_above;
pub mod hardware;
pub mod index;
pub mod labels;
pub mod layout;
pub mod lints;
pub mod names;
pub mod nesting;
pub mod nodes;
mod outputs;
pub mod part;
mod setting;
pub mod sheet;
pub mod stickers;
pub mod stroke_font;
pub mod summary;
pub mod supports;
pub mod svg;
pub mod tables;
pub mod units;
pub mod workbook;

pub use outputs::{
    Inputs, OutputFile, above_files, assembly_file, blanks, check, cladding_files, layout_files,
    outputs, parts, sheet_files, sticker_files, support_files, table_files,
};
