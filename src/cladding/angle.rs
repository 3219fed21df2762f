//! The free angle of the planar patch: which angles are feasible, and which one is taken.
//!
//! A feasible plan is convex with a margin, has increasing cladding functions of both families
//! with slopes within the user's bounds, and lets the flat lamellae of a family lie side by side.
//! Feasible angles form intervals on either side of a forbidden gap around the plan most similar
//! to the surface patch (method notes, section 3). Among them the most compact plan is taken: the
//! one with the smallest area, which is also the one that differs most from the deployed state
//! (paper, section 4.2).

use super::{CladdingFunction, DistanceTable, PlanarQuad, Survey, TraceFailure, survey, trace};
use crate::layout::SideLengths;
use crate::project::model::Family;
use serde::{Deserialize, Serialize};

/// Step of the scan, radians: a quarter of a degree.
const SCAN: f64 = 0.25 * DEGREE;
/// Ends of feasible intervals are located this well, radians.
const LOCATE: f64 = 0.002 * DEGREE;
/// The chosen angle is rounded to this, radians: an angle that people can write down and that does
/// not move with the last digits of the surface.
const ROUND: f64 = 0.1 * DEGREE;
/// A plan whose corner is this close to a straight angle has no defined corner when assembled,
/// radians.
pub(super) const CONVEXITY: f64 = 3.0 * DEGREE;
/// Flat lamellae of a family keep this share of their width as play between them.
const PLAY: f64 = 0.1;
/// Members that cross at a smaller planar angle share so long a contact that bolts cannot keep
/// them apart, radians.
const CROSSING: f64 = 10.0 * DEGREE;
/// A later interval has to beat an earlier one by this much: symmetric patches take the acute
/// angle, whatever the rounding of their mesh.
const CLEARLY: f64 = 0.99;
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

/// Result of the search for an angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AngleChoice {
    /// Open interval of angles with a convex plan, radians.
    pub convex: Option<(f64, f64)>,
    /// Intervals of feasible angles, radians, ascending.
    pub feasible: Vec<(f64, f64)>,
    /// The plan taken, or what stands against the angle that comes closest.
    pub taken: Result<Clad, Infeasible>,
    /// Slopes where they come closest to the bounds, if no plan was taken.
    pub survey: Option<Survey>,
}

/// The least bad angle of an infeasible patch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Infeasible {
    /// Radians.
    pub alpha: f64,
    /// What stands against it.
    pub obstacle: Obstacle,
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
    let follow = |family| {
        trace(maps.table(family), &quad, family).map_err(|f| Obstacle::NoCladding(family, f))
    };
    let clad = Clad {
        alpha,
        quad,
        u: follow(Family::U)?,
        v: follow(Family::V)?,
    };
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

