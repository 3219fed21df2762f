//! The design surface: a triangle mesh with adjacency, and points on it.
//!
//! Lengths in metres, z up, faces counter-clockwise seen from outside (above).
//!
//! | to | use |
//! |---|---|
//! | read a mesh file | [`read_obj`] |
//! | walk over it | [`Mesh`], [`HalfEdge`] |
//! | name a place on it | [`SurfacePoint`], [`Tangent`] |
//! | find a place | [`Locator`], [`SurfaceMesh::vertex`] |
//! | ask how it bends | [`Curvature`], [`curvature::peaks`] |
//! | work on a part of it | [`grow`], [`SubMesh`], [`Clearance`] |
//! | make and write one | [`generate`], [`write_obj`] |

mod adjacency;
pub mod curvature;
pub mod generate;
mod grow;
mod locate;
mod mesh;
mod point;
mod read;
mod segment;
mod submesh;
mod union_find;
mod write;

pub use adjacency::MeshDefect;
pub use curvature::{Curvature, VertexCurvature};
pub use grow::grow;
pub use locate::{Closest, Locator, Miss};
pub use mesh::{HalfEdge, Mesh};
pub use point::{SurfacePoint, Tangent};
pub use read::{NoVertex, ReadOptions, Side, SurfaceMesh, read_obj};
pub use submesh::{Clearance, SubMesh};
pub use write::write_obj;

/// A point in space, metres.
pub type Point3 = nalgebra::Point3<f64>;
/// A vector in space, metres or unit.
pub type Vector3 = nalgebra::Vector3<f64>;
