//! Words for patches that cannot be clad: what stands against them, with numbers, and what to
//! change.
//!
//! Key paths begin with a dot: they name fields of the stage's input (`alpha`, `slope`,
//! `members`, `width`), which the build translates into the project's keys.

use super::{AngleChoice, Crowded, Infeasible, Obstacle, TraceFailure};
use crate::diagnostics::codes::cladding as codes;
use crate::diagnostics::{Code, Diagnostic};
use crate::project::model::Family;

/// Says why a patch has no plan. `given` tells whether the user chose the angle.
pub fn explain(choice: &AngleChoice, infeasible: &Infeasible, given: bool) -> Diagnostic {
    let angle = degrees(infeasible.alpha);
    let at = if given {
        format!("with the planar angle of {angle}")
    } else {
        format!("at any planar angle; {angle} comes closest")
    };
    let (code, message, key, label, help) = describe(&infeasible.obstacle, &at);
    let mut diagnostic = Diagnostic::error(code, message);
    let by_angle = !matches!(infeasible.obstacle, Obstacle::Crowded(_));
    diagnostic = match key {
        _ if given && by_angle => diagnostic.at_key(".alpha", "this angle does not work"),
        "." => diagnostic.at_key(key, label),
        _ => diagnostic.at_key(".", "in this patch").at_key(key, label),
    };
    if !by_angle {
        return diagnostic.help(help);
    }
    if let Some((low, high)) = choice.convex {
        diagnostic = diagnostic.note(format!(
            "plans are convex between {} and {}",
            degrees(low),
            degrees(high)
        ));
    }
    if given && !choice.feasible.is_empty() {
        let intervals: Vec<String> = choice
            .feasible
            .iter()
            .map(|(low, high)| format!("{} to {}", degrees(*low), degrees(*high)))
            .collect();
        return diagnostic
            .note(format!("feasible angles: {}", intervals.join(", ")))
            .help("choose a feasible angle, or say `alpha = \"auto\"` for the most compact plan");
    }
    diagnostic.help(help)
}

type Words = (Code, String, &'static str, &'static str, String);

fn describe(obstacle: &Obstacle, at: &str) -> Words {
    let split = "move the corners so that the patch covers less of the curvature, or split it (`egg split`)";
    match *obstacle {
        Obstacle::NotConvex(_) => (
            codes::NO_PLAN,
            format!("the patch has no convex plan: its four sides do not close {at}"),
            ".",
            "sides of these lengths make no convex quadrilateral",
            "move the corners so that no side is as long as the other three together".into(),
        ),
        Obstacle::Flat(margin) => (
            codes::NO_PLAN,
            format!(
                "the patch has no plan {at}: a corner is within {} of a straight angle",
                degrees(margin)
            ),
            ".",
            "opposite sides differ too much in length",
            "move the corners so that opposite sides are of similar length".into(),
        ),
        Obstacle::NoCladding(family, TraceFailure::TurnsBack { at: shares }) => (
            codes::NO_CLADDING,
            format!(
                "the patch has no cladding function of the {}-family {at}: equal lengths \
                 exist only up to {:.0} % of its start side and {:.0} % of its end side",
                letter(family),
                100.0 * shares[0],
                100.0 * shares[1]
            ),
            ".",
            "this patch cannot be covered by members of equal length",
            split.into(),
        ),
        Obstacle::NoCladding(family, TraceFailure::Congruent { at: shares }) => (
            codes::CONGRUENT,
            format!(
                "the patch is as wide in the plane as on the surface {at}: near {:.0} % of \
                 the start side the lengths of the {}-family single out no members",
                100.0 * shares[0],
                letter(family)
            ),
            ".",
            "this plan is nearly congruent to the patch",
            "take an angle further from the one on the surface".into(),
        ),
        Obstacle::Crowded(Crowded {
            family,
            side: [from, to],
            length,
            needed,
            members,
        }) => (
            codes::OVERLAP,
            format!(
                "side {from}-{to} of the patch is {} long, but the {members} members of the \
                 {}-family need {} to lie side by side",
                millimetres(length),
                letter(family),
                millimetres(needed)
            ),
            ".members",
            "so many members begin or end on that side",
            "take fewer members or narrower lamellae, or move the corners of that side apart"
                .into(),
        ),
        Obstacle::Slope(family, [low, high], [least, most]) => (
            codes::SLOPE,
            format!(
                "members of the patch bunch {at}: the cladding function of the {}-family \
                 has slopes from {low:.2} to {high:.2}, where {least} to {most} is allowed",
                letter(family)
            ),
            ".slope",
            "these are the bounds",
            format!(
                "{split}; or allow slopes down to {:.2} and up to {:.2}",
                (100.0 * low).floor() / 100.0,
                (100.0 * high).ceil() / 100.0
            ),
        ),
        Obstacle::Overlap(family, [gap, needed]) => (
            codes::OVERLAP,
            format!(
                "flat lamellae overlap {at}: members of the {}-family come as \
                 close as {} where {} are needed",
                letter(family),
                millimetres(gap),
                millimetres(needed)
            ),
            ".members",
            "so many members lie side by side in the flat state",
            "take fewer members or narrower lamellae".into(),
        ),
        Obstacle::Sharp(angle) => (
            codes::SHARP,
            format!("members cross at {} in the plane {at}", degrees(angle)),
            ".",
            "no bolt holds lamellae apart that cross at so small an angle",
            "move the corners so that opposite sides are of similar length".into(),
        ),
    }
}

fn letter(family: Family) -> char {
    match family {
        Family::U => 'u',
        Family::V => 'v',
    }
}

fn degrees(radians: f64) -> String {
    format!("{:.1}°", radians.to_degrees())
}

fn millimetres(metres: f64) -> String {
    format!("{:.1} mm", metres * 1000.0)
}
