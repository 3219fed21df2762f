//! What splitting did and what it left, in words.

use super::appraise::{Appraisal, Limits, Measured};
use super::cut::Refusal;
use super::draft::{Draft, DraftPatch};
use super::split::Workshop;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::splitting as codes;
use crate::project::model::Family;

/// What was done to each patch of the project, and what is left infeasible.
pub(super) fn account(
    workshop: &Workshop<'_>,
    before: &Draft,
    start: &[Measured],
    end: &[Measured],
    weaves: bool,
) -> Vec<Diagnostic> {
    let limits = workshop.limits();
    let mut told = Vec::new();
    for (i, (patch, measured)) in before.patches.iter().zip(start).enumerate() {
        let parts: Vec<(&DraftPatch, &Measured)> = workshop
            .draft
            .patches
            .iter()
            .zip(end)
            .filter(|(part, _)| part.origin == patch.name)
            .collect();
        let key = format!(".draft.patches[{i}]");
        if parts.len() > 1
            && let Ok(appraisal) = measured
        {
            let names: Vec<String> = parts.iter().map(|(p, _)| format!("`{}`", p.name)).collect();
            told.push(
                Diagnostic::note_only(
                    codes::SPLIT,
                    format!(
                        "`{}` is split into {} patches: {}",
                        patch.name,
                        parts.len(),
                        reason(appraisal, &limits)
                    ),
                )
                .at_key(&key, "this patch")
                .about(&patch.name)
                .note(format!("they are {}", names.join(", "))),
            );
        }
        for (part, measured) in parts {
            let Ok(appraisal) = measured else { continue };
            if appraisal.settled(&limits) {
                continue;
            }
            let stays = if appraisal.feasible(&limits) {
                "larger than wanted"
            } else {
                "infeasible"
            };
            let why = workshop.stuck.get(&part.name);
            told.push(
                Diagnostic::warning(
                    codes::LEFT,
                    format!(
                        "`{}` stays {stays}: {}",
                        part.name,
                        reason(appraisal, &limits)
                    ),
                )
                .at_key(&key, "in this patch")
                .about(&part.name)
                .note(refusal_words(why.unwrap_or(&Refusal::NoHelp)))
                .help(refusal_advice(why.unwrap_or(&Refusal::NoHelp))),
            );
        }
    }
    if !weaves {
        told.push(
            Diagnostic::warning(
                codes::LEFT,
                "members through the corners of the parts do not go on in order in the patches \
                 beyond",
            )
            .at_key(".draft.patches[0]", "in the network from here")
            .help("give the strips more members, or cut the patches by hand where `egg split` cuts them"),
        );
    }
    told
}

/// What is violated, by how much and where.
fn reason(appraisal: &Appraisal, limits: &Limits) -> String {
    let feasibility = &appraisal.feasibility;
    let worst = feasibility.peaks.iter().find(|peak| {
        let over = |eta: &f64| *eta > limits.eta_max;
        peak.eta().iter().any(over)
    });
    if let Some(peak) = worst {
        let [u, v] = peak.eta();
        let at = peak.place;
        return format!(
            "η is {u:.4} for the u-family and {v:.4} for the v-family at the peak of curvature at \
             ({:.4}, {:.4}, {:.4}) m, the limit {}",
            at.x, at.y, at.z, limits.eta_max
        );
    }
    if let Some(wanted) = limits.max_side.filter(|_| appraisal.feasible(limits)) {
        let longest = appraisal.lengths.longest();
        return format!("its longest side is {longest:.4} m, `split.max_side` {wanted} m");
    }
    let Some(angles) = &appraisal.angles else {
        return "its peaks are not covered".to_owned();
    };
    match (&angles.taken, angles.survey) {
        (Ok(_), _) if !appraisal.own_angle => "its own `alpha` is not feasible".to_owned(),
        (Ok(_), _) => "its neighbours asked for it".to_owned(),
        (Err(why), _) => {
            let described = crate::cladding::explain(angles, why, false);
            described.message
        }
    }
}

fn refusal_words(refusal: &Refusal) -> String {
    match refusal {
        Refusal::Members(family) => format!(
            "the {}-family has too few members to share between two parts",
            letter(*family)
        ),
        Refusal::MinSide(least) => {
            format!("parts would have sides shorter than `split.min_side`, {least} m")
        }
        Refusal::MaxPatches(most) => {
            format!("there would be more patches than `split.max_patches`, {most}")
        }
        Refusal::Folded => "the parts would be no quadrilaterals".to_owned(),
        Refusal::NoHelp => "no cut makes it better".to_owned(),
        Refusal::Order(family) => format!(
            "members of the {}-family through its corners would not go on in order in its \
             neighbours",
            letter(*family)
        ),
    }
}

fn refusal_advice(refusal: &Refusal) -> &'static str {
    match refusal {
        Refusal::Members(_) | Refusal::Order(_) => "give the strip more members",
        Refusal::MinSide(_) => "allow shorter sides",
        Refusal::MaxPatches(_) => "allow more patches (`split.max_patches`)",
        Refusal::Folded | Refusal::NoHelp => "move its corners",
    }
}

fn letter(family: Family) -> char {
    match family {
        Family::U => 'u',
        Family::V => 'v',
    }
}
