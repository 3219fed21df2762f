//! All criteria of a patch in one record, for the table of `egg check` and for scripts. It is there
//! for infeasible patches too, as far as they could be measured.

use super::{Criteria, Feasibility};
use crate::cladding::{AngleChoice, Clad, Infeasible, Obstacle};
use crate::layout::Domain;
use crate::project::model::Family;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Criteria of a patch. Lengths in metres, angles in degrees, curvature in 1/m².
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PatchCheck {
    /// Name of the patch.
    pub patch: String,
    /// Names of its corners.
    pub corners: [String; 4],
    /// Whether all criteria hold.
    pub feasible: bool,
    /// Short names of the criteria that do not hold.
    pub violated: Vec<String>,
    /// Members per family, boundary members included.
    pub members: PerFamily<u32>,
    /// Lengths of the sides 1-2, 2-3, 3-4, 4-1; none if the patch is no quadrilateral.
    pub sides: Option<[f64; 4]>,
    /// Coverage of the peaks.
    pub eta: Option<PerFamily<f64>>,
    /// Its limit.
    pub eta_max: f64,
    /// All significant peaks inside, highest first.
    pub peaks: Vec<PeakCheck>,
    /// Highest curvature inside.
    pub curvature_max: Option<f64>,
    /// Shorter geodesics are unique; none where the patch is nowhere domed.
    pub injectivity_bound: Option<f64>,
    /// The longest geodesic between opposite sides.
    pub longest_geodesic: Option<f64>,
    /// Diagonals 1-3 and 2-4.
    pub diagonals: Option<DiagonalCheck>,
    /// Least and greatest slope of the cladding functions: of the plan that is taken, or where
    /// they come closest to the bounds.
    pub slopes: PerFamily<Option<[f64; 2]>>,
    /// Their bounds.
    pub slope_bounds: [f64; 2],
    /// Angle at the first corner.
    pub angle: AngleCheck,
}

/// A value of each family.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PerFamily<T> {
    /// Of the u-family.
    pub u: T,
    /// Of the v-family.
    pub v: T,
}

impl<T> From<[T; 2]> for PerFamily<T> {
    fn from([u, v]: [T; 2]) -> Self {
        Self { u, v }
    }
}

/// A significant peak of curvature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PeakCheck {
    /// Where it is.
    pub place: [f64; 3],
    /// Gaussian curvature there.
    pub gaussian: f64,
    /// η of both families.
    pub eta: PerFamily<f64>,
}

/// Diagonals on the surface and in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DiagonalCheck {
    /// On the surface.
    pub surface: [f64; 2],
    /// In the plane, if there is a plan.
    pub planar: Option<[f64; 2]>,
    /// Whether one gets longer and the other shorter.
    pub exchange: Option<bool>,
}

/// The angle at the first corner.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AngleCheck {
    /// On the surface.
    pub surface: Option<f64>,
    /// In the plan that is taken.
    pub planar: Option<f64>,
    /// Where plans are convex.
    pub convex: Option<[f64; 2]>,
    /// Where plans are feasible.
    pub feasible: Vec<[f64; 2]>,
}

/// What was found about a patch, as far as it could be measured.
#[derive(Debug, Clone, Copy, Default)]
pub struct Findings<'a> {
    /// Its domain, if it is a quadrilateral.
    pub domain: Option<&'a Domain>,
    /// Curvature, coverage, diagonals.
    pub feasibility: Option<&'a Feasibility>,
    /// The search for an angle.
    pub angles: Option<&'a AngleChoice>,
    /// The plan.
    pub clad: Option<&'a Clad>,
}

