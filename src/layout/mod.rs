//! Layout.

mod network;

pub use network::{Line, Network, SidePiece, Station, edge_id};
