//! Whether the flat state can lie flat.

use super::lamella::Section;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::grid as codes;
use crate::members::{Member, member_label};

/// Other pairs that are named beside the closest one.
const NAMED: usize = 4;

/// Neighbouring members of a family that are closer in the plane than the lamellae are wide: the
/// closest pair, with the others.
pub fn check_flat_state(members: &[Member], section: &Section) -> Option<Diagnostic> {
    let mut close: Vec<(f64, String)> = members
        .windows(2)
        .map(|pair| {
            let ids = [0, 1].map(|i| member_label(pair[i].family, pair[i].index));
            let place = format!("`{}` and `{}`", ids[0], ids[1]);
            (least_distance(&pair[0], &pair[1]), place)
        })
        .filter(|(gap, _)| *gap < section.width)
        .collect();
    close.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ((gap, place), others) = close.split_first()?;
    let told = Diagnostic::warning(
        codes::FLAT_OVERLAP,
        format!(
            "flat lamellae {place} are {} apart and {} wide",
            millimetres(*gap),
            millimetres(section.width)
        ),
    )
    .at_key(".", "in this patch")
    .help("take fewer members, narrower lamellae or a larger `alpha`");
    if others.is_empty() {
        return Some(told);
    }
    let named = others.iter().take(NAMED);
    let mut list: Vec<String> = named
        .map(|(gap, place)| format!("{place} are {} apart", millimetres(*gap)))
        .collect();
    if others.len() > NAMED {
        list.push(format!("{} more pairs are too close", others.len() - NAMED));
    }
    Some(told.note(list.join("; ")))
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
