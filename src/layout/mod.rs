//! Layout.

mod anchors;
mod check;
mod domain;
mod interior;
mod locality;
mod network;
mod side;

pub use anchors::place_anchors;
pub use check::check_quad;
pub use domain::Domain;
pub use interior::vertices_inside;
pub use locality::{Proof, Quad};
pub use network::{Line, Network, SidePiece, Station, edge_id};
pub use side::Side;
