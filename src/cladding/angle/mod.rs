//! The free angle of the planar patch: which angles are feasible, and which one is taken.
//!
//! A feasible plan is convex with a margin, has increasing cladding functions of both families
//! with slopes within the user's bounds, and lets the flat lamellae of a family lie side by side.
//! Feasible angles form intervals on either side of a forbidden gap around the plan most similar
//! to the surface patch (method notes, section 3). Among them the most compact plan is taken: the
//! one with the smallest area, which is also the one that differs most from the deployed state
//! (paper, section 4.2).

mod search;

pub use search::{AngleChoice, Infeasible, choose_angle};

use super::{CladdingFunction, DistanceTable, PlanarQuad, TraceFailure, trace};
use crate::layout::SideLengths;
use crate::project::model::Family;
use serde::{Deserialize, Serialize};

/// A plan whose corner is this close to a straight angle has no defined corner when assembled,
/// radians.
pub(super) const CONVEXITY: f64 = 3.0 * DEGREE;
/// Flat lamellae of a family keep this share of their width as play between them.
const PLAY: f64 = 0.1;
/// Members that cross at a smaller planar angle share so long a contact that bolts cannot keep
/// them apart, radians.
const CROSSING: f64 = 10.0 * DEGREE;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// What a plan has to keep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Demands {
    /// Bounds of the slopes of cladding functions.
    pub slope: [f64; 2],
    /// Members of the u- and the v-family, boundary members included.
    pub members: [u32; 2],
    /// Width of a lamella, metres.
    pub width: f64,
}

/// The surface side of the choice: side lengths and the distance tables of both families.
#[derive(Debug, Clone, Copy)]
pub struct Maps<'a> {
    /// Lengths of the sides.
    pub sides: SideLengths,
    /// u-family: side AB to side DC.
    pub u: &'a DistanceTable,
    /// v-family: side AD to side BC.
    pub v: &'a DistanceTable,
}

impl Maps<'_> {
    fn table(&self, family: Family) -> &DistanceTable {
        match family {
            Family::U => self.u,
            Family::V => self.v,
        }
    }
}

/// A plan with its cladding functions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Clad {
    /// Angle at A, radians.
    pub alpha: f64,
    /// The flat patch.
    pub quad: PlanarQuad,
    /// Cladding function of the u-family.
    pub u: CladdingFunction,
    /// Cladding function of the v-family.
    pub v: CladdingFunction,
}

impl Clad {
    /// The cladding function of a family.
    pub fn function(&self, family: Family) -> &CladdingFunction {
        match family {
            Family::U => &self.u,
            Family::V => &self.v,
        }
    }
}

/// Why a plan is not feasible, with the number and its limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Obstacle {
    /// No convex quadrilateral with this angle: the open interval where there is one, radians;
    /// `None` where these four lengths close nowhere.
    NotConvex(Option<(f64, f64)>),
    /// A corner within [`CONVEXITY`] of a straight angle; the margin that is there, radians.
    Flat(f64),
    /// A side is too short for the lamellae that begin or end on it.
    Crowded(Crowded),
    /// A family has no cladding function.
    NoCladding(Family, TraceFailure),
    /// Flat lamellae of a family overlap: least distance of centre lines and what is needed,
    /// metres.
    Overlap(Family, [f64; 2]),
    /// Members cross at too small an angle in the plane, radians.
    Sharp(f64),
    /// The slopes of a family's cladding function leave the bounds: these, then the bounds.
    Slope(Family, [f64; 2], [f64; 2]),
}

/// A side that is too short for its lamellae, whatever the angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Crowded {
    /// The family that begins or ends on it.
    pub family: Family,
    /// Numbers of the corners at its ends, from 1.
    pub side: [u8; 2],
    /// Its length, metres.
    pub length: f64,
    /// What its lamellae need beside each other, metres.
    pub needed: f64,
    /// How many there are.
    pub members: u32,
}

