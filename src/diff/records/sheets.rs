//! Panels and sheets of foil, and where parts lie on them.

use crate::diff::class::Class::Redraw;
use crate::diff::part::{Field, Item, Kind, Part};
use crate::diff::quantity::Quantity;
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
