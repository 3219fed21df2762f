//! A table in the making: paths are followed from pair to pair and proven on the way; what is open
//! in the end is solved, a row at a time.

use super::blocks::{BLOCK, Blocks, Bound};
use super::laid::Laid;
use super::room::Room;
use super::table::Known;
use super::unrolled::Tight;
use super::walk::Walk;
use super::{Arrival, GeodesicError, Geodesics, Path};
use crate::surface::SurfacePoint;
use rayon::prelude::*;
use std::sync::OnceLock;

/// A pair.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) arrival: Arrival,
    pub(super) kind: Known,
    /// For a shorter path.
    pub(super) room: Room,
}

impl Cell {
    /// Of a path that is proven to be the shortest.
    pub(super) fn proven(path: &Tight) -> Self {
        Self {
            arrival: path.arrival(),
            kind: Known::Proven,
            room: Room([0.0; 2]),
        }
    }

    /// What two branches tell of a pair that the first does not prove.
    fn or(self, other: Self) -> Self {
        let longer = other.arrival.length >= self.arrival.length;
        if other.kind == Known::Open && longer {
            self
        } else {
            other
        }
    }
}

/// An end of the row of columns.
#[derive(Debug, Clone, Copy)]
pub(super) enum End {
    First,
    Last,
}

/// A table in the making.
pub(super) struct Draft<'a> {
    pub(super) geodesics: &'a Geodesics<'a>,
    pub(super) from: &'a [SurfacePoint],
    pub(super) to: &'a [SurfacePoint],
    begins: [OnceLock<Vec<Option<Arrival>>>; 2],
}

impl<'a> Draft<'a> {
    /// Of all pairs of two rows of checked points.
    pub(super) fn new(
        geodesics: &'a Geodesics<'a>,
        from: &'a [SurfacePoint],
        to: &'a [SurfacePoint],
    ) -> Self {
        Self {
            geodesics,
            from,
            to,
            begins: Default::default(),
        }
    }

    /// Follows paths from pair to pair; `None` where they are lost.
    pub(super) fn follow(&self) -> Vec<Vec<Option<Cell>>> {
        let begins: Vec<usize> = (0..self.from.len()).step_by(BLOCK).collect();
        begins
            .into_par_iter()
            .flat_map_iter(|first| {
                let last = (first + BLOCK).min(self.from.len());
                let blocks = Blocks::new(self, first..last);
                (first..last)
                    .map(|i| self.row(i, &blocks))
                    .collect::<Vec<_>>()
            })
            .collect()
    }

    /// How paths to the first or the last column leave each row's point.
    pub(super) fn begins(&self, end: End) -> &[Option<Arrival>] {
        self.begins[end as usize].get_or_init(|| {
            let target = match end {
                End::First => self.to.first(),
                End::Last => self.to.last(),
            };
            let mut begins = vec![None; self.from.len()];
            let (Some(first), Some(target)) = (self.from.first(), target) else {
                return begins;
            };
            let geodesics = self.geodesics;
            let path = geodesics.near_path(first, target);
            let walk = Walk::new(geodesics.mesh, &geodesics.charts, target);
            let (Some((path, _)), Some(mut walk)) = (path, walk) else {
                return begins;
            };
            let mut last = walk.take_up(&path);
            for (begin, source) in begins.iter_mut().zip(self.from) {
                let Some(here) = last else { break };
                if let Some(tight) = walk.step(&here, source) {
                    *begin = Some(tight.arrival_reversed());
                    last = Some(tight.last);
                }
            }
            begins
        })
    }

    /// A walk from a row's point, and where its path to a column ends that is known.
    pub(super) fn walk_to(&self, i: usize, j: usize, known: &Arrival) -> Option<(Walk<'a>, Laid)> {
        let geodesics = self.geodesics;
        let mut walk = Walk::new(geodesics.mesh, &geodesics.charts, &self.from[i])?;
        let last = walk.shot(&known.start, known.length, self.to.get(j)?)?;
        Some((walk, last))
    }

    /// The pairs of a row: followed from its first column, and where paths are not proven to be
    /// the shortest also from its last, since another branch may lead there.
    fn row(&self, i: usize, blocks: &Blocks<'_, 'a>) -> Vec<Option<Cell>> {
        let count = self.to.len();
        let mut row = vec![None; count];
        self.pass(i, 0..count, End::First, blocks, &mut row);
        let open = |cell: &Option<Cell>| cell.is_none_or(|cell| cell.kind == Known::Open);
        if let Some(first) = row.iter().position(open) {
            self.pass(i, (first..count).rev(), End::Last, blocks, &mut row);
        }
        self.bridge(i, blocks, &mut row);
        row
    }

