//! The bill of materials. Bolts, shells, foils and supports are what the assembly needs; panels,
//! the cut list and consumables follow from parts that are compared themselves. So do descriptions.

use crate::diff::class::Class::{Reassemble, Redraw};
use crate::diff::part::{Field, Kind, Part};
use crate::diff::quantity::Quantity;
use crate::plan::Plan;

pub(super) fn rows(plan: &Plan) -> Vec<Part> {
    plan.bill_of_materials
        .iter()
        .map(|row| {
            let need = match row.category.as_str() {
                "fastener" | "sleeve" | "friction" | "support" => Reassemble,
                _ => Redraw,
            };
            let amount = if row.unit == "pcs" {
                Quantity::Count
            } else {
                Quantity::Amount
            };
            let mut fields = vec![
                Field::number("quantity", need, row.quantity, amount).headline(),
                Field::text("unit", need, &*row.unit).headline(),
                Field::number("spare", Redraw, row.spare, amount),
                Field::text("material", need, &*row.material),
                Field::text("specification", need, &*row.specification),
            ];
            if let Some(cost) = row.unit_cost {
                fields.push(Field::number("unit cost", Redraw, cost, Quantity::Money));
            }
            Part {
                kind: Kind::BillRow,
                id: row.id.clone(),
                fields,
                items: Vec::new(),
                presence: need,
            }
        })
        .collect()
}
