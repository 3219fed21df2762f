//! Cladding.

mod angle;
mod explain;
mod function;
mod maps;
mod planar;
mod table;
mod trace;

pub use angle::{
    AngleChoice, Clad, Crowded, Demands, Infeasible, Maps, Obstacle, choose_angle, clad,
};
pub use explain::explain;
pub use function::CladdingFunction;
pub use maps::{SAMPLES, distance_table};
pub use planar::{PlanarQuad, Point2, SideLengths};
pub use table::{DistanceTable, nodes};
pub use trace::{TraceFailure, trace};
