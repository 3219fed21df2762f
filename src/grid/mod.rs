//! The grid of a patch: crossings of the two families, notches, lamellae, the flat state.

mod check;

mod lamella;
mod net;

pub use check::check_flat_state;

pub use lamella::{Lamella, Opening, Section, lamella};
pub use net::{Crossing, Miscrossing, Positions, crossings_of};
