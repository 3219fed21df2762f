//! The search for an angle: which ones are feasible, and which one is taken.

use super::{CONVEXITY, CROSSING, Clad, DEGREE, Demands, Maps, Obstacle, clad};
use crate::cladding::{PlanarQuad, Survey, TraceFailure, survey};
use serde::{Deserialize, Serialize};

/// Step of the scan, radians: a quarter of a degree.
const SCAN: f64 = 0.25 * DEGREE;
/// Ends of feasible intervals are located this well, radians.
pub(super) const LOCATE: f64 = 0.002 * DEGREE;
/// The chosen angle is rounded to this, radians: an angle that people can write down and that does
/// not move with the last digits of the surface.
pub(super) const ROUND: f64 = 0.1 * DEGREE;
/// A later interval has to beat an earlier one by this much: symmetric patches take the acute
/// angle, whatever the rounding of their mesh.
const CLEARLY: f64 = 0.99;

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
