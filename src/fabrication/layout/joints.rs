//! Joints of a lamella on the flat layout: where its pieces meet, the plate over them, and the
//! letters that the ids of the two pieces end in.

use super::Line;
use crate::fabrication::drawing::{Anchor, Closure, Drawing, Layer, Path, Text, upright};
use crate::fabrication::pieces::plates;
use crate::fabrication::stroke_font;
use crate::fabrication::units::MM;
use crate::plan::LamellaRecord;

/// Letters in widths of the lamella.
const LETTERS: f64 = 0.55;
/// From a joint to a letter beside it, in heights of the letter.
const BESIDE: f64 = 0.3;

/// Draws the joints of a lamella on the layer of its outline.
pub(super) fn draw(drawing: &mut Drawing, strip: Layer, lamella: &LamellaRecord, line: &Line) {
    let width = lamella.width * MM;
    for plate in plates(lamella) {
        let corners = [
            [plate.from, 0.0],
            [plate.to, 0.0],
            [plate.to, width],
            [plate.from, width],
        ];
        let corners = corners.map(|at| line.on_lamella(lamella, at));
        drawing.draw(strip, &plate.id, Path::polyline(&corners, Closure::Closed));
    }
    let (angle, is_turned) = upright(line.angle());
    for pair in lamella.pieces.windows(2) {
        let Some(joint) = &pair[0].joint else {
            continue;
        };
        let seam = pair[0].to * MM;
        let half = 0.5 * joint.length * MM;
        let ends = [0.0, width].map(|y| line.on_lamella(lamella, [seam, y]));
        drawing.draw(strip, &pair[0].id, Path::polyline(&ends, Closure::Open));
        for (piece, side) in pair.iter().zip([-1.0, 1.0]) {
            let letter = piece.id.strip_prefix(&lamella.id).unwrap_or(&piece.id);
            let unit = stroke_font::width(letter);
            // On the half of the plate, which nothing crosses; beside joints without one.
            let (height, middle) = if joint.screws.is_empty() {
                let height = LETTERS * width;
                (height, half + (BESIDE + 0.5 * unit) * height)
            } else {
                ((LETTERS * width).min(0.7 * half / unit), 0.5 * half)
            };
            let drop = if is_turned { 0.5 } else { -0.5 } * height;
            let at = line.on_lamella(lamella, [seam + side * middle, 0.5 * width + drop]);
            let text = Text::new(letter, at, height)
                .anchored(Anchor::Middle)
                .turned(angle);
            drawing.draw(Layer::Label, &piece.id, text);
        }
    }
}
