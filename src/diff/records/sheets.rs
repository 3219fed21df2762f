//! Panels and sheets of foil, where parts lie on them, and how good that is.

use crate::diff::class::Class::Redraw;
use crate::diff::part::{Field, Item, Kind, Part};
use crate::diff::quantity::{Quantity, number};
use crate::plan::Plan;

pub(super) fn sheets(plan: &Plan) -> Vec<Part> {
    plan.sheets
        .iter()
        .chain(&plan.foils)
        .map(|record| Part {
            kind: Kind::Sheet,
            id: record.id.clone(),
            fields: vec![
                Field::text("material", Redraw, &*record.material).headline(),
                Field::length("thickness", Redraw, record.thickness).headline(),
                Field::length("length", Redraw, record.length).headline(),
                Field::length("width", Redraw, record.width).headline(),
                Field::length("kerf", Redraw, record.kerf),
                Field::count("windows", Redraw, record.windows.len()),
                Field::number("used", Redraw, record.yield_share, Quantity::Share),
            ],
            items: record
                .parts
                .iter()
                .map(|placed| Item {
                    kind: "part",
                    id: placed.part.clone(),
                    fields: vec![Field::place("place", Redraw, [placed.x, placed.y, 0.0])],
                    presence: Redraw,
                })
                .collect(),
            presence: Redraw,
        })
        .collect()
}

pub(super) fn nestings(plan: &Plan) -> Vec<Part> {
    plan.nesting
        .iter()
        .map(|record| {
            let thickness = Quantity::Length.shown(record.thickness);
            let count = |name, count: u32| Field::count(name, Redraw, count as usize);
            let share = |name, share| Field::number(name, Redraw, share, Quantity::Share);
            Part {
                kind: Kind::Nesting,
                id: format!(
                    "{}-{}mm",
                    record.material,
                    number(thickness, Quantity::Length)
                ),
                fields: vec![
                    count("panels", record.panels).headline(),
                    count("sheets", record.sheets).headline(),
                    count("sheets at least", record.sheets_bound),
                    count("rows", record.rows),
                    count("rows at least", record.rows_bound),
                    share("yield", record.yield_share),
                    share("yield at most", record.yield_bound),
                ],
                items: Vec::new(),
                presence: Redraw,
            }
        })
        .collect()
}
