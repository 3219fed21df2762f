//! Blocks and wedges, drawn at full size.
//!
//! A block is drawn for people: its side view in the plane in which its contact face falls, the
//! view from above, and what it weighs and withstands. The side view is true to size, so it is a
//! template too. Cut files of their own are the side of a wedge, to be cut from sheets as often as
//! the width of the wedge needs and glued, and the two sides of the form of an inclined block.
//!
//! Millimetres; in the side view the contact face falls to the right.

use super::super::drawing::{Anchor, Closure, Drawing, Layer, Palette, Path, Shape, Text};
use super::super::sheet::trim;
use super::super::stroke_font;
use super::super::units::MM;
use super::GRAVITY;
use crate::plan::{SupportBody, SupportRecord};
use crate::project::model::{ColourPreset, SupportKind};

/// What is written on the drawings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockStyle<'a> {
    /// The project's name.
    pub project: &'a str,
    /// The grid's own mass that one support carries on average, kilograms.
    pub share: f64,
    /// Thickness of the sheets that wedges are cut from, metres.
    pub sheet: f64,
    /// Colours of tools.
    pub colours: ColourPreset,
}

/// The side of a block or wedge: a foot, and a straight top that falls to the right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    /// Millimetres.
    pub length: f64,
    /// Height at the left end.
    pub high: f64,
    /// Height at the right end.
    pub low: f64,
}

impl Side {
    /// The contour, counter-clockwise from the lower left corner.
    pub fn contour(&self) -> Path {
        Path::polyline(
            &[
                [0.0, 0.0],
                [self.length, 0.0],
                [self.length, self.low],
                [0.0, self.high],
            ],
            Closure::Closed,
        )
    }
}

/// The side of the wedge of a support, or of the form of an inclined block.
pub fn side(record: &SupportRecord, body: &SupportBody) -> Side {
    let tan = libm::tan(record.tilt.to_radians());
    let length = body.pad * MM;
    let middle = match record.kind {
        SupportKind::WedgeOnBlock => (record.height - body.block) * MM,
        SupportKind::ConcreteBlock | SupportKind::Printed => body.block * MM,
    };
    Side {
        length,
        high: middle + 0.5 * length * tan,
        low: middle - 0.5 * length * tan,
    }
}

/// How many sides of a wedge are glued to its width.
pub fn layers(body: &SupportBody, sheet: f64) -> usize {
    libm::ceil(body.pad / sheet - 1e-9).max(1.0) as usize
}

/// The cut file of the side, none for a printed support. `fabrication.kerf` is not compensated:
/// a wedge may be a tenth of a millimetre off.
pub fn template(record: &SupportRecord, style: &BlockStyle<'_>) -> Option<Drawing> {
    let body = record.body?;
    let words = match record.kind {
        SupportKind::Printed => return None,
        SupportKind::WedgeOnBlock => format!(
            "cut {} of {} mm",
            layers(&body, style.sheet),
            trim(style.sheet * MM)
        ),
        SupportKind::ConcreteBlock => "form, cut 2".to_owned(),
    };
    let side = side(record, &body);
    let border = 5.0;
    let size = [side.length + 2.0 * border, side.high + 2.0 * border];
    let mut drawing = Drawing::new(
        format!("{} {}: template", style.project, record.id),
        size,
        Palette::Cut(style.colours),
    );
    let at = [border; 2];
    // The letters stay below the top, which falls to the right.
    let room = side.length - 4.0;
    for (line, text) in [words.as_str(), record.at.as_str()].iter().enumerate() {
        let height = 4.0_f64
            .min(room / stroke_font::width(text))
            .min(0.25 * side.low);
        let x = 2.0;
        let y = 0.25 * side.low + 1.6 * height * line as f64;
        let right = x + stroke_font::width(text) * height;
        let top = side.high - (side.high - side.low) * right / side.length;
        if y + height + 0.5 < top {
            let text = Text::new(*text, [x, y], height);
            drawing.draw(Layer::Engrave, &record.id, Shape::Text(text).translated(at));
        }
    }
    let axis = bolt_axis(record, &body);
    let axis = axis.map(|[x, y]| [x + 0.5 * side.length, y - base_of(record, &body)]);
    let axis = clipped_to_foot(axis);
    drawing.draw(
        Layer::Score,
        &record.id,
        Path::polyline(&axis, Closure::Open).translated(at),
    );
    drawing.draw(Layer::CutOuter, &record.id, side.contour().translated(at));
    Some(drawing)
}

/// Height at which the drawn side begins: wedges stand on their block.
fn base_of(record: &SupportRecord, body: &SupportBody) -> f64 {
    match record.kind {
        SupportKind::WedgeOnBlock => body.block * MM,
        SupportKind::ConcreteBlock | SupportKind::Printed => 0.0,
    }
}

