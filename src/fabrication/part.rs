//! Parts: a piece of a lamella as the shapes that cut it.
//!
//! A part lies along x from its start and is drawn as seen on its top face, in millimetres from
//! the lower left corner of its nominal outline ([`outline`]). Its shapes stand in cutting order:
//! engraving, scores, openings, outline.
//!
//! **Kerf.** A beam removes half its width on either side of the line it follows: with kerf `k`
//! outlines grow and openings shrink by `k/2` all around, so that the cut part is nominal. With
//! 0 the drawing itself is nominal and the machine may compensate.
//!
//! **Slides.** The label of a notch ends in an arrow that points from the flat to the deployed
//! place of the bolt: `v05→` is bolted at the left end of its notch and slides to the right.

use super::drawing::{Closure, Entity, Layer, Path, Shape, Text};
use super::labels::{self, Labels, Place, Strip};
use super::outline;
use super::pieces::{End, Piece, Plate};
use super::stroke_font;
use super::units::MM;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::plan::{CrossingRecord, JointRecord, LamellaRecord, MemberRecord, OpeningRecord};
use crate::project::model::{Fabrication, Hardware, SpliceKind};
use serde::Serialize;

/// Slides below this (millimetres) are cut as round holes: less than any machine repeats.
pub const LEAST_SLIDE: f64 = 0.01;

/// A part to cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Its id, engraved on it.
    pub id: String,
    /// Nominal length, millimetres.
    pub length: f64,
    /// Nominal width, millimetres.
    pub width: f64,
    /// How much of its two ends is shaped: rounded, or a joint; millimetres.
    pub ends: [f64; 2],
    /// In cutting order, in the part's frame.
    pub shapes: Vec<Entity>,
}

/// How parts are drawn. Millimetres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PartStyle {
    /// Width of the cut that is compensated; 0 draws nominal geometry.
    pub kerf: f64,
    /// Height of engraved labels.
    pub label_height: f64,
    /// How far a sticker reaches beyond the contact area.
    pub sticker_margin: f64,
}

impl PartStyle {
    /// That of a project.
    pub fn of(hardware: &Hardware, fabrication: &Fabrication) -> Self {
        Self {
            kerf: fabrication.kerf * MM,
            label_height: fabrication.label_height * MM,
            sticker_margin: hardware.sticker.as_ref().map_or(0.0, |s| s.margin) * MM,
        }
    }
}

/// What a part is made from, besides its lamella: who crosses it where.
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbours<'a> {
    /// The member whose lamella it is.
    pub member: &'a MemberRecord,
    /// Crossings and the lamella of the other member at each, those of this lamella's openings.
    pub crossings: Vec<(&'a CrossingRecord, &'a LamellaRecord)>,
}

/// Draws a piece of a lamella. Warnings tell of labels without place.
pub fn draw(
    piece: &Piece<'_>,
    neighbours: &Neighbours<'_>,
    style: PartStyle,
) -> (Part, Vec<Diagnostic>) {
    let (labels, warnings) = label(piece, neighbours, style);
    let width = piece.lamella.width * MM;
    let entity = |layer, shape| Entity {
        layer,
        subject: piece.id.to_owned(),
        shape,
    };
    let mut shapes: Vec<Entity> = labels
        .texts
        .into_iter()
        .map(|text| entity(Layer::Engrave, Shape::Text(text)))
        .collect();
    shapes.extend(
        scarfs(piece, style)
            .into_iter()
            .map(|(layer, shape)| entity(layer, shape)),
    );
    // Scores stand after all engraving.
    shapes.sort_by_key(|entity| entity.layer);
    for opening in piece.openings() {
        let shape = opening_shape(piece.lamella, opening, style.kerf);
        shapes.push(entity(
            Layer::CutInner,
            shape.translated([-piece.from, 0.0]),
        ));
    }
    for (at, hole) in piece.screws() {
        shapes.push(entity(Layer::CutInner, screw(at, width, hole, style.kerf)));
    }
    let outline = outline::of(piece, style.kerf);
    shapes.push(entity(Layer::CutOuter, outline.into()));
    let part = Part {
        id: piece.id.to_owned(),
        length: piece.length(),
        width,
        ends: [&piece.start, &piece.end].map(|end| end.length(width)),
        shapes,
    };
    (part, warnings)
}

