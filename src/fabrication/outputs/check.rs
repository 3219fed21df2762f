//! Whether the parts of a plan can be made.

use super::Workshop;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Severity, Warned};
use crate::fabrication::hardware;
use crate::fabrication::lints::lints;
use crate::fabrication::units::MM;
use crate::plan::{OpeningRecord, Plan};

/// Whether the parts of a plan can be made and hold, and what a workshop should know.
pub fn check(plan: &Plan, workshop: &Workshop) -> Checked<()> {
    let mut told = hardware::check(&workshop.hardware);
    told.extend(kerf_errors(plan, workshop.kerf));
    told.extend(lints(&plan.lamellae, workshop));
    if told.iter().any(|d| d.severity == Severity::Error) {
        Err(told)
    } else {
        Ok(Warned {
            value: (),
            warnings: told,
        })
    }
}

fn kerf_errors(plan: &Plan, kerf: f64) -> Option<Diagnostic> {
    let (lamella, diameter) = plan
        .lamellae
        .iter()
        .flat_map(|lamella| lamella.openings.iter().map(move |o| (lamella, o)))
        .map(|(lamella, opening)| match opening {
            OpeningRecord::Hole { diameter, .. } | OpeningRecord::Notch { diameter, .. } => {
                (lamella, *diameter)
            }
        })
        .find(|(_, diameter)| *diameter <= kerf)?;
    Some(
        Diagnostic::error(
            codes::KERF_CLOSES_OPENING,
            format!(
                "an opening of {:.2} mm in `{}` is cut with a kerf of {:.2} mm",
                diameter * MM,
                lamella.id,
                kerf * MM
            ),
        )
        .at_key("fabrication.kerf", "wider than the opening")
        .about(&lamella.id),
    )
}
