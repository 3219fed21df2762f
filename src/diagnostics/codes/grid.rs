//! Codes of members and the grid: `E06xx` and lints `W06xx`.

use super::{Code, CodeInfo};

/// A member without equal lengths.
pub const NO_MEMBER: Code = Code::new("E0601");
/// Members that do not meet once.
pub const MISCROSSING: Code = Code::new("E0602");
/// Members that spiral.
pub const SPIRAL: Code = Code::new("E0603");
/// Counts that contradict each other.
pub const COUNTS: Code = Code::new("E0604");

/// A ring that was to close.
pub const CANNOT_CLOSE: Code = Code::new("E0330");

/// A ring that does not close.
pub const OPEN_RING: Code = Code::new("W0330");
/// Flat lamellae that lie on each other.
pub const FLAT_OVERLAP: Code = Code::new("W0601");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0330",
        name: "ring-cannot-close",
        title: "a ring of members does not close",
        text: "\
`distribution.closed` asks that the members of a ring of patches end where they began. A member is \
carried around by the cladding functions of the patches, and these depend on the surface and on the \
planar angles: what one patch shifts, another has to shift back. egg looks for angles and places of \
members with which all of them come back, within what is feasible for each patch, both ways of \
collapsing included. Here it found none; the closest that it came to is told, with its angles.

As many inner members as there are patches with automatic angles can close in general, so ask for \
fewer members, or let egg choose more of the angles. Any number closes where patches are mirror \
images of each other, or the same patch turned, an even number of times: then the mesh has to be \
symmetric too, down to its triangles. Angles that went as far as they go are named: wider bounds in \
`split.slope` or smaller patches leave them more room. A ring into whose sides corners of other \
patches reach cannot be asked to close, because the members through these corners are given.

Otherwise take the family out of `closed`: on the side where the ring begins, members of the two \
patches then end beside each other, each on the boundary lamella of its own patch.",
    },
    CodeInfo {
        code: "W0330",
        name: "open-ring",
        title: "the members of a ring end beside where they began",
        text: "\
Members that run once around a ring of patches need not come back to where they began (paper, \
section 4.4). On the side where the ring begins the members of the two patches end beside each \
other. The grid is sound: every patch has a boundary lamella of its own there. It is said because \
it shows. `distribution.closed` makes them end where they began, if the angles of the patches allow \
it.",
    },
    CodeInfo {
        code: "E0601",
        name: "no-member",
        title: "a member has no end point of equal length",
        text: "\
Members are solved on exact distances after the cladding function has said where they end. No \
point of the end side near that place makes the lengths on the surface and in the plane equal. \
This happens where shortest geodesics jump from one side of a hill to the other: the patch is not \
covered around the peak (see the η of the patch). Split the patch over the peak.",
    },
    CodeInfo {
        code: "E0602",
        name: "crossing-count",
        title: "two members do not cross exactly once",
        text: "\
Every u-member of a patch has to meet every v-member once, on the surface and in the plane: that is \
what makes the grid a mechanism. On the surface two shortest geodesics that meet twice run around a \
peak of curvature on both sides. Split the patch over the peak or choose another `alpha`.",
    },
    CodeInfo {
        code: "E0603",
        name: "spiral",
        title: "members run round and round through neighbouring patches",
        text: "\
A corner of a patch that stands inside a side of its neighbour gives a member there, which runs on \
through the neighbour and the patches behind it. Here such members come back to where they began, \
beside themselves, and would go round for ever. Let corners meet, or leave a gap between patches.",
    },
    CodeInfo {
        code: "E0604",
        name: "member-counts",
        title: "numbers of members contradict each other",
        text: "\
Members run on across shared sides, and a corner inside a side gives one more. A patch has to have \
room for the members of all its neighbours on that side: between two given members lies one space \
at least. Give the patch more members, or its neighbours fewer.",
    },
    CodeInfo {
        code: "W0601",
        name: "lamellae-overlap",
        title: "flat lamellae of one family lie on each other",
        text: "\
In the flat state two neighbouring lamellae of one family are closer than their width. They are in \
one layer and cannot both lie flat. Take fewer members or a larger `alpha`.",
    },
];
