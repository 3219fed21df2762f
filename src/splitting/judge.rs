//! Criteria of a patch held against the project's limits, in words: what is violated, by how
//! much, where on the surface, and how the patch can be split.

use super::proposal::{Proposal, against_bunching, over_peak};
use super::{Feasibility, JudgedPeak};
use crate::cladding::{AngleChoice, Clad};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::{cladding, splitting};
use crate::project::model::Family;
use crate::surface::Point3;
use serde::{Deserialize, Serialize};

/// What a patch is judged by, and how it is called.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Criteria {
    /// Largest feasible η.
    pub eta_max: f64,
    /// Bounds of the slopes of cladding functions.
    pub slope: [f64; 2],
    /// Name of the patch, which proposals begin with.
    pub patch: String,
    /// Names of its corners.
    pub corners: [String; 4],
}

/// Findings about a patch. `clad` is its plan, if it has one; without one a note proposes where to
/// split.
pub fn judge(
    feasibility: &Feasibility,
    angles: &AngleChoice,
    clad: Option<&Clad>,
    criteria: &Criteria,
) -> Vec<Diagnostic> {
    let mut told: Vec<Diagnostic> = feasibility
        .peaks
        .iter()
        .filter_map(|peak| uncovered(peak, criteria))
        .collect();
    match clad {
        Some(clad) => told.extend(diagonals(feasibility, clad)),
        None if told.is_empty() => told.extend(proposed(feasibility, angles, criteria)),
        None => {}
    }
    told
}

fn uncovered(peak: &JudgedPeak, criteria: &Criteria) -> Option<Diagnostic> {
    let proposal = over_peak(peak, criteria.eta_max)?;
    let [u, v] = peak.eta();
    let message = format!(
        "members pass beside the peak of curvature at {}: η is {u:.4} for the u-family and {v:.4} \
         for the v-family, the limit {}",
        place(&peak.place),
        criteria.eta_max
    );
    Some(
        Diagnostic::warning(cladding::UNCOVERED, message)
            .at_key(".", "this patch")
            .help(words(&proposal, criteria)),
    )
}

fn diagonals(feasibility: &Feasibility, clad: &Clad) -> Option<Diagnostic> {
    let [e, f] = feasibility.diagonals;
    let [e_planar, f_planar] = clad.quad.diagonals();
    ((e - e_planar) * (f - f_planar) >= 0.0).then(|| {
        Diagnostic::warning(
            cladding::DIAGONALS,
            format!(
                "both diagonals change in the same direction: {e:.4} m to {e_planar:.4} m and \
                 {f:.4} m to {f_planar:.4} m when flat"
            ),
        )
        .at_key(".", "this patch")
        .help("choose another `alpha`")
    })
}

fn proposed(
    feasibility: &Feasibility,
    angles: &AngleChoice,
    criteria: &Criteria,
) -> Option<Diagnostic> {
    let survey = angles.survey?;
    let bunching = survey.violates(criteria.slope);
    let proposal = against_bunching(feasibility, bunching)?;
    let [least, most] = criteria.slope;
    let slopes: Vec<String> = ["u", "v"]
        .into_iter()
        .zip(survey.slopes)
        .zip(bunching)
        .filter(|(_, bunches)| *bunches)
        .map(|((family, slopes), _)| match slopes {
            Some([low, high]) => {
                format!("slopes of the {family}-family from {low:.2} to {high:.2}")
            }
            None => format!("no cladding function of the {family}-family"),
        })
        .collect();
    Some(
        Diagnostic::note_only(
            splitting::PROPOSAL,
            format!(
                "at its best angle, {:.1}°, the patch has {}, where {least} to {most} is allowed; \
                 its curvature is highest at {}",
                survey.alpha.to_degrees(),
                slopes.join(" and "),
                place(&feasibility.peak)
            ),
        )
        .at_key(".", "this patch")
        .help(words(&proposal, criteria)),
    )
}

/// A proposal in terms of the project file.
fn words(proposal: &Proposal, criteria: &Criteria) -> String {
    let Criteria { patch, corners, .. } = criteria;
    // Corners at the ends of the sides AB, BC, DC and AD in their directions, and the side's number.
    let side = |number: usize, at: f64| {
        let (i, j) = [(0, 1), (1, 2), (3, 2), (0, 3)][number];
        let name = ["12", "23", "34", "41"][number];
        let [from, to] = [i, j].map(|k: usize| &corners[k]);
        let at = (at * 1000.0).round() / 1000.0;
        format!("`{patch}-s{name} = {{ on = [\"{from}\", \"{to}\"], at = {at} }}`")
    };
    match *proposal {
        Proposal::Edge { along, from, to } => {
            let ends = match along {
                Family::U => [side(0, from), side(2, to)],
                Family::V => [side(3, from), side(1, to)],
            };
            format!(
                "split the patch by a side over the peak, between the points {} and {}; `egg \
                 split` writes the patches",
                ends[0], ends[1]
            )
        }
        Proposal::Corner { at, shares } => {
            let ends: Vec<String> = (0..4).map(|k| side(k, shares[k])).collect();
            format!(
                "put a corner at {} with sides to the points {}; `egg split` writes the patches",
                place(&at),
                ends.join(", ")
            )
        }
    }
}

fn place(at: &Point3) -> String {
    format!("({:.4}, {:.4}, {:.4}) m", at.x, at.y, at.z)
}
