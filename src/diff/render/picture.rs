//! A drawing as SVG elements. What was is red and dashed, what is is green and solid and
//! thicker, what stays is grey and thin, what moved has an arrow: nobody needs to see colours to
//! read it, and a legend says so.

use crate::diff::drawing::{Drawing, Label, Move, Outline, Shape, State};
use crate::fabrication::svg::number;
use svg::Node as _;
use svg::node::element::{Circle, Element, Group, Line, Path, Rectangle, Text};

/// Largest side of a drawing in units of its pens and letters.
const UNITS: f64 = 1000.0;
/// Height of letters, units.
const LETTERS: f64 = 13.0;
/// Height of the legend, units.
const LEGEND: f64 = 74.0;
/// Shorter moves, in units, get a ring instead of an arrow.
const SHORTEST_ARROW: f64 = 9.0;

const BEFORE: &str = "#c62828";
const AFTER: &str = "#1b7f3b";
const SAME: &str = "#9e9e9e";
const MOVED: &str = "#a35200";
const INK: &str = "#222222";

/// A drawing in units, y down, with its size.
pub(super) fn group(drawing: &Drawing) -> (Group, [f64; 2]) {
    let scale = UNITS / drawing.size[0].max(drawing.size[1]).max(1e-9);
    let place = |[x, y]: [f64; 2]| [x * scale, (drawing.size[1] - y) * scale];
    let size = drawing.size.map(|side| side * scale);
    let mut group = Group::new();
    for shape in &drawing.shapes {
        group = group.add(element(shape, &place, scale));
    }
    for arrow in &drawing.moves {
        group = group.add(moved(arrow, &place));
    }
    let mut taken: Vec<[f64; 4]> = Vec::new();
    // What changed is named before what did not.
    let mut labels: Vec<&Label> = drawing.labels.iter().collect();
    labels.sort_by_key(|label| std::cmp::Reverse(label.state));
    for label in labels {
        let [x, y] = place(label.at);
        let width = 0.6 * LETTERS * label.text.chars().count() as f64;
        // A name stands over its part, and beside a dot.
        let is_dot = |shape: &Shape| matches!(&shape.outline, Outline::Slot(at, _, radius) if *radius == 0.0 && *at == label.at);
        let (x, y) = if drawing.shapes.iter().any(is_dot) {
            (x + 7.0, y - 7.0)
        } else {
            (x - 0.5 * width, y + 0.35 * LETTERS)
        };
        let x = x.clamp(2.0, (size[0] - width).max(2.0));
        let frame = [x, y - LETTERS, x + width, y + 0.4 * LETTERS];
        let free = |other: &[f64; 4]| {
            frame[2] < other[0] || other[2] < frame[0] || frame[3] < other[1] || other[3] < frame[1]
        };
        if taken.iter().all(free) {
            taken.push(frame);
            let colour = match label.state {
                State::Same => INK,
                State::Before => BEFORE,
                State::After => AFTER,
            };
            let text = words(&label.text, [x, y], LETTERS, colour);
            group = group.add(named(text, &label.part));
        }
    }
    let (legend, height) = legend(size, drawing.size, scale);
    (group.add(legend), [size[0].max(620.0), size[1] + height])
}

fn element(shape: &Shape, place: &dyn Fn([f64; 2]) -> [f64; 2], scale: f64) -> Element {
    let (stroke, pen) = match shape.state {
        State::Same => (SAME, 0.8),
        State::Before => (BEFORE, 1.4),
        State::After => (AFTER, 2.0),
    };
    let mut element: Element = match &shape.outline {
        Outline::Line(places) => Path::new().set("d", path(places, place, "")).into(),
        Outline::Ring(places) => Path::new().set("d", path(places, place, "Z")).into(),
        Outline::Slot(a, b, radius) => slot(place(*a), place(*b), radius * scale),
    };
    let dot = matches!(&shape.outline, Outline::Slot(_, _, radius) if *radius == 0.0);
    let fill = if dot && shape.state != State::Before {
        stroke
    } else {
        "none"
    };
    element.assign("fill", fill);
    element.assign("stroke", stroke);
    element.assign("stroke-width", number(pen));
    element.assign("class", word(shape.state));
    if shape.state == State::Before {
        element.assign("stroke-dasharray", "6 4");
    }
    assign_part(&mut element, &shape.part);
    element
}

fn word(state: State) -> &'static str {
    match state {
        State::Same => "same",
        State::Before => "before",
        State::After => "after",
    }
}

fn path(places: &[[f64; 2]], place: &dyn Fn([f64; 2]) -> [f64; 2], end: &str) -> String {
    let mut text = String::new();
    for (i, at) in places.iter().enumerate() {
        let [x, y] = place(*at);
        text.push_str(if i == 0 { "M" } else { "L" });
        text.extend([&number(x), " ", &number(y)]);
    }
    text + end
}

