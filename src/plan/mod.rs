//! The plan document.

mod document;

pub use document::*;