/// The axis of the hole from just inside the contact face to its end, from the middle of the
/// foot, in the side view.
fn bolt_axis(record: &SupportRecord, body: &SupportBody) -> [[f64; 2]; 2] {
    let (sin, cos) = libm::sincos(record.tilt.to_radians());
    [0.5, body.depth * MM].map(|depth| [-depth * sin, record.height * MM - depth * cos])
}

/// A line from above cut off half a millimetre above the foot.
fn clipped_to_foot([top, end]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let floor = 0.5;
    if end[1] >= floor || top[1] - end[1] <= 0.0 {
        return [top, end];
    }
    let share = (top[1] - floor) / (top[1] - end[1]);
    [top, [top[0] + share * (end[0] - top[0]), floor]]
}

/// The drawing of a block, none for a printed support.
pub fn block(record: &SupportRecord, style: &BlockStyle<'_>) -> Option<Drawing> {
    let body = record
        .body
        .filter(|_| record.kind != SupportKind::Printed)?;
    let foot = body.foot * MM;
    let mut sheet = Paper::new(record, style, foot);
    let tan = libm::tan(record.tilt.to_radians());
    let slope = |length: f64| 0.5 * length * tan;

    // Side view, the middle of the foot at the origin.
    let block_side = match record.kind {
        SupportKind::WedgeOnBlock => Side {
            length: foot,
            high: body.block * MM,
            low: body.block * MM,
        },
        SupportKind::ConcreteBlock | SupportKind::Printed => side(record, &body),
    };
    sheet.closed(
        Layer::LamellaV,
        &block_side.contour().translated([-0.5 * foot, 0.0]),
    );
    let face = side(record, &body);
    if record.kind == SupportKind::WedgeOnBlock {
        let at = [-0.5 * face.length, body.block * MM];
        sheet.closed(Layer::LamellaU, &face.contour().translated(at));
    }
    let axis = bolt_axis(record, &body);
    sheet.line(Layer::Bolt, axis);
    let middle = record.height * MM;
    let right = 0.5 * foot;
    let top = middle + slope(face.length);
    sheet.level(-1, [-right, 0.0], [right, 0.0], -2.6, &mm(foot));
    sheet.upright(right + sheet.step(2.0), 0.0, middle, &mm(middle));
    let high = match record.kind {
        SupportKind::WedgeOnBlock => body.block * MM,
        SupportKind::ConcreteBlock | SupportKind::Printed => block_side.high,
    };
    if record.kind == SupportKind::WedgeOnBlock || record.tilt > 0.05 {
        sheet.upright(-right - sheet.step(2.0), 0.0, high, &mm(high));
    }
    if record.kind == SupportKind::ConcreteBlock && record.tilt > 0.05 {
        let low = block_side.low;
        sheet.upright(right + sheet.step(6.5), 0.0, low, &mm(low));
    }

    // View from above, to the right of the side view.
    let away = foot + sheet.step(16.0) + 0.5 * foot;
    let centre = [away, 0.5 * foot];
    let square = |half: f64| {
        Path::rectangle(
            [centre[0] - half, centre[1] - half],
            [centre[0] + half, centre[1] + half],
        )
    };
    sheet.closed(Layer::LamellaV, &square(0.5 * foot));
    if record.kind == SupportKind::WedgeOnBlock {
        sheet.closed(Layer::LamellaU, &square(0.5 * face.length));
    }
    let arm = sheet.step(0.8);
    sheet.line(
        Layer::Bolt,
        [[centre[0] - arm, centre[1]], [centre[0] + arm, centre[1]]],
    );
    sheet.line(
        Layer::Bolt,
        [[centre[0], centre[1] - arm], [centre[0], centre[1] + arm]],
    );
    if record.tilt > 0.05 {
        sheet.arrow(centre, [centre[0] + 0.45 * foot, centre[1]]);
    }
    sheet.level(
        -1,
        [centre[0] - 0.5 * foot, 0.0],
        [centre[0] + 0.5 * foot, 0.0],
        -2.6,
        &mm(foot),
    );
    let lines = notes(record, &body, style);
    Some(sheet.finish(top, &lines))
}

fn mm(value: f64) -> String {
    trim(libm::round(value * 10.0) / 10.0)
}