/// Puts the criteria of a patch together.
pub fn check(findings: &Findings<'_>, criteria: &Criteria, members: [u32; 2]) -> PatchCheck {
    let Findings {
        domain,
        feasibility,
        angles,
        clad,
    } = *findings;
    let slopes = match clad {
        Some(clad) => [Family::U, Family::V].map(|f| Some(clad.function(f).slope_range())),
        None => angles
            .and_then(|a| a.survey)
            .map_or([None; 2], |survey| survey.slopes),
    };
    let diagonals = feasibility.map(|f| {
        let planar = clad.map(|clad| clad.quad.diagonals());
        DiagonalCheck {
            surface: f.diagonals,
            planar,
            exchange: planar.map(|[e, g]| (f.diagonals[0] - e) * (f.diagonals[1] - g) < 0.0),
        }
    });
    let degrees = |(low, high): (f64, f64)| [low.to_degrees(), high.to_degrees()];
    let violated = violated(findings, criteria, diagonals.and_then(|d| d.exchange));
    PatchCheck {
        patch: criteria.patch.clone(),
        corners: criteria.corners.clone(),
        feasible: violated.is_empty(),
        violated,
        members: members.into(),
        sides: domain.map(|d| d.lengths().to_array()),
        eta: feasibility.map(|f| f.eta().into()),
        eta_max: criteria.eta_max,
        peaks: feasibility.map_or_else(Vec::new, |f| {
            f.peaks
                .iter()
                .map(|peak| PeakCheck {
                    place: [peak.place.x, peak.place.y, peak.place.z],
                    gaussian: peak.gaussian,
                    eta: peak.eta().into(),
                })
                .collect()
        }),
        curvature_max: feasibility.map(|f| f.curvature_max),
        injectivity_bound: feasibility.and_then(Feasibility::injectivity_bound),
        longest_geodesic: feasibility.map(|f| f.longest),
        diagonals,
        slopes: slopes.into(),
        slope_bounds: criteria.slope,
        angle: AngleCheck {
            surface: domain.and_then(Domain::angle_at_a).map(f64::to_degrees),
            planar: clad.map(|c| c.alpha.to_degrees()),
            convex: angles.and_then(|a| a.convex).map(degrees),
            feasible: angles.map_or_else(Vec::new, |a| {
                a.feasible.iter().copied().map(degrees).collect()
            }),
        },
    }
}

fn violated(findings: &Findings<'_>, criteria: &Criteria, exchange: Option<bool>) -> Vec<String> {
    let mut violated: Vec<&str> = Vec::new();
    if findings.domain.is_none() {
        return vec!["layout".to_owned()];
    }
    match findings.feasibility {
        None => violated.push("geodesics"),
        Some(feasibility) => {
            let [u, v] = feasibility.eta().map(|eta| eta > criteria.eta_max);
            violated.extend(u.then_some("eta u"));
            violated.extend(v.then_some("eta v"));
        }
    }
    match (findings.clad, findings.angles) {
        (Some(_), _) => {}
        (None, None) => violated.push("no plan"),
        (None, Some(angles)) => violated.extend(against(angles, criteria)),
    }
    if exchange == Some(false) {
        violated.push("diagonals");
    }
    violated.into_iter().map(str::to_owned).collect()
}

/// What stands against all plans of a patch, each in a word or two.
fn against(angles: &AngleChoice, criteria: &Criteria) -> Vec<&'static str> {
    let obstacle = match &angles.taken {
        Ok(_) => return vec!["alpha"],
        Err(Infeasible { obstacle, .. }) => obstacle,
    };
    match obstacle {
        Obstacle::NotConvex(_) | Obstacle::Flat(_) => vec!["convexity"],
        Obstacle::Crowded(_) | Obstacle::Overlap(..) => vec!["overlap"],
        Obstacle::Sharp(_) => vec!["crossing angle"],
        Obstacle::NoCladding(family, _) => vec![["cladding u", "cladding v"][*family as usize]],
        Obstacle::Slope(family, ..) => {
            // The search stops at the first family that bunches; the survey knows both.
            let surveyed = angles.survey.map(|s| s.violates(criteria.slope));
            let mut bunching = surveyed.unwrap_or_default();
            bunching[*family as usize] = true;
            let names = ["slope u", "slope v"].into_iter().zip(bunching);
            names
                .filter_map(|(name, bunches)| bunches.then_some(name))
                .collect()
        }
    }
}
