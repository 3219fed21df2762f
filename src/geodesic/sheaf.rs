//! Sheaves: the beams that wait at an edge, from left to right, in one plane.
//!
//! When a sheaf crosses a face, only the opposite corner is looked at: beams that pass it on the
//! left leave through the left edge, the others through the right one, and the one that reaches it
//! first is divided there. What else covers the corner is nearer nowhere on one side of it (*one
//! angle, one split*; J. Chen, Y. Han 1990): its lines there cross the way of the first.
//!
//! Beams that run on side by side come to overlap little by little. Every few faces they are laid
//! out as windows and trimmed.

use super::beam::{Beam, Gate, Motion};
use super::laid::{V2, cross};
use super::solve::CLEARLY;
use super::trim;
use super::window::Window;

/// Beams that wait at an edge.
#[derive(Debug, Clone)]
pub(super) struct Sheaf {
    /// From left to right. Neighbours may overlap by what a few faces have let them.
    pub(super) beams: Vec<Beam>,
    /// The edge, in the plane of the beams.
    pub(super) gate: Gate,
    /// The outermost points of the edge that beams reach, from A, metres.
    pub(super) covers: [f64; 2],
    /// About the distance of the nearest point that they reach, metres.
    pub(super) nearest: f64,
    /// Faces since all beams were trimmed.
    pub(super) age: u32,
}

/// Faces after which beams are trimmed. Fewer cost time for trimming, more leave beams that have
/// lost what they covered.
const TRIMMED_EVERY: u32 = 8;

/// A point closer to an outermost line of a beam than this share of the edge lies on it.
const TOUCHING: f64 = 1e-13;

/// Lists that every step uses again.
#[derive(Debug, Default)]
pub(super) struct Lists {
    first: Vec<Window>,
    second: Vec<Window>,
    merged: Vec<Window>,
    joined: Vec<Beam>,
}

/// How beams pass a corner.
#[derive(Debug, Default)]
pub(super) struct Parting {
    /// So many beams at the begin pass on the left.
    lefts: usize,
    /// From here all beams pass on the right.
    rights: usize,
    /// Of those between, what passes on the left, and what on the right.
    left: Vec<Beam>,
    right: Vec<Beam>,
}

impl Parting {
    /// Parts beams at a corner, and finds the one that reaches it first and its distance there.
    pub(super) fn at(
        &mut self,
        beams: &[Beam],
        corner: V2,
        slack: f64,
        edge: f64,
    ) -> Option<(f64, Beam)> {
        let passes_left = |w: &&Beam| w.misses_right(corner) > slack;
        let passes_right = |w: &&Beam| w.misses_left(corner) > slack;
        self.lefts = beams.iter().take_while(passes_left).count();
        let rest = &beams[self.lefts..];
        self.rights = beams.len() - rest.iter().rev().take_while(passes_right).count();
        self.left.clear();
        self.right.clear();
        let between = &beams[self.lefts..self.rights];
        let mut first: Option<(f64, usize)> = None;
        for (i, w) in between.iter().enumerate() {
            if w.covers(corner, slack) {
                let distance = w.distance(corner);
                if first.is_none_or(|(least, _)| distance < least) {
                    first = Some((distance, i));
                }
            }
        }
        let touching = -TOUCHING * edge;
        for (i, w) in between.iter().enumerate() {
            if w.misses_right(corner) > touching {
                self.left.push(*w);
            } else if w.misses_left(corner) > touching {
                self.right.push(*w);
            } else {
                let (on_left, on_right) = match first {
                    Some((distance, j)) if i != j => sides_kept(&between[j], distance, w, corner),
                    _ => (true, true),
                };
                let towards = w.towards(corner);
                if on_left {
                    self.left.push(Beam {
                        right: towards,
                        ..*w
                    });
                }
                if on_right {
                    self.right.push(Beam {
                        left: towards,
                        ..*w
                    });
                }
            }
        }
        first.map(|(distance, i)| (distance, between[i]))
    }

