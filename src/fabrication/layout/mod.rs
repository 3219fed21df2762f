//! The flat layout of a patch: its lamellae at true size where they lie when the grid is bolted
//! together flat, seen from the top, the u-family above the v-family.
//!
//! It is the drawing to assemble by: every lamella with its id at both ends, its openings, its
//! joints with the letters of their pieces, and the bolts where they stand in the flat state. Frame:
//! the patch's planar frame in millimetres, moved into the first quadrant.

mod ids;
mod joints;

use crate::fabrication::drawing::{Bounds, Closure, Drawing, Layer, Palette, Path, Shape, Text};
use crate::fabrication::outline;
use crate::fabrication::part::{opening_shape, short_id};
use crate::fabrication::sheet::trim;
use crate::fabrication::stroke_font;
use crate::fabrication::units::{MM, round_length};
use crate::plan::{CrossingRecord, LamellaRecord, MemberRecord, PatchRecord};
use crate::project::model::Family;

/// A patch with everything that lies flat.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatPatch<'a> {
    /// The project's name.
    pub project: &'a str,
    /// The patch.
    pub patch: &'a PatchRecord,
    /// Its members with their lamellae.
    pub lamellae: Vec<(&'a MemberRecord, &'a LamellaRecord)>,
    /// Its crossings.
    pub crossings: Vec<&'a CrossingRecord>,
    /// Nominal diameter of the bolts, metres.
    pub bolt: f64,
}

/// A member's line in the plane, millimetres.
struct Line {
    start: [f64; 2],
    direction: [f64; 2],
    length: f64,
}

impl Line {
    fn new(member: &MemberRecord) -> Self {
        let [a, b] = member.planar.map(|point| point.map(|v| v * MM));
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let length = libm::hypot(dx, dy);
        // A member without length has no direction; its lamella is drawn along x.
        let direction = if length > 0.0 {
            [dx / length, dy / length]
        } else {
            [1.0, 0.0]
        };
        Self {
            start: a,
            direction,
            length,
        }
    }

    /// The point at (`x` along, `y` to the left).
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.direction;
        [self.start[0] + c * x - s * y, self.start[1] + s * x + c * y]
    }

    /// A place on a lamella: along it from its end, across it from its right edge.
    fn on_lamella(&self, lamella: &LamellaRecord, [x, y]: [f64; 2]) -> [f64; 2] {
        self.at([x - lamella.end_margin * MM, y - 0.5 * lamella.width * MM])
    }

    fn angle(&self) -> f64 {
        libm::atan2(self.direction[1], self.direction[0])
    }
}

/// Draws the layout.
pub fn draw(flat: &FlatPatch<'_>) -> Drawing {
    let mut drawing = Drawing::new(
        format!("{} {}: flat layout", flat.project, flat.patch.id),
        [0.0; 2],
        Palette::People,
    );
    let extent = extent(flat);
    let height = letter_height(flat, extent);
    drawing.pen = extent / 500.0;
    for &(member, lamella) in &flat.lamellae {
        draw_lamella(&mut drawing, member, lamella);
    }
    ids::draw(&mut drawing, flat, height);
    for crossing in &flat.crossings {
        let centre = crossing.planar.map(|v| v * MM);
        let radius = 0.5 * flat.bolt * MM;
        drawing.draw(Layer::Bolt, &crossing.id, Shape::Circle { centre, radius });
    }
    frame(&mut drawing, flat, extent);
    drawing
}

fn draw_lamella(drawing: &mut Drawing, member: &MemberRecord, lamella: &LamellaRecord) {
    let line = Line::new(member);
    let lay = |at| line.on_lamella(lamella, at);
    let (strip, opening) = match member.family {
        Family::U => (Layer::LamellaU, Layer::OpeningU),
        Family::V => (Layer::LamellaV, Layer::OpeningV),
    };
    drawing.draw(strip, &lamella.id, outline::whole(lamella, 0.0).mapped(lay));
    joints::draw(drawing, strip, lamella, &line);
    for record in &lamella.openings {
        let shape = match opening_shape(lamella, record, 0.0) {
            Shape::Path(path) => Shape::Path(path.mapped(lay)),
            Shape::Circle { centre, radius } => Shape::Circle {
                centre: lay(centre),
                radius,
            },
            other @ Shape::Text(_) => other,
        };
        drawing.draw(opening, &lamella.id, shape);
    }
}

