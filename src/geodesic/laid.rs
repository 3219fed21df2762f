//! Faces laid out in one plane, one after the other along a strip.

use super::charts::{Charts, Step};
use crate::surface::{HalfEdge, Mesh, SurfacePoint};

/// A point or vector of the plane.
pub(super) type V2 = [f64; 2];

pub(super) fn sub(a: V2, b: V2) -> V2 {
    [a[0] - b[0], a[1] - b[1]]
}

/// Positive where `b` lies left of `a`.
pub(super) fn cross(a: V2, b: V2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(super) fn dot(a: V2, b: V2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn norm(a: V2) -> f64 {
    dot(a, a).sqrt()
}

/// A side of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

impl Side {
    pub(super) const BOTH: [Self; 2] = [Self::Left, Self::Right];
}

/// A way round a vertex.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Turn {
    /// Counter-clockwise.
    Left,
    /// Clockwise.
    Right,
}

/// A direction turned to the left by an angle, radians.
pub(super) fn turned(v: V2, angle: f64) -> V2 {
    let (s, c) = libm::sincos(angle);
    turned_to(v, [c, s])
}

/// A vector turned as an axis, of length 1, is turned from the first direction of the plane.
#[inline]
pub(super) fn turned_to([x, y]: V2, [c, s]: V2) -> V2 {
    [x * c - y * s, x * s + y * c]
}

/// A vector along and across an axis, of length 1: turned back.
#[inline]
pub(super) fn along(axis: V2, v: V2) -> V2 {
    [dot(axis, v), cross(axis, v)]
}

/// A point along and across an axis, of length 1, that begins at an origin.
#[inline]
pub(super) fn placed([ox, oy]: V2, [ux, uy]: V2, [x, y]: V2) -> V2 {
    [ox + ux * x - uy * y, oy + uy * x + ux * y]
}

/// A face in the plane, seen over the half-edge by which it was entered: who walks into it has
/// the half-edge's origin on the left and its target on the right.
#[derive(Debug, Clone, Copy)]
pub(super) struct Laid {
    pub(super) entry: HalfEdge,
    /// Image of the origin of `entry`.
    pub(super) left: V2,
    /// Image of its target.
    pub(super) right: V2,
}

impl Laid {
    /// The face above a half-edge, with a point of it at the origin of the plane.
    pub(super) fn around(
        mesh: &Mesh,
        charts: &Charts,
        entry: HalfEdge,
        point: &SurfacePoint,
    ) -> Option<Self> {
        let [x, y] = charts.coordinates(mesh, entry, point)?;
        Some(Self {
            entry,
            left: [-x, -y],
            right: [charts.chart(entry).length - x, -y],
        })
    }

    /// Image of a point of the entry's chart.
    pub(super) fn place(&self, charts: &Charts, point: V2) -> V2 {
        placed(self.left, self.axis(charts), point)
    }

    /// A direction of the plane in the entry's chart.
    pub(super) fn in_chart(&self, charts: &Charts, direction: V2) -> V2 {
        along(self.axis(charts), direction)
    }

    /// A direction of the entry's chart in the plane.
    pub(super) fn in_plane(&self, charts: &Charts, direction: V2) -> V2 {
        turned_to(direction, self.axis(charts))
    }

    /// One end of the entry.
    pub(super) fn end(&self, side: Side) -> V2 {
        match side {
            Side::Left => self.left,
            Side::Right => self.right,
        }
    }

    /// The vertex at one end of the entry.
    pub(super) fn vertex(&self, mesh: &Mesh, side: Side) -> u32 {
        match side {
            Side::Left => mesh.origin(self.entry),
            Side::Right => mesh.target(self.entry),
        }
    }

    /// Image of the corner opposite the entry.
    pub(super) fn apex(&self, charts: &Charts) -> V2 {
        apex(self.left, self.right, &charts.steps[self.entry.0 as usize])
    }

    /// Image of a point, if it lies in or on the face.
    pub(super) fn image(&self, mesh: &Mesh, charts: &Charts, point: &SurfacePoint) -> Option<V2> {
        let coordinates = charts.coordinates(mesh, self.entry, point)?;
        Some(self.place(charts, coordinates))
    }

    /// The half-edges of the face in order, each with the image of its origin.
    pub(super) fn corners(&self, charts: &Charts) -> [(HalfEdge, V2); 3] {
        let entry = self.entry;
        [
            (entry, self.left),
            (entry.next(), self.right),
            (entry.prev(), self.apex(charts)),
        ]
    }

    /// The half-edge of the face that leaves one of its corners.
    pub(super) fn spoke(&self, mesh: &Mesh, vertex: u32) -> Option<HalfEdge> {
        let around = [self.entry, self.entry.next(), self.entry.prev()];
        around.into_iter().find(|&h| mesh.origin(h) == vertex)
    }

    /// The next face round one of the corners; `None` at the border.
    pub(super) fn beside(
        &self,
        mesh: &Mesh,
        charts: &Charts,
        vertex: u32,
        turn: Turn,
    ) -> Option<Self> {
        let spoke = self.spoke(mesh, vertex)?;
        let exit = match turn {
            Turn::Left => spoke.prev(),
            Turn::Right => spoke,
        };
        self.across(mesh, charts, exit)
    }

    /// The face beyond a half-edge of this one; `None` at the border.
    pub(super) fn across(&self, mesh: &Mesh, charts: &Charts, exit: HalfEdge) -> Option<Self> {
        let entry = mesh.twin(exit)?;
        let (left, right) = if exit == self.entry {
            (self.right, self.left)
        } else if exit == self.entry.next() {
            (self.apex(charts), self.right)
        } else {
            (self.left, self.apex(charts))
        };
        Some(Self { entry, left, right })
    }

    #[inline]
    fn axis(&self, charts: &Charts) -> V2 {
        let length = charts.chart(self.entry).length;
        let along = sub(self.right, self.left);
        [along[0] / length, along[1] / length]
    }
}

/// Image of the corner opposite a half-edge, from the images of its ends.
#[inline]
pub(super) fn apex(left: V2, right: V2, step: &Step) -> V2 {
    let [ex, ey] = sub(right, left);
    let [along, across] = step.apex;
    [
        left[0] + ex * along - ey * across,
        left[1] + ey * along + ex * across,
    ]
}
