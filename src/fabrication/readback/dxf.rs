//! A reader of DXF entities: lines, lightweight polylines and circles, by their code pairs.

use super::curves::{Curve, Geometry, Read};
use crate::fabrication::drawing::{Closure, Path, Vertex};

/// A code and its value.
type Pair<'a> = (i32, &'a str);

/// Curves of the model space, or why the text has none.
pub(super) fn read(text: &str) -> Result<Read, String> {
    let pairs = pairs(text)?;
    let size = size(&pairs);
    let start = pairs
        .windows(2)
        .position(|w| w[0] == (0, "SECTION") && w[1] == (2, "ENTITIES"))
        .ok_or("it has no ENTITIES")?;
    let body = &pairs[start + 2..];
    let end = body
        .iter()
        .position(|pair| *pair == (0, "ENDSEC"))
        .ok_or("its ENTITIES do not end")?;
    let mut curves = Vec::new();
    for record in body[..end].chunk_by(|_, next| next.0 != 0) {
        let Some((0, kind)) = record.first().copied() else {
            return Err("ENTITIES begin with no entity".to_owned());
        };
        let geometry = match kind {
            "LINE" => line(record)?,
            "CIRCLE" => circle(record)?,
            "LWPOLYLINE" => polyline(record)?,
            other => return Err(format!("it has an entity `{other}`")),
        };
        curves.push(Curve {
            layer: value(record, 8).unwrap_or("0").to_owned(),
            subject: None,
            geometry,
        });
    }
    Ok(Read { size, curves })
}

fn pairs(text: &str) -> Result<Vec<Pair<'_>>, String> {
    let mut lines = text.lines().enumerate();
    let mut pairs = Vec::new();
    while let Some((number, code)) = lines.next() {
        let code = code
            .trim()
            .parse()
            .map_err(|_| format!("line {} is no group code", number + 1))?;
        let (_, value) = lines.next().ok_or("its last value is missing")?;
        pairs.push((code, value.trim()));
    }
    match pairs.last() {
        Some((0, "EOF")) => Ok(pairs),
        _ => Err("it does not end in EOF".to_owned()),
    }
}

/// The limits of the drawing, which are the frame of the sheet.
fn size(pairs: &[Pair<'_>]) -> [f64; 2] {
    let limits = pairs.iter().position(|pair| *pair == (9, "$LIMMAX"));
    let after = limits.map_or(&[][..], |at| &pairs[at + 1..]);
    let number = |code: i32| {
        let pair = after.iter().take(2).find(|pair| pair.0 == code);
        pair.and_then(|pair| pair.1.parse().ok()).unwrap_or(0.0)
    };
    [number(10), number(20)]
}

fn value<'a>(record: &[Pair<'a>], code: i32) -> Option<&'a str> {
    record.iter().find(|pair| pair.0 == code).map(|pair| pair.1)
}

fn parse(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("`{text}` is no number")),
    }
}

fn number(record: &[Pair<'_>], code: i32) -> Result<f64, String> {
    parse(value(record, code).ok_or(format!("an entity has no group {code}"))?)
}

fn line(record: &[Pair<'_>]) -> Result<Geometry, String> {
    let point = |x, y| Ok::<_, String>([number(record, x)?, number(record, y)?]);
    let ends = [point(10, 20)?, point(11, 21)?];
    Ok(Geometry::Path(Path::polyline(&ends, Closure::Open)))
}

fn circle(record: &[Pair<'_>]) -> Result<Geometry, String> {
    Ok(Geometry::Circle {
        centre: [number(record, 10)?, number(record, 20)?],
        radius: number(record, 40)?,
    })
}

fn polyline(record: &[Pair<'_>]) -> Result<Geometry, String> {
    let mut vertices: Vec<Vertex> = Vec::new();
    for (code, text) in record {
        match code {
            10 => vertices.push(Vertex {
                x: parse(text)?,
                y: f64::NAN,
                bulge: 0.0,
            }),
            20 | 42 => {
                let vertex = vertices.last_mut().ok_or("a polyline has no vertex")?;
                let number = parse(text)?;
                match code {
                    20 => vertex.y = number,
                    _ => vertex.bulge = number,
                }
            }
            _ => {}
        }
    }
    if vertices.is_empty() || vertices.iter().any(|v| v.y.is_nan()) {
        return Err("a polyline has a vertex without y".to_owned());
    }
    let flags: i32 = value(record, 70).and_then(|f| f.parse().ok()).unwrap_or(0);
    let closed = if flags & 1 == 1 {
        Closure::Closed
    } else {
        Closure::Open
    };
    Ok(Geometry::Path(Path { vertices, closed }))
}
