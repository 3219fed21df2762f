//! Locally shortest paths from strips: a strip is pulled tight and turned to the other side of
//! every vertex round which the path bends without need, until nothing bends that need not.
//!
//! The way round the other side of such a vertex is strictly shorter, so lengths fall from turn to
//! turn; where rounding says otherwise the last shorter strip is kept. Nothing can go on for ever.

use super::charts::Charts;
use super::funnel::Bend;
use super::laid::{Laid, Side, cross, dot, sub};
use super::path::{Leg, Path};
use super::unrolled::{Strip, Unrolled};
use crate::surface::{HalfEdge, Mesh, SurfacePoint};
use std::f64::consts::PI;

/// Lengths that agree to this share are equal: rounding over a few hundred faces.
pub(super) const EQUAL: f64 = 1e-14;

/// A vertex is passed on its narrower side if the path bends there by more than this, radians. The
/// bend lengthens the path by its square.
const BENT: f64 = 1e-10;

/// A bend that does not go away and misses the half turn by more, radians, is no tie but a fault.
const TIE: f64 = 1e-6;

/// Turns of one strip; paths that need more are left to the exact solver.
pub(super) const MOST_TURNS: usize = 400;

/// Turns of a strip that leads to a path beside the one before, and not to another branch.
pub(super) const FEW_TURNS: usize = 24;

/// Pulls strips tight; keeps what it allocates.
pub(super) struct Relaxer<'a> {
    mesh: &'a Mesh,
    charts: &'a Charts,
    kept: Vec<HalfEdge>,
}

impl<'a> Relaxer<'a> {
    pub(super) fn new(mesh: &'a Mesh, charts: &'a Charts) -> Self {
        Self {
            mesh,
            charts,
            kept: Vec::new(),
        }
    }

    /// Turns a strip until its tight path is locally shortest, and leaves it laid flat; `None` where
    /// that takes more turns than wanted.
    pub(super) fn relax(
        &mut self,
        from: (&SurfacePoint, &Laid),
        strip: &mut Strip,
        to: &SurfacePoint,
        unrolled: &mut Unrolled,
        most: usize,
    ) -> Option<()> {
        let surface = (self.mesh, self.charts);
        let mut shortest = f64::INFINITY;
        for _ in 0..most {
            self.tidy(from.0, strip, to);
            let found = unrolled.lay(surface, from, strip, to)?;
            if found >= shortest * (1.0 - EQUAL) {
                // A tie up to rounding: the strip before is as good.
                strip.through.clone_from(&self.kept);
                self.tidy(from.0, strip, to);
                unrolled.lay(surface, from, strip, to)?;
                let bends = 0..unrolled.bends.len();
                let needless =
                    |i: usize| self.other_side(unrolled, i).is_some_and(|a| a < PI - TIE);
                return (!bends.into_iter().any(needless)).then_some(());
            }
            shortest = found;
            self.kept.clone_from(&strip.through);
            if !self.turn(strip, unrolled) {
                return Some(());
            }
        }
        None
    }

    /// The whole path through a strip that was relaxed and laid flat.
    pub(super) fn path(
        &self,
        from: &SurfacePoint,
        strip: &Strip,
        to: &SurfacePoint,
        unrolled: &Unrolled,
    ) -> Option<Path> {
        let through = &strip.through;
        let mut legs = Vec::with_capacity(unrolled.bends.len() + 1);
        let (mut begin, mut next, mut face) = (*from, 0, strip.face);
        for bend in &unrolled.bends {
            let (first, last) = self.range_at(unrolled, bend.gate, bend.side);
            let vertex = unrolled.faces[bend.gate].vertex(self.mesh, bend.side);
            let end = SurfacePoint::Vertex(vertex);
            legs.push(Leg {
                from: begin,
                through: through[next.min(first)..first].to_vec(),
                to: end,
                face: if next > first {
                    through[next - 1].face()
                } else {
                    face
                },
            });
            (begin, next) = (end, last + 1);
            face = self.mesh.twin(through[last])?.face();
        }
        legs.push(Leg {
            from: begin,
            through: through[next..].to_vec(),
            to: *to,
            face,
        });
        Path::through(self.mesh, self.charts, &legs)
    }

    /// Drops steps back, and what lies before the begin and behind the end.
    fn tidy(&self, from: &SurfacePoint, strip: &mut Strip, to: &SurfacePoint) {
        let mesh = self.mesh;
        let through = &mut strip.through;
        let mut kept = 0;
        for i in 0..through.len() {
            let h = through[i];
            if kept > 0 && mesh.twin(through[kept - 1]) == Some(h) {
                kept -= 1;
                strip.face = h.face();
                // The face before the step back is the one after it.
                if kept == 0 {
                    strip.face = mesh.twin(h).map_or(h.face(), HalfEdge::face);
                }
            } else {
                through[kept] = h;
                kept += 1;
            }
        }
        through.truncate(kept);
        let touches = |point: &SurfacePoint, h: HalfEdge| match *point {
            SurfacePoint::Vertex(v) => mesh.origin(h) == v || mesh.target(h) == v,
            SurfacePoint::Edge { half_edge, .. } => {
                h == half_edge || mesh.twin(h) == Some(half_edge)
            }
            SurfacePoint::Face { .. } => false,
        };
        if let Some(last) = through.iter().rposition(|&h| touches(from, h)) {
            strip.face = mesh.twin(through[last]).map_or(strip.face, HalfEdge::face);
            through.drain(..=last);
        }
        if let Some(first) = through.iter().position(|&h| touches(to, h)) {
            strip.face = through[first].face();
            through.truncate(first);
        }
        if let Some(first) = through.first() {
            strip.face = first.face();
        }
    }

