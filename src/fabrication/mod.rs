//! Cutting files.

pub mod drawing;
pub mod dxf;
pub mod labels;
pub mod nesting;
pub mod part;
pub mod stroke_font;
pub mod svg;
pub mod units;
