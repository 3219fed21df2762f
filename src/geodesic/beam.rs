//! Beams: windows that keep their place in the plane while the faces ahead are laid out beside it.
//!
//! A window is bound to an edge, so that every face it crosses costs it a turn of its root, two
//! intersections and two distances. A beam is the same bundle of straight lines as a root and two
//! outermost directions in a plane: crossing a face leaves it as it is.

use super::laid::{V2, along, cross, norm, placed, sub, turned_to};
use super::window::Window;

/// Straight lines from one root between two directions. One cache line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beam {
    /// Image of the root.
    pub(super) from: V2,
    /// The leftmost direction, of length 1.
    pub(super) left: V2,
    /// The rightmost direction, of length 1.
    pub(super) right: V2,
    /// Distance of the root from the source, metres.
    pub(super) sigma: f64,
    /// The vertex where the straight lines start, or `SOURCE`.
    pub(super) root: u32,
}

/// An edge A→B laid out in a plane: beams come from its right, where A is on their left.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gate {
    /// Image of A.
    pub(super) left: V2,
    /// Image of B.
    pub(super) right: V2,
    /// From A to B, of length 1.
    along: V2,
    /// Metres.
    pub(super) length: f64,
}

/// A root closer to the line of an edge than this share of the edge sees it as a point.
const GRAZING: f64 = 1e-15;

impl Gate {
    pub(super) fn new(left: V2, right: V2) -> Self {
        let edge = sub(right, left);
        let length = norm(edge);
        let share = 1.0 / length;
        Self {
            left,
            right,
            along: [edge[0] * share, edge[1] * share],
            length,
        }
    }

    /// An edge in the plane of its own chart.
    pub(super) fn flat(length: f64) -> Self {
        Self {
            left: [0.0, 0.0],
            right: [length, 0.0],
            along: [1.0, 0.0],
            length,
        }
    }

    /// Image of a point of the edge, metres from A.
    pub(super) fn at(&self, b: f64) -> V2 {
        self.place([b, 0.0])
    }

    /// Image of a point of the edge's chart.
    pub(super) fn place(&self, point: V2) -> V2 {
        placed(self.left, self.along, point)
    }

    /// The point of the edge's chart with an image.
    #[inline]
    pub(super) fn in_chart(&self, place: V2) -> V2 {
        along(self.along, sub(place, self.left))
    }
}

/// A turn and a shift of the plane, by which the images of an edge in two planes coincide.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    from: V2,
    to: V2,
    turn: V2,
}

impl Motion {
    pub(super) fn new(from: &Gate, to: &Gate) -> Self {
        Self {
            from: from.left,
            to: to.left,
            turn: along(from.along, to.along),
        }
    }

    #[inline]
    fn turned(&self, v: V2) -> V2 {
        turned_to(v, self.turn)
    }

    /// A beam in the other plane.
    #[inline]
    pub(super) fn carried(&self, beam: &Beam) -> Beam {
        let [x, y] = self.turned(sub(beam.from, self.from));
        Beam {
            from: [x + self.to[0], y + self.to[1]],
            left: self.turned(beam.left),
            right: self.turned(beam.right),
            ..*beam
        }
    }
}

impl Beam {
    /// The beam through a window, in the plane of the edge's chart.
    #[inline]
    pub(super) fn through(window: &Window) -> Self {
        let from = [window.x, -window.depth];
        Self {
            from,
            left: unit([window.b0 - window.x, window.depth]),
            right: unit([window.b1 - window.x, window.depth]),
            sigma: window.sigma,
            root: window.root,
        }
    }

    /// The interval of an edge that the beam reaches; `None` if it passes beside the edge, or
    /// along it.
    #[inline]
    pub(super) fn window(&self, gate: &Gate) -> Option<Window> {
        let [x, y] = gate.in_chart(self.from);
        let depth = -y;
        let meets = |ray: V2| {
            let [onward, up] = along(gate.along, ray);
            if up > 0.0 {
                (x + depth * (onward / up)).clamp(0.0, gate.length)
            } else if onward > 0.0 {
                gate.length
            } else {
                0.0
            }
        };
        let b = [meets(self.left), meets(self.right)];
        (b[1] > b[0] && depth > GRAZING * (b[1] + x.abs()))
            .then(|| Window::new(b, x, depth, self.sigma, self.root))
    }

    /// How far a point lies left of the leftmost line, metres.
    #[inline]
    pub(super) fn misses_left(&self, point: V2) -> f64 {
        cross(self.left, sub(point, self.from))
    }

    /// How far a point lies right of the rightmost line, metres.
    #[inline]
    pub(super) fn misses_right(&self, point: V2) -> f64 {
        cross(sub(point, self.from), self.right)
    }

    /// Whether a point lies between the outermost lines, or misses them by less than a slack, metres.
    #[inline]
    pub(super) fn covers(&self, point: V2, slack: f64) -> bool {
        self.misses_left(point) <= slack && self.misses_right(point) <= slack
    }

    /// Distance of a point on one of the lines from the source, metres.
    #[inline]
    pub(super) fn distance(&self, point: V2) -> f64 {
        self.sigma + norm(sub(point, self.from))
    }

    /// The direction of a point.
    #[inline]
    pub(super) fn towards(&self, point: V2) -> V2 {
        unit(sub(point, self.from))
    }
}

#[inline]
fn unit(v: V2) -> V2 {
    let share = 1.0 / norm(v);
    [v[0] * share, v[1] * share]
}
