//! The layout: which shortest geodesics frame which patches.
//!
//! | to | use |
//! |---|---|
//! | find the anchors on the surface | [`place_anchors`] |
//! | know from names alone which lines are needed and which piece of which line a side is | [`Network`] |
//! | find the shortest geodesic between two anchors, on as much of the surface as it takes | [`shortest_line`] |
//! | walk along a side by share of its length | [`Side`] |
//! | take the part of the surface around a patch, with proof that no geodesic leaves it | [`Quad`], [`Proof`] |
//! | have four sides on that part | [`Domain`], [`SideLengths`] |
//! | refuse what is no quadrilateral | [`check_quad`] |
//! | see where the border of the surface is in the way | [`bend_at_border`], [`hole_inside`] |
//! | refuse patches that overlap or miss each other by little | [`check_network`] |
//!
//! A side is a piece of a *line*, the shortest geodesic between two anchors. Both patches beside a
//! shared side, and all patches at a T-junction, follow the same curve to the last bit.

mod anchors;
mod border;
mod check;
mod domain;
mod interior;
mod lengths;
mod line;
mod locality;
mod neighbours;
mod network;
mod side;

pub use anchors::place_anchors;
pub use border::{Bend, bend_at_border, hole_inside};
pub use check::check_quad;
pub use domain::Domain;
pub use interior::vertices_inside;
pub use lengths::SideLengths;
pub use line::shortest_line;
pub use locality::{Proof, Quad};
pub use neighbours::{PlacedPatch, Structure, check_network};
pub use network::{Line, Network, SidePiece, Station, edge_id};
pub use side::Side;

use crate::surface::Point3;

/// A place as diagnostics tell it: `(1.25, 0.5, -0.0312) m`.
pub fn place(p: Point3) -> String {
    let number = |x: f64| {
        let text = format!("{x:.4}");
        let short = text.trim_end_matches('0').trim_end_matches('.');
        if short == "-0" { "0" } else { short }.to_owned()
    };
    format!("({}, {}, {}) m", number(p.x), number(p.y), number(p.z))
}