/// Draws a plate over a joint: its id between the screws.
pub fn draw_plate(plate: &Plate<'_>, style: PartStyle) -> (Part, Vec<Diagnostic>) {
    let [length, width] = [plate.to - plate.from, plate.lamella.width * MM];
    let hole = plate.joint.hole * MM;
    let screws: Vec<f64> = plate
        .joint
        .screws
        .iter()
        .map(|at| at * MM - plate.from)
        .collect();
    let place = |&at: &f64| Place {
        opening: [at - 0.5 * hole, at + 0.5 * hole],
        contact: [at - 0.5 * hole, at + 0.5 * hole],
        label: String::new(),
        slide: None,
    };
    let strip = Strip {
        length,
        width,
        ends: [0.0; 2],
        openings: screws.iter().map(place).collect(),
    };
    let entity = |layer, shape| Entity {
        layer,
        subject: plate.id.clone(),
        shape,
    };
    let mut shapes = Vec::new();
    let mut warnings = Vec::new();
    match labels::single(&strip, &plate.id, style.label_height) {
        Some(text) => shapes.push(entity(Layer::Engrave, text.into())),
        None => warnings.push(omitted(&plate.id, &[format!("`{}`", plate.id)])),
    }
    shapes.extend(
        screws
            .iter()
            .map(|at| entity(Layer::CutInner, screw(*at, width, hole, style.kerf))),
    );
    let outline = outline::rectangle(length, width, style.kerf);
    shapes.push(entity(Layer::CutOuter, outline.into()));
    let part = Part {
        id: plate.id.clone(),
        length,
        width,
        ends: [0.0; 2],
        shapes,
    };
    (part, warnings)
}

fn screw(at: f64, width: f64, hole: f64, kerf: f64) -> Shape {
    Shape::Circle {
        centre: [at, 0.5 * width],
        radius: 0.5 * (hole - kerf),
    }
}

/// Where scarfs begin, and which face is planed down from there to the end: the piece before a
/// joint loses its top, the piece after it its back.
fn scarfs(piece: &Piece<'_>, style: PartStyle) -> Vec<(Layer, Shape)> {
    let width = piece.lamella.width * MM;
    let scarf = |end: &End<'_>| match end {
        End::Joint(joint) if joint.kind == SpliceKind::Scarf => Some(joint.length * MM),
        _ => None,
    };
    let mut drawn = Vec::new();
    let ends = [
        (scarf(&piece.start), "PLANE BACK", "↓"),
        (scarf(&piece.end), "PLANE TOP", "↑"),
    ];
    for (i, (length, words, sign)) in ends.into_iter().enumerate() {
        let Some(length) = length else { continue };
        let [from, to] = match i {
            0 => [0.0, length],
            _ => [piece.length() - length, piece.length()],
        };
        let line = if i == 0 { to } else { from };
        let score = Path::polyline(&[[line, 0.0], [line, width]], Closure::Open);
        drawn.push((Layer::Score, score.into()));
        let room = [to - from - 2.0 * labels::CLEAR, width - 2.0 * labels::CLEAR];
        let fits = |text: &str| {
            let height = (room[0] / stroke_font::width(text)).min(style.label_height);
            (height >= labels::LEAST_HEIGHT && height <= room[1]).then_some(height)
        };
        let text = [words, sign]
            .into_iter()
            .find_map(|text| Some((text, fits(text)?)));
        if let Some((text, height)) = text {
            let x = 0.5 * (from + to - stroke_font::width(text) * height);
            let text = Text::new(text, [x, 0.5 * (width - height)], height);
            drawn.push((Layer::Engrave, text.into()));
        }
    }
    drawn
}

/// An opening in the frame of the whole lamella.
pub fn opening_shape(lamella: &LamellaRecord, opening: &OpeningRecord, kerf: f64) -> Shape {
    let ([from, to], diameter) = opening_extent(lamella, opening);
    let radius = 0.5 * (diameter - kerf);
    let y = 0.5 * lamella.width * MM;
    if to - from < LEAST_SLIDE {
        Shape::Circle {
            centre: [0.5 * (from + to), y],
            radius,
        }
    } else {
        Path::slot(from, to, y, radius).into()
    }
}

/// First and last position of the bolt in an opening from the start of the lamella, and the
/// diameter that is cut, millimetres.
pub fn opening_extent(lamella: &LamellaRecord, opening: &OpeningRecord) -> ([f64; 2], f64) {
    let place = |s: f64| (lamella.end_margin + s) * MM;
    match *opening {
        OpeningRecord::Hole { at, diameter, .. } => ([place(at); 2], diameter * MM),
        OpeningRecord::Notch {
            from, to, diameter, ..
        } => ([place(from.min(to)), place(from.max(to))], diameter * MM),
    }
}

