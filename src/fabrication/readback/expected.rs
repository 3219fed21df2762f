//! What the plan says about a part, in the part's frame; millimetres.
//!
//! Openings are computed from the records here, not by the code that draws them.

use crate::fabrication::outline;
use crate::fabrication::pieces::{pieces, plates};
use crate::fabrication::units::MM;
use crate::plan::{LamellaRecord, OpeningRecord, Plan};
use core::f64::consts::PI;
use std::collections::BTreeMap;

/// A part.
pub(super) struct ExpectedPart {
    pub(super) length: f64,
    pub(super) width: f64,
    /// Length of the nominal outline.
    pub(super) perimeter: f64,
    pub(super) openings: Vec<ExpectedOpening>,
}

/// An opening along the middle of its part.
pub(super) struct ExpectedOpening {
    /// What it is for: a crossing, or `screw`.
    pub(super) name: String,
    /// First and last centre of the bolt.
    pub(super) centres: [f64; 2],
    pub(super) diameter: f64,
}

impl ExpectedOpening {
    /// Enclosed area of the cut contour with a kerf.
    pub(super) fn area(&self, kerf: f64) -> f64 {
        let diameter = self.diameter - kerf;
        0.25 * PI * diameter * diameter + (self.centres[1] - self.centres[0]) * diameter
    }
}

/// All parts of a plan by id.
pub(super) fn parts(plan: &Plan) -> BTreeMap<String, ExpectedPart> {
    let mut parts = BTreeMap::new();
    for lamella in &plan.lamellae {
        let all: Vec<ExpectedOpening> = lamella
            .openings
            .iter()
            .map(|opening| expected(lamella, opening))
            .collect();
        for piece in pieces(lamella) {
            let mut openings: Vec<ExpectedOpening> = all
                .iter()
                .filter(|o| {
                    let middle = 0.5 * (o.centres[0] + o.centres[1]);
                    piece.from <= middle && middle < piece.to
                })
                .map(|o| ExpectedOpening {
                    name: o.name.clone(),
                    centres: o.centres.map(|x| x - piece.from),
                    diameter: o.diameter,
                })
                .collect();
            openings.extend(piece.screws().into_iter().map(screw));
            parts.insert(
                piece.id.to_owned(),
                ExpectedPart {
                    length: piece.length(),
                    width: lamella.width * MM,
                    perimeter: outline::of(&piece, 0.0).length(),
                    openings,
                },
            );
        }
        for plate in plates(lamella) {
            let [length, width] = [plate.to - plate.from, lamella.width * MM];
            let at = |x: &f64| (x * MM - plate.from, plate.joint.hole * MM);
            parts.insert(
                plate.id.clone(),
                ExpectedPart {
                    length,
                    width,
                    perimeter: 2.0 * (length + width),
                    openings: plate.joint.screws.iter().map(at).map(screw).collect(),
                },
            );
        }
    }
    parts
}

fn expected(lamella: &LamellaRecord, opening: &OpeningRecord) -> ExpectedOpening {
    let place = |s: f64| (lamella.end_margin + s) * MM;
    let (centres, diameter, crossing) = match opening {
        OpeningRecord::Hole {
            at,
            diameter,
            crossing,
        } => ([place(*at); 2], diameter, crossing),
        OpeningRecord::Notch {
            from,
            to,
            diameter,
            crossing,
        } => (
            [place(from.min(*to)), place(from.max(*to))],
            diameter,
            crossing,
        ),
    };
    ExpectedOpening {
        name: crossing.clone(),
        centres,
        diameter: diameter * MM,
    }
}

fn screw((at, hole): (f64, f64)) -> ExpectedOpening {
    ExpectedOpening {
        name: "screw".to_owned(),
        centres: [at; 2],
        diameter: hole,
    }
}
