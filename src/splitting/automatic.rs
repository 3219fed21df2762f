//! Workflow 1 (paper, Algorithm 1): peaks that a family does not cover get a side over them, those
//! that neither covers a corner; when all peaks are covered, families whose members bunch are cut
//! in the same way.
//!
//! All infeasible patches of a round are cut at once, so what happens on one side of a symmetric
//! surface happens on the other.

use super::Proposal;
use super::appraise::{Appraisal, Limits};
use super::proposal::{against_bunching, against_shape, over_peak};
use super::split::{NoSplit, Workshop};

/// Rounds after which nothing new is to be expected: a side halved so often is a thousandth.
const ROUNDS: usize = 10;

/// Cuts until all patches are feasible or stuck.
pub(super) fn run(workshop: &mut Workshop<'_>) -> Result<(), NoSplit> {
    for _ in 0..ROUNDS {
        let cuts = proposals(workshop, cover)?;
        let cuts = if cuts.is_empty() {
            proposals(workshop, even_out)?
        } else {
            cuts
        };
        if cuts.is_empty() {
            break;
        }
        workshop.cut(&cuts)?;
    }
    Ok(())
}

type Rule = fn(&Appraisal, &Limits) -> Option<Proposal>;

fn proposals(workshop: &mut Workshop<'_>, rule: Rule) -> Result<Vec<(String, Proposal)>, NoSplit> {
    let limits = workshop.limits();
    let measured = workshop.appraise()?;
    Ok(workshop
        .draft
        .patches
        .iter()
        .zip(&measured)
        .filter(|(patch, _)| !workshop.stuck.contains_key(&patch.name))
        .filter_map(|(patch, measured)| {
            let proposal = rule(measured.as_ref().ok()?, &limits)?;
            Some((patch.name.clone(), proposal))
        })
        .collect())
}

/// Covers the highest peak that is not covered.
pub(super) fn cover(appraisal: &Appraisal, limits: &Limits) -> Option<Proposal> {
    let mut peaks = appraisal.feasibility.peaks.iter();
    peaks.find_map(|peak| over_peak(peak, limits.eta_max))
}

/// Cuts the families whose members bunch; a patch without any plan across its longer sides.
pub(super) fn even_out(appraisal: &Appraisal, limits: &Limits) -> Option<Proposal> {
    if appraisal.feasible(limits) || !appraisal.own_angle {
        return None;
    }
    let angles = appraisal.angles.as_ref()?;
    let Some(survey) = angles.survey else {
        return Some(against_shape(appraisal.lengths));
    };
    against_bunching(&appraisal.feasibility, survey.violates(limits.slope))
}