/// Area of what is cut of a lamella, all pieces together, square millimetres: outline less openings
/// and holes for screws, without kerf.
pub fn net_area(lamella: &LamellaRecord) -> f64 {
    let openings: f64 = lamella
        .openings
        .iter()
        .map(|opening| match opening_shape(lamella, opening, 0.0) {
            Shape::Path(path) => path.area(),
            Shape::Circle { radius, .. } => core::f64::consts::PI * radius * radius,
            Shape::Text(_) => 0.0,
        })
        .sum();
    let screws: f64 = lamella
        .pieces
        .iter()
        .filter_map(|piece| piece.joint.as_ref())
        .map(screw_area)
        .sum();
    outline::whole(lamella, 0.0).area() - openings - screws
}

/// Area of all holes for screws of a joint, square millimetres.
pub fn screw_area(joint: &JointRecord) -> f64 {
    let radius = 0.5 * joint.hole * MM;
    joint.screws.len() as f64 * core::f64::consts::PI * radius * radius
}

fn label(
    piece: &Piece<'_>,
    neighbours: &Neighbours<'_>,
    style: PartStyle,
) -> (Labels, Vec<Diagnostic>) {
    let lamella = piece.lamella;
    let width = lamella.width * MM;
    let mut openings: Vec<Place> = piece
        .openings()
        .map(|opening| {
            let ([from, to], diameter) = opening_extent(lamella, opening);
            let [from, to] = [from - piece.from, to - piece.from];
            let radius = 0.5 * diameter;
            let other = neighbours
                .crossings
                .iter()
                .find(|(crossing, _)| crossing.id == opening.crossing());
            let reach = other.map_or(radius, |(crossing, other)| {
                contact_reach(width, other.width * MM, crossing) + style.sticker_margin
            });
            Place {
                opening: [from - radius, to + radius],
                contact: [from - reach, to + reach],
                label: other.map_or_else(String::new, |(_, other)| {
                    short_id(&other.id, &neighbours.member.patch)
                }),
                slide: slide(opening),
            }
        })
        .collect();
    openings.extend(piece.screws().into_iter().map(|(at, hole)| Place {
        opening: [at - 0.5 * hole, at + 0.5 * hole],
        contact: [at - 0.5 * hole, at + 0.5 * hole],
        label: String::new(),
        slide: None,
    }));
    openings.sort_by(|a, b| a.opening[0].total_cmp(&b.opening[0]));
    let strip = Strip {
        length: piece.length(),
        width,
        ends: [&piece.start, &piece.end].map(|end| end.length(width)),
        openings,
    };
    let labels = labels::place(&strip, [piece.id, "→ TOP"], style.label_height);
    let mut warnings = Vec::new();
    if !labels.omitted.is_empty() {
        let list: Vec<String> = labels.omitted.iter().map(|l| format!("`{l}`")).collect();
        warnings.push(omitted(piece.id, &list));
    }
    if !stroke_font::knows(piece.id) {
        warnings.push(
            Diagnostic::warning(
                codes::LABEL_CHARACTERS,
                format!(
                    "the id `{}` has characters that cannot be engraved",
                    piece.id
                ),
            )
            .help("name patches with Latin letters and digits")
            .about(piece.id),
        );
    }
    (labels, warnings)
}

fn omitted(id: &str, list: &[String]) -> Diagnostic {
    Diagnostic::warning(
        codes::LABEL_OMITTED,
        format!(
            "no room on lamella `{id}` for the label {}",
            list.join(", ")
        ),
    )
    .note(format!(
        "letters are at least {} mm high and keep {} mm from openings and edges",
        labels::LEAST_HEIGHT,
        labels::CLEAR
    ))
    .about(id)
}

/// Which way the bolt slides in an opening when the grid unfolds.
fn slide(opening: &OpeningRecord) -> Option<&'static str> {
    match opening {
        OpeningRecord::Hole { .. } => None,
        OpeningRecord::Notch { from, to, .. } => Some(if to > from { "→" } else { "←" }),
    }
}

/// How far the strip of a crossing lamella reaches from its centre along this one, at the flatter
/// of its two angles: a parallelogram of widths `w`, `w'` at angle t reaches
/// `w' / (2 sin t) + w / (2 tan t)`.
pub fn contact_reach(width: f64, other: f64, crossing: &CrossingRecord) -> f64 {
    [crossing.angle_planar, crossing.angle_surface]
        .into_iter()
        .map(|degrees| {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            (other + width * cos.abs()) / (2.0 * sin.abs().max(1e-6))
        })
        .fold(0.0, f64::max)
}

/// An id without the patch that everything around it shares: `v05` for `west.v05` on `west`.
pub fn short_id(id: &str, patch: &str) -> String {
    id.strip_prefix(patch)
        .and_then(|rest| rest.strip_prefix('.'))
        .unwrap_or(id)
        .to_owned()
}
