//! Where shorter paths than those of a row of a table can leave: what is left for the exact solver.

use super::aim::Range;
use super::charts::Charts;
use super::draft::{Cell, Draft};
use super::laid::{Laid, V2, cross, dot, turned};
use super::masses::Masses;
use super::table::Known;
use super::unrolled::Tight;
use super::walk::Walk;

/// Directions of paths are known to this angle, radians.
const PLAY: f64 = 1e-9;

/// Directions farther than this from the middle, radians, are not told apart from all.
const WIDEST: f64 = 1.4;

/// How far on the left and right of a path a shorter one may leave, radians.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room(pub(super) [f64; 2]);

impl Room {
    /// In any direction.
    pub(super) const ANY: Self = Self([f64::INFINITY; 2]);

    /// As much as all curvature of a mesh leaves beside any path, if none of it is rough.
    pub(super) fn of(masses: &Masses) -> Option<Self> {
        masses.all.map(|all| Self([all.curvature; 2]))
    }

    /// The directions that it spans beside a path that a walk has just found, if they can be told
    /// apart from all others.
    pub(super) fn range(self, walk: &Walk<'_>, path: &Tight) -> Option<Range> {
        let Self([left, right]) = self;
        range(walk.faces_around(), path.ahead, [-right, left])
    }
}

/// A range between angles from a direction in the plane of the faces around a point.
fn range(around: Vec<Laid>, ahead: V2, [low, high]: [f64; 2]) -> Option<Range> {
    let ends = [low - PLAY, high + PLAY];
    ends.iter().all(|angle| angle.abs() < WIDEST).then(|| {
        let [low, high] = ends.map(|angle| turned(ahead, angle));
        Range { around, low, high }
    })
}

impl Draft<'_> {
    /// The directions in which paths of a row can leave that are shorter than the open ones: each
    /// keeps within the room beside the open one.
    pub(super) fn range(&self, i: usize, cells: &[Cell]) -> Option<Range> {
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
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for j in (first..=last).filter(open) {
            let Room([left, right]) = cells[j].room;
            let angle = angle(j)?;
            (low, high) = (low.min(angle - right), high.max(angle + left));
        }
        range(around, ahead, [low, high])
    }
}
