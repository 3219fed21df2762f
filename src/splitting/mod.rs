//! Feasibility of patches, and splitting of those that are not feasible.
//!
//! | to | use |
//! |---|---|
//! | measure a patch by the surface alone: curvature, coverage of its peaks, diagonals | [`feasibility`], [`coverage`] |
//! | hold that against the project's limits, in words | [`judge`] |
//! | have all criteria in one record, and those of all patches for scripts | [`check`], [`CheckDocument`] |
//! | know where a patch can be split | [`Proposal`] |

mod account;
mod appraise;
mod automatic;
mod block;
mod check;
mod coverage;
mod cut;
mod document;
mod draft;
mod feasibility;
mod growing;
mod informed;
mod judge;
mod merging;
mod principal;
mod proposal;
mod split;

pub use check::{AngleCheck, DiagonalCheck, Findings, PatchCheck, PeakCheck, PerFamily, check};
pub use coverage::{Coverage, coverage};
pub use cut::Refusal;
pub use document::{CheckDocument, schema};
pub use draft::{Draft, DraftPatch};
pub use feasibility::{Feasibility, JudgedPeak, feasibility};
pub use judge::{Criteria, judge};
pub use proposal::Proposal;
pub use split::{Cancelled, NoSplit, SplitLimits, Weaves, split};
