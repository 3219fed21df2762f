//! Tables of shortest distances between two rows of points, and how they are known to be shortest.

use super::aim::Range;
use super::certificate::{Certificate, Grounds};
use super::charts::Charts;
use super::heights::{Heights, Trail};
use super::laid::{Laid, cross, dot};
use super::proof::Room;
use super::unrolled::Tight;
use super::walk::Walk;
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

/// Rows and columns of a block whose paths share one bound.
const BLOCK: usize = 4;

/// Paths of a block keep within this share of the distance of their ends from the middle one's.
const TUBE: f64 = 1.15;

/// Blocks that are wider than this share of their paths are no neighbours.
const WIDEST: f64 = 0.06;

/// Points of a path lie on it up to this share of its length.
const ON: f64 = 1e-9;

/// How much steeper paths arrive at a row than others can differ from them: directions of a row are
/// those of its chords.
const IN_FRONT: f64 = 1.1;

/// Directions of paths are known to this angle, radians.
const PLAY: f64 = 1e-9;

/// Directions farther than this from the middle, radians, are not told apart from all.
const WIDEST_RANGE: f64 = 1.4;

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
        let draft = Draft {
            geodesics: self,
            from: &from,
            to: &to,
            straight: grounds == Grounds::Compared && self.is_straight(&to),
        };
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

    /// Whether points lie on the shortest path between the first and the last of them.
    fn is_straight(&self, row: &[SurfacePoint]) -> bool {
        let (Some(first), Some(last)) = (row.first(), row.last()) else {
            return false;
        };
        let Ok(path) = self.shortest(first, last) else {
            return false;
        };
        let line = path.polyline(self.mesh);
        row.iter().all(|point| {
            let at = point.position(self.mesh);
            line.windows(2).any(|piece| {
                let (along, out) = (piece[1] - piece[0], at - piece[0]);
                let share = (out.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                (out - along * share).norm() < ON * path.length
            })
        })
    }

    /// Exact paths from one point.
    fn paths(&self, from: &SurfacePoint, to: &[SurfacePoint]) -> Result<Vec<Path>, GeodesicError> {
        let field = self.field(from, Reach::Targets(to))?;
        to.iter().map(|target| field.path_to(target)).collect()
    }
}

/// A pair.
#[derive(Debug, Clone, Copy)]
struct Cell {
    arrival: Arrival,
    kind: Known,
    /// For a shorter path.
    room: Room,
}

/// A table in the making.
struct Draft<'a> {
    geodesics: &'a Geodesics<'a>,
    from: &'a [SurfacePoint],
    to: &'a [SurfacePoint],
    /// Whether the second row lies on the shortest path between its ends.
    straight: bool,
}

impl<'a> Draft<'a> {
    /// Follows paths from pair to pair; `None` where they are lost.
    fn follow(&self) -> Vec<Vec<Option<Cell>>> {
        let begins = self.begins();
        let blocks: Vec<usize> = (0..self.from.len()).step_by(BLOCK).collect();
        blocks
            .into_par_iter()
            .flat_map_iter(|first| {
                let last = (first + BLOCK).min(self.from.len());
                let bounds = self.bounds(first, last, &begins);
                let row = move |i: usize| (i, bounds.clone());
                (first..last)
                    .map(row)
                    .map(|(i, bounds)| self.row(i, begins[i].as_ref(), &bounds))
                    .collect::<Vec<_>>()
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
    fn walk_to(&self, i: usize, j: usize, known: &Arrival) -> Option<(Walk<'a>, Laid)> {
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
            let heights = walk.bounds.around(&trail, within, masses);
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
        let unique = self.geodesics.grounds() == Grounds::Unique;
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
                _ if unique => Ok(path),
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
    fn solve_open(
        &self,
        i: usize,
        row: Vec<Option<Cell>>,
    ) -> Result<(Vec<Cell>, bool), GeodesicError> {
        let from = &self.from[i];
        let exact = |path: &Path| Cell {
            arrival: Arrival {
                length: path.length,
                start: path.start,
                end: path.end,
            },
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
        let shorter = self.geodesics.shorter(from, &known, range);
        for (j, shorter) in open.into_iter().zip(shorter) {
            match shorter {
                Some(path) => cells[j] = exact(&path),
                None => cells[j].kind = Known::Exact,
            }
        }
        Ok((cells, true))
    }

    /// Whether all paths to a column arrive on one side of the second row that keep within the room
    /// beside a known one.
    fn arrives_in_front(&self, j: usize, cell: &Cell) -> bool {
        if !self.straight {
            return false;
        }
        let at = |j: usize| self.to[j].position(self.geodesics.mesh);
        let along = at((j + 1).min(self.to.len() - 1)) - at(j.saturating_sub(1));
        let cosine = along.normalize().dot(&cell.arrival.end.direction).abs();
        let Room([left, right]) = cell.room;
        libm::acos(cosine.min(1.0)) > IN_FRONT * left.max(right)
    }

    /// The directions in which paths of a row can leave that are shorter than the open ones: each
    /// keeps within the room beside the open one, at both ends. Where the second row is a shortest
    /// path too, and the shorter one arrives on the same side of it, it also keeps between the
    /// proven paths next to it: shortest paths cross neither each other nor the row.
    fn range(&self, i: usize, cells: &[Cell]) -> Option<Range> {
        let open = |j: &usize| cells[*j].kind == Known::Open;
        let first = (0..cells.len()).find(open)?;
        let last = (0..cells.len()).rfind(open)?;
        let middle = usize::midpoint(first, last);
        let (walk, _) = self.walk_to(i, middle, &cells[middle].arrival)?;
        let around = walk.faces_around();
        let ahead = walk.unrolled.image;
        let angle = |j: usize| {
            let start = &cells[j].arrival.start;
            let laid = around.iter().find(|laid| laid.entry.face() == start.face)?;
            let along = Charts::from_space(walk.mesh, laid.entry, &start.direction);
            let direction = laid.in_plane(walk.charts, along);
            Some(libm::atan2(cross(ahead, direction), dot(ahead, direction)))
        };
        let angles: Vec<f64> = (0..cells.len()).map(angle).collect::<Option<_>>()?;
        // Whether paths to later columns leave farther on the left.
        let proven = |j: &usize| cells[*j].kind == Known::Proven;
        let [begin, end] = [
            (0..cells.len()).find(proven),
            (0..cells.len()).rfind(proven),
        ];
        let turn = match (begin, end) {
            (Some(begin), Some(end)) => angles[end] - angles[begin],
            _ => 0.0,
        };
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for j in (first..=last).filter(open) {
            let Room([left, right]) = cells[j].room;
            let (mut lowest, mut highest) = (angles[j] - right, angles[j] + left);
            let before = (0..j).rfind(proven).map(|k| angles[k]);
            let after = (j + 1..cells.len()).find(proven).map(|k| angles[k]);
            let (on_right, on_left) = if turn > 0.0 {
                (before, after)
            } else {
                (after, before)
            };
            if turn != 0.0 && self.arrives_in_front(j, &cells[j]) {
                lowest = on_right.map_or(lowest, |a| a.max(lowest));
                highest = on_left.map_or(highest, |a| a.min(highest));
            }
            (low, high) = (low.min(lowest), high.max(highest));
        }
        let ends = [low - PLAY, high + PLAY];
        ends.iter().all(|a| a.abs() < WIDEST_RANGE).then(|| {
            let [low, high] = ends.map(|angle| {
                let (s, c) = libm::sincos(angle);
                [ahead[0] * c - ahead[1] * s, ahead[0] * s + ahead[1] * c]
            });
            Range { around, low, high }
        })
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