    /// Divides the parted beams, with an empty list for one of the sides.
    pub(super) fn divide(&mut self, mut beams: Vec<Beam>, mut other: Vec<Beam>) -> [Vec<Beam>; 2] {
        if self.lefts >= beams.len() - self.rights {
            other.append(&mut self.right);
            other.extend_from_slice(&beams[self.rights..]);
            beams.truncate(self.lefts);
            beams.append(&mut self.left);
            [beams, other]
        } else {
            other.extend_from_slice(&beams[..self.lefts]);
            other.append(&mut self.left);
            beams.splice(..self.rights, self.right.drain(..));
            [other, beams]
        }
    }
}

/// A direction that differs from another by less is the same up to rounding.
const PARALLEL: f64 = 1e-13;

/// Which parts of a beam that covers a corner are of use, beside another that reaches it first:
/// left of the corner, and right of it.
fn sides_kept(first: &Beam, least: f64, beam: &Beam, corner: V2) -> (bool, bool) {
    let lean = cross(first.towards(corner), beam.towards(corner));
    if beam.distance(corner) <= least * CLEARLY || lean.abs() < PARALLEL {
        return (true, true);
    }
    (lean < 0.0, lean > 0.0)
}

impl Sheaf {
    /// A single beam, through a window of an edge.
    pub(super) fn single(mut beams: Vec<Beam>, window: &Window, length: f64) -> Self {
        beams.clear();
        beams.push(Beam::through(window));
        Self {
            beams,
            gate: Gate::flat(length),
            covers: [window.b0, window.b1],
            nearest: window.nearest(),
            age: 0,
        }
    }

    /// Drops beams at both ends that are of no use, and finds what the others cover. False if
    /// nothing is left.
    ///
    /// Of use is what no path through an end of the edge beats, from the distances of these (Xin,
    /// Wang 2009), and what is not beyond a limit. Where a sheaf covers an edge without a gap, the
    /// beams that an end beats are those next to it.
    pub(super) fn settle(&mut self, at: [f64; 2], limit: f64) -> bool {
        let gate = self.gate;
        let of_use = |beam: &Beam| {
            let w = beam.window(&gate)?;
            let kept = (at[0] + w.b1) * CLEARLY >= w.d1
                && (at[1] + (gate.length - w.b0)) * CLEARLY >= w.d0
                && w.nearest() <= limit;
            kept.then_some(w)
        };
        let found = self.beams.iter().enumerate();
        let first = found.clone().find_map(|(i, beam)| Some((i, of_use(beam)?)));
        let Some((begin, first)) = first else {
            return false;
        };
        let last = found
            .skip(begin + 1)
            .rev()
            .find_map(|(i, beam)| Some((i, of_use(beam)?)));
        let (end, last) = last.unwrap_or((begin, first));
        self.beams.truncate(end + 1);
        self.beams.drain(..begin);
        self.covers = [first.b0, last.b1];
        self.nearest = nearest(first.d0, last.d1, last.b1 - first.b0)
            .min(first.nearest())
            .min(last.nearest());
        true
    }

    /// Trims all beams if it is time to.
    pub(super) fn age(&mut self, lists: &mut Lists) {
        self.age += 1;
        if self.age < TRIMMED_EVERY {
            return;
        }
        lists.first.clear();
        trimmed(&self.beams, &self.gate, &mut lists.first);
        self.beams.clear();
        self.beams.extend(lists.first.iter().map(Beam::through));
        self.gate = Gate::flat(self.gate.length);
        self.age = 0;
    }

