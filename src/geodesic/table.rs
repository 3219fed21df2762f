//! Tables of shortest distances between two rows of points, and how they are known to be shortest.

use super::certificate::{Certificate, Grounds, exact_rows};
use super::walk::Walk;
use super::{Arrival, GeodesicError, Geodesics, Path, Reach, SAME};
use crate::surface::{SurfacePoint, Tangent};
use rayon::prelude::*;
use std::collections::BTreeSet;

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
    /// All solved neighbours lead to the same path.
    Agreed,
    /// They lead to different paths, of which this is the shortest so far; none is so when the
    /// table is done.
    Chosen,
}

impl Geodesics<'_> {
    /// Shortest distances between all pairs of two rows of points, each row in order along a curve,
    /// so that paths of neighbours lie close together.
    ///
    /// # Errors
    /// Those of [`Geodesics::field`] and [`Field::path_to`](super::Field::path_to), for the first
    /// pair that has one; so a point of one row may not be one of the other's.
    pub fn table(
        &self,
        from: &[SurfacePoint],
        to: &[SurfacePoint],
    ) -> Result<Table, GeodesicError> {
        if let Some(face) = self.charts.degenerate {
            return Err(GeodesicError::DegenerateFace { face });
        }
        let (from, to) = (self.all_checked(from)?, self.all_checked(to)?);
        let grounds = self.grounds();
        let rows = exact_rows(from.len(), grounds);
        let solved: Vec<Vec<Path>> = rows
            .par_iter()
            .map(|&row| self.paths(&from[row], &to))
            .collect::<Result<_, _>>()?;
        let mut columns: Vec<Vec<Option<Cell>>> = (0..to.len())
            .into_par_iter()
            .map(|j| {
                let seeds = rows.iter().zip(&solved);
                let seeds: Vec<_> = seeds.map(|(&row, paths)| (row, &paths[j])).collect();
                self.column(&from, &to[j], &seeds)
            })
            .collect();
        let mut solves = rows.len();
        let mut cells = Vec::with_capacity(from.len() * to.len());
        for (i, source) in from.iter().enumerate() {
            let open: Vec<usize> = (0..to.len()).filter(|&j| columns[j][i].is_none()).collect();
            if !open.is_empty() {
                solves += 1;
                let targets: Vec<SurfacePoint> = open.iter().map(|&j| to[j]).collect();
                for (j, path) in open.into_iter().zip(self.paths(source, &targets)?) {
                    columns[j][i] = Some(Cell {
                        arrival: arrival(&path),
                        kind: Known::Exact,
                    });
                }
            }
            cells.extend(columns.iter().filter_map(|column| column[i]));
        }
        let mut table = Draft {
            geodesics: self,
            from: &from,
            to: &to,
            cells,
        };
        if grounds == Grounds::Bracketed {
            table.exchange_branches();
            solves += table.verify_chosen();
        }
        let count = |kind: Known| table.cells.iter().filter(|cell| cell.kind == kind).count();
        Ok(Table {
            certificate: Certificate {
                grounds,
                solves,
                exact: count(Known::Exact),
                agreed: count(Known::Agreed),
            },
            pairs: table.cells.iter().map(|cell| cell.arrival).collect(),
            kinds: table.cells.iter().map(|cell| cell.kind).collect(),
            columns: to.len(),
        })
    }

    /// Exact paths from one point.
    fn paths(&self, from: &SurfacePoint, to: &[SurfacePoint]) -> Result<Vec<Path>, GeodesicError> {
        let field = self.field(from, Reach::Targets(to))?;
        to.iter().map(|target| field.path_to(target)).collect()
    }

    /// Paths from all points of a row to a target, followed from the solved ones to those between
    /// them, from both sides; `None` where that fails.
    fn column(
        &self,
        row: &[SurfacePoint],
        target: &SurfacePoint,
        seeds: &[(usize, &Path)],
    ) -> Vec<Option<Cell>> {
        let mut cells = vec![None; row.len()];
        for &(i, path) in seeds {
            cells[i] = Some(Cell {
                arrival: arrival(path),
                kind: Known::Exact,
            });
        }
        let Some(mut walk) = Walk::new(self.mesh, &self.charts, target) else {
            return cells;
        };
        for (k, &(i, path)) in seeds.iter().enumerate() {
            let Some(begin) = walk.take_up(path) else {
                continue;
            };
            let mut follow = |steps: &mut dyn Iterator<Item = usize>| {
                let mut last = begin;
                for i in steps {
                    let Some(tight) = walk.step(&last, &row[i]) else {
                        return;
                    };
                    last = tight.last;
                    let found = tight.arrival_reversed();
                    let mut cell = match cells[i] {
                        None => Cell {
                            arrival: found,
                            kind: Known::Agreed,
                        },
                        Some(known) => known.or(found),
                    };
                    if tight.doubtful {
                        cell.kind = Known::Chosen;
                    }
                    cells[i] = Some(cell);
                }
            };
            let next = seeds.get(k + 1).map_or(row.len(), |seed| seed.0);
            let previous = if k > 0 { seeds[k - 1].0 + 1 } else { 0 };
            follow(&mut (i + 1..next));
            follow(&mut (previous..i).rev());
        }
        cells
    }
}

