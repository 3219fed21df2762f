//! A table in the making: paths are followed from pair to pair and proven on the way; what is open
//! in the end is solved, a row at a time.

use super::certificate::Grounds;
use super::heights::Heights;
use super::laid::Laid;
use super::room::Room;
use super::table::Known;
use super::trail::Trail;
use super::unrolled::Tight;
use super::walk::Walk;
use super::{Arrival, GeodesicError, Geodesics, Path};
use crate::surface::SurfacePoint;
use rayon::prelude::*;

/// Rows and columns of a block whose paths share one bound.
const BLOCK: usize = 4;

/// Paths of a block keep within this share of the distance of their ends from the middle one's.
const TUBE: f64 = 1.15;

/// Blocks that are wider than this share of their paths are no neighbours.
const WIDEST: f64 = 0.06;

/// A pair.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) arrival: Arrival,
    pub(super) kind: Known,
    /// For a shorter path.
    pub(super) room: Room,
}

/// A table in the making.
pub(super) struct Draft<'a> {
    pub(super) geodesics: &'a Geodesics<'a>,
    pub(super) from: &'a [SurfacePoint],
    pub(super) to: &'a [SurfacePoint],
}

impl<'a> Draft<'a> {
    /// Follows paths from pair to pair; `None` where they are lost.
    pub(super) fn follow(&self) -> Vec<Vec<Option<Cell>>> {
        let begins = self.begins();
        let blocks: Vec<usize> = (0..self.from.len()).step_by(BLOCK).collect();
        blocks
            .into_par_iter()
            .flat_map_iter(|first| {
                let last = (first + BLOCK).min(self.from.len());
                let bounds = self.bounds(first, last, &begins);
                let row = |i: usize| self.row(i, begins[i].as_ref(), &bounds);
                (first..last).map(row).collect::<Vec<_>>()
            })
            .collect()
    }

    /// How paths to the first column leave each row's point.
    fn begins(&self) -> Vec<Option<Arrival>> {
        let mut begins = vec![None; self.from.len()];
        let (Some(first), Some(target)) = (self.from.first(), self.to.first()) else {
            return begins;
        };
        let geodesics = self.geodesics;
        if first == target {
            return begins;
        }
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
    }

    /// A walk from a row's point, and where its path to a column ends that is known.
    pub(super) fn walk_to(&self, i: usize, j: usize, known: &Arrival) -> Option<(Walk<'a>, Laid)> {
        let geodesics = self.geodesics;
        let mut walk = Walk::new(geodesics.mesh, &geodesics.charts, &self.from[i])?;
        let last = walk.shot(&known.start, known.length, self.to.get(j)?)?;
        Some((walk, last))
    }

    /// Per block of columns bounds of other geodesics beside the paths of rows, and the trail near
    /// which these have to keep.
    fn bounds(&self, first: usize, last: usize, begins: &[Option<Arrival>]) -> Vec<Option<Bound>> {
        let blocks = self.to.len().div_ceil(BLOCK);
        let mut bounds = vec![None; blocks];
        if self.geodesics.grounds() == Grounds::Unique {
            return bounds;
        }
        let masses = self.geodesics.masses();
        let mesh = self.geodesics.mesh;
        let middle = usize::midpoint(first, last);
        let Some((mut walk, mut here)) = begins[middle]
            .as_ref()
            .and_then(|begin| self.walk_to(middle, 0, begin))
        else {
            return bounds;
        };
        let far = |points: &[SurfacePoint], from: usize, to: usize, middle: usize| {
            let at = points[middle].position(mesh);
            let far = points[from..to]
                .iter()
                .map(|p| (p.position(mesh) - at).norm());
            far.fold(0.0, f64::max)
        };
        for (block, bound) in bounds.iter_mut().enumerate() {
            let begin = block * BLOCK;
            let end = (begin + BLOCK).min(self.to.len());
            let centre = usize::midpoint(begin, end);
            let mut path = None;
            for j in begin..=centre {
                path = walk.step(&here, &self.to[j]);
                if let Some(tight) = &path {
                    here = tight.last;
                }
            }
            let Some(trail) = path.map(|path| walk.trail(&path, &self.to[centre])) else {
                continue;
            };
            let within = 1e-3 * trail.length
                + TUBE * far(self.from, first, last, middle).max(far(self.to, begin, end, centre));
            if within > WIDEST * trail.length {
                continue;
            }
            let Some(heights) = walk.bounds.around(&trail, within, masses) else {
                continue;
            };
            *bound = Some(Bound {
                trail,
                within,
                heights,
                parts: walk.bounds.parts(),
            });
        }
        bounds
    }

    /// The pairs of a row.
    fn row(
        &self,
        i: usize,
        begin: Option<&Arrival>,
        bounds: &[Option<Bound>],
    ) -> Vec<Option<Cell>> {
        let mut cells = vec![None; self.to.len()];
        let begin = begin.and_then(|begin| self.walk_to(i, 0, begin));
        let Some((mut walk, mut last)) = begin else {
            return cells;
        };
        for (j, cell) in cells.iter_mut().enumerate() {
            let target = &self.to[j];
            let Some(path) = walk.step(&last, target) else {
                continue;
            };
            let alone =
                |walk: &mut Walk<'a>, among| self.geodesics.prove(walk, &path, target, among);
            let proven = match &bounds[j / BLOCK] {
                None => alone(&mut walk, None),
                Some(bound) if !bound.holds(&walk, &path) => alone(&mut walk, None),
                // Bounds of a block are wider than those of a path.
                Some(bound) => walk
                    .proven(&path, target, &bound.heights)
                    .or_else(|_| alone(&mut walk, Some(&bound.parts))),
            };
            let (path, kind, room) = match proven {
                Ok(path) => (path, Known::Proven, Room([0.0; 2])),
                Err(room) => (path, Known::Open, room),
            };
            last = path.last;
            *cell = Some(Cell {
                arrival: path.arrival(),
                kind,
                room,
            });
        }
        cells
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

/// Bounds of other geodesics that hold near a trail.
#[derive(Debug, Clone)]
struct Bound {
    trail: Trail,
    /// Metres.
    within: f64,
    heights: [Heights; 2],
    /// The only fine cells with curvature that another geodesic can enclose.
    parts: Vec<usize>,
}

impl Bound {
    /// Whether it holds for the path that was found last.
    fn holds(&self, walk: &Walk<'_>, path: &Tight) -> bool {
        let longer = (path.length - self.trail.length).abs();
        longer <= 2.0 * self.within && walk.strays(path, &self.trail) <= self.within
    }
}
