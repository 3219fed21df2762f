//! The grid of a patch: where its members cross, how far bolts slide, which lamellae are cut.
//!
//! [`crossings_of`] holds every u-member to crossing every v-member exactly once, on the surface
//! and in the plane; [`lamella`] turns a member and its crossings into a strip with openings.

mod check;
mod lamella;
mod net;

pub use check::check_flat_state;
pub use lamella::{Lamella, Opening, Section, lamella};
pub use net::{Crossing, Miscrossing, Positions, crossings_of};
