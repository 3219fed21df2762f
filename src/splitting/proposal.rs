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
/// Peaks whose curvatures differ by less than this share may be images of each other.
const ALIKE: f64 = 0.05;
/// Images are so close to each other's places, in shares of a side.
const TWINS: f64 = 0.1;
/// Twins are at least so far from each other, in shares of a side.
const APART: f64 = 0.2;

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
    let (at, shares) = shares_at(feasibility);
    match bunching {
        [false, false] => None,
        [true, false] => Some(Proposal::across(Family::U, shares)),
        [false, true] => Some(Proposal::across(Family::V, shares)),
        [true, true] => Some(Proposal::corner(at, shares)),
    }
}

/// The highest peak that is not close to the rim, with the shares of the sides AB and DC, AD and BC at
/// which ways over it end; the middle where there is none.
pub(super) fn shares_at(feasibility: &Feasibility) -> (Point3, [[f64; 2]; 2]) {
    let inner = |share: f64| (OUTER..=1.0 - OUTER).contains(&share);
    let covers = |peak: &&JudgedPeak| {
        let mut ends = peak.coverage.iter().flat_map(|c| [c.start, c.end]);
        ends.all(inner)
    };
    feasibility
        .peaks
        .iter()
        .find(covers)
        .map_or((feasibility.centre, [[0.5; 2]; 2]), |peak| {
            (peak.place, peak.coverage.map(|c| [c.start, c.end]))
        })
}

/// Two highest peaks that are mirror images of each other, by their places between the sides:
/// the side between them leaves one on either side. `None` unless both are uncovered.
pub(super) fn between_twins(feasibility: &Feasibility, eta_max: f64) -> Option<Proposal> {
    let mut uncovered = feasibility
        .peaks
        .iter()
        .filter(|peak| peak.eta().iter().any(|eta| *eta > eta_max));
    let (one, other) = (uncovered.next()?, uncovered.next()?);
    if other.gaussian < (1.0 - ALIKE) * one.gaussian {
        return None;
    }
    let at = |peak: &JudgedPeak| peak.coverage.map(|c| 0.5 * (c.start + c.end));
    let ([u, v], [s, t]) = (at(one), at(other));
    let mirrored = |a: f64, b: f64| (a + b - 1.0).abs() < TWINS && (a - b).abs() > APART;
    let level = |a: f64, b: f64| (a - b).abs() < TWINS;
    let along = match (mirrored(u, s), mirrored(v, t)) {
        (true, _) if level(v, t) => Family::U,
        (_, true) if level(u, s) => Family::V,
        _ => return None,
    };
    Some(Proposal::Edge {
        along,
        from: 0.5,
        to: 0.5,
    })
}

/// A patch that is larger than wanted: equal parts of its longer sides, one cut at a time.
pub(super) fn against_size(sides: SideLengths, wanted: f64) -> Proposal {
    let u_starts = sides.ab.max(sides.cd);
    let v_starts = sides.bc.max(sides.da);
    let (along, longest) = if u_starts >= v_starts {
        (Family::U, u_starts)
    } else {
        (Family::V, v_starts)
    };
    let parts = (longest / wanted).ceil().max(2.0);
    // An odd part first leaves an even rest.
    let share = if parts % 2.0 == 0.0 { 0.5 } else { 1.0 / parts };
    Proposal::Edge {
        along,
        from: share,
        to: share,
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
