//! Where shorter paths than those of a row of a table can leave: what is left for the exact solver.

use super::aim::Range;
use super::charts::Charts;
use super::draft::{Cell, Draft};
use super::laid::{cross, dot};
use super::table::Known;

/// How much steeper paths arrive at a row than others can differ from them: directions of a row are
/// those of its chords.
const IN_FRONT: f64 = 1.1;

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
}

impl Draft<'_> {
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
        let angles: Vec<f64> = (0..cells.len()).map(angle).collect::<Option<_>>()?;
        // Whether paths to later columns leave farther on the left, where all do or none does.
        let proven = |j: &usize| cells[*j].kind == Known::Proven;
        let mut between = (0..cells.len()).filter(proven).map(|j| angles[j]);
        let mut turns = Vec::with_capacity(cells.len());
        let mut before = between.next();
        for angle in between {
            turns.extend(before.map(|before| angle > before));
            before = Some(angle);
        }
        let leftward = turns.first().copied();
        let leftward = leftward.filter(|first| turns.iter().all(|turn| turn == first));
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for j in (first..=last).filter(open) {
            let Room([left, right]) = cells[j].room;
            let (mut lowest, mut highest) = (angles[j] - right, angles[j] + left);
            let before = (0..j).rfind(proven).map(|k| angles[k]);
            let after = (j + 1..cells.len()).find(proven).map(|k| angles[k]);
            if let Some(leftward) = leftward
                && self.arrives_in_front(j, &cells[j])
            {
                let (on_right, on_left) = if leftward {
                    (before, after)
                } else {
                    (after, before)
                };
                // A path that is open may lie on the wrong side of a proven one.
                lowest = on_right.map_or(lowest, |a| a.max(lowest));
                highest = on_left.map_or(highest, |a| a.min(highest));
            }
            (low, high) = (low.min(lowest), high.max(highest));
        }
        let ends = [low - PLAY, high + PLAY];
        ends.iter().all(|a| a.abs() < WIDEST).then(|| {
            let [low, high] = ends.map(|angle| {
                let (s, c) = libm::sincos(angle);
                [ahead[0] * c - ahead[1] * s, ahead[0] * s + ahead[1] * c]
            });
            Range { around, low, high }
        })
    }
}
