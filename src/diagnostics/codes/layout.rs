//! Codes of the layout: `E04xx` and lints `W04xx`.

use super::{Code, CodeInfo};

/// No surface over an anchor.
pub const OFF_SURFACE: Code = Code::new("E0401");
/// A vertex that the mesh does not have.
pub const NO_VERTEX: Code = Code::new("E0402");
/// Two anchors at one place.
pub const SAME_PLACE: Code = Code::new("E0403");
/// No way over the surface.
pub const NO_PATH: Code = Code::new("E0404");
/// A corner that is no corner.
pub const FOLDED: Code = Code::new("E0405");
/// Sides that meet between their corners.
pub const SIDES_CROSS: Code = Code::new("E0406");

/// An anchor that is well off the surface.
pub const FAR_ANCHOR: Code = Code::new("W0401");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0401",
        name: "anchor-off-surface",
        title: "there is no surface over an anchor",
        text: "\
An anchor of two numbers is the topmost surface point over (x, y). Here no part of the mesh lies \
over that place. The message tells the nearest place that is covered.

Check the units: bare numbers are in `project.units`, the mesh in `surface.units`. A design in \
millimetres over a mesh in metres misses it by a factor of 1000.",
    },
    CodeInfo {
        code: "E0402",
        name: "anchor-vertex",
        title: "an anchor names a vertex that the surface does not have",
        text: "\
`{ vertex = n }` counts the `v` records of the mesh file from 0. The number is beyond the last \
one, or no face uses that vertex.",
    },
    CodeInfo {
        code: "E0403",
        name: "anchors-coincide",
        title: "two anchors are at the same place",
        text: "\
Both ends of a side fall on one point of the surface, so there is no geodesic between them. \
Anchors that are given by three numbers move to the closest surface point: two of them may meet \
there.",
    },
    CodeInfo {
        code: "E0404",
        name: "no-geodesic",
        title: "no geodesic joins two anchors",
        text: "\
The shortest geodesic between the anchors could not be found: they lie on different parts of the \
surface, or the mesh has faces without area on the way.",
    },
    CodeInfo {
        code: "E0405",
        name: "folded-patch",
        title: "a patch folds over at a corner",
        text: "\
Corners go around a patch. At this corner the two sides leave in the same direction, go straight \
on, or turn inwards, so that the patch is no convex quadrilateral: members near the corner would \
leave it and cross its sides. Usually two corners are listed in the wrong order, or one lies \
between its neighbours.

    corners = [\"a\", \"b\", \"c\", \"d\"]     # around the patch, not across it",
    },
    CodeInfo {
        code: "E0406",
        name: "sides-cross",
        title: "two sides of a patch meet between their corners",
        text: "\
Sides of a patch may meet only at its corners. Either the corners are listed across the patch \
instead of around it, or a shortest geodesic takes another way than the one that was meant: over a \
hill it passes the side where the way is shorter.",
    },
    CodeInfo {
        code: "W0401",
        name: "anchor-far-from-surface",
        title: "an anchor is far from the surface",
        text: "\
An anchor of three numbers is the closest point of the surface. This one was moved by more than \
five per cent of the size of the surface to get there, which is more than rounding: check units \
and coordinates.",
    },
];
