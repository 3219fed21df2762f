//! Feasibility of patches: can shortest geodesics cover them, and how far from it are they?
//!
//! [`feasibility`] measures a patch by the surface alone (curvature, coverage of its peaks,
//! diagonals), [`judge`] holds that against its flat state and the project's limits.

mod coverage;
mod feasibility;

pub use coverage::{Coverage, coverage};
pub use feasibility::{Feasibility, feasibility, judge};
