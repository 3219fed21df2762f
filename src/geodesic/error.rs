//! Why a geodesic could not be given.

use crate::surface::SurfacePoint;
use std::fmt;

/// Why a geodesic could not be given. No distance is ever a sentinel: what is not known is one of
/// these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GeodesicError {
    /// A point that is not on the mesh: an id out of range, a coordinate that is not finite or
    /// outside its range.
    InvalidPoint {
        /// The point.
        point: SurfacePoint,
    },
    /// A radius that is negative or not a number.
    InvalidRadius {
        /// The radius, metres.
        radius: f64,
    },
    /// A face with two corners at the same place, or with a corner that is not finite: it has no
    /// directions.
    DegenerateFace {
        /// The first such face.
        face: u32,
    },
    /// A path between two points that are one has no direction; its length is zero.
    Coincident {
        /// The point.
        point: SurfacePoint,
    },
    /// Source and target lie in different components of the mesh.
    Unreachable {
        /// The target.
        target: SurfacePoint,
    },
    /// The target lies farther from the source than the field was asked to reach.
    BeyondReach {
        /// The target.
        target: SurfacePoint,
    },
    /// A path could not be followed back from its target: the coordinates of the mesh are too
    /// coarse for its faces (area below rounding).
    Untraceable {
        /// The target.
        target: SurfacePoint,
    },
}

impl fmt::Display for GeodesicError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InvalidPoint { point } => write!(f, "{point:?} is not a point of the mesh"),
            Self::InvalidRadius { radius } => write!(f, "{radius} m is not a radius"),
            Self::DegenerateFace { face } => write!(f, "face {face} has a side of length zero"),
            Self::Coincident { point } => {
                write!(f, "a path from {point:?} to itself has no direction")
            }
            Self::Unreachable { target } => {
                write!(f, "no path on the surface leads to {target:?}")
            }
            Self::BeyondReach { target } => {
                write!(f, "{target:?} is farther than the field reaches")
            }
            Self::Untraceable { target } => {
                write!(f, "the path to {target:?} is lost in rounding")
            }
        }
    }
}

impl std::error::Error for GeodesicError {}
