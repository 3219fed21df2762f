//! Parts: a lamella as the shapes that cut it.
//!
//! A part lies along x from the start of its lamella and is drawn as seen on its top face, in
//! millimetres from the lower left corner of its nominal outline. Its shapes stand in cutting
//! order: engraving, openings, outline.
//!
//! **Ends are round**, half circles over the whole width. Several lamellae turn about one bolt
//! where patches meet, and round ends show the same outline at every angle, leave no corner that
//! catches or splits, and keep at least the wood around an end hole that a square end of the same
//! margin has in the direction of the pull.
//!
//! **Kerf.** A beam removes half its width on either side of the line it follows: with kerf `k`
//! outlines grow and openings shrink by `k/2` all around, so that the cut part is nominal. With
//! 0 the drawing itself is nominal and the machine may compensate.

use super::drawing::{Entity, Layer, Path, Shape};
use super::labels::{self, Labels, Place, Strip};
use super::stroke_font;
use super::units::MM;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::plan::{CrossingRecord, LamellaRecord, MemberRecord, OpeningRecord};

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
    /// In cutting order, in the part's frame.
    pub shapes: Vec<Entity>,
}

/// How parts are drawn. Millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartStyle {
    /// Width of the cut that is compensated; 0 draws nominal geometry.
    pub kerf: f64,
    /// Height of engraved labels.
    pub label_height: f64,
    /// How far a sticker reaches beyond the contact area.
    pub sticker_margin: f64,
}

/// What a part is made from, besides its lamella: who crosses it where.
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbours<'a> {
    /// The member whose lamella it is.
    pub member: &'a MemberRecord,
    /// Crossings and the lamella of the other member at each, those of this lamella's openings.
    pub crossings: Vec<(&'a CrossingRecord, &'a LamellaRecord)>,
}

/// Draws a lamella as one part. Warnings tell of labels without place.
pub fn draw(
    lamella: &LamellaRecord,
    neighbours: &Neighbours<'_>,
    style: PartStyle,
) -> (Part, Vec<Diagnostic>) {
    let (labels, warnings) = label(lamella, neighbours, style);
    let [length, width] = [lamella.length * MM, lamella.width * MM];
    let entity = |layer, shape| Entity {
        layer,
        subject: lamella.id.clone(),
        shape,
    };
    let mut shapes: Vec<Entity> = labels
        .texts
        .into_iter()
        .map(|text| entity(Layer::Engrave, Shape::Text(text)))
        .collect();
    for opening in &lamella.openings {
        shapes.push(entity(
            Layer::CutInner,
            opening_shape(lamella, opening, style.kerf),
        ));
    }
    shapes.push(entity(Layer::CutOuter, outline(lamella, style.kerf).into()));
    let part = Part {
        id: lamella.id.clone(),
        length,
        width,
        shapes,
    };
    (part, warnings)
}

/// The outline with round ends, counter-clockwise.
pub fn outline(lamella: &LamellaRecord, kerf: f64) -> Path {
    let [length, width] = [lamella.length * MM, lamella.width * MM];
    let radius = 0.5 * width.min(length);
    Path::slot(radius, length - radius, 0.5 * width, radius + 0.5 * kerf)
}

/// An opening in the frame of the part.
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

/// Area of the cut part, square millimetres: outline less openings, without kerf.
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
    outline(lamella, 0.0).area() - openings
}

fn label(
    lamella: &LamellaRecord,
    neighbours: &Neighbours<'_>,
    style: PartStyle,
) -> (Labels, Vec<Diagnostic>) {
    let width = lamella.width * MM;
    let openings = lamella
        .openings
        .iter()
        .map(|opening| {
            let ([from, to], diameter) = opening_extent(lamella, opening);
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
            }
        })
        .collect();
    let strip = Strip {
        length: lamella.length * MM,
        width,
        round: 0.5 * width,
        openings,
    };
    let labels = labels::place(&strip, [&lamella.id, "→ TOP"], style.label_height);
    let mut warnings = Vec::new();
    if !labels.omitted.is_empty() {
        let omitted: Vec<String> = labels.omitted.iter().map(|l| format!("`{l}`")).collect();
        warnings.push(
            Diagnostic::warning(
                codes::LABEL_OMITTED,
                format!(
                    "no room on lamella `{}` for the label {}",
                    lamella.id,
                    omitted.join(", ")
                ),
            )
            .note(format!(
                "letters are at least {} mm high and keep {} mm from openings and edges",
                labels::LEAST_HEIGHT,
                labels::CLEAR
            ))
            .about(&lamella.id),
        );
    }
    if !stroke_font::knows(&lamella.id) {
        warnings.push(
            Diagnostic::warning(
                codes::LABEL_CHARACTERS,
                format!(
                    "the id `{}` has characters that cannot be engraved",
                    lamella.id
                ),
            )
            .help("name patches with Latin letters and digits")
            .about(&lamella.id),
        );
    }
    (labels, warnings)
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