    /// Adds the beams of another sheaf at the same edge, and leaves an empty one.
    pub(super) fn join(&mut self, other: &mut Self, lists: &mut Lists) {
        if other.beams.len() > self.beams.len() {
            std::mem::swap(self, other);
        }
        let motion = Motion::new(&other.gate, &self.gate);
        let touching = TOUCHING * self.gate.length;
        let carried = |beams: &[Beam], to: usize, into: &mut Vec<Beam>| {
            into.splice(to..to, beams.iter().map(|beam| motion.carried(beam)));
        };
        let (ours, theirs) = (self.hull(), other.hull());
        if theirs[0] >= ours[1] - touching {
            self.beams
                .extend(other.beams.iter().map(|beam| motion.carried(beam)));
        } else if theirs[1] <= ours[0] + touching {
            carried(&other.beams, 0, &mut self.beams);
        } else {
            let [begin, end] = self.apart(theirs, touching);
            if begin >= end {
                carried(&other.beams, begin, &mut self.beams);
            } else {
                let [from, to] = other.apart(ours, touching);
                lists.first.clear();
                lists.second.clear();
                lists.merged.clear();
                trimmed(&self.beams[begin..end], &self.gate, &mut lists.first);
                trimmed(&other.beams[from..to], &other.gate, &mut lists.second);
                trim::merge(&lists.first, &lists.second, &mut lists.merged);
                let back = Motion::new(&Gate::flat(self.gate.length), &self.gate);
                lists.joined.clear();
                let joined = &mut lists.joined;
                joined.extend(other.beams[..from].iter().map(|beam| motion.carried(beam)));
                joined.extend(lists.merged.iter().map(|w| back.carried(&Beam::through(w))));
                joined.extend(other.beams[to..].iter().map(|beam| motion.carried(beam)));
                self.beams.splice(begin..end, joined.drain(..));
            }
        }
        self.covers = [ours[0].min(theirs[0]), ours[1].max(theirs[1])];
        self.nearest = self.nearest.min(other.nearest);
        self.age = self.age.max(other.age);
        other.beams.clear();
    }

    /// The outermost points of the edge that any beam reaches, from A, metres. Between two trimmings
    /// a beam may reach past the outermost one.
    fn hull(&self) -> [f64; 2] {
        let [mut begin, mut end] = self.covers;
        if begin > 0.0 {
            let mut place = self.gate.at(begin);
            for beam in &self.beams {
                if beam.misses_left(place) < 0.0
                    && let Some(w) = beam.window(&self.gate)
                    && w.b0 < begin
                {
                    begin = w.b0;
                    place = self.gate.at(begin);
                }
            }
        }
        if end < self.gate.length {
            let mut place = self.gate.at(end);
            for beam in &self.beams {
                if beam.misses_right(place) < 0.0
                    && let Some(w) = beam.window(&self.gate)
                    && w.b1 > end
                {
                    end = w.b1;
                    place = self.gate.at(end);
                }
            }
        }
        [begin, end]
    }

    /// From the first to behind the last beam that is not beside an interval of the edge.
    fn apart(&self, interval: [f64; 2], touching: f64) -> [usize; 2] {
        let [from, to] = interval.map(|b| self.gate.at(b));
        let left = |w: &&Beam| w.misses_right(from) > -touching;
        let right = |w: &&Beam| w.misses_left(to) > -touching;
        let begin = self.beams.iter().take_while(left).count();
        let rest = &self.beams[begin..];
        [
            begin,
            self.beams.len() - rest.iter().rev().take_while(right).count(),
        ]
    }
}

/// Beams as windows without overlap.
fn trimmed(beams: &[Beam], gate: &Gate, out: &mut Vec<Window>) {
    for window in beams.iter().filter_map(|beam| beam.window(gate)) {
        trim::push(out, window);
    }
}

/// About the least distance on an edge with these distances at its ends: as if all came from one
/// point of a plane.
fn nearest(d0: f64, d1: f64, length: f64) -> f64 {
    let x = (d0 * d0 - d1 * d1 + length * length) / (2.0 * length);
    if x <= 0.0 {
        d0
    } else if x >= length {
        d1
    } else {
        (d0 * d0 - x * x).max(0.0).sqrt()
    }
}
