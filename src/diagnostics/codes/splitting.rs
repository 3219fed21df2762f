//! Codes of splitting: lints `W0350` to `W0369`.

use super::{Code, CodeInfo};

/// Where a patch without a plan can be split.
pub const PROPOSAL: Code = Code::new("W0350");
/// A patch that splitting leaves infeasible.
pub const LEFT: Code = Code::new("W0351");
/// What splitting did.
pub const SPLIT: Code = Code::new("W0352");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "W0350",
        name: "split-proposal",
        title: "where a patch without a plan can be split",
        text: "\
At no planar angle both families have cladding functions with slopes within `split.slope`. The \
message tells the angle at which they come closest. Shorter members bend less of the curvature: \
a side across the members of the family that fails makes them shorter, a corner those of both \
families (paper, Algorithm 1).

Add the proposed points and patches to the project file by hand, let `egg split` write them, or \
set `split.workflow` to have them made with every build.",
    },
    CodeInfo {
        code: "W0351",
        name: "split-incomplete",
        title: "splitting leaves an infeasible patch",
        text: "\
Splitting ended with a patch that violates a criterion, or with one that is larger than \
`split.max_side`, and says why it could not go on: a limit of the project (`split.min_side`, \
`split.max_patches`), too few members to share among the parts, or a patch that splitting does not \
help. Loosen the limit, give the strip more members, or move the corners of the \
patch.",
    },
    CodeInfo {
        code: "W0352",
        name: "split-done",
        title: "what splitting did",
        text: "\
A note of what `split.workflow` made of a patch: into how many patches it was split, and why. \
`egg split` prints the resulting points and patches, which can be pasted into the project file and \
edited there; then remove `split.workflow`.",
    },
];
