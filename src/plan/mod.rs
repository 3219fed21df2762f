//! The plan: the compiler's one result, from which drawings, sheets, bills and differences are
//! made, and from nothing else.

mod chapter;
mod cladding_file;
mod document;
mod openings;
mod round;
mod write;

pub use chapter::{
    EdgePiece, PatchNames, PatchResults, StripNames, bind, patch_chapter, skeleton_chapter,
    strip_chapter,
};
pub use cladding_file::cladding_to_ron;
pub use document::*;
pub use write::{FORMAT, ReadError, from_ron, schema, to_json, to_ron};
