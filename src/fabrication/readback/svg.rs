//! A reader of the SVG that cut files are written in: groups that are layers, paths of lines and
//! arcs, circles; millimetres, y down.

use super::curves::{Curve, Geometry, Read};
use crate::fabrication::drawing::{Closure, Path, Vertex};
use ::svg::node::Attributes;
use ::svg::node::element::tag::Type;
use ::svg::parser::Event;

/// Curves with y up, or why the text has none.
pub(super) fn read(text: &str) -> Result<Read, String> {
    let mut size = None;
    let mut layer: Option<String> = None;
    let mut curves = Vec::new();
    for event in ::svg::read(text).map_err(|error| error.to_string())? {
        let (tag, kind, attributes) = match event {
            Event::Tag(tag, kind, attributes) => (tag, kind, attributes),
            Event::Error(error) => return Err(error.to_string()),
            _ => continue,
        };
        match (tag, kind) {
            ("svg", Type::Start) => size = Some(frame(&attributes)?),
            ("g", Type::Start) => layer = Some(attribute(&attributes, "id")?.to_owned()),
            ("g", Type::End) => layer = None,
            ("path" | "circle", Type::Start | Type::Empty) => {
                let [_, height] = size.ok_or("a shape stands before the frame")?;
                let shapes = if tag == "path" {
                    path(attribute(&attributes, "d")?, height)?
                } else {
                    vec![circle(&attributes, height)?]
                };
                let layer = layer.clone().ok_or("a shape stands on no layer")?;
                let subject = attributes.get("inkscape:label").map(ToString::to_string);
                curves.extend(shapes.into_iter().map(|geometry| Curve {
                    layer: layer.clone(),
                    subject: subject.clone(),
                    geometry,
                }));
            }
            _ => {}
        }
    }
    Ok(Read {
        size: size.ok_or("it has no svg element")?,
        curves,
    })
}

fn attribute<'a>(attributes: &'a Attributes, name: &str) -> Result<&'a str, String> {
    let value = attributes.get(name).map(|value| &**value);
    value.ok_or(format!("an element has no `{name}`"))
}

fn parse(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("`{text}` is no number")),
    }
}

/// Width and height, which must be in millimetres and the same as those of the view box.
fn frame(attributes: &Attributes) -> Result<[f64; 2], String> {
    let side = |name: &str| {
        let text = attribute(attributes, name)?;
        let number = text.strip_suffix("mm");
        parse(number.ok_or(format!("its {name} is not in millimetres"))?)
    };
    let size = [side("width")?, side("height")?];
    let view = attribute(attributes, "viewBox")?;
    let numbers: Result<Vec<f64>, String> = view.split_whitespace().map(parse).collect();
    if numbers? != [0.0, 0.0, size[0], size[1]] {
        return Err("its view box is not its size in millimetres".to_owned());
    }
    Ok(size)
}

fn circle(attributes: &Attributes, height: f64) -> Result<Geometry, String> {
    let number = |name: &str| parse(attribute(attributes, name)?);
    Ok(Geometry::Circle {
        centre: [number("cx")?, height - number("cy")?],
        radius: number("r")?,
    })
}

/// The chains of a path's data.
fn path(data: &str, height: f64) -> Result<Vec<Geometry>, String> {
    let mut paths: Vec<Path> = Vec::new();
    let mut rest = data;
    while let Some(command) = rest.chars().next() {
        let body = &rest[command.len_utf8()..];
        let end = body
            .find(|c: char| c.is_ascii_alphabetic())
            .unwrap_or(body.len());
        let numbers: Result<Vec<f64>, String> = body[..end].split_whitespace().map(parse).collect();
        let numbers = numbers?;
        rest = &body[end..];
        let point = |x: f64, y: f64| Vertex {
            x,
            y: height - y,
            bulge: 0.0,
        };
        match (command, numbers.as_slice(), paths.last_mut()) {
            ('M', [x, y], _) => paths.push(Path {
                vertices: vec![point(*x, *y)],
                closed: Closure::Open,
            }),
            ('L', [x, y], Some(path)) => path.vertices.push(point(*x, *y)),
            ('A', [rx, ry, _, large, sweep, x, y], Some(path)) if rx == ry => {
                let to = point(*x, *y);
                arc(path, *rx, *large != 0.0, *sweep != 0.0, to)?;
            }
            ('Z', [], Some(path)) => close(path),
            _ => return Err(format!("a path has `{command}{}`", &body[..end])),
        }
    }
    Ok(paths.into_iter().map(Geometry::Path).collect())
}

/// Appends an arc. SVG's positive direction with y down is clockwise with y up.
fn arc(path: &mut Path, radius: f64, large: bool, sweep: bool, to: Vertex) -> Result<(), String> {
    let from = path.vertices.last_mut().ok_or("an arc has no start")?;
    let chord = libm::hypot(to.x - from.x, to.y - from.y);
    let half = libm::asin((0.5 * chord / radius).min(1.0));
    let swept = if large {
        2.0 * (core::f64::consts::PI - half)
    } else {
        2.0 * half
    };
    let bulge = libm::tan(0.25 * swept);
    from.bulge = if sweep { -bulge } else { bulge };
    path.vertices.push(to);
    Ok(())
}

/// A path that comes back to its start by itself is closed there, without a side of no length.
fn close(path: &mut Path) {
    path.closed = Closure::Closed;
    if let [first, .., last] = path.vertices.as_slice()
        && libm::hypot(first.x - last.x, first.y - last.y) < 1e-6
    {
        path.vertices.pop();
    }
}
