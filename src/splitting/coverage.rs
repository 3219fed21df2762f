//! Coverage of curvature peaks: can shortest geodesics of a family reach every point around a
//! peak of Gaussian curvature, or do they all pass beside it (paper, section 4.1)?

use crate::geodesic::{GeodesicError, Geodesics, Reach};
use crate::layout::{Domain, Side};
use crate::project::model::Family;
use crate::surface::SurfacePoint;
use serde::{Deserialize, Serialize};

/// Points of a side at which distances are compared. The ratio is stationary in both feet, so a
/// step of 1/64 of the side changes it by less than 1e-4 of its excess.
const FEET: usize = 65;

/// How a family covers a peak.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Coverage {
    /// η: the way over the peak, divided by the shortest one; 1 when the peak is covered.
    pub eta: f64,
    /// The peak.
    pub peak: SurfacePoint,
    /// Share of the start side that is closest to the peak.
    pub start: f64,
    /// Share of the end side at which the detour over the peak is shortest.
    pub end: f64,
}

/// η of both families at a peak inside the patch: u first.
pub fn coverage(
    domain: &Domain,
    geodesics: &Geodesics<'_>,
    peak: &SurfacePoint,
) -> Result<[Coverage; 2], GeodesicError> {
    let families = [Family::U, Family::V];
    let feet = |side: &Side| -> Vec<SurfacePoint> {
        (0..FEET)
            .map(|i| side.at(domain.mesh(), share(i)))
            .collect()
    };
    let sides = families.map(|f| (feet(domain.start(f)), feet(domain.end(f))));
    let all: Vec<SurfacePoint> = sides
        .iter()
        .flat_map(|(start, end)| start.iter().chain(end))
        .copied()
        .collect();
    let from_peak = geodesics.field(peak, Reach::Targets(&all))?;
    let mut covers = Vec::with_capacity(2);
    for (start, end) in &sides {
        let to_start = distances(&from_peak, start)?;
        let to_end = distances(&from_peak, end)?;
        let first = position_of_least(&to_start);
        let across = geodesics.field(&start[first], Reach::Targets(end))?;
        let direct = distances(&across, end)?;
        let detour: Vec<f64> = to_end
            .iter()
            .zip(&direct)
            .map(|(over, direct)| over - direct)
            .collect();
        let last = position_of_least(&detour);
        covers.push(Coverage {
            eta: (to_start[first] + to_end[last]) / direct[last],
            peak: *peak,
            start: share(first),
            end: share(last),
        });
    }
    Ok([covers[0], covers[1]])
}

fn share(i: usize) -> f64 {
    i as f64 / (FEET - 1) as f64
}

fn distances(
    field: &crate::geodesic::Field<'_>,
    points: &[SurfacePoint],
) -> Result<Vec<f64>, GeodesicError> {
    points.iter().map(|point| field.distance(point)).collect()
}

fn position_of_least(values: &[f64]) -> usize {
    let mut least = 0;
    for (i, value) in values.iter().enumerate() {
        if *value < values[least] {
            least = i;
        }
    }
    least
}
