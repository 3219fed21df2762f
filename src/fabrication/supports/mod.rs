//! Supports: what gives an elastic grid *the* shape among all isometric ones.
//!
//! A support is a point and a tangent plane (paper, section 5.3). Its contact face lies below the
//! stack of lamellae that meet at the point, square to the surface normal, and a bolt through the
//! stack screws into it. [`records`] finds the places, lays a level ground below them and gives
//! every support its body:
//!
//! | kind | body | made with |
//! |---|---|---|
//! | `printed` | from a round foot to a round, inclined contact face | [`solid`]: STL and 3MF |
//! | `concrete-block` | a square block with an inclined top | [`drawing`]: block and form |
//! | `wedge-on-block` | a level square block, a wooden wedge on it | [`drawing`]: block and wedge |
//!
//! A body stands with the middle of its foot plumb below the middle of its contact face, so that
//! one cross on the ground places it ([`setting_out`]). Blocks are proportioned to be carried and
//! not to tip by themselves (paper, section 6.1). What bent lamellae push with only statics can
//! tell; the horizontal thrust that tips a block is stated instead, beside the weight of the grid.
//!
//! Metres, kilograms, newtons; z up.

mod body;
pub mod drawing;
mod places;
mod remarks;
pub mod setting_out;
pub mod solid;
mod table;

pub use body::wedge_middle;
pub use table::{kind_word, table};

use super::hardware::Series;
use super::units::MM;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Severity, Warned};
use crate::plan::{MemberRecord, Plan, SupportRecord};
use crate::project::model::{Bolt, SupportKind, Supports};
use body::body;
use places::{Place, places};
use remarks::{below_ground, warnings};

/// kg/m^3: plain concrete.
pub const CONCRETE: f64 = 2400.0;
/// kg/m^3: polylactide, the usual filament.
pub const FILAMENT: f64 = 1240.0;
/// kg/m^3: softwood.
pub const WEDGE_WOOD: f64 = 500.0;
/// m/s^2.
pub const GRAVITY: f64 = 9.81;

/// Length of thread in the support, in diameters of the bolt.
const ENGAGEMENT: f64 = 2.5;
/// What the hole is deeper than the bolt reaches, metres.
const TIP: f64 = 2e-3;
/// Height of the thin edge of a wedge, metres.
pub const WEDGE_EDGE: f64 = 5e-3;

/// Between the ground and the lowest member where the project says no height, metres.
const CLEAR: f64 = 20e-3;

/// Steeper contact faces need a bracket, not a foot, degrees.
pub const STEEPEST: f64 = 70.0;

/// What supports depend on besides the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportInputs<'a> {
    /// `[supports]`.
    pub supports: &'a Supports,
    /// The bolt at crossings.
    pub bolt: &'a Bolt,
}

/// A contact face before the ground is known.
struct Face<'a> {
    place: Place<'a>,
    position: [f64; 3],
    normal: [f64; 3],
    /// Radians.
    tilt: f64,
    /// Radians.
    azimuth: f64,
    bolt_length: f64,
    bore: f64,
    depth: f64,
}

/// Every support of a plan, by id.
pub fn records(plan: &Plan, inputs: SupportInputs<'_>) -> Checked<Vec<SupportRecord>> {
    let Some(series) = Series::of(inputs.bolt.diameter) else {
        // Told by the check of the hardware.
        return Ok(Warned {
            value: Vec::new(),
            warnings: Vec::new(),
        });
    };
    let (places, mut told) = places(plan, &inputs.supports.at, inputs.bolt.diameter);
    let mut faces = Vec::new();
    for place in places {
        match face(place, series, inputs.bolt) {
            Ok(face) => faces.push(face),
            Err(error) => told.push(*error),
        }
    }
    let kind = inputs.supports.kind;
    let height = match inputs.supports.height {
        0.0 => Height::Least(lowest_member(plan).map_or(f64::INFINITY, |(_, z)| z - CLEAR)),
        height => Height::Said(height),
    };
    let ground = ground(&faces, kind, height, &mut told);
    let records: Vec<SupportRecord> = faces
        .iter()
        .map(|face| record(face, kind, ground))
        .collect();
    told.extend(warnings(&records));
    told.extend(below_ground(plan, ground, &records));
    if told.iter().any(|d| d.severity == Severity::Error) {
        return Err(told);
    }
    Ok(Warned {
        value: records,
        warnings: told,
    })
}

