//! The distance maps of a patch from exact geodesics.

use super::{DistanceTable, nodes};
use crate::geodesic::{GeodesicError, Geodesics};
use crate::layout::{Domain, Proof, Side};
use crate::project::model::Family;
use crate::surface::SurfacePoint;

/// Samples a side. Splines through squared distances at these err by 2e-5 of the side length on
/// a tall dome (method notes, section 2), below the noise that triangulation puts on a distance;
/// final members are solved on exact distances.
pub const SAMPLES: usize = 17;

/// The table of exact shortest distances from the start side of a family to its end side, and how
/// many of its pairs are not proved to be shortest on the whole surface.
pub fn distance_table(
    domain: &Domain,
    family: Family,
) -> Result<(DistanceTable, usize), GeodesicError> {
    let mesh = domain.mesh();
    let geodesics = Geodesics::new(mesh);
    let on = |side: &Side| -> Vec<SurfacePoint> {
        nodes(SAMPLES).map(|share| side.at(mesh, share)).collect()
    };
    let (starts, ends) = (on(domain.start(family)), on(domain.end(family)));
    let table = geodesics.table(&starts, &ends)?;
    let row = |i: usize| (0..ends.len()).map(|j| table.pair(i, j).length).collect();
    let rows: Vec<Vec<f64>> = (0..starts.len()).map(row).collect();
    let proof = Proof::new(domain);
    let unproved = starts
        .iter()
        .zip(&rows)
        .flat_map(|(start, row)| ends.iter().zip(row).map(move |(end, d)| (start, end, *d)))
        .filter(|(start, end, distance)| !proof.holds(start, end, *distance))
        .count();
    Ok((DistanceTable::new(&rows), unproved))
}
