//! Which families members run through one after the other, and how well that goes.

use crate::diff::class::Class::{Reassemble, Redraw};
use crate::diff::part::{Field, Item, Kind, Part};
use crate::diff::quantity::Quantity;
use crate::plan::Plan;

pub(super) fn strips(plan: &Plan) -> Vec<Part> {
    plan.strips
        .iter()
        .map(|record| {
            let mut fields = vec![
                Field::number(
                    "evenness gained",
                    Redraw,
                    record.evenness_gained,
                    Quantity::Ratio,
                )
                .headline(),
            ];
            if let Some(ring) = &record.ring {
                let ends = if ring.closed { "closed" } else { "open" };
                fields.push(Field::text("ring", Reassemble, ends).headline());
                fields.push(Field::length("drift", Redraw, ring.drift).headline());
            }
            Part {
                kind: Kind::Strip,
                id: record.id.clone(),
                fields,
                items: record
                    .families
                    .iter()
                    .map(|family| Item {
                        kind: "family",
                        id: family.clone(),
                        fields: Vec::new(),
                        presence: Reassemble,
                    })
                    .collect(),
                presence: Reassemble,
            }
        })
        .collect()
}
