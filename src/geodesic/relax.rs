//! Locally shortest paths from strips: a strip is pulled tight and turned to the other side of
//! every vertex round which the path bends without need, until nothing bends that need not.
//!
//! The way round the other side of such a vertex is strictly shorter, so lengths fall from turn to
//! turn; where rounding says otherwise the last shorter strip is kept. Nothing can go on for ever.

use super::charts::Charts;
use super::funnel::{Bend, Gate, Side, length, pull};
use super::laid::{Laid, V2, cross, dot, norm, sub};
use super::path::{Leg, Path};
use super::shoot::Strip;
use crate::surface::{HalfEdge, Mesh, SurfacePoint, Tangent};
use std::f64::consts::PI;

/// Lengths that agree to this share are equal: rounding over a few hundred faces.
pub(super) const EQUAL: f64 = 1e-14;

/// A vertex is passed on its narrower side if the path bends there by more than this, radians. The
/// bend lengthens the path by its square.
const BENT: f64 = 1e-10;

/// Turns of one strip; paths that need more are left to the exact solver.
const MOST_TURNS: usize = 400;

/// A locally shortest path in its strip.
#[derive(Debug, Clone)]
pub(super) struct Tight {
    /// Metres.
    pub(super) length: f64,
    /// Direction at the begin.
    pub(super) start: Tangent,
    /// Direction at the end, pointing onward.
    pub(super) end: Tangent,
    /// The last face in the plane of the strip, its begin at the origin.
    pub(super) last: Laid,
    /// The end in this plane.
    pub(super) image: V2,
    /// Where the straight line that leaves with the path would end.
    pub(super) ahead: V2,
    /// Whether a branch that promised to be shorter was not found so.
    pub(super) doubtful: bool,
}

/// Pulls strips tight; keeps what it allocates.
pub(super) struct Relaxer<'a> {
    mesh: &'a Mesh,
    charts: &'a Charts,
    gates: Vec<Gate>,
    bends: Vec<Bend>,
    kept: Vec<HalfEdge>,
    faces: Vec<Laid>,
}

/// A strip laid flat.
struct Flat {
    first: Laid,
    last: Laid,
    image: V2,
}

impl<'a> Relaxer<'a> {
    pub(super) fn new(mesh: &'a Mesh, charts: &'a Charts) -> Self {
        Self {
            mesh,
            charts,
            gates: Vec::new(),
            bends: Vec::new(),
            kept: Vec::new(),
            faces: Vec::new(),
        }
    }

    /// Turns a strip until its tight path is locally shortest.
    pub(super) fn relax(
        &mut self,
        from: &SurfacePoint,
        base: &Laid,
        strip: &mut Strip,
        to: &SurfacePoint,
    ) -> Option<Tight> {
        let mut shortest = f64::INFINITY;
        for _ in 0..MOST_TURNS {
            self.tidy(from, strip, to);
            let flat = self.lay(from, base, strip, to)?;
            pull(&self.gates, flat.image, &mut self.bends);
            let found = length(&self.bends, flat.image);
            if found >= shortest * (1.0 - EQUAL) {
                // A tie up to rounding: the strip before is as good.
                strip.through.clone_from(&self.kept);
                self.tidy(from, strip, to);
                let flat = self.lay(from, base, strip, to)?;
                pull(&self.gates, flat.image, &mut self.bends);
                return self.tight(&flat);
            }
            shortest = found;
            self.kept.clone_from(&strip.through);
            if !self.turn(strip, &flat) {
                return self.tight(&flat);
            }
        }
        None
    }

    /// The whole path through the strip that was relaxed last.
    pub(super) fn path(
        &mut self,
        from: &SurfacePoint,
        base: &Laid,
        strip: &Strip,
        to: &SurfacePoint,
    ) -> Option<Path> {
        let flat = self.lay(from, base, strip, to)?;
        pull(&self.gates, flat.image, &mut self.bends);
        let through = &strip.through;
        let mut legs = Vec::with_capacity(self.bends.len() + 1);
        let (mut begin, mut next, mut face) = (*from, 0, strip.face);
        for bend in &self.bends {
            let (first, last) = range_at(&self.gates, bend.gate, bend.side);
            let end = SurfacePoint::Vertex(self.gates[bend.gate].vertex(bend.side));
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

    /// Lays a strip flat.
    fn lay(
        &mut self,
        from: &SurfacePoint,
        base: &Laid,
        strip: &Strip,
        to: &SurfacePoint,
    ) -> Option<Flat> {
        let (mesh, charts) = (self.mesh, self.charts);
        let first = face_at(mesh, charts, from, base, strip.face)?;
        let mut last = first;
        self.gates.clear();
        self.faces.clear();
        for &exit in &strip.through {
            if exit.face() != last.entry.face() {
                return None;
            }
            last = last.across(mesh, charts, exit)?;
            self.faces.push(last);
            self.gates.push(Gate {
                left: last.left,
                right: last.right,
                left_vertex: mesh.target(exit),
                right_vertex: mesh.origin(exit),
            });
        }
        let image = last.image(mesh, charts, to)?;
        Some(Flat { first, last, image })
    }

    /// Passes the vertices of needless bends on their other sides; whether there were any.
    fn turn(&mut self, strip: &mut Strip, flat: &Flat) -> bool {
        let mut turned = false;
        let mut free = usize::MAX;
        for i in (0..self.bends.len()).rev() {
            let Bend { gate, side, at } = self.bends[i];
            let v = self.gates[gate].vertex(side);
            if self.mesh.is_border_vertex(v) {
                continue;
            }
            let before = if i > 0 {
                self.bends[i - 1].at
            } else {
                [0.0; 2]
            };
            let after = self.bends.get(i + 1).map_or(flat.image, |b| b.at);
            let (come, go) = (sub(at, before), sub(after, at));
            let turn = libm::atan2(cross(come, go).abs(), dot(come, go));
            let other = self.charts.total_angles[v as usize] - (PI + turn);
            if other >= PI - BENT {
                continue;
            }
            let range = range_at(&self.gates, gate, side);
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

    /// The strip that was relaxed last: its faces after each gate, its gates and its bends.
    pub(super) fn last(&self) -> (&[Laid], &[Gate], &[Bend]) {
        (&self.faces, &self.gates, &self.bends)
    }

    fn tight(&self, flat: &Flat) -> Option<Tight> {
        let (mesh, charts) = (self.mesh, self.charts);
        let length = length(&self.bends, flat.image);
        if length <= 0.0 {
            return None;
        }
        let begin = self.bends.first().map_or(flat.image, |b| b.at);
        let before = self.bends.last().map_or([0.0; 2], |b| b.at);
        let tangent = |laid: &Laid, direction: V2| Tangent {
            face: laid.entry.face(),
            direction: Charts::to_space(mesh, laid.entry, laid.in_chart(charts, direction)),
        };
        Some(Tight {
            length,
            start: tangent(&flat.first, begin),
            end: tangent(&flat.last, sub(flat.image, before)),
            last: flat.last,
            image: flat.image,
            ahead: {
                let along = norm(begin);
                begin.map(|x| x / along * length)
            },
            doubtful: false,
        })
    }
}

/// The neighbouring gates that end at the same vertex.
fn range_at(gates: &[Gate], gate: usize, side: Side) -> (usize, usize) {
    let v = gates[gate].vertex(side);
    let same = |i: &usize| gates[*i].vertex(side) == v;
    let first = (0..gate).rev().take_while(same).last().unwrap_or(gate);
    let last = (gate + 1..gates.len())
        .take_while(same)
        .last()
        .unwrap_or(gate);
    (first, last)
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