/// Scans the convex angles, locates the feasible intervals and takes the most compact plan.
pub fn choose_angle(maps: &Maps<'_>, demands: &Demands) -> AngleChoice {
    let Some((low, high)) = maps.sides.convex_range() else {
        let obstacle = Obstacle::NotConvex(None);
        return AngleChoice {
            convex: None,
            feasible: Vec::new(),
            taken: Err(Infeasible {
                alpha: 0.0,
                obstacle,
            }),
            survey: None,
        };
    };
    let steps = ((high - low) / SCAN).ceil().max(8.0) as u32;
    let angle = |k: u32| low + (high - low) * (f64::from(k) + 0.5) / f64::from(steps);
    let tried: Vec<_> = (0..steps).map(|k| clad(maps, demands, angle(k))).collect();
    let is_feasible = |alpha: f64| clad(maps, demands, alpha).is_ok();

    let mut feasible = Vec::new();
    let mut best: Option<(f64, f64)> = None;
    let mut k = 0;
    while k < steps {
        let Some(run) = tried[k as usize..].iter().position(Result::is_ok) else {
            break;
        };
        let first = k + run as u32;
        let length = tried[first as usize..]
            .iter()
            .take_while(|t| t.is_ok())
            .count() as u32;
        let last = first + length - 1;
        let before = if first == 0 { low } else { angle(first - 1) };
        let after = if last + 1 == steps {
            high
        } else {
            angle(last + 1)
        };
        let interval = (
            boundary(is_feasible, angle(first), before),
            boundary(is_feasible, angle(last), after),
        );
        feasible.push(interval);
        // The area rises from either end of the convex range, so its smallest value on an
        // interval stands at one of its ends.
        for end in [interval.0, interval.1] {
            let alpha = round_into(interval, end);
            let area = PlanarQuad::new(maps.sides, alpha).map_or(f64::INFINITY, |q| q.area());
            if best.is_none_or(|(_, smallest)| area < smallest * CLEARLY) && is_feasible(alpha) {
                best = Some((alpha, area));
            }
        }
        k = last + 1;
    }
    let taken = match best {
        Some((alpha, _)) => {
            clad(maps, demands, alpha).map_err(|obstacle| Infeasible { alpha, obstacle })
        }
        None => Err(least_bad(&tried, angle)),
    };
    let survey = taken
        .is_err()
        .then(|| survey(maps, demands.slope))
        .flatten();
    AngleChoice {
        convex: Some((low, high)),
        feasible,
        taken,
        survey,
    }
}

