//! The SVG writer: a [`Drawing`] as a tree of plain elements at its true size.
//!
//! Width and height are in millimetres and the view box counts millimetres, so that neither a
//! browser's 96 dpi nor an importer's habits can change the size. Each layer is one group with
//! its look as plain attributes, named for Inkscape too; there are no transforms, classes, styles
//! or references, which cutters' programs read differently. y runs down: `y_svg = height - y`.
//!
//! Within a layer the drawing's order is kept; layers come in the order of [`Layer`], which puts
//! engraving before scores, openings before outlines.
//!
//! Numbers are written by [`number`] alone: four decimals are a tenth of a micrometre.

use super::drawing::{Closure, Drawing, Entity, NotFinite, Path, Segment, Shape, Style};
use svg::node::element::{Circle, Group, Path as PathElement, Title};

/// Longest arc that is written in one piece, as the bulge of 120 degrees. The centre of a half
/// circle hangs on the last digits of its radius, that of a third does not.
const LONGEST_BULGE: f64 = 0.577_350_269_189_625_8;

/// Writes a drawing. The only way to fail is a number that is none.
pub fn write(drawing: &Drawing) -> Result<Vec<u8>, NotFinite> {
    drawing.check()?;
    let [width, height] = drawing.size;
    let mut document = svg::Document::new()
        .set(
            "xmlns:inkscape",
            "http://www.inkscape.org/namespaces/inkscape",
        )
        .set("width", format!("{}mm", number(width)))
        .set("height", format!("{}mm", number(height)))
        .set(
            "viewBox",
            format!("0 0 {} {}", number(width), number(height)),
        )
        .add(Title::new(printable(&drawing.title)));
    for layer in drawing.layers() {
        let style = drawing.palette.style(layer);
        let mut group = Group::new()
            .set("id", layer.name())
            .set("inkscape:groupmode", "layer")
            .set("inkscape:label", layer.name())
            .set("fill", style.fill.map_or_else(|| "none".to_owned(), hex))
            .set("stroke", hex(style.rgb))
            .set("stroke-width", number(style.pen * drawing.pen))
            .set("stroke-linecap", "round")
            .set("stroke-linejoin", "round");
        for entity in drawing.entities.iter().filter(|e| e.layer == layer) {
            group = add(group, entity, &style, height);
        }
        document = document.add(group);
    }
    Ok(format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{document}\n").into_bytes())
}

/// A number as text: four decimals, trailing zeros and a negative zero dropped.
pub fn number(value: f64) -> String {
    let mut text = format!("{value:.4}");
    text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    if text == "-0" {
        text.remove(0);
    }
    text
}

fn add(group: Group, entity: &Entity, style: &Style, height: f64) -> Group {
    let stroke_only = |path: PathElement| match style.fill {
        Some(_) => path.set("fill", "none"),
        None => path,
    };
    match &entity.shape {
        Shape::Path(path) => {
            let element = PathElement::new().set("d", data([path], height));
            group.add(labelled(
                match path.closed {
                    Closure::Open => stroke_only(element),
                    Closure::Closed => element,
                },
                entity,
            ))
        }
        Shape::Circle { centre, radius } => group.add(labelled(
            Circle::new()
                .set("cx", number(centre[0]))
                .set("cy", number(height - centre[1]))
                .set("r", number(*radius)),
            entity,
        )),
        Shape::Text(text) => {
            let mut element = PathElement::new()
                .set("aria-label", printable(&text.content))
                .set("d", data(&text.strokes(), height));
            if let Some(share) = style.letters {
                element = element.set("stroke-width", number(share * text.height));
            }
            group.add(labelled(stroke_only(element), entity))
        }
    }
}

/// Names the thing that an element belongs to, as Inkscape shows it.
fn labelled<T: svg::Node>(mut element: T, entity: &Entity) -> T {
    if !entity.subject.is_empty() {
        element.assign("inkscape:label", printable(&entity.subject));
    }
    element
}

fn data<'a>(paths: impl IntoIterator<Item = &'a Path>, height: f64) -> String {
    let point = |[x, y]: [f64; 2]| format!("{} {}", number(x), number(height - y));
    let mut text = String::new();
    for path in paths {
        let mut segments = path.segments().peekable();
        if let Some(first) = segments.peek() {
            text.push('M');
            text += &point(first.from);
        }
        while let Some(segment) = segments.next() {
            if segment.bulge != 0.0 {
                arcs(&segment, &mut |radius, sweep, to| {
                    let radius = number(radius);
                    let shape = ["A", &radius, " ", &radius, " 0 0 ", sweep, " "];
                    text.extend(shape);
                    text += &point(to);
                });
            } else if segments.peek().is_some() || path.closed == Closure::Open {
                // The last straight side of a closed path is drawn by the closing Z.
                text.push('L');
                text += &point(segment.to);
            }
        }
        if path.closed == Closure::Closed {
            text.push('Z');
        }
    }
    text
}

/// Calls `draw` with radius, SVG's sweep flag and end of each piece of an arc. Counter-clockwise
/// with y up is SVG's negative direction with y down.
fn arcs(segment: &Segment, draw: &mut impl FnMut(f64, &'static str, [f64; 2])) {
    if segment.bulge.abs() > LONGEST_BULGE {
        for half in segment.halves() {
            arcs(&half, draw);
        }
    } else if let Some(arc) = segment.arc() {
        let sweep = if segment.bulge < 0.0 { "1" } else { "0" };
        draw(arc.radius, sweep, segment.to);
    }
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Text without characters that XML forbids.
pub(crate) fn printable(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::drawing::{Layer, Palette, Text};
    use crate::project::model::ColourPreset;

    #[test]
    fn numbers_have_no_tails() {
        let shown = [0.1 + 0.2, -0.00001, 1e-7, 3_100.051_234_5, 10.0, -2.5];
        let shown: Vec<_> = shown.into_iter().map(number).collect();
        assert_eq!(shown, ["0.3", "0", "0", "3100.0512", "10", "-2.5"]);
    }

    #[test]
    fn a_slot_is_six_arcs_of_its_radius_and_two_lines() {
        let mut drawing = Drawing::new(
            "slot & \"co\"",
            [20.0, 10.0],
            Palette::Cut(ColourPreset::RedCut),
        );
        drawing.draw(Layer::CutInner, "w.u01", Path::slot(5.0, 12.0, 4.0, 2.0));
        drawing.draw(Layer::Engrave, "w.u01", Text::new("l-", [1.0, 1.0], 5.0));
        let text = String::from_utf8(write(&drawing).expect("finite")).expect("UTF-8");
        insta::with_settings!({
            snapshot_path => "../../tests/golden/fabrication",
            prepend_module_to_snapshot => false,
            omit_expression => true,
        }, { insta::assert_snapshot!("slot.svg", text) });
    }

    #[test]
    fn a_number_that_is_none_is_refused() {
        let mut drawing = Drawing::new("", [20.0, 10.0], Palette::People);
        drawing.draw(Layer::Label, "x", Path::slot(f64::NAN, 12.0, 4.0, 2.0));
        assert_eq!(
            write(&drawing),
            Err(NotFinite {
                subject: "x".into(),
                layer: Layer::Label
            })
        );
    }
}
