//! The language.

pub mod model;
