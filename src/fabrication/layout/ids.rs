//! Ids beyond both tips of every lamella, in its direction.
//!
//! At small angles lamellae lie nearly along each other, and an id right behind its tip would stand on
//! a neighbour: it moves on in the direction of its lamella to where nothing is, and a line leads
//! back to the tip.

use super::{FlatPatch, Line};
use crate::fabrication::drawing::{Anchor, Closure, Drawing, Layer, Path, Text, Tile, upright};
use crate::fabrication::part::short_id;
use crate::fabrication::units::MM;
use crate::plan::{LamellaRecord, MemberRecord};
use crate::project::model::Family;

/// From a tip to its id, in letter heights.
const GAP: f64 = 0.8;
/// Ids move on in steps of this, in letter heights, so often at most.
const STEP: f64 = 0.5;
const STEPS: u32 = 80;
/// From the end of the line that leads to an id to the id, in letter heights.
const BEFORE: f64 = 0.3;

/// Draws all ids, those of the upper lamellae nearer to their tips.
pub(super) fn draw(drawing: &mut Drawing, flat: &FlatPatch<'_>, height: f64) {
    let mut taken: Vec<Tile> = flat.lamellae.iter().map(strip).collect();
    for family in [Family::U, Family::V] {
        for (member, lamella) in &flat.lamellae {
            if member.family != family {
                continue;
            }
            let line = Line::new(member);
            let name = short_id(&lamella.id, &flat.patch.id);
            for end in [End::Start, End::End] {
                let tip = lamella.end_margin * MM;
                let place = |step: u32| {
                    let away = tip + (GAP + STEP * f64::from(step)) * height;
                    (away, id(&name, &line, end, away, height))
                };
                let is_free = |text: &Text| {
                    let tile = Tile::of_text(text);
                    !taken.iter().any(|other| other.overlaps(&tile))
                };
                let found = (0..STEPS).find(|step| is_free(&place(*step).1));
                let (away, text) = place(found.unwrap_or(0));
                taken.push(Tile::of_text(&text));
                if found.is_some_and(|step| step > 0) {
                    let lead =
                        [tip, away - BEFORE * height].map(|x| line.at([end.beyond(&line, x), 0.0]));
                    let lead = Path::polyline(&lead, Closure::Open);
                    drawing.draw(Layer::Axis, &lamella.id, lead);
                }
                drawing.draw(Layer::Label, &lamella.id, text);
            }
        }
    }
}

#[derive(Clone, Copy)]
enum End {
    Start,
    End,
}

impl End {
    /// A place on a line so far beyond this end of it.
    fn beyond(self, line: &Line, away: f64) -> f64 {
        match self {
            Self::Start => -away,
            Self::End => line.length + away,
        }
    }
}

/// An id that begins so far beyond an end, readable from below or from the right.
fn id(name: &str, line: &Line, end: End, away: f64, height: f64) -> Text {
    let (angle, is_turned) = upright(line.angle());
    let side = if is_turned { 0.5 } else { -0.5 } * height;
    let anchor = match (end, is_turned) {
        (End::Start, false) | (End::End, true) => Anchor::End,
        (End::Start, true) | (End::End, false) => Anchor::Start,
    };
    Text::new(name, line.at([end.beyond(line, away), side]), height)
        .anchored(anchor)
        .turned(angle)
}

/// Where a lamella lies.
fn strip((member, lamella): &(&MemberRecord, &LamellaRecord)) -> Tile {
    let line = Line::new(member);
    let ends = [0.0, lamella.length * MM];
    let middle = 0.5 * lamella.width * MM;
    Tile::along(
        ends.map(|x| line.on_lamella(lamella, [x, middle])),
        lamella.width * MM,
    )
}
