//! Members: even distribution over the sides that a family crosses, exact refinement.

pub mod distribution;
mod member;
mod refine;
pub mod schedule;
pub mod threads;
mod weave;

pub use member::{Member, crossing_label, id_in, member_label};
pub use refine::{Between, Given, RefineError, boundary_member, refine};
pub use weave::{Ground, WeaveError, weave};