    /// The angle of a bend on the other side of its vertex, radians; none at the border.
    fn other_side(&self, flat: &Unrolled, bend: usize) -> Option<f64> {
        let Bend { gate, side, at } = flat.bends[bend];
        let v = flat.faces[gate].vertex(self.mesh, side);
        if self.mesh.is_border_vertex(v) {
            return None;
        }
        let before = if bend > 0 {
            flat.bends[bend - 1].at
        } else {
            [0.0; 2]
        };
        let after = flat.bends.get(bend + 1).map_or(flat.image, |b| b.at);
        let (come, go) = (sub(at, before), sub(after, at));
        // Towards the vertex; round a saddle by more than half a turn.
        let towards = match side {
            Side::Left => cross(come, go),
            Side::Right => -cross(come, go),
        };
        let turn = libm::atan2(towards, dot(come, go));
        let turn = if turn < -BENT { turn + 2.0 * PI } else { turn };
        Some(self.charts.total_angles[v as usize] - (PI + turn))
    }

    /// Passes the vertices of needless bends on their other sides; whether there were any.
    fn turn(&self, strip: &mut Strip, flat: &Unrolled) -> bool {
        let mut turned = false;
        let mut free = usize::MAX;
        for i in (0..flat.bends.len()).rev() {
            let Bend { gate, side, .. } = flat.bends[i];
            if self
                .other_side(flat, i)
                .is_none_or(|angle| angle >= PI - BENT)
            {
                continue;
            }
            let range = self.range_at(flat, gate, side);
            if range.1 >= free {
                continue;
            }
            if self.pass_other_side(&mut strip.through, range, side) {
                turned = true;
                free = range.0;
            }
        }
        turned
    }

    /// Replaces the gates that end at a vertex on one side of the path by those on its other side.
    fn pass_other_side(
        &self,
        through: &mut Vec<HalfEdge>,
        (first, last): (usize, usize),
        side: Side,
    ) -> bool {
        let mesh = self.mesh;
        let Some(end) = mesh.twin(through[last]).map(HalfEdge::face) else {
            return false;
        };
        let mut round = Vec::new();
        // The half-edge that leaves the vertex in the current face.
        let mut spoke = match side {
            Side::Left => through[first].next(),
            Side::Right => through[first],
        };
        while spoke.face() != end {
            let exit = match side {
                Side::Left => spoke,
                Side::Right => spoke.prev(),
            };
            let Some(twin) = mesh.twin(exit) else {
                return false;
            };
            round.push(exit);
            spoke = match side {
                Side::Left => twin.next(),
                Side::Right => twin,
            };
            if round.len() > mesh.faces().len() {
                return false;
            }
        }
        through.splice(first..=last, round);
        true
    }

    /// The neighbouring gates that end at the same vertex.
    fn range_at(&self, flat: &Unrolled, gate: usize, side: Side) -> (usize, usize) {
        let vertex = |i: usize| flat.faces[i].vertex(self.mesh, side);
        let v = vertex(gate);
        let same = |i: &usize| vertex(*i) == v;
        let first = (0..gate).rev().take_while(same).last().unwrap_or(gate);
        let last = (gate + 1..flat.faces.len())
            .take_while(same)
            .last()
            .unwrap_or(gate);
        (first, last)
    }
}

/// A face around a point in the plane of `base`.
pub(super) fn face_at(
    mesh: &Mesh,
    charts: &Charts,
    point: &SurfacePoint,
    base: &Laid,
    face: u32,
) -> Option<Laid> {
    let mut laid = *base;
    match *point {
        SurfacePoint::Face { .. } => {}
        SurfacePoint::Edge { .. } => {
            if laid.entry.face() != face {
                laid = laid.across(mesh, charts, laid.entry)?;
            }
        }
        SurfacePoint::Vertex(v) => {
            // Counter-clockwise from the base, which is the first around a border vertex.
            let faces = mesh.outgoing(v).count();
            let mut spoke = laid.entry;
            for _ in 0..faces {
                if spoke.face() == face {
                    break;
                }
                laid = laid.across(mesh, charts, spoke.prev())?;
                spoke = laid.entry;
            }
        }
    }
    (laid.entry.face() == face).then_some(laid)
}