    /// Follows a branch over columns as far as it leads, and notes its paths where they are shorter
    /// than what is known.
    fn pass(
        &self,
        i: usize,
        columns: impl Iterator<Item = usize>,
        end: End,
        blocks: &Blocks<'_, 'a>,
        row: &mut [Option<Cell>],
    ) {
        let first = match end {
            End::First => 0,
            End::Last => row.len() - 1,
        };
        let begin = self.begins(end)[i].as_ref();
        let begin = begin.and_then(|begin| self.walk_to(i, first, begin));
        let Some((mut walk, mut last)) = begin else {
            return;
        };
        let mut trusted = true;
        for j in columns {
            let Some(path) = walk.step_on(&last, &self.to[j]) else {
                break;
            };
            last = path.last;
            let known = row[j];
            if known.is_some_and(|cell| cell.kind != Known::Open) {
                continue;
            }
            let (cell, end) = self.cell(&mut walk, &path, j, blocks, trusted);
            trusted = cell.kind == Known::Proven;
            last = end;
            row[j] = Some(known.map_or(cell, |known| known.or(cell)));
        }
    }

    /// Follows paths over the columns that no branch has led to.
    fn bridge(&self, i: usize, blocks: &Blocks<'_, 'a>, row: &mut [Option<Cell>]) {
        let mut known: Option<(Walk<'a>, Laid)> = None;
        for j in 1..row.len() {
            if row[j].is_some() {
                known = None;
                continue;
            }
            if known.is_none() {
                known = row[j - 1].and_then(|cell| self.walk_to(i, j - 1, &cell.arrival));
            }
            let Some((walk, last)) = &mut known else {
                continue;
            };
            let Some(path) = walk.step(last, &self.to[j]) else {
                continue;
            };
            let (cell, end) = self.cell(walk, &path, j, blocks, true);
            *last = end;
            row[j] = Some(cell);
        }
    }

    /// A pair whose path was just found, and where it ends in the plane; if not `trusted`, a proof
    /// is unlikely and only tried where it costs little.
    fn cell(
        &self,
        walk: &mut Walk<'a>,
        path: &Tight,
        j: usize,
        blocks: &Blocks<'_, 'a>,
        trusted: bool,
    ) -> (Cell, Laid) {
        let target = &self.to[j];
        let known = self.geodesics.prove_at_once(walk, path, target);
        let proven =
            known.unwrap_or_else(|| self.beside(walk, path, target, blocks.of(j), trusted));
        match proven {
            Ok(path) => (Cell::proven(&path), path.last),
            Err(room) => {
                let cell = Cell {
                    arrival: path.arrival(),
                    kind: Known::Open,
                    room,
                };
                (cell, path.last)
            }
        }
    }

    /// A proof by the curvature near a path or near its block.
    fn beside(
        &self,
        walk: &mut Walk<'a>,
        path: &Tight,
        target: &SurfacePoint,
        bound: Option<&Bound>,
        trusted: bool,
    ) -> Result<Tight, Room> {
        let geodesics = self.geodesics;
        match bound.filter(|bound| bound.holds(walk, path)) {
            None if !trusted && let Some(room) = Room::of(geodesics.masses()) => Err(room),
            None => geodesics.prove_beside(walk, path, target, None),
            // Bounds of a block are wider than those of a path.
            Some(bound) => match walk.proven(path, target, &bound.heights) {
                Err(_) if trusted => {
                    geodesics.prove_beside(walk, path, target, bound.parts.as_deref())
                }
                proven => proven,
            },
        }
    }

    /// Solves the pairs of a row that are not proven; whether there were any.
    pub(super) fn solve_open(
        &self,
        i: usize,
        row: Vec<Option<Cell>>,
    ) -> Result<(Vec<Cell>, bool), GeodesicError> {
        let from = &self.from[i];
        let exact = |path: &Path| Cell {
            arrival: Arrival::of(path),
            kind: Known::Exact,
            room: Room([0.0; 2]),
        };
        if row.iter().any(Option::is_none) {
            let lost: Vec<SurfacePoint> = (0..row.len())
                .filter(|&j| row[j].is_none_or(|cell| cell.kind == Known::Open))
                .map(|j| self.to[j])
                .collect();
            let mut paths = self.geodesics.paths(from, &lost)?.into_iter();
            let cells = row.into_iter().filter_map(|cell| match cell {
                Some(cell) if cell.kind != Known::Open => Some(cell),
                _ => paths.next().as_ref().map(exact),
            });
            return Ok((cells.collect(), true));
        }
        let mut cells: Vec<Cell> = row.into_iter().flatten().collect();
        let open: Vec<usize> = (0..cells.len())
            .filter(|&j| cells[j].kind == Known::Open)
            .collect();
        if open.is_empty() {
            return Ok((cells, false));
        }
        let known: Vec<(SurfacePoint, f64)> = open
            .iter()
            .map(|&j| (self.to[j], cells[j].arrival.length))
            .collect();
        let range = self.range(i, &cells);
        let shorter = self.geodesics.shorter(from, &known, range)?;
        for (j, shorter) in open.into_iter().zip(shorter) {
            match shorter {
                Some(path) => cells[j] = exact(&path),
                None => cells[j].kind = Known::Exact,
            }
        }
        Ok((cells, true))
    }
}
