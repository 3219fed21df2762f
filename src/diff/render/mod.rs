//! The difference for people. Every renderer works from the document alone.

pub(super) mod html;
pub(super) mod markdown;
mod picture;
pub(super) mod svg;
pub(super) mod text;
pub(super) mod words;
