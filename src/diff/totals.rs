//! Sums over the structure: what a reviewer weighs before anything else.

use super::document::Total;
use super::part::{Kind, Part, Value};
use super::quantity::Quantity;
use crate::plan::{BomRow, Plan};

/// Sums of two plans.
pub(super) fn of_plans(before: &Plan, after: &Plan) -> Vec<Total> {
    let sum = |f: fn(&Plan) -> Option<f64>| [before, after].map(f);
    let rows = [
        (
            "lamellae",
            Quantity::Count,
            sum(|p| count(p.lamellae.len())),
        ),
        (
            "cut length",
            Quantity::LongLength,
            sum(|p| p.lamellae.iter().map(|l| l.length).reduce(|a, b| a + b)),
        ),
        (
            "mass of lamellae",
            Quantity::Mass,
            sum(|p| p.lamellae.iter().map(|l| l.mass).reduce(|a, b| a + b)),
        ),
        (
            "stickers",
            Quantity::Count,
            sum(|p| count(p.stickers.len())),
        ),
        (
            "supports",
            Quantity::Count,
            sum(|p| count(p.supports.len())),
        ),
        ("sheets", Quantity::Count, sum(|p| count(p.sheets.len()))),
        ("sheets used", Quantity::Share, sum(used)),
        ("fasteners", Quantity::Count, sum(fasteners)),
        ("cost", Quantity::Money, sum(cost)),
    ];
    let totals = rows
        .into_iter()
        .map(|(what, quantity, sides)| total(what, quantity, sides));
    totals.flatten().collect()
}

/// Sums of two lists of parts.
pub(super) fn of_parts(before: &[Part], after: &[Part]) -> Vec<Total> {
    let sides = [before, after];
    let number = |kind: Kind| {
        sides.map(|parts| count(parts.iter().filter(|part| part.kind == kind).count()))
    };
    let length = sides.map(|parts| {
        let lamellae = parts.iter().filter(|part| part.kind == Kind::Lamella);
        let lengths =
            lamellae
                .flat_map(|part| &part.fields)
                .filter_map(|field| match field.value {
                    Value::Number(value, Quantity::Length) if field.name == "length" => Some(value),
                    _ => None,
                });
        lengths.reduce(|a, b| a + b)
    });
    let rows = [
        ("lamellae", Quantity::Count, number(Kind::Lamella)),
        ("cut length", Quantity::LongLength, length),
        ("stickers", Quantity::Count, number(Kind::Sticker)),
        ("supports", Quantity::Count, number(Kind::Support)),
        ("sheets", Quantity::Count, number(Kind::Sheet)),
    ];
    let totals = rows
        .into_iter()
        .map(|(what, quantity, sides)| total(what, quantity, sides));
    totals.flatten().collect()
}

fn total(what: &str, quantity: Quantity, [before, after]: [Option<f64>; 2]) -> Option<Total> {
    if before.is_none() && after.is_none() {
        return None;
    }
    Some(Total {
        what: what.to_owned(),
        before: before.map(|value| quantity.shown(value)),
        after: after.map(|value| quantity.shown(value)),
        quantity,
        unit: quantity.unit().to_owned(),
    })
}

fn count(number: usize) -> Option<f64> {
    (number > 0).then_some(number as f64)
}

/// Share of the area of all sheets that becomes parts.
fn used(plan: &Plan) -> Option<f64> {
    let area = |sheet: &crate::plan::SheetRecord| sheet.length * sheet.width;
    let all: f64 = plan.sheets.iter().map(area).sum();
    let parts: f64 = plan.sheets.iter().map(|s| area(s) * s.yield_share).sum();
    (all > 0.0).then(|| parts / all)
}

fn fasteners(plan: &Plan) -> Option<f64> {
    let rows = plan
        .bill_of_materials
        .iter()
        .filter(|row| row.category == "fastener");
    rows.map(|row| row.quantity).reduce(|a, b| a + b)
}

/// What the rows with a price cost, spares included.
fn cost(plan: &Plan) -> Option<f64> {
    let cost = |row: &BomRow| Some(row.unit_cost? * (row.quantity + row.spare));
    plan.bill_of_materials
        .iter()
        .filter_map(cost)
        .reduce(|a, b| a + b)
}
