//! A strip of faces laid flat, with the tight line through it.

use super::charts::Charts;
use super::funnel::{Bend, length, pull};
use super::laid::{Laid, Side, V2, cross, norm, sub};
use super::relax::face_at;
use crate::surface::{HalfEdge, Mesh, Point3, SurfacePoint, Tangent};

/// The faces between two points.
#[derive(Debug, Clone, Default)]
pub(super) struct Strip {
    /// The half-edges of the faces being left, in order.
    pub(super) through: Vec<HalfEdge>,
    /// The face of both ends where nothing is crossed, else the first.
    pub(super) face: u32,
}

/// A strip laid flat with its begin at the origin.
#[derive(Debug, Clone)]
pub(super) struct Unrolled {
    pub(super) first: Laid,
    /// After each crossed edge, which is the entry.
    pub(super) faces: Vec<Laid>,
    /// Of the tight line.
    pub(super) bends: Vec<Bend>,
    /// Where the end is.
    pub(super) image: V2,
}

/// A locally shortest path in its strip.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tight {
    /// Metres.
    pub(super) length: f64,
    /// Direction at the begin.
    pub(super) start: Tangent,
    /// Direction at the end, pointing onward.
    pub(super) end: Tangent,
    /// The last face in the plane of the strip, its begin at the origin.
    pub(super) last: Laid,
    /// The direction in which the path leaves, in this plane; of any length.
    pub(super) ahead: V2,
}

/// A straight piece of a path in the plane of its strip.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    at: V2,
    ahead: V2,
    length: f64,
    /// Arc length of its begin, metres.
    passed: f64,
}

impl Leg {
    /// How far a place lies aside, metres, positive on the given side, and the arc length of its foot.
    pub(super) fn see(&self, place: V2, side: Side) -> (f64, f64) {
        let out = sub(place, self.at);
        let [ux, uy] = self.ahead.map(|x| x / self.length);
        let aside = ux * out[1] - uy * out[0];
        let along = self.passed + ux * out[0] + uy * out[1];
        (if side == Side::Left { aside } else { -aside }, along)
    }
}

impl Unrolled {
    /// Nothing yet.
    pub(super) fn new(first: Laid) -> Self {
        Self {
            first,
            faces: Vec::new(),
            bends: Vec::new(),
            image: [0.0; 2],
        }
    }

    /// Lays a strip flat and pulls the line through it tight; its length, metres.
    pub(super) fn lay(
        &mut self,
        (mesh, charts): (&Mesh, &Charts),
        (from, base): (&SurfacePoint, &Laid),
        strip: &Strip,
        to: &SurfacePoint,
    ) -> Option<f64> {
        self.first = face_at(mesh, charts, from, base, strip.face)?;
        let mut last = self.first;
        self.faces.clear();
        for &exit in &strip.through {
            if exit.face() != last.entry.face() {
                return None;
            }
            last = last.across(mesh, charts, exit)?;
            self.faces.push(last);
        }
        self.image = last.image(mesh, charts, to)?;
        pull(&self.faces, self.image, &mut self.bends);
        Some(length(&self.bends, self.image))
    }

    /// The last face.
    pub(super) fn last(&self) -> &Laid {
        self.faces.last().unwrap_or(&self.first)
    }

    /// Whether the straight line from the begin to the end crosses every edge between its ends, from
    /// the right side.
    pub(super) fn is_straight(&self) -> bool {
        let to = self.image;
        self.faces.iter().all(|laid| {
            cross(laid.right, to) >= 0.0
                && cross(to, laid.left) >= 0.0
                && cross(laid.right, laid.left) > 0.0
        })
    }

    /// The tight line as a path; `None` if it has no length.
    pub(super) fn tight(&self, mesh: &Mesh, charts: &Charts) -> Option<Tight> {
        let length = length(&self.bends, self.image);
        if length <= 0.0 {
            return None;
        }
        let ahead = self.bends.first().map_or(self.image, |b| b.at);
        let before = self.bends.last().map_or([0.0; 2], |b| b.at);
        let tangent = |laid: &Laid, direction: V2| Tangent {
            face: laid.entry.face(),
            direction: Charts::to_space(mesh, laid.entry, laid.in_chart(charts, direction)),
        };
        let last = *self.last();
        Some(Tight {
            length,
            start: tangent(&self.first, ahead),
            end: tangent(&last, sub(self.image, before)),
            last,
            ahead,
        })
    }

    /// The straight pieces of the line, and for each the faces whose entries it crosses.
    pub(super) fn legs(&self) -> impl Iterator<Item = (Leg, std::ops::Range<usize>)> + '_ {
        let ends = self.bends.iter().map(|b| (b.at, b.gate + 1));
        let ends = ends.chain([(self.image, self.faces.len())]);
        let (mut at, mut passed, mut first) = ([0.0; 2], 0.0, 0);
        ends.map(move |(end, last)| {
            let ahead = sub(end, at);
            let leg = Leg {
                at,
                ahead,
                length: norm(ahead),
                passed,
            };
            let range = first..last.max(first);
            (at, first) = (end, last.max(first));
            passed += leg.length;
            (leg, range)
        })
    }

    /// Arc length, metres, and place of the crossing of a leg with the entry of a face.
    pub(super) fn crossing(&self, mesh: &Mesh, leg: &Leg, face: usize) -> (f64, Point3) {
        let laid = &self.faces[face];
        let (left, right) = (sub(laid.left, leg.at), sub(laid.right, leg.at));
        let (to_left, to_right) = (cross(leg.ahead, left), cross(leg.ahead, right));
        let share = (to_left / (to_left - to_right)).clamp(0.0, 1.0);
        let share = if share.is_nan() { 0.5 } else { share };
        let meet = [0, 1].map(|k| left[k] + (right[k] - left[k]) * share);
        let ends = Side::BOTH.map(|side| mesh.position(laid.vertex(mesh, side)));
        (
            leg.passed + norm(meet),
            ends[0] + (ends[1] - ends[0]) * share,
        )
    }
}
