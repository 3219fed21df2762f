//! Feasibility of patches: can they be covered, and how far from it are they?

mod coverage;
mod feasibility;

pub use coverage::{Coverage, coverage};
pub use feasibility::{Feasibility, feasibility, judge};