/// The boundary of feasibility between a feasible and an infeasible angle, on the feasible side.
fn boundary(is_feasible: impl Fn(f64) -> bool, mut inside: f64, mut outside: f64) -> f64 {
    while (inside - outside).abs() > LOCATE {
        let middle = 0.5 * (inside + outside);
        if is_feasible(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

/// Rounds an end of an interval to a tenth of a degree, inwards where the interval is wide enough.
fn round_into((low, high): (f64, f64), end: f64) -> f64 {
    let units = end / ROUND;
    let rounded = if end == low {
        units.ceil()
    } else {
        units.floor()
    } * ROUND;
    if rounded >= low && rounded <= high {
        rounded
    } else {
        end
    }
}

/// The attempt that got furthest; among those as far, the one closest to its limit.
fn least_bad(tried: &[Result<Clad, Obstacle>], angle: impl Fn(u32) -> f64) -> Infeasible {
    let score = |obstacle: &Obstacle| match obstacle {
        Obstacle::NotConvex(_) | Obstacle::Crowded(_) => 0.0,
        Obstacle::Flat(margin) => 0.5 * margin / CONVEXITY,
        Obstacle::NoCladding(_, TraceFailure::Congruent { .. }) => 1.0,
        Obstacle::NoCladding(_, TraceFailure::TurnsBack { at }) => 1.0 + 0.25 * (at[0] + at[1]),
        Obstacle::Overlap(_, [gap, needed]) => 2.0 + (gap / needed).clamp(0.0, 1.0),
        Obstacle::Sharp(sharpest) => 3.0 + sharpest / CROSSING,
        Obstacle::Slope(_, [low, high], _) => 4.0 + (low / high).clamp(0.0, 1.0),
    };
    let mut best = Infeasible {
        alpha: angle(0),
        obstacle: Obstacle::NotConvex(None),
    };
    for (k, attempt) in tried.iter().enumerate() {
        if let Err(obstacle) = attempt
            && (k == 0 || score(obstacle) > score(&best.obstacle))
        {
            best = Infeasible {
                alpha: angle(k as u32),
                obstacle: *obstacle,
            };
        }
    }
    best
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
mod tests {
    use super::super::fit::fitted;
    use super::*;

    const MODES: usize = 5;

    /// A curve over the plane: a chord with offsets in a sine basis.
    struct Curve {
        a: [f64; 2],
        b: [f64; 2],
        offsets: [f64; MODES],
    }

    impl Curve {
        /// Position over the plane and the length of the derivative on the dome
        /// z = 0.25 exp(-r^2 / (2 0.3^2)) around (0.5, 0.5).
        fn at(&self, t: f64) -> ([f64; 2], f64) {
            let [dx, dy] = [self.b[0] - self.a[0], self.b[1] - self.a[1]];
            let chord = libm::hypot(dx, dy);
            let (mut offset, mut slope) = (0.0, 0.0);
            for (k, c) in self.offsets.iter().enumerate() {
                let w = (k + 1) as f64 * std::f64::consts::PI;
                offset += c * libm::sin(w * t);
                slope += c * w * libm::cos(w * t);
            }
            let (x, y) = (
                self.a[0] + t * dx - offset * dy / chord,
                self.a[1] + t * dy + offset * dx / chord,
            );
            let (vx, vy) = (dx - slope * dy / chord, dy + slope * dx / chord);
            let (rx, ry) = (x - 0.5, y - 0.5);
            let z = 0.25 * libm::exp(-(rx * rx + ry * ry) / 0.18);
            let vz = -z * (rx * vx + ry * vy) / 0.09;
            ([x, y], (vx * vx + vy * vy + vz * vz).sqrt())
        }

        /// Arc length up to t, by Gauss's rule with three points a cell.
        fn length(&self, to: f64) -> f64 {
            let n = 48;
            let gauss = [
                (-0.774_596_669_241_483_4, 5.0),
                (0.0, 8.0),
                (0.774_596_669_241_483_4, 5.0),
            ];
            let cell = to / f64::from(n);
            (0..n / 3)
                .flat_map(|i| gauss.map(|(x, w)| (3.0 * cell * (f64::from(i) + 0.5 + 0.5 * x), w)))
                .map(|(t, w)| self.at(t).1 * w * 3.0 * cell / 18.0)
                .sum()
        }

        /// The geodesic between two points: Newton's method on the length.
        fn geodesic(a: [f64; 2], b: [f64; 2]) -> Self {
            let mut curve = Self {
                a,
                b,
                offsets: [0.0; MODES],
            };
            for _ in 0..5 {
                let h = 1e-3;
                let shifted = |i: usize, j: usize, si: f64, sj: f64| {
                    let mut offsets = curve.offsets;
                    offsets[i] += si * h;
                    offsets[j] += sj * h;
                    Curve { a, b, offsets }.length(1.0)
                };
                let gradient = nalgebra::SVector::<f64, MODES>::from_fn(|i, _| {
                    (shifted(i, i, 0.5, 0.5) - shifted(i, i, -0.5, -0.5)) / (2.0 * h)
                });
                let hessian = nalgebra::SMatrix::<f64, MODES, MODES>::from_fn(|i, j| {
                    let (i, j) = (i.min(j), i.max(j));
                    (shifted(i, j, 1.0, 1.0) - shifted(i, j, 1.0, -1.0) - shifted(i, j, -1.0, 1.0)
                        + shifted(i, j, -1.0, -1.0))
                        / (4.0 * h * h)
                });
                let step = hessian.lu().solve(&gradient).unwrap();
                for i in 0..MODES {
                    curve.offsets[i] -= step[i];
                }
            }
            curve
        }

        /// The point at a share of the arc length.
        fn point(&self, share: f64) -> [f64; 2] {
            let total = self.length(1.0);
            let mut t = share;
            for _ in 0..8 {
                t -= (self.length(t) - share * total) / self.at(t).1;
            }
            self.at(t).0
        }
    }

    /// The dome h = 0.25, sigma = 0.3 on the unit square; by its symmetry one table serves both
    /// families.
    fn dome_maps() -> (SideLengths, DistanceTable, DistanceTable) {
        let side = Curve::geodesic([0.0, 0.0], [1.0, 0.0]);
        let distance = |start, end| {
            let (p, q) = (side.point(start), side.point(end));
            Curve::geodesic(p, [q[0], 1.0 - q[1]]).length(1.0)
        };
        let length = side.length(1.0);
        let (table, _) = fitted(1e-5, distance);
        (
            SideLengths {
                ab: length,
                bc: length,
                cd: length,
                da: length,
            },
            table.clone(),
            table,
        )
    }

    const LOOSE: Demands = Demands {
        slope: [0.01, 100.0],
        members: [7, 7],
        width: 0.0,
    };

    #[test]
    fn the_dome_has_the_slopes_of_the_method_notes() {
        let (sides, u, v) = dome_maps();
        let maps = Maps {
            sides,
            u: &u,
            v: &v,
        };
        // The notes print two digits. Here finer tables and curves change the slopes by less than
        // 2e-3, so the distance to the notes is theirs, and grows towards the gap.
        for (degrees, low, high, within) in [
            (30.0, 0.70, 1.43, 0.03),
            (60.0, 0.53, 1.88, 0.04),
            (75.0, 0.26, 3.9, 0.06),
        ] {
            let clad = clad(&maps, &LOOSE, degrees * DEGREE).unwrap();
            let range = clad.u.slope_range();
            assert!(
                (range[0] / low - 1.0).abs() < within,
                "{degrees}: {range:?}"
            );
            assert!(
                (range[1] / high - 1.0).abs() < within,
                "{degrees}: {range:?}"
            );
            // Turned by 180 degrees the dome is itself, so the function is its own inverse.
            assert!(
                (range[0] * range[1] - 1.0).abs() < 2e-3,
                "{degrees}: {range:?}"
            );
        }
        let in_the_gap = clad(&maps, &LOOSE, 90.0 * DEGREE).unwrap_err();
        assert!(
            matches!(in_the_gap, Obstacle::NoCladding(..)),
            "{in_the_gap:?}"
        );
    }

    #[test]
    fn feasible_angles_lie_on_both_sides_of_a_gap_and_the_most_compact_is_taken() {
        let (sides, u, v) = dome_maps();
        let maps = Maps {
            sides,
            u: &u,
            v: &v,
        };
        let demands = Demands {
            slope: [0.5, 2.0],
            members: [7, 7],
            width: 0.05,
        };
        let choice = choose_angle(&maps, &demands);
        assert_eq!(choice.feasible.len(), 2, "{:?}", choice.feasible);
        let [left, right] = [choice.feasible[0], choice.feasible[1]];
        // The dome is symmetric: what holds at an angle holds at its supplement.
        assert!((left.0 + right.1 - std::f64::consts::PI).abs() < 1e-4);
        assert!(left.1 < 65.0 * DEGREE && right.0 > 115.0 * DEGREE);
        let taken = choice.taken.unwrap();
        assert!((taken.alpha - left.0).abs() < ROUND || (taken.alpha - right.1).abs() < ROUND);
        let tenths = taken.alpha / ROUND;
        assert!((tenths - tenths.round()).abs() < 1e-9);
        // One step further the lamellae would overlap.
        let further = clad(&maps, &demands, left.0 - 2.0 * LOCATE).unwrap_err();
        assert!(matches!(further, Obstacle::Overlap(..)), "{further:?}");
    }

    #[test]
    fn an_infeasible_patch_says_what_comes_closest() {
        let (sides, u, v) = dome_maps();
        let maps = Maps {
            sides,
            u: &u,
            v: &v,
        };
        let strict = Demands {
            slope: [0.95, 1.05],
            members: [7, 7],
            width: 0.05,
        };
        let choice = choose_angle(&maps, &strict);
        assert!(choice.feasible.is_empty());
        let Err(Infeasible {
            obstacle: Obstacle::Slope(_, [low, high], _),
            ..
        }) = choice.taken
        else {
            panic!("{:?}", choice.taken)
        };
        assert!(low < 0.95 && high > 1.05);
        let impossible = SideLengths {
            ab: 1.0,
            bc: 0.1,
            cd: 0.1,
            da: 0.1,
        };
        let none = choose_angle(
            &Maps {
                sides: impossible,
                u: &u,
                v: &v,
            },
            &strict,
        );
        assert_eq!(none.convex, None);
    }
}
