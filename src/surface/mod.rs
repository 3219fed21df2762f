//! The design surface: a triangle mesh with adjacency, and points on it.
//!
//! Lengths in metres, z up, faces counter-clockwise seen from outside (above).

mod mesh;
mod point;

pub use mesh::{HalfEdge, Mesh, MeshDefect};
pub use point::{SurfacePoint, Tangent};

/// A point in space, metres.
pub type Point3 = nalgebra::Point3<f64>;
/// A vector in space, metres or unit.
pub type Vector3 = nalgebra::Vector3<f64>;
