//! Coverage of curvature peaks: can shortest geodesics of a family reach every point around a
//! peak of Gaussian curvature, or do they all pass beside it (paper, section 4.1)?
//!
//! η of a way from one side over the peak to the opposite side is its length, divided by that of
//! the shortest way between its ends. The paper takes the way from the place of the first side
//! that is closest to the peak. On an oblique patch, or with a peak near a corner, no member begins
//! there: the straight way on from it leaves the patch through a neighbouring side. So all pairs of
//! places are tried that a cladding function within the slope bounds can join, and the best one
//! counts. On patches with right angles that is the paper's.

use crate::cladding::DistanceTable;
use crate::geodesic::{GeodesicError, Geodesics, Reach};
use crate::layout::{Domain, Side};
use crate::project::model::Family;
use crate::surface::SurfacePoint;
use serde::{Deserialize, Serialize};

/// Points of a side at which distances are compared. The ratio is stationary in both feet, so a
/// step of 1/64 of the side changes it by less than 1e-4 of its excess.
const FEET: usize = 65;

/// Ways whose η exceeds 1 by less than half of what the paper allows all cover the peak: the
/// straightest of them says where a side over the peak would run.
const COVERED: f64 = 0.5 * 0.0015;
/// What a way from one corner of a patch to the opposite one would cost in η more than one between
/// opposite places: of ways that pass beside the peak, straight ones are looked for first.
const LEAN: f64 = 0.05;

/// Costs that differ by less are equal, as on both sides of an axis of symmetry: the first counts,
/// whatever rounding says.
const TIE: f64 = 1e-9;

/// How a family covers a peak.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Coverage {
    /// η: the way over the peak, divided by the shortest one; 1 when the peak is covered.
    pub eta: f64,
    /// The peak.
    pub peak: SurfacePoint,
    /// Share of the start side at which a side over the peak would begin.
    pub start: f64,
    /// Share of the end side at which it would end.
    pub end: f64,
    /// From there to the peak and from the peak to there, metres.
    pub arms: [f64; 2],
}

/// η of both families at a peak inside the patch: u first. `tables` are the distance maps of the
/// families, `slope` the bounds of cladding functions.
pub fn coverage(
    domain: &Domain,
    geodesics: &Geodesics<'_>,
    peak: &SurfacePoint,
    tables: [&DistanceTable; 2],
    slope: [f64; 2],
) -> Result<[Coverage; 2], GeodesicError> {
    let families = [Family::U, Family::V];
    let feet = |side: &Side| -> Vec<SurfacePoint> {
        (0..FEET)
            .map(|i| side.at(domain.mesh(), share(i)))
            .collect()
    };
    let sides = families.map(|f| (feet(domain.start(f)), feet(domain.end(f))));
    let mut covers = Vec::with_capacity(2);
    for ((start, end), table) in sides.iter().zip(tables) {
        let to = [
            distances(geodesics, peak, start)?,
            distances(geodesics, peak, end)?,
        ];
        let pairs = || {
            (0..FEET)
                .flat_map(|i| (0..FEET).map(move |j| (i, j)))
                .filter(|&(i, j)| may_be_joined(share(i), share(j), slope))
        };
        // The map leads the way; it errs where geodesics jump from one side of the peak to the
        // other, so exact distances from both of its ends have the last word.
        let led = straightest(pairs().map(|(i, j)| {
            let direct = table.distance_squared(share(i), share(j)).0.sqrt();
            (i, j, (to[0][i] + to[1][j]) / direct)
        }));
        let row = distances(geodesics, &start[led.0], end)?;
        let in_row: Vec<Pair> = pairs()
            .filter(|&(i, _)| i == led.0)
            .map(|(i, j)| (i, j, (to[0][i] + to[1][j]) / row[j]))
            .collect();
        let last = straightest(in_row.iter().copied()).1;
        let column = distances(geodesics, &end[last], start)?;
        let in_column: Vec<Pair> = pairs()
            .filter(|&(_, j)| j == last)
            .map(|(i, j)| (i, j, (to[0][i] + to[1][j]) / column[i]))
            .collect();
        let exact = || in_row.iter().chain(&in_column).copied();
        let (i, j, _) = straightest(exact());
        covers.push(Coverage {
            eta: exact()
                .map(|(_, _, eta)| eta)
                .fold(f64::INFINITY, f64::min)
                .max(1.0),
            peak: *peak,
            start: share(i),
            end: share(j),
            arms: [to[0][i], to[1][j]],
        });
    }
    Ok([covers[0], covers[1]])
}

/// Whether an increasing function from (0, 0) to (1, 1) with slopes within the bounds can pass
/// through a pair of shares.
fn may_be_joined(start: f64, end: f64, [low, high]: [f64; 2]) -> bool {
    let least = (low * start).max(1.0 - high * (1.0 - start));
    let most = (high * start).min(1.0 - low * (1.0 - start));
    // Both are 0 at 0 and 1 at 1, up to rounding.
    end >= least - 1e-12 && end <= most + 1e-12
}

/// Places on both sides and η of the way between them.
type Pair = (usize, usize, f64);

/// The straightest of the pairs that cover the peak; one that is straight and covers it well if
/// none does.
fn straightest(pairs: impl Iterator<Item = Pair>) -> Pair {
    let cost = |&(i, j, eta): &Pair| {
        let lean = share(i) - share(j);
        eta.max(1.0 + COVERED) + LEAN * lean * lean
    };
    pairs
        .reduce(|least, next| {
            if cost(&next) < cost(&least) - TIE {
                next
            } else {
                least
            }
        })
        .unwrap_or((0, 0, 1.0))
}

fn share(i: usize) -> f64 {
    i as f64 / (FEET - 1) as f64
}

/// Distances from a point to places along a side.
fn distances(
    geodesics: &Geodesics<'_>,
    from: &SurfacePoint,
    side: &[SurfacePoint],
) -> Result<Vec<f64>, GeodesicError> {
    match geodesics.table(std::slice::from_ref(from), side) {
        Ok(table) => Ok((0..side.len()).map(|i| table.pair(0, i).length).collect()),
        // A field knows how far it is from a point to itself.
        Err(GeodesicError::Coincident { .. }) => {
            let field = geodesics.field(from, Reach::Targets(side))?;
            side.iter().map(|point| field.distance(point)).collect()
        }
        Err(error) => Err(error),
    }
}
