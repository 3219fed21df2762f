//! Grid.

mod crossing;

pub use crossing::{Curve, Hit, crossings};
