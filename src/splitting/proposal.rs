//! Where an infeasible patch can be split (paper, Algorithm 1): by a side over the peak of
//! curvature where one family fails, by a corner on the peak where both do.

use super::{Feasibility, JudgedPeak};
use crate::layout::SideLengths;
use crate::project::model::Family;
use crate::surface::Point3;
use serde::{Deserialize, Serialize};

/// A cut closer to a corner than this share of a side leaves a sliver. A peak out there is no
/// place to cut at; the middle is.
const OUTER: f64 = 0.15;

/// A way to split a patch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Proposal {
    /// A new side that runs like a member of a family.
    Edge {
        /// The family.
        along: Family,
        /// Share of the family's start side where it begins.
        from: f64,
        /// Share of the family's end side where it ends.
        to: f64,
    },
    /// A new corner with sides to all four sides of the patch.
    Corner {
        /// Where, metres.
        at: Point3,
        /// Shares of the sides AB, BC, DC and AD, in these directions.
        shares: [f64; 4],
    },
}

impl Proposal {
    /// The family whose members an edge cuts in two.
    fn across(failing: Family, shares: [[f64; 2]; 2]) -> Self {
        let along = match failing {
            Family::U => Family::V,
            Family::V => Family::U,
        };
        let [from, to] = shares[along as usize];
        Self::Edge { along, from, to }
    }

    fn corner(at: Point3, [[ab, dc], [ad, bc]]: [[f64; 2]; 2]) -> Self {
        Self::Corner {
            at,
            shares: [ab, bc, dc, ad],
        }
    }
}

/// What covers a peak: an edge over it where one family passes beside it, a corner on it where
/// both do. `None` if both families cover it.
pub(super) fn over_peak(peak: &JudgedPeak, eta_max: f64) -> Option<Proposal> {
    let shares = peak.coverage.map(|cover| [cover.start, cover.end]);
    match peak.eta().map(|eta| eta > eta_max) {
        [false, false] => None,
        [true, false] => Some(Proposal::across(Family::U, shares)),
        [false, true] => Some(Proposal::across(Family::V, shares)),
        [true, true] => Some(Proposal::corner(peak.place, shares)),
    }
}

/// What shortens the members of the families that bunch: through the highest peak that is not close
/// to the rim, or through the middle. `None` if no family does.
pub(super) fn against_bunching(feasibility: &Feasibility, bunching: [bool; 2]) -> Option<Proposal> {
    let inner = |share: f64| (OUTER..=1.0 - OUTER).contains(&share);
    let covers = |peak: &&JudgedPeak| {
        let mut ends = peak.coverage.iter().flat_map(|c| [c.start, c.end]);
        ends.all(inner)
    };
    let (at, shares) = feasibility
        .peaks
        .iter()
        .find(covers)
        .map_or((feasibility.centre, [[0.5; 2]; 2]), |peak| {
            (peak.place, peak.coverage.map(|c| [c.start, c.end]))
        });
    match bunching {
        [false, false] => None,
        [true, false] => Some(Proposal::across(Family::U, shares)),
        [false, true] => Some(Proposal::across(Family::V, shares)),
        [true, true] => Some(Proposal::corner(at, shares)),
    }
}

/// A patch without a plan whose sides are to blame: halves of the longer pair of sides are closer
/// to each other than the sides are.
pub(super) fn against_shape(sides: SideLengths) -> Proposal {
    let u_starts = sides.ab + sides.cd;
    let v_starts = sides.bc + sides.da;
    let along = if u_starts >= v_starts {
        Family::U
    } else {
        Family::V
    };
    Proposal::Edge {
        along,
        from: 0.5,
        to: 0.5,
    }
}
