//! The plan: the compiler's one result, from which drawings, sheets, bills and differences are
//! made, and from nothing else.

mod document;
mod round;
mod write;

pub use document::*;
pub use write::{FORMAT, ReadError, from_ron, schema, to_json, to_ron};
