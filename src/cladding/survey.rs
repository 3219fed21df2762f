//! Where a patch without a feasible plan stands: the slopes of both families at the angle at which
//! they violate the bounds least.

use super::angle::CONVEXITY;
use super::{Maps, PlanarQuad, trace};
use crate::project::model::Family;
use serde::{Deserialize, Serialize};

/// Step of the scan, radians: one degree tells which family fails, and by how much.
const STEP: f64 = std::f64::consts::PI / 180.0;
/// A family without a cladding function violates more than any slopes.
const NO_FUNCTION: f64 = 1e3;

/// Slopes of both families at the least bad angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Survey {
    /// The angle at A, radians.
    pub alpha: f64,
    /// Least and greatest slope of the u- and the v-family; `None` without a cladding function.
    pub slopes: [Option<[f64; 2]>; 2],
}

impl Survey {
    /// Whether the u- and the v-family violate the bounds.
    pub fn violates(&self, bounds: [f64; 2]) -> [bool; 2] {
        self.slopes.map(|slopes| violation(slopes, bounds) > 0.0)
    }
}

/// Looks for the angle at which the worse of both families violates the bounds least; `None`
/// where no angle gives a convex plan.
pub fn survey(maps: &Maps<'_>, bounds: [f64; 2]) -> Option<Survey> {
    let (low, high) = maps.sides.convex_range()?;
    let steps = ((high - low) / STEP).ceil().max(8.0) as u32;
    let mut best: Option<([f64; 3], Survey)> = None;
    for k in 0..steps {
        let alpha = low + (high - low) * (f64::from(k) + 0.5) / f64::from(steps);
        let Some(quad) = PlanarQuad::new(maps.sides, alpha) else {
            continue;
        };
        let slopes = [(Family::U, maps.u), (Family::V, maps.v)].map(|(family, table)| {
            let function = trace(table, &quad, family).ok()?;
            Some(function.slope_range())
        });
        let [u, v] = slopes.map(|slopes| violation(slopes, bounds));
        // A corner that is nearly straight speaks against an angle whatever the slopes.
        let flat = f64::from(quad.convexity_margin() < CONVEXITY);
        let rank = [flat, u.max(v), u + v];
        if best.is_none_or(|(least, _)| rank < least) {
            best = Some((rank, Survey { alpha, slopes }));
        }
    }
    best.map(|(_, survey)| survey)
}

/// By which factor, as its logarithm, slopes leave the bounds; 0 within them.
fn violation(slopes: Option<[f64; 2]>, [least, most]: [f64; 2]) -> f64 {
    slopes.map_or(NO_FUNCTION, |[low, high]| {
        libm::log(least / low).max(libm::log(high / most)).max(0.0)
    })
}
