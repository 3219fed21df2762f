//! Pieces: what is cut of a lamella in one part.
//!
//! A lamella that the stock takes is one piece, named as the lamella. A spliced one is several,
//! `west.u03a`, `west.u03b`, which reach over the middle of their joint by half of its length
//! where the joint is one of fingers or a scarf, and meet in it where a plate laps over it. The
//! plate is a part of its own, `west.u03a-b`.
//!
//! Everything here is read off the plan's records. Millimetres from the start of the lamella.

use super::nesting::Blank;
use super::part::{net_area, opening_extent, screw_area};
use super::units::MM;
use crate::plan::{JointRecord, LamellaRecord, OpeningRecord, PieceRecord};
use crate::project::model::{Grain, SpliceKind};

/// A piece of a lamella, or the whole of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece<'a> {
    /// Its id.
    pub id: &'a str,
    /// The lamella.
    pub lamella: &'a LamellaRecord,
    /// Where its wood begins.
    pub from: f64,
    /// Where its wood ends.
    pub to: f64,
    /// Shape of its end at `from`.
    pub start: End<'a>,
    /// Shape of its end at `to`.
    pub end: End<'a>,
}

/// How a piece ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End<'a> {
    /// As the lamella does.
    Round,
    /// In a joint.
    Joint(&'a JointRecord),
}

/// A plate over a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate<'a> {
    /// Its id.
    pub id: String,
    /// The lamella that it joins; the plate has its width, thickness and material.
    pub lamella: &'a LamellaRecord,
    /// The joint.
    pub joint: &'a JointRecord,
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

impl End<'_> {
    /// How much of the piece belongs to the end: the rounding, or the joint.
    pub fn length(&self, width: f64) -> f64 {
        match self {
            Self::Round => 0.5 * width,
            Self::Joint(joint) => match joint.kind {
                SpliceKind::Finger | SpliceKind::Scarf => joint.length * MM,
                SpliceKind::Plate => 0.5 * joint.length * MM,
            },
        }
    }
}

impl Plate<'_> {
    /// Area of the cut part, square millimetres, without kerf.
    pub fn net_area(&self) -> f64 {
        self.lamella.width * MM * (self.to - self.from) - screw_area(self.joint)
    }

    /// Kilograms: it is of the wood of its lamella.
    pub fn mass(&self) -> f64 {
        self.lamella.mass * self.net_area() / net_area(self.lamella)
    }
}

impl<'a> Piece<'a> {
    /// Length of the part, millimetres.
    pub fn length(&self) -> f64 {
        self.to - self.from
    }

    /// Openings that lie in the piece.
    pub fn openings(&self) -> impl Iterator<Item = &'a OpeningRecord> {
        let (lamella, from, to) = (self.lamella, self.from, self.to);
        lamella.openings.iter().filter(move |opening| {
            let ([first, last], _) = opening_extent(lamella, opening);
            let middle = 0.5 * (first + last);
            from <= middle && middle < to
        })
    }

    /// Screws of plates that go through the piece, from its own start, and the diameter of their
    /// holes.
    pub fn screws(&self) -> Vec<(f64, f64)> {
        let through = |end: &End<'a>| match end {
            End::Round => Vec::new(),
            End::Joint(joint) => joint
                .screws
                .iter()
                .map(|at| at * MM)
                .filter(|at| (self.from..=self.to).contains(at))
                .map(|at| (at - self.from, joint.hole * MM))
                .collect(),
        };
        let mut screws = through(&self.start);
        screws.extend(through(&self.end));
        screws
    }
}

/// The pieces of a lamella, from its start to its end.
pub fn pieces(lamella: &LamellaRecord) -> Vec<Piece<'_>> {
    if lamella.pieces.is_empty() {
        return vec![Piece {
            id: &lamella.id,
            lamella,
            from: 0.0,
            to: lamella.length * MM,
            start: End::Round,
            end: End::Round,
        }];
    }
    let before = |i: usize| {
        let piece: Option<&PieceRecord> = lamella.pieces.get(i.checked_sub(1)?);
        piece?.joint.as_ref()
    };
    lamella
        .pieces
        .iter()
        .enumerate()
        .map(|(i, piece)| {
            let (start, end) = (before(i), piece.joint.as_ref());
            Piece {
                id: &piece.id,
                lamella,
                from: piece.from * MM - start.map_or(0.0, reach),
                to: piece.to * MM + end.map_or(0.0, reach),
                start: start.map_or(End::Round, End::Joint),
                end: end.map_or(End::Round, End::Joint),
            }
        })
        .collect()
}

/// How far the wood of a piece reaches over the middle of its joint, millimetres.
fn reach(joint: &JointRecord) -> f64 {
    match joint.kind {
        SpliceKind::Finger | SpliceKind::Scarf => 0.5 * joint.length * MM,
        SpliceKind::Plate => 0.0,
    }
}

/// The plates over the joints of a lamella.
pub fn plates(lamella: &LamellaRecord) -> Vec<Plate<'_>> {
    let mut plates = Vec::new();
    for pair in lamella.pieces.windows(2) {
        let Some(joint) = pair[0].joint.as_ref() else {
            continue;
        };
        if joint.kind != SpliceKind::Plate {
            continue;
        }
        let next = pair[1].id.strip_prefix(&lamella.id).unwrap_or(&pair[1].id);
        let [middle, half] = [pair[0].to * MM, 0.5 * joint.length * MM];
        plates.push(Plate {
            id: format!("{}-{next}", pair[0].id),
            lamella,
            joint,
            from: middle - half,
            to: middle + half,
        });
    }
    plates
}

/// What nesting needs of all parts: pieces and plates.
pub fn blanks<'a>(
    lamellae: impl IntoIterator<Item = &'a LamellaRecord>,
    grain: impl Fn(&str) -> Grain,
) -> Vec<Blank> {
    let mut blanks = Vec::new();
    for lamella in lamellae {
        let blank = |id: &str, length: f64, whole: f64| Blank {
            id: id.to_owned(),
            material: lamella.material.clone(),
            thickness: lamella.thickness,
            length: length / MM,
            width: lamella.width,
            whole: whole / MM,
            grain: grain(&lamella.material),
        };
        for piece in pieces(lamella) {
            let longest = piece
                .openings()
                .map(|opening| {
                    let ([from, to], diameter) = opening_extent(lamella, opening);
                    to - from + diameter
                })
                .fold(0.0, f64::max);
            let length = match lamella.pieces.as_slice() {
                [] => lamella.length * MM,
                _ => piece.length(),
            };
            blanks.push(blank(piece.id, length, longest));
        }
        for plate in plates(lamella) {
            blanks.push(blank(&plate.id, plate.to - plate.from, 0.0));
        }
    }
    blanks
}
