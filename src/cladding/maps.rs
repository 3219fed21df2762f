//! The distance maps of a patch from exact geodesics.

use super::DistanceTable;
use super::fit::fit;
use crate::geodesic::{GeodesicError, Geodesics};
use crate::layout::{Domain, Proof, Side};
use crate::project::model::Family;
use crate::surface::{Mesh, SurfacePoint};

/// Distances on a polyhedron are smooth but for the angles at its edges, which pass on a hundredth
/// of the square of an edge in the distance: twice that in its square, whatever the distance.
const ROUGHNESS: f64 = 0.02;

/// Pairs of places of which exact distances were taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pairs {
    /// All of them.
    pub all: usize,
    /// Those that are not proved to be shortest on the whole surface.
    pub unproved: usize,
}

/// The table of shortest distances from the start side of a family to its end side, and from how
/// many exact ones it is made.
pub fn distance_table(
    domain: &Domain,
    family: Family,
) -> Result<(DistanceTable, Pairs), GeodesicError> {
    let mesh = domain.mesh();
    let geodesics = Geodesics::new(mesh);
    let proof = Proof::new(domain);
    let mut unproved = 0;
    let sample = |starts: &[f64], ends: &[f64]| -> Result<Vec<Vec<f64>>, GeodesicError> {
        let on = |side: &Side, shares: &[f64]| -> Vec<SurfacePoint> {
            shares.iter().map(|share| side.at(mesh, *share)).collect()
        };
        let (starts, ends) = (
            on(domain.start(family), starts),
            on(domain.end(family), ends),
        );
        let table = geodesics.table(&starts, &ends)?;
        let row = |i: usize| (0..ends.len()).map(|j| table.pair(i, j).length).collect();
        let rows: Vec<Vec<f64>> = (0..starts.len()).map(row).collect();
        unproved += starts
            .iter()
            .zip(&rows)
            .flat_map(|(start, row)| ends.iter().zip(row).map(move |(end, d)| (start, end, *d)))
            .filter(|(start, end, distance)| !proof.holds(start, end, *distance))
            .count();
        Ok(rows)
    };
    let edge = mean_edge(mesh);
    let (table, all) = fit(ROUGHNESS * edge * edge, sample)?;
    Ok((table, Pairs { all, unproved }))
}

fn mean_edge(mesh: &Mesh) -> f64 {
    let (count, sum) = mesh.edges().fold((0.0, 0.0), |(count, sum), edge| {
        (count + 1.0, sum + mesh.edge_vector(edge).norm())
    });
    sum / count
}
