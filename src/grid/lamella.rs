//! Lamellae: what is cut of a member, with its holes and notches.

use super::{Crossing, Positions};
use crate::members::{Member, crossing_label};
use crate::project::model::Family;
use serde::{Deserialize, Serialize};

/// Everything beside the geometry that shapes a lamella. Lengths in metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Width.
    pub width: f64,
    /// Thickness.
    pub thickness: f64,
    /// From the ends of the member to the ends of the lamella.
    pub end_margin: f64,
    /// Diameter of the bolt.
    pub bolt: f64,
    /// Outer diameter of the shell around the bolt in notches; without shells, of the bolt.
    pub slider: f64,
    /// Play in openings.
    pub clearance: f64,
    /// kg/m^3.
    pub density: f64,
}

/// A part to cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lamella {
    /// Family of its member.
    pub family: Family,
    /// Index of its member.
    pub index: u32,
    /// Metres, end margins included.
    pub length: f64,
    /// Kilograms, round ends and openings subtracted.
    pub mass: f64,
    /// Along the member, ascending.
    pub openings: Vec<Opening>,
}

/// An opening. Positions are arc lengths from the start of the member, metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// Index of the u-member of the crossing that it serves.
    pub u: u32,
    /// Index of the v-member of that crossing.
    pub v: u32,
    /// Centre of the bolt in the flat state.
    pub from: f64,
    /// Centre of the bolt in the deployed state; the same for a round hole.
    pub to: f64,
    /// Cut width.
    pub diameter: f64,
    /// Whether the bolt slides.
    pub notch: bool,
}

/// A slide shorter than this needs no notch: the play takes it. A tenth of the usual kerf.
const NO_SLIDE: f64 = 2e-5;

impl Opening {
    /// Where the cut begins and ends on the member, metres.
    pub fn extent(&self) -> (f64, f64) {
        let half = 0.5 * self.diameter;
        (self.from.min(self.to) - half, self.from.max(self.to) + half)
    }

    /// The crossing that it serves: `u03-v05`.
    pub fn label(&self) -> String {
        crossing_label(self.u, self.v)
    }

    /// Cut area, square metres.
    pub fn area(&self) -> f64 {
        let round = 0.25 * std::f64::consts::PI * self.diameter * self.diameter;
        round + (self.to - self.from).abs() * self.diameter
    }
}

/// The lamella of a member. `crossings` are those of its patch.
pub fn lamella(member: &Member, crossings: &[Crossing], section: &Section) -> Lamella {
    let mut openings: Vec<Opening> = crossings
        .iter()
        .filter_map(|crossing| {
            let on = position_on(member, crossing)?;
            Some(opening(crossing, member, on, section))
        })
        .collect();
    openings.sort_by(|a, b| a.extent().0.total_cmp(&b.extent().0));
    let length = member.length_surface() + 2.0 * section.end_margin;
    let open: f64 = openings.iter().map(Opening::area).sum();
    let area = strip_area(length, section.width) - open;
    Lamella {
        family: member.family,
        index: member.index,
        length,
        mass: area * section.thickness * section.density,
        openings,
    }
}

/// Area of a strip with round ends, half circles over the whole width.
fn strip_area(length: f64, width: f64) -> f64 {
    let across = width.min(length);
    length * width - (1.0 - 0.25 * std::f64::consts::PI) * across * across
}

fn position_on(member: &Member, crossing: &Crossing) -> Option<Positions> {
    match member.family {
        Family::U => (crossing.u == member.index).then_some(crossing.on_u),
        Family::V => (crossing.v == member.index).then_some(crossing.on_v),
    }
}

/// Boundary members and the ends of inner ones get round holes for the bolt; inner crossings get
/// a notch on both lamellae (method notes, section 5).
fn opening(crossing: &Crossing, member: &Member, on: Positions, section: &Section) -> Opening {
    let length = member.length_surface();
    let at_end = on.surface <= 0.0 || on.surface >= length;
    let slides = !member.boundary && !at_end;
    let notch = slides && on.slide().abs() > NO_SLIDE;
    let diameter = if slides { section.slider } else { section.bolt } + section.clearance;
    let (from, to) = if notch {
        (on.planar, on.surface)
    } else {
        (on.surface, on.surface)
    };
    Opening {
        u: crossing.u,
        v: crossing.v,
        from,
        to,
        diameter,
        notch,
    }
}