/// Makes and checks the plan with a given angle, radians.
pub fn clad(maps: &Maps<'_>, demands: &Demands, alpha: f64) -> Result<Clad, Obstacle> {
    if let Some(crowded) = crowded(maps, demands) {
        return Err(Obstacle::Crowded(crowded));
    }
    let quad = PlanarQuad::new(maps.sides, alpha)
        .ok_or_else(|| Obstacle::NotConvex(maps.sides.convex_range()))?;
    if quad.convexity_margin() < CONVEXITY {
        return Err(Obstacle::Flat(quad.convexity_margin()));
    }
    let clad = trace_both(maps, quad, alpha)?;
    let lines = [(Family::U, 0), (Family::V, 1)]
        .map(|(family, i)| flat_members(&clad, family, demands.members[i]));
    let needed = demands.width * (1.0 + PLAY);
    for (family, lines) in [Family::U, Family::V].into_iter().zip(&lines) {
        let gap = least_gap(lines);
        if gap < needed {
            return Err(Obstacle::Overlap(family, [gap, needed]));
        }
    }
    let sharpest = sharpest_crossing(&lines[0], &lines[1]);
    if sharpest < CROSSING {
        return Err(Obstacle::Sharp(sharpest));
    }
    // Last, so that the slopes that are told are those of an angle with nothing else against it.
    for family in [Family::U, Family::V] {
        let [low, high] = clad.function(family).slope_range();
        if low < demands.slope[0] || high > demands.slope[1] {
            return Err(Obstacle::Slope(family, [low, high], demands.slope));
        }
    }
    Ok(clad)
}

/// The plan with a given angle, radians, whatever its shape and its slopes; `None` where there is
/// none, or where members of a family do not exist all the way.
pub fn lay(maps: &Maps<'_>, alpha: f64) -> Option<Clad> {
    let quad = PlanarQuad::new(maps.sides, alpha)?;
    trace_both(maps, quad, alpha).ok()
}

fn trace_both(maps: &Maps<'_>, quad: PlanarQuad, alpha: f64) -> Result<Clad, Obstacle> {
    let follow = |family| {
        trace(maps.table(family), &quad, family).map_err(|f| Obstacle::NoCladding(family, f))
    };
    Ok(Clad {
        alpha,
        quad,
        u: follow(Family::U)?,
        v: follow(Family::V)?,
    })
}

/// Neighbouring members are at most as far apart as their ends, so a side has to be as long as
/// its lamellae are wide together. Of several short sides the shortest one for its lamellae.
fn crowded(maps: &Maps<'_>, demands: &Demands) -> Option<Crowded> {
    let SideLengths { ab, bc, cd, da } = maps.sides;
    let sides = [
        (Family::U, [1, 2], ab),
        (Family::V, [2, 3], bc),
        (Family::U, [3, 4], cd),
        (Family::V, [4, 1], da),
    ];
    sides
        .into_iter()
        .map(|(family, side, length)| {
            let members = demands.members[usize::from(family == Family::V)];
            let gaps = f64::from(members.saturating_sub(1));
            Crowded {
                family,
                side,
                length,
                needed: gaps * demands.width * (1.0 + PLAY),
                members,
            }
        })
        .filter(|side| side.length < side.needed)
        .min_by(|a, b| (a.length / a.needed).total_cmp(&(b.length / b.needed)))
}

type Line = [super::Point2; 2];

/// Straight members with even shares on the start side.
fn flat_members(clad: &Clad, family: Family, count: u32) -> Vec<Line> {
    (0..count)
        .map(|i| {
            let start = f64::from(i) / f64::from(count - 1);
            let end = clad.function(family).at(start).0;
            [clad.quad.start(family, start), clad.quad.end(family, end)]
        })
        .collect()
}

/// Smallest distance between neighbouring members: as they do not cross, it stands at an end of
/// one of them.
fn least_gap(lines: &[Line]) -> f64 {
    let to_line = |p: super::Point2, [a, b]: Line| {
        let along = (b - a).normalize();
        along.perp(&(p - a)).abs()
    };
    lines
        .windows(2)
        .flat_map(|w| {
            let (a, b) = (w[0], w[1]);
            [
                to_line(a[0], b),
                to_line(a[1], b),
                to_line(b[0], a),
                to_line(b[1], a),
            ]
        })
        .fold(f64::INFINITY, f64::min)
}

/// Smallest angle between a member of one family and one of the other, radians.
fn sharpest_crossing(u: &[Line], v: &[Line]) -> f64 {
    let mut largest_cos: f64 = 0.0;
    for [a, b] in u {
        let along = (b - a).normalize();
        for [p, q] in v {
            largest_cos = largest_cos.max(along.dot(&(q - p).normalize()).abs());
        }
    }
    libm::acos(largest_cos.min(1.0))
}

#[cfg(test)]
mod tests;
