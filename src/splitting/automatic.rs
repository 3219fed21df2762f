//! Workflow 1 (paper, Algorithm 1): peaks that a family does not cover get a side over them, those
//! that neither covers a corner; when all peaks are covered, families whose members bunch are cut
//! in the same way, and at last what is larger than the designer wants.
//!
//! All infeasible patches of a round are cut at once, so what happens on one side of a symmetric
//! surface happens on the other.

use super::Proposal;
use super::appraise::{Appraisal, Limits};
use super::proposal::{against_bunching, against_shape, against_size, between_twins, over_peak};
use super::split::{NoSplit, Workshop};

/// Rounds after which nothing new is to be expected: a side halved so often is a thousandth.
const ROUNDS: usize = 10;

/// Cuts until all patches are feasible or stuck.
pub(super) fn run(workshop: &mut Workshop<'_>) -> Result<(), NoSplit> {
    for _ in 0..ROUNDS {
        let mut cuts = Vec::new();
        for rule in [cover, even_out, downsize] {
            cuts = proposals(workshop, rule)?;
            if !cuts.is_empty() {
                break;
            }
        }
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

/// Covers the highest peak that is not covered; twins are parted first.
fn cover(appraisal: &Appraisal, limits: &Limits) -> Option<Proposal> {
    if let Some(between) = twins(appraisal, limits) {
        return Some(between);
    }
    let mut peaks = appraisal.feasibility.peaks.iter();
    peaks.find_map(|peak| over_peak(peak, limits.eta_max))
}

/// Parts two peaks that are mirror images of each other and that are not covered: what is done about
/// each of them then is the same.
pub(super) fn twins(appraisal: &Appraisal, limits: &Limits) -> Option<Proposal> {
    between_twins(&appraisal.feasibility, limits.eta_max)
}

/// Cuts a patch that is larger than the designer wants.
pub(super) fn downsize(appraisal: &Appraisal, limits: &Limits) -> Option<Proposal> {
    let wanted = limits.max_side?;
    let large = appraisal.too_large(limits) && appraisal.own_angle;
    large.then(|| against_size(appraisal.lengths, wanted))
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
