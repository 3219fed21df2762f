//! Changed values and items as the document tells them.

use crate::diff::class::Class;
use crate::diff::document::{Action, FieldChange, ItemChange, Reading};
use crate::diff::part::{Field, Item, Value};
use crate::diff::quantity::Quantity;

/// What happened to an item.
pub(super) fn item_change(item: &Item, action: Action, fields: Vec<FieldChange>) -> ItemChange {
    ItemChange {
        kind: item.kind.to_owned(),
        id: item.id.clone(),
        action,
        fields,
    }
}

/// What happened to a value; one side is none where it came or went.
pub(super) fn field_change(
    before: Option<&Field>,
    after: Option<&Field>,
    delta: Option<f64>,
    class: Class,
) -> FieldChange {
    let quantity = [after, before].into_iter().flatten().find_map(quantity_of);
    FieldChange {
        name: after.or(before).map_or("", |field| &field.name).to_owned(),
        before: before.and_then(reading),
        after: after.and_then(reading),
        delta: delta
            .zip(quantity)
            .map(|(delta, quantity)| quantity.shown(delta)),
        quantity,
        unit: quantity.map_or("", Quantity::unit).to_owned(),
        class,
    }
}

fn quantity_of(field: &Field) -> Option<Quantity> {
    match field.value {
        Value::Number(_, quantity) => Some(quantity),
        Value::Place(_) | Value::Curve(_) => Some(Quantity::Length),
        Value::Text(_) | Value::Id(_) => None,
    }
}

fn reading(field: &Field) -> Option<Reading> {
    match &field.value {
        Value::Number(value, quantity) => Some(Reading::Number(quantity.shown(*value))),
        Value::Text(text) | Value::Id(text) => Some(Reading::Text(text.clone())),
        Value::Place(_) | Value::Curve(_) => None,
    }
}
