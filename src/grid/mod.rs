//! The grid of a patch: crossings of the two families, notches, lamellae, the flat state.

mod crossing;
mod lamella;
mod net;

pub use crossing::{Curve, Hit, crossings};
pub use lamella::{Lamella, Opening, Section, lamella};
pub use net::{Crossing, Miscrossing, Positions, crossings_of};
