//! The bodies of supports: what is printed, cast or cut below a contact face, and when it tips.

use super::{CONCRETE, FILAMENT, Face, GRAVITY, STEEPEST, WEDGE_EDGE, solid};
use crate::fabrication::units::MM;
use crate::plan::SupportBody;
use crate::project::model::SupportKind;

/// Contact face of a printed foot and of a wedge in widths of the widest lamella.
const PAD: f64 = 1.5;
/// Foot of a printed support in diameters of its contact face.
const PRINTED_FOOT: f64 = 1.4;
/// Least side of a block in widths of the widest lamella.
const BLOCK: f64 = 3.0;
/// Least foot of a support in heights of its contact face: it tips at a quarter of its weight.
const FOOT_OF_HEIGHT: f64 = 0.5;
/// Least plastic around a hole and below it, metres.
pub(super) const WALL: f64 = 2e-3;
/// Least height of the lower rim of a printed contact face, metres.
const BASE: f64 = 3e-3;
/// Least height of the lower edge of a block, metres: less breaks off.
pub(super) const LOW_EDGE: f64 = 30e-3;
/// Least concrete below a cast-in sleeve, metres.
const COVER: f64 = 20e-3;

impl Face<'_> {
    pub(super) fn is_steep(&self) -> bool {
        self.tilt.to_degrees() > STEEPEST
    }

    fn pad(&self, kind: SupportKind) -> f64 {
        match kind {
            SupportKind::Printed | SupportKind::WedgeOnBlock => PAD * self.place.width,
            SupportKind::ConcreteBlock => BLOCK * self.place.width,
        }
    }

    /// Least height of the middle of the contact face above the ground.
    pub(super) fn least_height(&self, kind: SupportKind) -> f64 {
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

/// The body below a contact face at a height above the ground.
pub(super) fn body(face: &Face<'_>, kind: SupportKind, height: f64) -> SupportBody {
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
