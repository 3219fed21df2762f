//! Layout.

mod interior;
mod network;

pub use interior::vertices_inside;
pub use network::{Line, Network, SidePiece, Station, edge_id};
