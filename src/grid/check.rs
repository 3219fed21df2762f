//! Whether the flat state can lie flat.

use super::lamella::Section;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::grid as codes;
use crate::members::{Member, member_label};

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
