//! Overlays as SVG files: one a drawing, or all below each other.

use super::picture;
use super::words::{project, side, verdict};
use crate::diff::document::Difference;
use crate::diff::drawing::Drawing;
use crate::fabrication::svg::number;
use svg::node::element::{Group, Rectangle, Text};

/// Height of the title of a drawing, units.
const TITLE: f64 = 46.0;

/// All overlays of a difference below each other. Where nothing changed, a picture that says so.
pub fn svg(difference: &Difference) -> String {
    let drawings: Vec<&Drawing> = difference.drawings.iter().collect();
    document(difference, &drawings)
}

/// One overlay of a difference.
pub fn svg_of(difference: &Difference, drawing: &Drawing) -> String {
    document(difference, &[drawing])
}

fn document(difference: &Difference, drawings: &[&Drawing]) -> String {
    let sides = [&difference.before, &difference.after].map(side);
    let name = project(difference, "→");
    let head = format!(
        "{name}: {} → {}: {}",
        sides[0],
        sides[1],
        verdict(difference)
    );
    let mut body = Group::new();
    let (mut width, mut height) = (620.0_f64, 40.0);
    body = body.add(words(&head, 26.0, 15.0));
    for drawing in drawings {
        let (picture, size) = picture::group(drawing);
        body = body.add(words(&drawing.title, height + 28.0, 18.0));
        height += TITLE;
        let place = format!("translate(0 {})", number(height));
        body = body.add(picture.set("transform", place));
        height += size[1];
        width = width.max(size[0]);
    }
    let background = Rectangle::new()
        .set("width", number(width))
        .set("height", number(height))
        .set("fill", "#ffffff");
    let document = svg::Document::new()
        .set("width", number(width))
        .set("height", number(height))
        .set(
            "viewBox",
            format!("0 0 {} {}", number(width), number(height)),
        )
        .add(svg::node::element::Title::new(printable(&head)))
        .add(background)
        .add(body);
    format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{document}\n")
}

fn words(text: &str, y: f64, height: f64) -> Text {
    Text::new(printable(text))
        .set("x", "20")
        .set("y", number(y))
        .set("font-family", "sans-serif")
        .set("font-size", number(height))
        .set("font-weight", "bold")
        .set("fill", "#222222")
}

fn printable(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}
