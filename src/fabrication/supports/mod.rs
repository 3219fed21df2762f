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

pub mod drawing;
mod places;
pub mod setting_out;
pub mod solid;
mod table;

pub use table::{kind_word, table};

use super::hardware::Series;
use super::units::MM;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Severity, Warned};
use crate::plan::{MemberRecord, Plan, SupportBody, SupportRecord};
use crate::project::model::{Bolt, SupportKind, Supports};
use places::{Place, places};

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
/// Contact face of a printed foot and of a wedge in widths of the widest lamella.
const PAD: f64 = 1.5;
/// Foot of a printed support in diameters of its contact face.
const PRINTED_FOOT: f64 = 1.4;
/// Least foot of a support in heights of its contact face: it tips at a quarter of its weight.
const FOOT_OF_HEIGHT: f64 = 0.5;
/// Least side of a block in widths of the widest lamella.
const BLOCK: f64 = 3.0;
/// Least plastic around a hole and below it, metres.
const WALL: f64 = 2e-3;
/// Least height of the lower rim of a printed contact face, metres.
const BASE: f64 = 3e-3;
/// Least height of the lower edge of a block, metres: less breaks off.
const LOW_EDGE: f64 = 30e-3;
/// Least concrete below a cast-in sleeve, metres.
const COVER: f64 = 20e-3;
/// Height of the thin edge of a wedge, metres.
pub const WEDGE_EDGE: f64 = 5e-3;

/// Between the ground and the lowest member where the project says no height, metres.
const CLEAR: f64 = 20e-3;

/// Steeper contact faces need a bracket, not a foot, degrees.
pub const STEEPEST: f64 = 70.0;
/// What common printers print, metres.
const PRINTER: f64 = 0.25;
/// What one person carries, kilograms.
const CARRIED: f64 = 25.0;

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

impl Face<'_> {
    fn is_steep(&self) -> bool {
        self.tilt.to_degrees() > STEEPEST
    }

    fn pad(&self, kind: SupportKind) -> f64 {
        match kind {
            SupportKind::Printed | SupportKind::WedgeOnBlock => PAD * self.place.width,
            SupportKind::ConcreteBlock => BLOCK * self.place.width,
        }
    }

    /// Least height of the middle of the contact face above the ground.
    fn least_height(&self, kind: SupportKind) -> f64 {
        let (sin, cos) = libm::sincos(self.tilt);
        let tan = sin / cos;
        let pad = self.pad(kind);
        match kind {
            SupportKind::Printed => {
                let rim = 0.5 * pad * sin + BASE;
                let hole = self.depth * cos + 0.5 * self.bore * sin + WALL;
                rim.max(hole)
            }
            SupportKind::ConcreteBlock => {
                // The side is that of the lamellae, or grows with the height.
                let narrow = 0.5 * pad * tan + LOW_EDGE;
                let wide = LOW_EDGE / (1.0 - 0.5 * FOOT_OF_HEIGHT * tan);
                narrow.max(wide).max(self.depth * cos + COVER)
            }
            SupportKind::WedgeOnBlock => wedge_middle(pad, self.tilt) + LOW_EDGE,
        }
    }
}

/// Height of a wedge at its middle.
pub fn wedge_middle(pad: f64, tilt: f64) -> f64 {
    WEDGE_EDGE + 0.5 * pad * libm::tan(tilt)
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

fn body(face: &Face<'_>, kind: SupportKind, height: f64) -> SupportBody {
    let pad = face.pad(kind);
    let mut body = SupportBody {
        pad,
        foot: 0.0,
        bore: face.bore,
        depth: face.depth,
        block: height,
        volume: 0.0,
        mass: 0.0,
        tipping_thrust: 0.0,
    };
    // Where the weight acts, from the middle of the foot towards the higher edge.
    let mut lever = 0.0;
    match kind {
        SupportKind::Printed => {
            body.foot = (PRINTED_FOOT * pad)
                .max(FOOT_OF_HEIGHT * height)
                .max(2.0 * radius_around_hole(face, pad, height));
            let solid = solid::printed(&body, face.tilt, face.azimuth);
            let (volume, centre) = solid.volume_and_centre();
            body.volume = volume / (MM * MM * MM);
            body.mass = body.volume * FILAMENT;
            lever = libm::hypot(centre[0], centre[1]) / MM;
        }
        SupportKind::ConcreteBlock => {
            body.foot = block_side(face, height);
            body.pad = body.foot;
            body.volume = body.foot * body.foot * height;
            body.mass = body.volume * CONCRETE;
            // The centre of an obliquely cut prism.
            lever = body.foot * body.foot * libm::tan(face.tilt) / (12.0 * height);
        }
        SupportKind::WedgeOnBlock => {
            body.foot = block_side(face, height);
            body.block = height - wedge_middle(pad, face.tilt);
            body.volume = body.foot * body.foot * body.block;
            body.mass = body.volume * CONCRETE;
        }
    }
    body.tipping_thrust = body.mass * GRAVITY * (0.5 * body.foot - lever).max(0.0) / height;
    body
}

/// A side that carries the lamellae and is broad for its height, to the next centimetre.
fn block_side(face: &Face<'_>, height: f64) -> f64 {
    let least = (BLOCK * face.place.width).max(FOOT_OF_HEIGHT * height);
    // A side that a tall block does not need must not dig its lower edge into the ground.
    let rounded = libm::ceil(least * 100.0 - 1e-6) / 100.0;
    let lower_edge = height - 0.5 * rounded * libm::tan(face.tilt);
    if lower_edge < LOW_EDGE {
        least
    } else {
        rounded
    }
}

/// Radius of the foot with which the wall of a printed support stays around the end of the hole,
/// which leans towards the higher side.
fn radius_around_hole(face: &Face<'_>, pad: f64, height: f64) -> f64 {
    let (sin, cos) = libm::sincos(face.tilt);
    let reach = face.depth * sin + 0.5 * face.bore * cos + WALL;
    let level = height - face.depth * cos;
    // The wall runs straight from the foot to the highest point of the contact face.
    let top = height + 0.5 * pad * sin;
    let share = (level / top).clamp(0.0, 0.95);
    (reach - share * 0.5 * pad * cos) / (1.0 - share)
}

fn warnings(records: &[SupportRecord]) -> Vec<Diagnostic> {
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
            .about(&heavy.at),
        );
    }
    told
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

/// The lowest point of the members if it lies below the ground.
fn below_ground(plan: &Plan, ground: f64, records: &[SupportRecord]) -> Option<Diagnostic> {
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

#[cfg(test)]
mod tests;
