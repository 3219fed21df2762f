//! Feasibility of patches.

mod coverage;

pub use coverage::{Coverage, coverage};
