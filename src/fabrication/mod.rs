//! Cutting files: everything that a workshop needs, made from the plan and the project's
//! fabrication values.
//!
//! | module | makes |
//! |---|---|
//! | [`nesting`] | sheets of the plan from the sizes of its lamellae |
//! | [`bom`] | the bill of materials of the plan |
//! | [`part`], [`labels`] | a lamella as the shapes that cut it |
//! | [`lints`], [`hardware`] | what a workshop would object to |
//! | [`sheet`] | cut file and overview of a sheet |
//! | [`layout`], [`network`], [`from_above`], [`cladding_plot`] | drawings of patches for people |
//! | [`tables`] | CSV |
//! | [`drawing`], [`stroke_font`] | the neutral drawing and its letters |
//! | [`dxf`], [`svg`] | the two writers, one file a drawing |
//!
//! Sheets and bill are records of the plan, so they are made first ([`nesting::nest`],
//! [`bom::rows`]); files are made from the finished plan. [`outputs`] makes all of them; each
//! kind has a function of its own with the small input that it needs, for incremental builds.
//! Plans are in metres, drawings in millimetres.

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
pub mod network;
pub mod nodes;
mod outputs;
pub mod part;
pub mod sheet;
pub mod stroke_font;
pub mod svg;
pub mod tables;
pub mod units;

pub use network::NamedQuad;
pub use outputs::{
    Inputs, OutputFile, above_files, blanks, check, cladding_files, layout_files, network_files,
    outputs, parts, sheet_files, table_files,
};