/// A pair.
#[derive(Debug, Clone, Copy)]
struct Cell {
    arrival: Arrival,
    kind: Known,
}

impl Cell {
    /// With another path for the same pair.
    fn or(self, found: Arrival) -> Self {
        let difference = found.length - self.arrival.length;
        if difference.abs() <= SAME * found.length {
            return self;
        }
        Self {
            arrival: if difference < 0.0 {
                found
            } else {
                self.arrival
            },
            kind: Known::Chosen,
        }
    }
}

/// A table that may get shorter.
struct Draft<'a> {
    geodesics: &'a Geodesics<'a>,
    from: &'a [SurfacePoint],
    to: &'a [SurfacePoint],
    cells: Vec<Cell>,
}

impl Draft<'_> {
    /// Where pairs have several branches, tries those of all neighbours on each, until none gets
    /// shorter.
    fn exchange_branches(&mut self) {
        let (rows, columns) = (self.from.len(), self.to.len());
        let around = move |cell: usize| {
            let (i, j) = (cell / columns, cell % columns);
            let up = (i > 0).then(|| cell - columns);
            let down = (i + 1 < rows).then(|| cell + columns);
            let left = (j > 0).then(|| cell - 1);
            let right = (j + 1 < columns).then(|| cell + 1);
            [up, down, left, right].into_iter().flatten()
        };
        let mut waiting: BTreeSet<usize> = (0..self.cells.len())
            .filter(|&cell| self.cells[cell].kind == Known::Chosen)
            .flat_map(|cell| around(cell).chain([cell]))
            .collect();
        while let Some(cell) = waiting.pop_first() {
            if self.cells[cell].kind == Known::Exact {
                continue;
            }
            for neighbour in around(cell) {
                let Some(found) = self.branch_of(neighbour, cell) else {
                    continue;
                };
                let better = self.cells[cell].or(found);
                if better.arrival.length < self.cells[cell].arrival.length {
                    self.cells[cell] = better;
                    waiting.extend(around(cell));
                }
            }
        }
    }

    /// Looks for shorter paths where there are several branches, with the exact solver and only
    /// where these could be; how many solves that took.
    fn verify_chosen(&mut self) -> usize {
        let columns = self.to.len();
        let chosen = |row: &[Cell]| row.iter().any(|cell| cell.kind == Known::Chosen);
        let rows: Vec<usize> = (0..self.from.len())
            .filter(|i| chosen(&self.cells[i * columns..(i + 1) * columns]))
            .collect();
        let verified: Vec<Vec<(usize, Option<Path>)>> = rows
            .par_iter()
            .map(|&i| {
                let open: Vec<usize> = (i * columns..(i + 1) * columns)
                    .filter(|&cell| self.cells[cell].kind == Known::Chosen)
                    .collect();
                let known: Vec<(SurfacePoint, f64)> = open
                    .iter()
                    .map(|&cell| (self.to[cell % columns], self.cells[cell].arrival.length))
                    .collect();
                let shorter = self.geodesics.shorter(&self.from[i], &known);
                open.into_iter().zip(shorter).collect()
            })
            .collect();
        for (cell, shorter) in verified.into_iter().flatten() {
            self.cells[cell].kind = Known::Exact;
            if let Some(path) = shorter {
                self.cells[cell].arrival = arrival(&path);
            }
        }
        rows.len()
    }

    /// The path of a neighbouring pair, followed to a pair.
    fn branch_of(&self, neighbour: usize, cell: usize) -> Option<Arrival> {
        let (mesh, charts) = (self.geodesics.mesh, &self.geodesics.charts);
        let known = &self.cells[neighbour].arrival;
        let columns = self.to.len();
        let place = |cell: usize| (&self.from[cell / columns], &self.to[cell % columns]);
        let ((near_from, near_to), (from, to)) = (place(neighbour), place(cell));
        if neighbour / columns == cell / columns {
            let mut walk = Walk::new(mesh, charts, from)?;
            let tight = walk.leap(&known.start, known.length, near_to, to)?;
            Some(tight.arrival())
        } else {
            let back = Tangent {
                face: known.end.face,
                direction: -known.end.direction,
            };
            let mut walk = Walk::new(mesh, charts, to)?;
            let tight = walk.leap(&back, known.length, near_from, from)?;
            Some(tight.arrival_reversed())
        }
    }
}

fn arrival(path: &Path) -> Arrival {
    Arrival {
        length: path.length,
        start: path.start,
        end: path.end,
    }
}
