//! Whether four sides make a quadrilateral.

use super::{Domain, Side, place};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::layout as codes;
use crate::geodesic::{Curve, angle_between, crossings};
use crate::surface::Tangent;

/// A corner with an angle below this, or that close to a straight one, is none, radians.
const CORNER: f64 = 0.02;

/// Faults of a patch as a quadrilateral on the surface. Corners are counted from 1; key paths
/// and names are those of the field `corners`.
pub fn check_quad(domain: &Domain) -> Vec<Diagnostic> {
    let mut faults = crossing_sides(domain);
    if faults.is_empty() {
        faults = folded_corners(domain);
    }
    faults
}

/// Interior angles at A, B, C, D, radians in (0, 2 pi); `None` where they cannot be measured.
fn corner_angles(domain: &Domain) -> [Option<f64>; 4] {
    let start = |side: &Side| side.path().start;
    let end = |side: &Side| {
        let arriving = side.path().end;
        Tangent {
            face: arriving.face,
            direction: -arriving.direction,
        }
    };
    let tangents = [
        (start(&domain.ab), start(&domain.ad)),
        (end(&domain.ab), start(&domain.bc)),
        (end(&domain.bc), end(&domain.dc)),
        (start(&domain.dc), end(&domain.ad)),
    ];
    let corners = domain.corners();
    let (turns, around) = (domain.corners_turn_left(), domain.turns_left());
    std::array::from_fn(|i| {
        let angle = angle_between(domain.mesh(), &corners[i], &tangents[i].0, &tangents[i].1)?;
        Some(if turns[i] == around {
            angle
        } else {
            2.0 * std::f64::consts::PI - angle
        })
    })
}

fn folded_corners(domain: &Domain) -> Vec<Diagnostic> {
    let mut faults = Vec::new();
    let corners = domain.corners();
    for (i, angle) in corner_angles(domain).into_iter().enumerate() {
        let Some(angle) = angle else { continue };
        let degrees = angle.to_degrees();
        let (number, at) = (i + 1, place(corners[i].position(domain.mesh())));
        let (message, help) = if angle > std::f64::consts::PI + CORNER {
            (
                format!(
                    "patch {{.}} turns inwards at corner {number} {{.corners[{i}]}} at {at}: its \
                     sides meet there at {degrees:.1}°"
                ),
                "move the corner outwards, or make two patches that meet there: members across a \
                 corner of more than 180° would leave the patch",
            )
        } else if !(CORNER..=std::f64::consts::PI - CORNER).contains(&angle) {
            (
                format!(
                    "patch {{.}} has no corner {number} {{.corners[{i}]}} at {at}: its sides meet \
                     there at {degrees:.1}°"
                ),
                "list the corners in order around the patch, and keep them apart",
            )
        } else {
            continue;
        };
        faults.push(
            Diagnostic::error(codes::FOLDED, message)
                .at_key(format!(".corners[{i}]"), "this corner")
                .help(help),
        );
    }
    faults
}

fn crossing_sides(domain: &Domain) -> Vec<Diagnostic> {
    let mesh = domain.mesh();
    let sides = [&domain.ab, &domain.bc, &domain.dc, &domain.ad];
    let curves = sides.map(|side| Curve::new(mesh, &side.path().points));
    let name = |i: usize| {
        let next = (i + 1) % 4;
        format!(
            "{}-{} (from {{.corners[{i}]}} to {{.corners[{next}]}})",
            i + 1,
            next + 1
        )
    };
    let mut faults = Vec::new();
    for i in 0..4 {
        for j in i + 1..4 {
            let neighbours = j == i + 1 || (i, j) == (0, 3);
            let apart = 1e-6 * curves[i].length();
            let inner = crossings(&curves[i], &curves[j]).into_iter().find(|hit| {
                // Neighbouring sides share a corner.
                let at_end = |s: f64, length: f64| s < apart || s > length - apart;
                !(neighbours
                    && at_end(hit.on_first, curves[i].length())
                    && at_end(hit.on_second, curves[j].length()))
            });
            if let Some(hit) = inner {
                faults.push(
                    Diagnostic::error(
                        codes::SIDES_CROSS,
                        format!(
                            "sides {} and {} of patch {{.}} meet at {}, between their corners",
                            name(i),
                            name(j),
                            place(hit.point.position(mesh)),
                        ),
                    )
                    .at_key(".corners", "the corners of this patch")
                    .help("list the corners in order around the patch"),
                );
            }
        }
    }
    faults
}
