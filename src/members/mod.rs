//! Members: even distribution over the sides that a family crosses, exact refinement.

pub mod distribution;
mod make;
mod member;
mod refine;
pub mod threads;

pub use make::{MakeError, make_members};
pub use member::{Member, crossing_label, id_in, member_label};
pub use refine::{Between, Given, RefineError, boundary_member, refine};
