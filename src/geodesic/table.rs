//! Tables of shortest distances between two rows of points, and how they are known to be shortest.

use super::certificate::{Certificate, Grounds};
use super::draft::{Cell, Draft};
use super::{Arrival, GeodesicError, Geodesics, Path, Reach};
use crate::surface::SurfacePoint;
use rayon::prelude::*;

/// Shortest distances from each point of one row to each of another, with end directions.
#[derive(Debug, Clone)]
pub struct Table {
    /// Row major: from each of the first row's points to all of the second's.
    pairs: Vec<Arrival>,
    kinds: Vec<Known>,
    columns: usize,
    /// How they are known to be shortest, and what that took.
    pub certificate: Certificate,
}

impl Table {
    /// The shortest path from a point of the first row to one of the second.
    pub fn pair(&self, from: usize, to: usize) -> &Arrival {
        &self.pairs[from * self.columns + to]
    }

    /// How a pair is known.
    pub fn known(&self, from: usize, to: usize) -> Known {
        self.kinds[from * self.columns + to]
    }
}

/// How a pair of a table is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// By the exact solver.
    Exact,
    /// No other geodesic has room beside it, or all that have were compared.
    Proven,
    /// Shortest among its neighbours; none is left so when the table is done.
    Open,
}

impl Geodesics<'_> {
    /// Shortest distances between all pairs of two rows of points, each row in order along a curve,
    /// so that paths of neighbours lie close together.
    ///
    /// # Errors
    /// [`GeodesicError::Coincident`] where a point of one row is one of the other's; else those of
    /// [`Geodesics::field`] and [`Field::path_to`](super::Field::path_to), for the first pair that
    /// has one.
    pub fn table(
        &self,
        from: &[SurfacePoint],
        to: &[SurfacePoint],
    ) -> Result<Table, GeodesicError> {
        if let Some(face) = self.charts.degenerate {
            return Err(GeodesicError::DegenerateFace { face });
        }
        let (from, to) = (self.all_checked(from)?, self.all_checked(to)?);
        // A path back to where it began may be shortest among its neighbours, but is no pair's.
        if let Some(&point) = to.iter().find(|point| from.contains(point)) {
            return Err(GeodesicError::Coincident { point });
        }
        let grounds = self.grounds();
        let draft = Draft::new(self, &from, &to);
        let rows: Vec<Vec<Option<Cell>>> = if grounds == Grounds::Solved {
            vec![vec![None; to.len()]; from.len()]
        } else {
            draft.follow()
        };
        let solved: Vec<(Vec<Cell>, bool)> = rows
            .into_par_iter()
            .enumerate()
            .map(|(i, row)| draft.solve_open(i, row))
            .collect::<Result<_, _>>()?;
        let solves = solved.iter().filter(|row| row.1).count();
        let cells: Vec<Cell> = solved.into_iter().flat_map(|row| row.0).collect();
        let count = |kind: Known| cells.iter().filter(|cell| cell.kind == kind).count();
        Ok(Table {
            certificate: Certificate {
                grounds,
                solves,
                exact: count(Known::Exact),
                proven: count(Known::Proven),
            },
            pairs: cells.iter().map(|cell| cell.arrival).collect(),
            kinds: cells.iter().map(|cell| cell.kind).collect(),
            columns: to.len(),
        })
    }

    /// Exact paths from one point.
    pub(super) fn paths(
        &self,
        from: &SurfacePoint,
        to: &[SurfacePoint],
    ) -> Result<Vec<Path>, GeodesicError> {
        let field = self.field(from, Reach::Targets(to))?;
        to.iter().map(|target| field.path_to(target)).collect()
    }
}
