//! Stickers: slippery foil where two lamellae slide on each other.
//!
//! At every crossing with a notch the lower face of the u-lamella lies on the upper face of the
//! v-lamella, and each of the two faces gets a sticker (paper, section 5.1: "no contact with the
//! rough wooden surface"). While the grid unfolds, the bolt moves along the lamella and the angle
//! of the crossing changes, so the contact area, the parallelogram in which the two strips
//! overlap, moves and shears. [`cover`] is the smallest quadrilateral over the whole width of the
//! lamella that holds all of them; [`records`] adds the margin, cuts neighbours apart where they
//! would lie on each other, and numbers all stickers in the order of assembly: patch by patch,
//! the v-lamellae that are laid out first before the u-lamellae, each from its start to its end.
//!
//! Metres and radians; along a lamella from the start of its member, across it from its middle
//! line, to the left positive, as seen on its top face.

mod foil;
mod table;

pub(super) use foil::area_of;
pub use foil::{FoilStyle, draw, nest};
pub use table::table;

use super::index::PlanIndex;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Diagnostic, Warned};
use crate::plan::{
    CrossingRecord, Face, LamellaRecord, MemberRecord, OpeningRecord, Plan, Positions,
    StickerRecord,
};
use crate::project::model::{Family, Sticker};

/// How far the slot of a sticker stands back from the notch below it, metres: an edge of foil in
/// the way of the shell would be rubbed off and jam it.
pub const SETBACK: f64 = 0.25e-3;

/// Least foil around a slot, metres: what a knife cuts and a finger peels off in one piece.
const LEAST_LAND: f64 = 0.4e-3;

/// Distance of two stickers on one face, metres.
const APART: f64 = 0.5e-3;

/// A crossing as one of its lamellae sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Width of the lamella that carries the sticker.
    pub width: f64,
    /// Width of the lamella that slides on it.
    pub other: f64,
    /// Where the bolt is on it in the flat and in the deployed state.
    pub on: [f64; 2],
    /// From its direction to that of the other lamella, in the flat and in the deployed state:
    /// both in (0, pi), or both in (-pi, 0).
    pub angles: [f64; 2],
}

/// The quadrilateral that holds the contact area at every place and angle between the two
/// states: its right edge (from, to) and its left edge (from, to).
///
/// At the distance `y` across, the other strip reaches along this lamella from `c + y cot t -
/// w / (2 sin t)` to `c + y cot t + w / (2 sin t)`, with its width `w`, the place `c` of the bolt
/// and the angle `t`. As a function of `t` the upper bound has no maximum inside of an interval
/// of angles, and as a function of `y` the largest of several straight lines is convex: so the
/// two states and the two edges of the lamella bound everything.
pub fn cover(contact: &Contact) -> [[f64; 2]; 2] {
    let [low, high] = sorted(contact.on);
    [-0.5, 0.5].map(|side| {
        let y = side * contact.width;
        let mut bounds = [f64::INFINITY, f64::NEG_INFINITY];
        for angle in contact.angles {
            let (sin, cos) = libm::sincos(angle);
            let middle = y * cos / sin;
            let reach = 0.5 * contact.other / sin.abs();
            bounds[0] = bounds[0].min(low + middle - reach);
            bounds[1] = bounds[1].max(high + middle + reach);
        }
        bounds
    })
}

/// Every sticker of a plan. Stickers without room for their slot are left out and told.
pub fn records(plan: &Plan, sticker: &Sticker) -> Warned<Vec<StickerRecord>> {
    let index = PlanIndex::new(plan);
    let mut stickers = Vec::new();
    let mut warnings = Vec::new();
    for patch in &plan.patches {
        for family in [Family::V, Family::U] {
            let mut members: Vec<&MemberRecord> = plan
                .members
                .iter()
                .filter(|member| member.patch == patch.id && member.family == family)
                .collect();
            members.sort_by_key(|member| member.index);
            for lamella in members.iter().filter_map(|m| index.lamella_of(&m.id)) {
                let (made, crowded) = on_lamella(lamella, family, &index, sticker);
                stickers.extend(made);
                if let Some(first) = crowded.first() {
                    warnings.push(no_room(lamella, first, crowded.len()));
                }
            }
        }
    }
    for (number, sticker) in stickers.iter_mut().enumerate() {
        sticker.number = number as u32 + 1;
    }
    Warned {
        value: stickers,
        warnings,
    }
}