/// Letters as large as neighbouring ends leave room for.
fn letter_height(flat: &FlatPatch<'_>, extent: f64) -> f64 {
    let mut room = extent / 60.0;
    for family in [Family::U, Family::V] {
        let mut lines: Vec<(u32, Line)> = flat
            .lamellae
            .iter()
            .filter(|(member, _)| member.family == family)
            .map(|(member, _)| (member.index, Line::new(member)))
            .collect();
        lines.sort_by_key(|(index, _)| *index);
        for pair in lines.windows(2) {
            let (a, b) = (&pair[0].1, &pair[1].1);
            for x in [0.0, a.length] {
                let from = a.at([x, 0.0]);
                let to = b.at([if x == 0.0 { 0.0 } else { b.length }, 0.0]);
                // Distance across the reading direction.
                let [c, s] = a.direction;
                let gap = (c * (to[1] - from[1]) - s * (to[0] - from[0])).abs();
                room = room.min(0.7 * gap);
            }
        }
    }
    room.max(extent / 400.0)
}

fn extent(flat: &FlatPatch<'_>) -> f64 {
    let mut bounds = Bounds::EMPTY;
    for (member, _) in &flat.lamellae {
        for point in member.planar {
            bounds.add(point.map(|v| v * MM));
        }
    }
    if bounds.is_empty() {
        1.0
    } else {
        let [width, height] = bounds.size();
        width.max(height).max(1.0)
    }
}

/// Moves the drawing into the first quadrant and adds title and scale below it.
fn frame(drawing: &mut Drawing, flat: &FlatPatch<'_>, extent: f64) {
    let bounds = drawing.bounds();
    if bounds.is_empty() {
        drawing.size = [extent; 2];
        return;
    }
    let border = extent / 40.0;
    let band = extent / 9.0;
    let shift = [border - bounds.min[0], border + band - bounds.min[1]];
    for entity in &mut drawing.entities {
        entity.shape = entity.shape.translated(shift);
    }
    let [width, height] = bounds.size();
    drawing.size = [width + 2.0 * border, height + 2.0 * border + band];

    let bar = round_length(extent / 5.0);
    let letters = extent / 70.0;
    let y = border + 5.0 * letters;
    for line in [
        [[border, y], [border + bar, y]],
        [[border, y - 0.5 * letters], [border, y + 0.5 * letters]],
        [
            [border + bar, y - 0.5 * letters],
            [border + bar, y + 0.5 * letters],
        ],
    ] {
        drawing.draw(Layer::Axis, "", Path::polyline(&line, Closure::Open));
    }
    let scale = format!("{} mm", trim(bar));
    let words = format!(
        "{} / {}   flat, seen from the top   1:1 mm",
        flat.project, flat.patch.id
    );
    let left = border + bar + letters;
    let after = left + stroke_font::width(&scale) * letters + 2.0 * letters;
    let room = drawing.size[0] - border - after;
    let fitted = letters.min(room / stroke_font::width(&words));
    let [layers, corners] = notes(flat);
    let below = |line: f64| y - (0.5 + 1.9 * line) * letters;
    let narrow = |words: &str| {
        let room = drawing.size[0] - 2.0 * border;
        (0.9 * letters).min(room / stroke_font::width(words))
    };
    let (first, second) = (narrow(&layers), narrow(&corners));
    for (text, at, letters) in [
        (scale, [left, y - 0.5 * letters], letters),
        (words, [after, y - 0.5 * fitted], fitted),
        (layers, [border, below(1.0)], first),
        (corners, [border, below(2.0)], second),
    ] {
        if letters > 0.0 {
            drawing.draw(Layer::Title, "", Text::new(text, at, letters));
        }
    }
}

/// What lies on what, and which corner is which.
fn notes(flat: &FlatPatch<'_>) -> [String; 2] {
    let PatchRecord {
        id,
        corners: [a, b, c, d],
        alpha_planar,
        alpha_surface,
        ..
    } = flat.patch;
    let ends = |family: Family| {
        let members = flat.lamellae.iter().map(|(member, _)| member);
        let family = members.filter(|member| member.family == family);
        let first = family.clone().min_by_key(|member| member.index);
        let last = family.max_by_key(|member| member.index);
        [first, last].map(|member| member.map_or_else(String::new, |m| short_id(&m.id, id)))
    };
    let ([u1, u2], [v1, v2]) = (ends(Family::U), ends(Family::V));
    [
        format!(
            "first {v1} to {v2}, then {u1} to {u2} across on top   angle at {a}: {alpha_planar:.1}° \
             flat, {alpha_surface:.1}° unfolded"
        ),
        format!("corners   {a}: {u1} {v1}   {b}: {u2} {v1}   {c}: {u2} {v2}   {d}: {u1} {v2}"),
    ]
}
