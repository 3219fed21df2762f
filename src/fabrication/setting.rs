//! Which two supports come first.
//!
//! A folded patch is long in one of its diagonals. On the surface the ends of that diagonal are
//! closer together, so a grid that is bolted there first has to arch up, and expands into the
//! right one of the shapes that it could buckle into (paper, section 6.1).

use crate::members::{crossing_label, id_in};
use crate::plan::{PatchRecord, Plan, SupportRecord};
use crate::project::model::Family;

/// The two supports that are fixed first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FirstTwo<'a> {
    /// Anchors or crossings, as the supports name them.
    pub(super) corners: [&'a str; 2],
    /// Distance in the flat state, metres.
    pub(super) flat: f64,
    /// Distance of the anchors in space, metres.
    pub(super) standing: f64,
}

/// The ends of the longest flat diagonal that have supports; of equal ones the first.
pub(super) fn first_two(plan: &Plan) -> Option<FirstTwo<'_>> {
    let mut best: Option<FirstTwo<'_>> = None;
    for patch in &plan.patches {
        for [i, j] in [[0, 2], [1, 3]] {
            let (Some(a), Some(b)) = (support(plan, patch, i), support(plan, patch, j)) else {
                continue;
            };
            let [p, q] = [i, j].map(|k| patch.planar_corners[k]);
            let flat = libm::hypot(p[0] - q[0], p[1] - q[1]);
            if best.as_ref().is_none_or(|best| flat > best.flat + 1e-9) {
                let gap = |k: usize| a.position[k] - b.position[k];
                best = Some(FirstTwo {
                    corners: [&a.at, &b.at],
                    flat,
                    standing: libm::sqrt((0..3).map(|k| gap(k) * gap(k)).sum()),
                });
            }
        }
    }
    best
}

/// The support at a corner of a patch.
fn support<'a>(plan: &'a Plan, patch: &PatchRecord, corner: usize) -> Option<&'a SupportRecord> {
    let last = |family: Family| {
        let members = plan.members.iter();
        members
            .filter(|m| m.patch == patch.id && m.family == family)
            .map(|m| m.index)
            .max()
    };
    let (u, v) = match corner {
        0 => (1, 1),
        1 => (last(Family::U)?, 1),
        2 => (last(Family::U)?, last(Family::V)?),
        _ => (1, last(Family::V)?),
    };
    let crossing = id_in(&patch.id, &crossing_label(u - 1, v - 1));
    plan.supports
        .iter()
        .find(|support| support.crossings.contains(&crossing))
}