fn face<'a>(place: Place<'a>, series: &Series, bolt: &Bolt) -> Result<Face<'a>, Box<Diagnostic>> {
    let up = if place.normal[2] < 0.0 { -1.0 } else { 1.0 };
    let normal = place.normal.map(|v| up * v);
    let position = [0, 1, 2].map(|i| place.position[i] - 0.5 * place.stack * normal[i]);
    let level = libm::hypot(normal[0], normal[1]);
    let tilt = libm::atan2(level, normal[2]);
    // A face that falls by less than a micrometre a metre has no direction in which it does.
    let azimuth = if level > 1e-6 {
        libm::atan2(normal[1], normal[0])
    } else {
        0.0
    };
    let washer = series.washer[2] / MM;
    let need = place.stack + washer + ENGAGEMENT * bolt.diameter;
    let bolt_length = series.length_of(need).ok_or_else(|| {
        Diagnostic::error(
            codes::BOLT_TOO_SHORT,
            format!(
                "the support at `{}` needs a bolt of {:.1} mm, {} ends at {:.0} mm",
                place.at,
                need * MM,
                bolt.name,
                series.lengths[1]
            ),
        )
        .at_key("hardware.bolt", "too short")
        .note(format!(
            "{:.1} mm of lamellae meet there, and {ENGAGEMENT} diameters of thread hold in the \
             support",
            place.stack * MM
        ))
        .about(place.at)
    })?;
    Ok(Face {
        position,
        normal,
        tilt,
        azimuth,
        bolt_length,
        bore: (series.diameter - series.pitch) / MM,
        depth: bolt_length - place.stack - washer + TIP,
        place,
    })
}

/// The thinnest sheet of a plan, metres: wedges are glued from its offcuts.
pub fn thinnest_sheet(plan: &Plan) -> Option<f64> {
    let thickness = plan.lamellae.iter().map(|lamella| lamella.thickness);
    thickness.min_by(f64::total_cmp)
}

/// How high the contact faces are above the ground.
#[derive(Clone, Copy)]
enum Height {
    /// As low as supports can be, the ground not above this.
    Least(f64),
    /// The lowest of them, as the project says.
    Said(f64),
}

/// Height of the ground, and what is too low for it.
fn ground(
    faces: &[Face<'_>],
    kind: SupportKind,
    height: Height,
    told: &mut Vec<Diagnostic>,
) -> f64 {
    let feet = || faces.iter().filter(|face| !face.is_steep());
    let lowest = |clear: &dyn Fn(&Face<'_>) -> f64| {
        feet()
            .map(|face| face.position[2] - clear(face))
            .fold(f64::INFINITY, f64::min)
    };
    let deepest = lowest(&|face| face.least_height(kind));
    if !deepest.is_finite() {
        return 0.0;
    }
    let height = match height {
        Height::Least(free) => return deepest.min(free),
        Height::Said(height) => height,
    };
    let ground = lowest(&|_| height);
    if ground > deepest + 1e-9 {
        let worst = feet().min_by(|a, b| {
            let spare = |face: &Face<'_>| face.position[2] - face.least_height(kind);
            spare(a).total_cmp(&spare(b))
        });
        if let Some(face) = worst {
            told.push(
                Diagnostic::error(
                    codes::SUPPORT_TOO_LOW,
                    format!(
                        "the support at `{}` is {:.0} mm high, its contact face of {:.0} degrees \
                         needs {:.0} mm",
                        face.place.at,
                        (face.position[2] - ground) * MM,
                        face.tilt.to_degrees(),
                        face.least_height(kind) * MM
                    ),
                )
                .at_key("supports.height", "too low")
                .help(format!(
                    "a height of {:.0} mm is enough; 0 is as low as the supports can be",
                    libm::ceil((height + ground - deepest) * MM)
                ))
                .about(face.place.at),
            );
        }
    }
    ground
}

fn record(face: &Face<'_>, kind: SupportKind, ground: f64) -> SupportRecord {
    let height = face.position[2] - ground;
    SupportRecord {
        id: format!("support-{}", face.place.at),
        at: face.place.at.to_owned(),
        crossings: face
            .place
            .crossings
            .iter()
            .map(|&id| id.to_owned())
            .collect(),
        kind,
        position: face.position,
        normal: face.normal,
        tilt: face.tilt.to_degrees(),
        azimuth: face.azimuth.to_degrees(),
        height,
        bolt_length: face.bolt_length,
        body: (!face.is_steep()).then(|| body(face, kind, height)),
    }
}

/// The lowest member and how high its lowest point is.
fn lowest_member(plan: &Plan) -> Option<(&MemberRecord, f64)> {
    let points = |member: &'_ MemberRecord| -> Option<f64> {
        let heights = member.polyline.iter().map(|point| point[2]);
        heights.min_by(f64::total_cmp)
    };
    let members = plan.members.iter();
    members
        .filter_map(|member| Some((member, points(member)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests;