/// Stickers of one lamella in order, and the crossings whose sticker has no room.
fn on_lamella(
    lamella: &LamellaRecord,
    family: Family,
    index: &PlanIndex<'_>,
    sticker: &Sticker,
) -> (Vec<StickerRecord>, Vec<String>) {
    let mut covers: Vec<(StickerRecord, [[f64; 2]; 2])> = lamella
        .openings
        .iter()
        .filter_map(|opening| {
            let crossing = index.crossing(opening.crossing())?;
            if !super::nodes::slides(crossing, index) {
                return None;
            }
            let contact = contact(lamella, family, crossing, index)?;
            let edges = cover(&contact).map(|[a, b]| [a - sticker.margin, b + sticker.margin]);
            Some((blank(lamella, family, opening), edges))
        })
        .collect();
    covers.sort_by(|a, b| a.0.slot[0].total_cmp(&b.0.slot[0]));
    for i in 1..covers.len() {
        let (before, after) = covers.split_at_mut(i);
        if let (Some(first), Some(second)) = (before.last_mut(), after.first_mut()) {
            part(&mut first.1, &mut second.1);
        }
    }
    let half = 0.5 * lamella.width;
    let mut made = Vec::new();
    let mut crowded = Vec::new();
    for (mut record, [right, left]) in covers {
        record.outline = [
            [right[0], -half],
            [right[1], -half],
            [left[1], half],
            [left[0], half],
        ];
        if land(&record) < LEAST_LAND - 1e-9 {
            crowded.push(record.crossing);
        } else {
            made.push(record);
        }
    }
    (made, crowded)
}

/// Cuts two neighbours apart half way between them where they would lie on each other. Together
/// they still cover all that both did.
fn part(first: &mut [[f64; 2]; 2], second: &mut [[f64; 2]; 2]) {
    for (a, b) in first.iter_mut().zip(second) {
        if b[0] - a[1] < APART {
            let middle = 0.5 * (a[1] + b[0]);
            a[1] = middle - 0.5 * APART;
            b[0] = middle + 0.5 * APART;
        }
    }
}

/// The crossing as the lamella sees it.
fn contact(
    lamella: &LamellaRecord,
    family: Family,
    crossing: &CrossingRecord,
    index: &PlanIndex<'_>,
) -> Option<Contact> {
    let [u, v] = [&crossing.u, &crossing.v].map(|id| index.member(id));
    let direction = |member: &MemberRecord| {
        let [a, b] = member.planar;
        [b[0] - a[0], b[1] - a[1]]
    };
    let [du, dv] = [direction(u?), direction(v?)];
    // From u to v counter-clockwise or clockwise in the plane; unfolding keeps the sense.
    let turn = (du[0] * dv[1] - du[1] * dv[0]).signum();
    let (on, other, turn) = match family {
        Family::U => (crossing.on_u, &crossing.v, turn),
        Family::V => (crossing.on_v, &crossing.u, -turn),
    };
    let Positions { surface, planar } = on;
    Some(Contact {
        width: lamella.width,
        other: index.lamella_of(other)?.width,
        on: [planar, surface],
        angles: [crossing.angle_planar, crossing.angle_surface]
            .map(|degrees| turn * degrees.to_radians()),
    })
}

/// A sticker without number and outline.
fn blank(lamella: &LamellaRecord, family: Family, opening: &OpeningRecord) -> StickerRecord {
    let (slot, diameter) = match *opening {
        OpeningRecord::Hole { at, diameter, .. } => ([at; 2], diameter),
        OpeningRecord::Notch {
            from, to, diameter, ..
        } => (sorted([from, to]), diameter),
    };
    let (letter, face) = match family {
        Family::U => ("u", Face::Bottom),
        Family::V => ("v", Face::Top),
    };
    StickerRecord {
        id: format!("{}.{letter}", opening.crossing()),
        number: 0,
        crossing: opening.crossing().to_owned(),
        lamella: lamella.id.clone(),
        face,
        outline: [[0.0; 2]; 4],
        slot,
        diameter: diameter + 2.0 * SETBACK,
    }
}

/// Least foil between slot and outline, metres: negative where the slot breaks through.
pub fn land(sticker: &StickerRecord) -> f64 {
    let radius = 0.5 * sticker.diameter;
    let outline = sticker.outline;
    let mut least = f64::INFINITY;
    for (i, a) in outline.iter().enumerate() {
        let b = outline[(i + 1) % 4];
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let length = libm::hypot(dx, dy);
        for x in sticker.slot {
            // Distance of a centre from the edge, inside positive: the outline runs
            // counter-clockwise. An edge of no length bounds nothing.
            let inside = (dx * -a[1] - dy * (x - a[0])) / length;
            if length > 0.0 {
                least = least.min(inside - radius);
            }
        }
    }
    least
}

fn no_room(lamella: &LamellaRecord, crossing: &str, count: usize) -> Diagnostic {
    let others = match count {
        1 => String::new(),
        n => format!(" and at {} other crossings", n - 1),
    };
    Diagnostic::warning(
        codes::STICKER_CROWDED,
        format!(
            "no sticker on `{}` at `{crossing}`{others}: less than {:.1} mm of foil would be left \
             beside the slot",
            lamella.id,
            LEAST_LAND * super::units::MM
        ),
    )
    .at_key("hardware.sticker", "no room for the foil")
    .help("wider lamellae, fewer members, or a thinner bolt and shell")
    .about(&lamella.id)
}

fn sorted([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests;
