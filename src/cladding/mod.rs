//! Cladding: which places on opposite sides of a patch are as far apart on the surface as in the
//! plane.
//!
//! | step | by |
//! |---|---|
//! | exact distances between opposite sides, interpolated | [`distance_table`], [`DistanceTable`] |
//! | the flat quadrilateral with one free angle | [`PlanarQuad`] |
//! | the arc of equal distances | [`trace`], [`CladdingFunction`] |
//! | the angle: feasible intervals and the most compact plan | [`choose_angle`], [`clad`], [`lay`] |
//! | how far from it a patch is where there is none | [`survey`] |
//! | why there is none, in words | [`explain`] |

mod angle;
mod explain;
mod function;
mod maps;
mod planar;
mod survey;
mod table;
mod trace;

pub use angle::{
    AngleChoice, Clad, Crowded, Demands, Infeasible, Maps, Obstacle, choose_angle, clad, lay,
};
pub use explain::explain;
pub use function::CladdingFunction;
pub use maps::{SAMPLES, distance_table};
pub use planar::{PlanarQuad, Point2};
pub use survey::{Survey, survey};
pub use table::{DistanceTable, nodes};
pub use trace::{TraceFailure, trace};
