//! Cutting files: everything that a workshop needs, made from the plan and the project's
//! fabrication values.
//!
//! | module | makes |
//! |---|---|
//! | [`nesting`] | sheets of the plan from the sizes of its lamellae |
//! | [`stickers`] | stickers and sheets of foil of the plan, and their cut files |
//! | [`supports`] | supports of the plan, their solids, drawings and the plan of the ground |
//! | [`bom`], [`summary`] | the bill of materials of the plan, and what it adds up to |
//! | [`splicing`] | pieces of lamellae that are longer than the stock |
//! | [`pieces`], [`part`], [`outline`], [`labels`] | a part as the shapes that cut it |
//! | [`lints`], [`hardware`] | what a workshop would object to |
//! | [`sheet`], [`passage`] | cut files and overview of a sheet; those of a sheet longer than the bed |
//! | [`coupon`] | a test piece for kerf and fit |
//! | [`layout`], [`network`], [`from_above`], [`cladding_plot`] | drawings of patches for people |
//! | [`tables`], [`workbook`] | CSV and XLSX |
//! | [`assembly`] | the step list |
//! | [`drawing`], [`stroke_font`] | the neutral drawing and its letters |
//! | [`dxf`], [`svg`], [`pdf`] | the writers |
//! | [`readback`] | whether files are those of a plan |
//!
//! Sheets, stickers, supports and bill are records of the plan, so they are made first
//! ([`nesting::nest`], [`stickers::records`], [`supports::records`], [`bom::rows`]); files are made
//! from the finished plan. [`outputs`] makes all of them; each
//! kind has a function of its own with the small input that it needs, for incremental builds.
//! Plans are in metres, drawings in millimetres.

pub mod assembly;
pub mod bom;
pub mod cladding_plot;
pub mod coupon;
mod curve;
mod cut_list;
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
pub mod network;
pub mod nodes;
pub mod outline;
mod outputs;
pub mod part;
pub mod passage;
pub mod pdf;
pub mod pieces;
pub mod readback;
mod sections;
mod setting;
pub mod sheet;
pub mod splicing;
pub mod stickers;
pub mod stroke_font;
pub mod summary;
pub mod supports;
pub mod svg;
pub mod tables;
pub mod units;
pub mod workbook;

pub use cut_list::Woods;
pub use network::NamedQuad;
pub use outputs::{
    Grains, Inputs, OutputFile, SheetSettings, Workshop, above_files, assembly_file, blanks, check,
    cladding_files, coupon_files, layout_files, network_files, outputs, overview_files, part_files,
    parts, sheet_files, sticker_files, support_files, table_files,
};
