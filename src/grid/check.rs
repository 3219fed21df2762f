//! What a workshop would find wrong with lamellae: openings too close to each other or to an end,
//! lamellae that lie on each other when flat.

use super::lamella::{Lamella, Section};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::grid as codes;
use crate::members::{Member, member_label};

/// Material that has to stay between two openings, in bolt diameters (method notes, section 5).
const WEB: f64 = 1.5;

/// Other places with the same fault that are named beside the worst one.
const NAMED: usize = 4;

/// Errors and warnings of the lamellae of a patch: of each kind the worst one, with the places of
/// the others.
pub fn check_lamellae(lamellae: &[Lamella], section: &Section) -> Vec<Diagnostic> {
    let mut overlaps = Vec::new();
    let mut ends = Vec::new();
    let mut webs = Vec::new();
    for lamella in lamellae {
        let id = member_label(lamella.family, lamella.index);
        for pair in lamella.openings.windows(2) {
            let web = pair[1].extent().0 - pair[0].extent().1;
            let names = format!("`{}` and `{}`", pair[0].label(), pair[1].label());
            let place = format!("the openings for {names} in lamella `{id}`");
            if web <= 0.0 {
                overlaps.push((web, place));
            } else if web < WEB * section.bolt {
                webs.push((web, place));
            }
        }
        let member_length = lamella.length - 2.0 * section.end_margin;
        for opening in &lamella.openings {
            let (from, to) = opening.extent();
            let free = (from + section.end_margin).min(member_length + section.end_margin - to);
            if free < 0.5 * opening.diameter {
                let label = opening.label();
                ends.push((free, format!("the opening for `{label}` in lamella `{id}`")));
            }
        }
    }
    let mut told = Vec::new();
    told.extend(worst(overlaps, |web, place| {
        let message = format!("{place} overlap by {}", millimetres(-web));
        Diagnostic::error(codes::OPENINGS_OVERLAP, message)
            .at_key(".", "in this patch")
            .help("take fewer members of the crossing family, or another `alpha`")
    }));
    told.extend(worst(ends, |free, place| {
        let message = if free > 0.0 {
            format!("{place} leaves {} to its end", millimetres(free))
        } else {
            format!("{place} reaches {} beyond its end", millimetres(-free))
        };
        Diagnostic::error(codes::OPENING_AT_END, message)
            .at_key(
                ".end_margin",
                "lamellae end this far beyond their last bolt",
            )
            .at_key(".", "in this patch")
            .help("give `fabrication.end_margin` of at least the width of a lamella")
    }));
    told.extend(worst(webs, |web, place| {
        let message = format!("{place} leave only {} between them", millimetres(web));
        Diagnostic::warning(codes::THIN_WEB, message)
            .at_key(".", "in this patch")
            .note(format!(
                "{WEB} bolt diameters, {}, should stay",
                millimetres(WEB * section.bolt)
            ))
    }));
    told
}

/// Tells the finding with the least room, metres, and where else there is one of its kind.
fn worst(
    mut findings: Vec<(f64, String)>,
    tell: impl Fn(f64, &str) -> Diagnostic,
) -> Option<Diagnostic> {
    findings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ((room, place), others) = findings.split_first()?;
    let told = tell(*room, place);
    let named = others.iter().take(NAMED);
    let mut lines: Vec<String> = named
        .map(|(room, place)| format!("{place}: {}", millimetres(*room)))
        .collect();
    match others.len().saturating_sub(NAMED) {
        0 => {}
        1 => lines.push("1 other".to_owned()),
        more => lines.push(format!("{more} others")),
    }
    Some(if lines.is_empty() {
        told
    } else {
        told.note(format!("the same at\n{}", lines.join("\n")))
    })
}

/// Neighbouring members of a family that are closer in the plane than the lamellae are wide: the
/// closest pair, with the others.
pub fn check_flat_state(members: &[Member], section: &Section) -> Vec<Diagnostic> {
    let close = members
        .windows(2)
        .map(|pair| {
            let ids = [0, 1].map(|i| member_label(pair[i].family, pair[i].index));
            let place = format!("flat lamellae `{}` and `{}`", ids[0], ids[1]);
            (least_distance(&pair[0], &pair[1]), place)
        })
        .filter(|(gap, _)| *gap < section.width)
        .collect();
    let told = worst(close, |gap, place| {
        let message = format!(
            "{place} are {} apart and {} wide",
            millimetres(gap),
            millimetres(section.width)
        );
        Diagnostic::warning(codes::FLAT_OVERLAP, message)
            .at_key(".", "in this patch")
            .help("take fewer members, narrower lamellae or a larger `alpha`")
    });
    told.into_iter().collect()
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
