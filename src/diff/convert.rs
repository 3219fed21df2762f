//! Files as text by parts, for `git diff`: a reviewer sees which part changed, not which
//! coordinate.

use super::lock::shown;
use super::part::{Field, Value};
use super::quantity::{Quantity, number};
use super::records;
use crate::plan::Plan;
use dxf::entities::EntityType;
use std::collections::BTreeMap;
use std::fmt::Write;

/// A plan: a line a part, its items indented below it.
pub fn plan_as_text(plan: &Plan) -> String {
    let mut text = String::new();
    for part in records::parts(plan) {
        let _ = writeln!(
            text,
            "{} {}{}",
            part.kind.word(),
            part.id,
            values(&part.fields)
        );
        for item in &part.items {
            let _ = writeln!(text, "  {} {}{}", item.kind, item.id, values(&item.fields));
        }
    }
    for told in &plan.diagnostics {
        let subject = told.subject.as_deref().unwrap_or("");
        let _ = writeln!(
            text,
            "{} {} {subject} {}",
            told.severity, told.code, told.message
        );
    }
    text
}

fn values(fields: &[Field]) -> String {
    let mut text = String::new();
    for field in fields {
        let value = match &field.value {
            // The places between follow from the surface.
            Value::Curve(places) => match (places.first(), places.last()) {
                (Some(first), Some(last)) => shown(&Value::Curve(vec![*first, *last])),
                _ => continue,
            },
            value => shown(value),
        };
        let _ = write!(text, "  {} {value}", field.name);
    }
    text
}

/// A closed or open path of a drawing, millimetres.
struct Path {
    low: [f64; 2],
    high: [f64; 2],
}

impl Path {
    fn around(places: impl Iterator<Item = [f64; 2]>) -> Option<Self> {
        places.fold(None, |bounds: Option<Self>, place| {
            let bounds = bounds.unwrap_or(Self {
                low: place,
                high: place,
            });
            Some(Self {
                low: [0, 1].map(|axis| bounds.low[axis].min(place[axis])),
                high: [0, 1].map(|axis| bounds.high[axis].max(place[axis])),
            })
        })
    }

    fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.high[axis] - self.low[axis])
    }

    fn holds(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.low[axis] <= other.low[axis] && other.high[axis] <= self.high[axis])
    }
}

/// A drawing of egg: parts (outlines of the layer of outer cuts) with their openings, measured
/// from the part's own corner, and what else is on each layer.
///
/// # Errors
/// Where the text is no DXF file: what the reader says.
pub fn dxf_as_text(bytes: &[u8]) -> Result<String, String> {
    let mut reader = bytes;
    let drawing = dxf::Drawing::load(&mut reader).map_err(|error| error.to_string())?;
    let (mut outlines, mut openings) = (Vec::new(), Vec::new());
    let mut others: BTreeMap<String, (usize, f64)> = BTreeMap::new();
    for entity in drawing.entities() {
        let (path, length) = match &entity.specific {
            EntityType::LwPolyline(line) => {
                let places = || line.vertices.iter().map(|v| [v.x, v.y]);
                let stretches = places().zip(places().skip(1));
                let length = stretches.map(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1]));
                (Path::around(places().chain(bulges(line))), length.sum())
            }
            EntityType::Circle(circle) => {
                let [x, y, r] = [circle.center.x, circle.center.y, circle.radius];
                let corners = [[x - r, y - r], [x + r, y + r]];
                (Path::around(corners.into_iter()), std::f64::consts::TAU * r)
            }
            EntityType::Line(line) => {
                let ends = [[line.p1.x, line.p1.y], [line.p2.x, line.p2.y]];
                let [a, b] = ends;
                let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
                (Path::around(ends.into_iter()), length)
            }
            _ => (None, 0.0),
        };
        match (entity.common.layer.as_str(), path) {
            ("CUT_OUTER", Some(path)) => outlines.push(path),
            ("CUT_INNER", Some(path)) => openings.push(path),
            (layer, _) => {
                let sum = others.entry(layer.to_owned()).or_default();
                sum.0 += 1;
                sum.1 += length;
            }
        }
    }
    Ok(described(&outlines, &openings, &others))
}

/// The farthest places of the arcs of a polyline.
fn bulges(line: &dxf::entities::LwPolyline) -> impl Iterator<Item = [f64; 2]> {
    let count = line.vertices.len();
    (0..count)
        .filter(|i| line.vertices[*i].bulge != 0.0)
        .map(move |i| {
            let (a, b) = (&line.vertices[i], &line.vertices[(i + 1) % count]);
            let half = 0.5 * a.bulge;
            // The sagitta stands on the middle of the chord, to its right for a positive bulge.
            [
                0.5 * (a.x + b.x) + half * (b.y - a.y),
                0.5 * (a.y + b.y) - half * (b.x - a.x),
            ]
        })
}

fn described(
    outlines: &[Path],
    openings: &[Path],
    others: &BTreeMap<String, (usize, f64)>,
) -> String {
    let mm = |value: f64| number(value, Quantity::Length);
    let by = |[x, y]: [f64; 2]| format!("{} x {} mm", mm(x), mm(y));
    let mut text = format!("{} parts, {} openings\n", outlines.len(), openings.len());
    for (i, outline) in outlines.iter().enumerate() {
        let [x, y] = outline.low;
        let size = by(outline.size());
        let _ = writeln!(text, "part {}: {size} at ({}, {})", i + 1, mm(x), mm(y));
        for opening in openings.iter().filter(|opening| outline.holds(opening)) {
            let [from, across] = [0, 1].map(|axis| opening.low[axis] - outline.low[axis]);
            let size = by(opening.size());
            let _ = writeln!(text, "  opening {size} at ({}, {})", mm(from), mm(across));
        }
    }
    for (layer, (count, length)) in others {
        let length = number(length / 1e3, Quantity::LongLength);
        let _ = writeln!(text, "layer {layer}: {count} lines, {length} m");
    }
    text
}
