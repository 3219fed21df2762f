//! What there is to say about supports: too steep, too large, too heavy, too low.

use super::lowest_member;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::fabrication::units::MM;
use crate::plan::{Plan, SupportRecord};
use crate::project::model::SupportKind;

/// What common printers print, metres.
const PRINTER: f64 = 0.25;
/// What one person carries, kilograms.
const CARRIED: f64 = 25.0;

/// Each cause is told once, at the first support that it is about.
pub(super) fn warnings(records: &[SupportRecord]) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    let group = |bad: &dyn Fn(&SupportRecord) -> bool| -> Option<(&SupportRecord, String)> {
        let mut found = records.iter().filter(|record| bad(record));
        let first = found.next()?;
        let others = match found.count() {
            0 => String::new(),
            1 => " and at another".to_owned(),
            n => format!(" and at {n} others"),
        };
        Some((first, others))
    };
    if let Some((steep, others)) = group(&|record| record.body.is_none()) {
        told.push(
            Diagnostic::warning(
                codes::SUPPORT_STEEP,
                format!(
                    "at `{}`{others} the contact face stands at {:.0} degrees: no foot is made",
                    steep.at, steep.tilt
                ),
            )
            .at_key("supports", "too steep for a foot")
            .help("bolt it to a wall or a post; place and normal stand in supports.csv")
            .about(&steep.at),
        );
    }
    let size = |record: &SupportRecord| {
        record.body.map_or(0.0, |body| {
            let rise = 0.5 * body.pad * libm::sin(record.tilt.to_radians());
            body.foot.max(record.height + rise)
        })
    };
    let printed = |record: &SupportRecord| record.kind == SupportKind::Printed;
    if let Some((large, others)) = group(&|r| printed(r) && size(r) > PRINTER) {
        told.push(
            Diagnostic::warning(
                codes::SUPPORT_LARGE,
                format!(
                    "the printed support at `{}`{others} is {:.0} mm large, common printers end \
                     at {:.0} mm",
                    large.at,
                    size(large) * MM,
                    PRINTER * MM
                ),
            )
            .at_key("supports.kind", "too large to print")
            .help("`kind = \"wedge-on-block\"`, or a post with a short printed head on it")
            .about(&large.at),
        );
    }
    let mass = |record: &SupportRecord| record.body.map_or(0.0, |body| body.mass);
    if let Some((heavy, others)) = group(&|r| mass(r) > CARRIED) {
        told.push(
            Diagnostic::warning(
                codes::SUPPORT_HEAVY,
                format!(
                    "the support at `{}`{others} weighs {:.0} kg, one person carries {CARRIED:.0}",
                    heavy.at,
                    mass(heavy)
                ),
            )
            .at_key("supports.kind", "heavy")
            .note(format!(
                "its contact face is {:.0} mm above the ground",
                heavy.height * MM
            ))
            .help(heavy_help(heavy.kind))
            .about(&heavy.at),
        );
    }
    told
}

/// What makes blocks lighter, or easier to move.
fn heavy_help(kind: SupportKind) -> &'static str {
    match kind {
        SupportKind::WedgeOnBlock => {
            "a smaller `height` in `[supports]` makes blocks lower; cast heavy ones where they stand"
        }
        _ => {
            "a smaller `height` in `[supports]` makes blocks lower, `kind = \"wedge-on-block\"` has \
             wood on top of them; cast heavy ones where they stand"
        }
    }
}

/// The lowest point of the members if it lies below the ground.
pub(super) fn below_ground(
    plan: &Plan,
    ground: f64,
    records: &[SupportRecord],
) -> Option<Diagnostic> {
    if records.iter().all(|record| record.body.is_none()) {
        return None;
    }
    let (member, lowest) = lowest_member(plan)?;
    let depth = ground - lowest;
    (depth > 1e-9).then(|| {
        Diagnostic::warning(
            codes::GRID_BELOW_GROUND,
            format!(
                "the grid dips {:.0} mm below the level ground, on `{}`",
                libm::ceil(depth * MM),
                member.id
            ),
        )
        .at_key("supports.height", "too low for the grid")
        .help(format!(
            "raise the supports by {:.0} mm, or support the structure where it is lowest",
            libm::ceil(depth * MM)
        ))
        .about(&member.id)
    })
}
