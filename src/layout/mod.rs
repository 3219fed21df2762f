//! The layout: which shortest geodesics frame which patches.
//!
//! | to | use |
//! |---|---|
//! | find the anchors on the surface | [`place_anchors`] |
//! | know from names alone which lines are needed and which piece of which line a side is | [`Network`] |
//! | walk along a side by share of its length | [`Side`] |
//! | take the part of the surface around a patch, with proof that no geodesic leaves it | [`Quad`], [`Proof`] |
//! | have four sides on that part | [`Domain`], [`SideLengths`] |
//! | refuse what is no quadrilateral | [`check_quad`] |
//!
//! A side is a piece of a *line*, the shortest geodesic between two anchors. Both patches beside a
//! shared side, and all patches at a T-junction, follow the same curve to the last bit.

mod anchors;
mod check;
mod domain;
mod interior;
mod lengths;
mod locality;
mod network;
mod side;

pub use anchors::place_anchors;
pub use check::check_quad;
pub use domain::Domain;
pub use interior::vertices_inside;
pub use lengths::SideLengths;
pub use locality::{Proof, Quad};
pub use network::{Line, Network, SidePiece, Station, edge_id};
pub use side::Side;
