//! What a workshop would find wrong with lamellae: openings too close to each other or to an end,
//! lamellae that lie on each other when flat.

use super::lamella::{Lamella, Opening, Section};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::grid as codes;
use crate::members::{Member, member_label};

/// Material that has to stay between two openings, in bolt diameters (method notes, section 5).
const WEB: f64 = 1.5;

/// Errors and warnings of the lamellae of a patch.
pub fn check_lamellae(lamellae: &[Lamella], section: &Section) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    for lamella in lamellae {
        let id = member_label(lamella.family, lamella.index);
        for pair in lamella.openings.windows(2) {
            told.extend(web_fault(&id, &pair[0], &pair[1], section));
        }
        let member_length = lamella.length - 2.0 * section.end_margin;
        for opening in &lamella.openings {
            let (from, to) = opening.extent();
            let free = (from + section.end_margin).min(member_length + section.end_margin - to);
            if free < 0.5 * opening.diameter {
                told.push(
                    Diagnostic::error(
                        codes::OPENING_AT_END,
                        format!(
                            "the opening for `{}` comes within {} of the end of lamella `{id}`",
                            opening.label(),
                            millimetres(free.max(0.0))
                        ),
                    )
                    .at_key(
                        ".end_margin",
                        "lamellae end this far beyond their last bolt",
                    )
                    .help("give `fabrication.end_margin` of at least the width of a lamella"),
                );
            }
        }
    }
    told
}

fn web_fault(id: &str, a: &Opening, b: &Opening, section: &Section) -> Option<Diagnostic> {
    let web = b.extent().0 - a.extent().1;
    let needed = WEB * section.bolt;
    let pair = format!("`{}` and `{}`", a.label(), b.label());
    if web <= 0.0 {
        let message = format!(
            "the openings for {pair} in lamella `{id}` overlap by {}",
            millimetres(-web)
        );
        let error = Diagnostic::error(codes::OPENINGS_OVERLAP, message);
        Some(
            error
                .at_key("", "in this patch")
                .help("take fewer members of the crossing family, or another `alpha`"),
        )
    } else if web < needed {
        let message = format!(
            "only {} stay between the openings for {pair} in lamella `{id}`; {} are wanted",
            millimetres(web),
            millimetres(needed)
        );
        let warning = Diagnostic::warning(codes::THIN_WEB, message);
        Some(warning.at_key("", "in this patch").note(format!(
            "{WEB} bolt diameters of {} should stay",
            millimetres(section.bolt)
        )))
    } else {
        None
    }
}

/// Neighbouring members of a family that are closer in the plane than the lamellae are wide.
pub fn check_flat_state(members: &[Member], section: &Section) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    for pair in members.windows(2) {
        let gap = least_distance(&pair[0], &pair[1]);
        if gap < section.width {
            let ids = [0, 1].map(|i| member_label(pair[i].family, pair[i].index));
            told.push(
                Diagnostic::warning(
                    codes::FLAT_OVERLAP,
                    format!(
                        "flat lamellae `{}` and `{}` are {} apart and {} wide",
                        ids[0],
                        ids[1],
                        millimetres(gap),
                        millimetres(section.width)
                    ),
                )
                .at_key("", "in this patch")
                .help("take fewer members, narrower lamellae or a larger `alpha`"),
            );
        }
    }
    told
}

/// Smallest distance of two straight members that do not cross: it stands at an end of one.
fn least_distance(a: &Member, b: &Member) -> f64 {
    let to_line = |p: nalgebra::Point2<f64>, line: &Member| {
        let along = (line.planar[1] - line.planar[0]).normalize();
        along.perp(&(p - line.planar[0])).abs()
    };
    [
        to_line(a.planar[0], b),
        to_line(a.planar[1], b),
        to_line(b.planar[0], a),
        to_line(b.planar[1], a),
    ]
    .into_iter()
    .fold(f64::INFINITY, f64::min)
}

fn millimetres(metres: f64) -> String {
    format!("{:.2} mm", metres * 1000.0)
}
