//! Where things are: the structure, its points, patches and members.

use crate::diff::class::Class::{Reassemble, Redraw};
use crate::diff::part::{Field, Item, Kind, Part, Value};
use crate::diff::quantity::Quantity;
use crate::plan::{CrossingRecord, Plan};
use crate::project::model::Family;
use std::collections::BTreeMap;

pub(super) fn structure(plan: &Plan) -> Vec<Part> {
    let [low, high] = plan.surface.bounding_box;
    let size = |axis: usize| high[axis] - low[axis];
    vec![Part {
        kind: Kind::Structure,
        id: "structure".to_owned(),
        fields: vec![
            Field::text("name", Redraw, &*plan.name).headline(),
            Field::number("surface area", Redraw, plan.surface.area, Quantity::Area),
            Field::length("surface size along x", Redraw, size(0)),
            Field::length("surface size along y", Redraw, size(1)),
            Field::length("surface size along z", Redraw, size(2)),
        ],
        items: Vec::new(),
        presence: Redraw,
    }]
}

pub(super) fn points(plan: &Plan) -> Vec<Part> {
    plan.points
        .iter()
        .map(|record| Part {
            kind: Kind::Point,
            id: record.id.clone(),
            fields: vec![Field::place("position", Reassemble, record.position)],
            items: Vec::new(),
            presence: Reassemble,
        })
        .collect()
}

pub(super) fn patches(plan: &Plan) -> Vec<Part> {
    let mut crossings: BTreeMap<&str, Vec<Item>> = BTreeMap::new();
    for record in &plan.crossings {
        let patch = record.id.split('.').next().unwrap_or("");
        crossings.entry(patch).or_default().push(crossing(record));
    }
    let count = |patch: &str, family: Family| {
        let of =
            |member: &&crate::plan::MemberRecord| member.patch == patch && member.family == family;
        plan.members.iter().filter(of).count()
    };
    plan.patches
        .iter()
        .map(|record| {
            let mut fields = vec![
                Field::count("members u", Reassemble, count(&record.id, Family::U)).headline(),
                Field::count("members v", Reassemble, count(&record.id, Family::V)).headline(),
                Field::number("alpha", Reassemble, record.alpha_planar, Quantity::Angle).headline(),
                Field::text(
                    "feasible",
                    Redraw,
                    if record.feasible { "yes" } else { "no" },
                )
                .headline(),
            ];
            let corners = ["corner 1", "corner 2", "corner 3", "corner 4"];
            for (name, corner) in corners.into_iter().zip(&record.corners) {
                fields.push(Field::id(name, Reassemble, &**corner));
            }
            let sides = ["side 1-2", "side 2-3", "side 3-4", "side 4-1"];
            for (name, side) in sides.into_iter().zip(&record.sides) {
                fields.push(Field::length(name, Reassemble, side.length));
            }
            let places = [
                "flat corner 1",
                "flat corner 2",
                "flat corner 3",
                "flat corner 4",
            ];
            for (name, [x, y]) in places.into_iter().zip(record.planar_corners) {
                fields.push(Field::place(name, Reassemble, [x, y, 0.0]));
            }
            fields.push(Field::number(
                "eta u",
                Redraw,
                record.eta.u,
                Quantity::Ratio,
            ));
            fields.push(Field::number(
                "eta v",
                Redraw,
                record.eta.v,
                Quantity::Ratio,
            ));
            Part {
                kind: Kind::Patch,
                items: crossings.remove(&*record.id).unwrap_or_default(),
                id: record.id.clone(),
                fields,
                presence: Reassemble,
            }
        })
        .collect()
}

fn crossing(record: &CrossingRecord) -> Item {
    let [x, y] = record.planar;
    Item {
        kind: "crossing",
        id: record.id.clone(),
        fields: vec![
            Field::place("position", Reassemble, record.position),
            Field::place("flat position", Reassemble, [x, y, 0.0]),
        ],
        presence: Reassemble,
    }
}

pub(super) fn members(plan: &Plan) -> Vec<Part> {
    plan.members
        .iter()
        .map(|record| {
            let [[x0, y0], [x1, y1]] = record.planar;
            Part {
                kind: Kind::Member,
                id: record.id.clone(),
                fields: vec![
                    Field::new("path", Reassemble, Value::Curve(sampled(&record.polyline))),
                    Field::place("flat start", Reassemble, [x0, y0, 0.0]),
                    Field::place("flat end", Reassemble, [x1, y1, 0.0]),
                    Field::text(
                        "boundary",
                        Reassemble,
                        if record.boundary { "yes" } else { "no" },
                    ),
                ],
                items: Vec::new(),
                presence: Reassemble,
            }
        })
        .collect()
}

/// Stretches between the places that stand for a curve.
const STRETCHES: usize = 16;

/// Places at equal shares of a polyline's length, ends included.
fn sampled(polyline: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let (Some(first), Some(last)) = (polyline.first(), polyline.last()) else {
        return Vec::new();
    };
    let lengths: Vec<f64> = polyline
        .windows(2)
        .map(|pair| distance(pair[0], pair[1]))
        .collect();
    let total: f64 = lengths.iter().sum();
    let mut places = vec![*first];
    let (mut segment, mut passed) = (0, 0.0);
    for stretch in 1..STRETCHES {
        let wanted = total * stretch as f64 / STRETCHES as f64;
        while segment + 1 < lengths.len() && passed + lengths[segment] < wanted {
            passed += lengths[segment];
            segment += 1;
        }
        let Some(length) = lengths.get(segment).filter(|length| **length > 0.0) else {
            places.push(*first);
            continue;
        };
        let share = (wanted - passed) / length;
        let (a, b) = (polyline[segment], polyline[segment + 1]);
        places.push(std::array::from_fn(|axis| {
            a[axis] + share * (b[axis] - a[axis])
        }));
    }
    places.push(*last);
    places
}

/// Distance of two places.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum();
    squares.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_has_the_same_places_however_it_is_cut() {
        let coarse = [[0.0; 3], [1.0, 0.0, 0.0]];
        let fine = [[0.0; 3], [0.1, 0.0, 0.0], [0.15, 0.0, 0.0], [1.0, 0.0, 0.0]];
        for (a, b) in sampled(&coarse).into_iter().zip(sampled(&fine)) {
            assert!(distance(a, b) < 1e-15);
        }
        assert_eq!(sampled(&coarse).len(), STRETCHES + 1);
        assert!(sampled(&[]).is_empty());
        assert_eq!(sampled(&[[1.0; 3]]), vec![[1.0; 3]; STRETCHES + 1]);
    }
}