/// All places nearer than a radius to a stretch; a dot of fixed size where there is no radius.
fn slot(a: [f64; 2], b: [f64; 2], radius: f64) -> Element {
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = libm::hypot(along[0], along[1]);
    if length < 1e-6 || radius == 0.0 {
        let radius = if radius == 0.0 { 4.0 } else { radius };
        return Circle::new()
            .set("cx", number(a[0]))
            .set("cy", number(a[1]))
            .set("r", number(radius))
            .into();
    }
    let across = [-along[1] / length * radius, along[0] / length * radius];
    let at = |end: [f64; 2], side: f64| {
        let (x, y) = (end[0] + side * across[0], end[1] + side * across[1]);
        format!("{} {}", number(x), number(y))
    };
    let arc = format!("A{0} {0} 0 0 0 ", number(radius));
    let data = format!(
        "M{}L{}{arc}{}L{}{arc}{}Z",
        at(a, 1.0),
        at(b, 1.0),
        at(b, -1.0),
        at(a, -1.0),
        at(a, 1.0)
    );
    Path::new().set("d", data).into()
}

fn moved(arrow: &Move, place: &dyn Fn([f64; 2]) -> [f64; 2]) -> Group {
    let (from, to) = (place(arrow.from), place(arrow.to));
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypot(along[0], along[1]);
    let mut group = Group::new()
        .set("class", "move")
        .set("fill", "none")
        .set("stroke", MOVED)
        .set("stroke-width", "1.6");
    let text_at = if length < SHORTEST_ARROW {
        let ring = Circle::new()
            .set("cx", number(to[0]))
            .set("cy", number(to[1]))
            .set("r", "11");
        group = group.add(ring);
        [to[0] + 14.0, to[1] + 18.0]
    } else {
        let [x, y] = along.map(|side| side / length);
        let wing = |side: f64| {
            let (back, out) = (8.0, 3.5 * side);
            let tip = [to[0] - back * x - out * y, to[1] - back * y + out * x];
            format!("{} {}", number(tip[0]), number(tip[1]))
        };
        let tip = format!("{} {}", number(to[0]), number(to[1]));
        let shaft = format!("M{} {}L{tip}", number(from[0]), number(from[1]));
        let head = format!("M{}L{tip}L{}Z", wing(1.0), wing(-1.0));
        group = group
            .add(Path::new().set("d", shaft))
            .add(Path::new().set("d", head).set("fill", MOVED));
        [0.5 * (from[0] + to[0]) + 6.0, 0.5 * (from[1] + to[1]) - 4.0]
    };
    let text = words(&arrow.text, text_at, 0.85 * LETTERS, MOVED);
    group = group.add(text);
    named(group, &arrow.part)
}

/// What the marks mean, and a bar of a round length.
fn legend(size: [f64; 2], millimetres: [f64; 2], scale: f64) -> (Group, f64) {
    let mut group = Group::new().set("class", "legend");
    let y = size[1] + 26.0;
    let entries = [
        ("before", BEFORE, "1.4", Some("6 4")),
        ("after", AFTER, "2.4", None),
        ("unchanged", SAME, "0.8", None),
    ];
    let mut x = 20.0;
    for (name, colour, pen, dashes) in entries {
        let mut line = Line::new()
            .set("x1", number(x))
            .set("y1", number(y))
            .set("x2", number(x + 46.0))
            .set("y2", number(y))
            .set("stroke", colour)
            .set("stroke-width", pen);
        if let Some(dashes) = dashes {
            line = line.set("stroke-dasharray", dashes);
        }
        let text = words(name, [x + 54.0, y + 5.0], LETTERS, INK);
        group = group.add(line).add(text);
        x += 150.0;
    }
    let arrow = Move {
        part: String::new(),
        from: [x, y],
        to: [x + 46.0, y],
        text: String::new(),
    };
    group = group.add(moved(&arrow, &|place| place)).add(words(
        "moved (a ring where too little to see)",
        [x + 54.0, y + 5.0],
        LETTERS,
        INK,
    ));
    let bar = crate::fabrication::units::round_length(0.25 * millimetres[0].max(millimetres[1]));
    let y = y + 30.0;
    let frame = Rectangle::new()
        .set("x", "20")
        .set("y", number(y - 3.0))
        .set("width", number(bar * scale))
        .set("height", "4")
        .set("fill", INK);
    let text = format!("{} mm", number(bar));
    group = group
        .add(frame)
        .add(words(&text, [28.0 + bar * scale, y + 4.0], LETTERS, INK));
    (group, LEGEND)
}

/// Words with a light edge, so that they can be read on lines.
fn words(text: &str, [x, y]: [f64; 2], height: f64, colour: &str) -> Text {
    Text::new(printable(text))
        .set("x", number(x))
        .set("y", number(y))
        .set("font-family", "sans-serif")
        .set("font-size", number(height))
        .set("fill", colour)
        .set("stroke", "#ffffff")
        .set("stroke-width", "3")
        .set("stroke-linejoin", "round")
        .set("paint-order", "stroke")
}

fn named<T: svg::Node>(mut element: T, part: &str) -> T {
    if !part.is_empty() {
        element.assign("data-part", printable(part));
    }
    element
}

fn assign_part(element: &mut Element, part: &str) {
    if !part.is_empty() {
        element.assign("data-part", printable(part));
    }
}

/// Text without characters that XML forbids.
fn printable(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}