/// What must be known of a block.
fn notes(record: &SupportRecord, body: &SupportBody, style: &BlockStyle<'_>) -> Vec<String> {
    let kind = match record.kind {
        SupportKind::ConcreteBlock => "block of concrete with an inclined top",
        SupportKind::WedgeOnBlock => "block of concrete, wooden wedge on it",
        SupportKind::Printed => "printed foot",
    };
    let mut lines = vec![
        format!("{} {}   {kind}   1:1 mm", style.project, record.id),
        format!(
            "{}. Its middle is {} above the ground",
            if record.tilt > 0.05 {
                format!("contact face {:.1}°, falls to the right", record.tilt)
            } else {
                "contact face level".to_owned()
            },
            mm(record.height * MM)
        ),
        format!(
            "concrete {:.2} l, {:.1} kg. Hole {} deep, square to the contact face",
            body.volume * 1e3,
            body.mass,
            mm(body.depth * MM)
        ),
    ];
    if record.kind == SupportKind::WedgeOnBlock {
        let side = side(record, body);
        lines.push(format!(
            "wedge {} x {} mm, {} to {} high: {} sides of {} mm, glued",
            mm(side.length),
            mm(side.length),
            mm(side.low),
            mm(side.high),
            layers(body, style.sheet),
            trim(style.sheet * MM)
        ));
    }
    lines.push(format!(
        "stands by itself, tips at a thrust of {:.0} N at the contact face",
        body.tipping_thrust
    ));
    lines.push(format!(
        "its share of the weight of the lamellae is {:.1} N. The thrust of the bent grid: see statics",
        style.share * GRAVITY
    ));
    lines
}

/// A drawing in the making, with letters in proportion to the block.
struct Paper<'a> {
    drawing: Drawing,
    record: &'a SupportRecord,
    letters: f64,
}

impl<'a> Paper<'a> {
    fn new(record: &'a SupportRecord, style: &BlockStyle<'_>, foot: f64) -> Self {
        let extent = (record.height * MM).max(foot);
        let mut drawing = Drawing::new(
            format!("{} {}", style.project, record.id),
            [0.0; 2],
            Palette::People,
        );
        drawing.pen = extent / 250.0;
        Self {
            drawing,
            record,
            letters: extent / 24.0,
        }
    }

    fn step(&self, letters: f64) -> f64 {
        letters * self.letters
    }

    fn closed(&mut self, layer: Layer, path: &Path) {
        self.drawing.draw(layer, &self.record.id, path.clone());
    }

    fn line(&mut self, layer: Layer, line: [[f64; 2]; 2]) {
        let path = Path::polyline(&line, Closure::Open);
        self.drawing.draw(layer, &self.record.id, path);
    }

    fn arrow(&mut self, from: [f64; 2], tip: [f64; 2]) {
        self.line(Layer::CurveU, [from, tip]);
        let [x, y] = tip;
        let barb = self.step(0.7);
        let barbs = [[x - barb, y + 0.5 * barb], tip, [x - barb, y - 0.5 * barb]];
        let path = Path::polyline(&barbs, Closure::Open);
        self.drawing.draw(Layer::CurveU, &self.record.id, path);
    }

    /// A dimension below a level edge.
    fn level(&mut self, side: i32, from: [f64; 2], to: [f64; 2], offset: f64, words: &str) {
        let y = from[1] + self.step(offset);
        self.line(Layer::Axis, [[from[0], y], [to[0], y]]);
        for x in [from[0], to[0]] {
            let reach = f64::from(side) * self.step(0.5);
            self.line(Layer::Axis, [[x, y + reach], [x, y - reach]]);
        }
        let at = [0.5 * (from[0] + to[0]), y + self.step(0.35)];
        let text = Text::new(words, at, self.letters).anchored(Anchor::Middle);
        self.drawing.draw(Layer::Label, &self.record.id, text);
    }

    /// A dimension beside the side view.
    fn upright(&mut self, x: f64, from: f64, to: f64, words: &str) {
        self.line(Layer::Axis, [[x, from], [x, to]]);
        let tick = self.step(0.5);
        for y in [from, to] {
            self.line(Layer::Axis, [[x - tick, y], [x + tick, y]]);
        }
        let at = [x - self.step(0.35), 0.5 * (from + to)];
        let text = Text::new(words, at, self.letters)
            .anchored(Anchor::Middle)
            .turned(core::f64::consts::FRAC_PI_2);
        self.drawing.draw(Layer::Label, &self.record.id, text);
    }

    /// Notes above the views, and the frame around everything.
    fn finish(mut self, top: f64, lines: &[String]) -> Drawing {
        let small = 0.8 * self.letters;
        let left = self.drawing.bounds().min[0];
        let mut y = top + self.step(1.6) + 1.8 * small * (lines.len() as f64 - 1.0);
        for (number, line) in lines.iter().enumerate() {
            let layer = if number == 0 {
                Layer::Title
            } else {
                Layer::Label
            };
            let text = Text::new(line, [left, y], small);
            self.drawing.draw(layer, &self.record.id, text);
            y -= 1.8 * small;
        }
        let bounds = self.drawing.bounds();
        let border = self.step(1.5);
        let shift = [border - bounds.min[0], border - bounds.min[1]];
        for entity in &mut self.drawing.entities {
            entity.shape = entity.shape.translated(shift);
        }
        let [width, height] = bounds.size();
        self.drawing.size = [width + 2.0 * border, height + 2.0 * border];
        self.drawing
    }
}
