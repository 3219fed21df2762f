//! Codes of cladding: `E05xx` and lints `W05xx`.

use super::{Code, CodeInfo};

/// No convex plan.
pub const NO_PLAN: Code = Code::new("E0501");
/// No cladding function.
pub const NO_CLADDING: Code = Code::new("E0502");
/// Slopes out of bounds.
pub const SLOPE: Code = Code::new("E0503");
/// Flat lamellae overlap.
pub const OVERLAP: Code = Code::new("E0504");
/// Members cross at too small an angle.
pub const SHARP: Code = Code::new("E0505");
/// The plan has the shape of the patch.
pub const CONGRUENT: Code = Code::new("E0506");

/// Shortest geodesics pass beside a peak.
pub const UNCOVERED: Code = Code::new("W0501");
/// The diagonals do not exchange their lengths.
pub const DIAGONALS: Code = Code::new("W0502");

/// A way around the patch may be shorter.
pub const UNPROVED: Code = Code::new("W0503");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0501",
        name: "no-plan",
        title: "the sides of a patch make no convex plan",
        text: "\
The flat patch is a quadrilateral with straight sides as long as those of the patch on the \
surface. It has to be convex, so that every member of one family meets every member of the other \
one, and no corner may be nearly straight.

With sides a, b, c, d the angle at the first corner is free within an interval. Where one side is \
nearly as long as the other three together, or opposite sides differ much, nothing is left of it.

Move the corners so that opposite sides are of similar length.",
    },
    CodeInfo {
        code: "E0502",
        name: "no-cladding",
        title: "a family of members has no cladding function",
        text: "\
A member is as long in the plane as on the surface. Starting from one boundary member, the pairs \
of end points with that property form a curve; where it is increasing and reaches the other \
boundary member it is the cladding function of the family (paper, section 3.2). Here it turns \
back on the way: beyond that point no member of equal length follows.

The angles for which this happens lie in a gap around the plan that is most similar to the patch. \
Where the gap fills the whole convex interval, the patch holds too much curvature. Make it \
smaller, or split it so that a side runs over the peak of curvature.",
    },
    CodeInfo {
        code: "E0503",
        name: "slope-bounds",
        title: "members bunch together",
        text: "\
The slope of a cladding function says how much the distance between neighbouring members changes \
from the start side to the end side. Very steep or flat slopes mean bunched members, which look \
uneven and jam when the grid is deployed (paper, section 4.2). `split.slope` bounds them:

    [split]
    slope = [0.5, 2.0]     # the default

Plans that are collapsed further have slopes closer to 1. If the best one still violates the \
bounds, make the patch smaller or allow more.",
    },
    CodeInfo {
        code: "E0504",
        name: "flat-overlap",
        title: "lamellae do not fit side by side in the flat state",
        text: "\
In the flat state lamellae of one family lie side by side in one layer. Their centre lines have to \
keep the width of a lamella and a tenth of it as play. The more compact the plan, the closer they \
lie; angles further open are not feasible for other reasons. A side that is shorter than its \
lamellae are wide together has no room at any angle.

Take fewer members, narrower lamellae, or widen the bounds that keep the plan from opening \
(`split.slope`).",
    },
    CodeInfo {
        code: "E0505",
        name: "sharp-crossing",
        title: "members cross at too small an angle in the plane",
        text: "\
Below 10 degrees two lamellae share so long a contact that a bolt no longer keeps their angle: \
the flat grid is a bundle, not a mechanism. Give a larger `alpha`, or corners whose opposite sides \
are of similar length.",
    },
    CodeInfo {
        code: "E0506",
        name: "congruent-plan",
        title: "the plan is congruent to the patch",
        text: "\
Where the flat quadrilateral has the shape of the patch itself, all distances agree and equal \
length selects no members. It would also be a grid that does not move: deployment lives from the \
difference between the flat and the deployed angles. Choose an `alpha` further from the angle on \
the surface.",
    },
    CodeInfo {
        code: "W0501",
        name: "uncovered-peak",
        title: "shortest geodesics pass beside a peak of curvature",
        text: "\
Every way from one side over the peak of Gaussian curvature to the opposite side is longer than \
the shortest geodesic between its ends, the best one by the factor η. Above `split.eta_max` \
(1.0015) members leave a hole around the peak, and the grid does not describe the surface there \
(paper, section 4.1).

Split the patch so that a side runs over the peak (one family is affected) or a corner stands on it \
(both are): by hand, with `egg split`, or with every build (`split.workflow`).",
    },
    CodeInfo {
        code: "W0502",
        name: "diagonals",
        title: "both diagonals change in the same direction",
        text: "\
When a grid collapses, one diagonal gets longer and the other one shorter. Here both diagonals of \
the plan are longer, or both shorter, than those of the surface patch, which speaks against a \
smooth deployment (paper, Expression 2). Choose another `alpha`.",
    },
    CodeInfo {
        code: "W0503",
        name: "unproved-geodesic",
        title: "a geodesic is not proved to be shortest on the whole surface",
        text: "\
Geodesics of a patch are solved on the part of the surface around it. Each is compared with the \
shortest way that could leave that part: at least the straight distances from its ends to the cut. \
Where this bound is not met, a shorter way around the patch cannot be excluded.

It happens to patches that bend around by nearly half a turn. Make the patch smaller.",
    },
];
