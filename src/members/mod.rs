//! Members: even distribution over the sides that a family crosses, exact refinement.

pub mod distribution;
mod member;
mod refine;

pub use member::{Member, crossing_id, member_id};
pub use refine::{Between, Given, RefineError, boundary_member, refine};
