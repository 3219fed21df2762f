//! Codes of the layout: `E04xx` and lints `W04xx`; of the layout as a whole `E032x` and `W032x`.

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

/// Patches that cover the same part of the surface.
pub const OVERLAP: Code = Code::new("E0320");
/// A corner that reaches over the side of a neighbour.
pub const UNDECLARED: Code = Code::new("E0321");
/// A side that bends around the border.
pub const BLOCKED: Code = Code::new("E0322");
/// A hole inside a patch.
pub const HOLE: Code = Code::new("E0323");

/// A corner that nearly stands on the side of a neighbour.
pub const NEAR_MISS: Code = Code::new("W0320");

/// An anchor that is well off the surface.
pub const FAR_ANCHOR: Code = Code::new("W0401");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0320",
        name: "patches-overlap",
        title: "two patches overlap",
        text: "\
Patches lie beside each other: their sides meet only in anchors, and no part of the surface belongs \
to two of them. Here two sides cross, or one patch lies within another, or two patches lie on the \
same side of the side that they share.

A side is the *shortest* geodesic between its anchors, which on a curved surface is not the straight \
line on a plan: look at `layout/patches.svg` of a build of one patch (`egg build --only west`). Move \
the corners, or put an anchor where the sides cross and divide the patches there.",
    },
    CodeInfo {
        code: "E0321",
        name: "undeclared-junction",
        title: "a corner reaches over the side of a neighbour",
        text: "\
A corner of one patch stands on the side of another, or a little beyond it, without being an anchor \
of that side. Members would end there, and the patches overlap by a sliver. A T-junction is \
declared by the anchor:

    t = { on = [\"a\", \"b\"], at = 0.3 }    # at 30 per cent of the way from a to b

The long side stays one side of its patch; the patches beyond take its parts, and members run on \
across.",
    },
    CodeInfo {
        code: "E0322",
        name: "blocked-side",
        title: "a side bends around the border of the surface",
        text: "\
The shortest way between two anchors runs along the border of a hole, or around a corner of the \
outline, and bends there. That is the shortest way, but no geodesic: a straight lamella does not \
bend sideways. Where the border itself was cut along a geodesic the way follows it without a bend, \
and all is well.

Move the anchors so that the way is free, put an anchor where the way touches the border and let \
patches meet there, or close the hole in the mesh (the openings can be cut into the finished grid).",
    },
    CodeInfo {
        code: "E0323",
        name: "hole-in-patch",
        title: "a patch has a hole of the surface inside",
        text: "\
Members of a patch run from side to side. Around a hole shortest geodesics bend and crowd, so the \
patch cannot be covered. Lay several patches around the hole (four are enough for a courtyard), or \
close it in the mesh.",
    },
    CodeInfo {
        code: "W0320",
        name: "near-junction",
        title: "a corner nearly stands on the side of a neighbour",
        text: "\
A corner of one patch stands on the side of another, or stops short of it by less than two per cent \
of that side, without being an anchor of it. The patches are then separate: members end at the gap. \
If they shall run on, declare the corner on the side:

    t = { on = [\"a\", \"b\"], at = 0.3 }",
    },
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
