//! From the parts of two sides to what changed.

mod told;
mod used_on;
mod weight;

use super::class::Class;
use super::document::{Action, Change, Count, FieldChange, Hidden, ItemChange};
use super::part::{Field, Item, Kind, Part, Value, by_number};
use super::quantity::Quantity;
use super::renames::{Renames, distance};
use super::tolerance::Tolerances;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use told::{field_change, item_change};
use used_on::note_sheets;
use weight::{Judged, Moved, Weight};

/// What comparing parts gives.
#[derive(Debug, Default)]
pub(super) struct Compared {
    /// Worst first.
    pub(super) changes: Vec<Change>,
    pub(super) counts: Vec<Count>,
    pub(super) hidden: Vec<Hidden>,
}

/// Compares all parts of two sides.
pub(super) fn compare(
    before: &[Part],
    after: &[Part],
    renames: &Renames,
    tolerances: &Tolerances,
) -> Compared {
    let mut comparison = Comparison {
        renames,
        tolerances,
        hidden: BTreeMap::new(),
        counts: BTreeMap::new(),
    };
    let mut old: BTreeMap<(Kind, String), &Part> = BTreeMap::new();
    let mut changes: Vec<(Reverse<Weight>, Change)> = Vec::new();
    for part in before {
        match renames.part(part.kind, &part.id) {
            Some(id) => {
                old.insert((part.kind, id), part);
            }
            None => changes.push(comparison.presence(part, Action::Removed)),
        }
    }
    for part in after {
        match old.remove(&(part.kind, part.id.clone())) {
            Some(previous) => changes.extend(comparison.change(previous, part)),
            None => changes.push(comparison.presence(part, Action::Added)),
        }
    }
    for part in old.into_values() {
        changes.push(comparison.presence(part, Action::Removed));
    }
    changes.sort_by(|(a, left), (b, right)| {
        a.cmp(b)
            .then(left.action.cmp(&right.action))
            .then(left.kind.cmp(&right.kind))
            .then_with(|| by_number(&left.id, &right.id))
    });
    let mut changes: Vec<Change> = changes.into_iter().map(|(_, change)| change).collect();
    note_sheets(&mut changes, before, after);
    Compared {
        changes,
        counts: comparison.counts.into_values().collect(),
        hidden: comparison.hidden.into_values().collect(),
    }
}

struct Comparison<'a> {
    renames: &'a Renames,
    tolerances: &'a Tolerances,
    hidden: BTreeMap<Quantity, Hidden>,
    /// By place in the list, then by word: openings come after lamellae.
    counts: BTreeMap<(Kind, u8), Count>,
}

impl Comparison<'_> {
    /// A part that is on one side only.
    fn presence(&mut self, part: &Part, action: Action) -> (Reverse<Weight>, Change) {
        self.count(part.kind, None, action);
        for item in part.items.iter().filter(|item| is_opening(item)) {
            self.count(part.kind, Some(item), action);
        }
        let fields = part.fields.iter().filter(|field| field.headline);
        let change = Change {
            kind: part.kind,
            id: part.id.clone(),
            previous_id: None,
            action,
            class: part.presence,
            fields: fields
                .map(|field| match action {
                    Action::Removed => field_change(Some(field), None, None, field.effect),
                    _ => field_change(None, Some(field), None, field.effect),
                })
                .collect(),
            items: Vec::new(),
            used_on: Vec::new(),
        };
        (Weight::new(part.kind, part.presence, f64::INFINITY), change)
    }

    /// A part that is on both sides; nothing if nothing changed above tolerance.
    fn change(&mut self, before: &Part, after: &Part) -> Option<(Reverse<Weight>, Change)> {
        let mut worst = Judged::default();
        let fields = self.fields(&after.id, &before.fields, &after.fields, &mut worst);
        let items = self.items(before, after, &mut worst);
        let previous_id = (before.id != after.id).then(|| before.id.clone());
        self.count_pair(after.kind, None, worst.class, previous_id.is_some());
        let class = match (worst.class, &previous_id) {
            (Some(Class::Noise) | None, None) => return None,
            (Some(Class::Noise) | None, Some(_)) => Class::Redraw,
            (Some(class), _) => class,
        };
        let action = match worst.class {
            Some(class) if class > Class::Noise => Action::Changed,
            _ => Action::Renamed,
        };
        let change = Change {
            kind: after.kind,
            id: after.id.clone(),
            previous_id,
            action,
            class,
            fields,
            items,
            used_on: Vec::new(),
        };
        Some((Weight::new(after.kind, class, worst.ratio), change))
    }

    /// Values that changed above tolerance.
    fn fields(
        &mut self,
        part: &str,
        before: &[Field],
        after: &[Field],
        worst: &mut Judged,
    ) -> Vec<FieldChange> {
        let mut changes = Vec::new();
        for field in after {
            let Some(old) = before.iter().find(|old| old.name == field.name) else {
                worst.raise(field.effect, f64::INFINITY);
                changes.push(field_change(None, Some(field), None, field.effect));
                continue;
            };
            let Some(moved) = self.moved(&old.value, &field.value) else {
                continue;
            };
            let class = if moved.ratio > 1.0 {
                field.effect
            } else {
                Class::Noise
            };
            worst.raise(class, moved.ratio);
            if class == Class::Noise {
                self.hide(part, field, &moved);
            } else {
                let delta = moved.delta;
                changes.push(field_change(Some(old), Some(field), delta, class));
            }
        }
        for old in before {
            if !after.iter().any(|field| field.name == old.name) {
                worst.raise(old.effect, f64::INFINITY);
                changes.push(field_change(Some(old), None, None, old.effect));
            }
        }
        changes
    }

    /// Items that changed above tolerance, by their ids.
    fn items(&mut self, before: &Part, after: &Part, worst: &mut Judged) -> Vec<ItemChange> {
        let mut changes = Vec::new();
        let mut old: BTreeMap<String, &Item> = BTreeMap::new();
        let mut gone: Vec<&Item> = Vec::new();
        for item in &before.items {
            match self.renames.id(&item.id) {
                Some(id) => {
                    old.insert(id, item);
                }
                None => gone.push(item),
            }
        }
        for item in &after.items {
            let Some(previous) = old.remove(&item.id) else {
                worst.raise(item.presence, f64::INFINITY);
                self.count(after.kind, Some(item), Action::Added);
                changes.push(item_change(item, Action::Added, Vec::new()));
                continue;
            };
            let mut judged = Judged::default();
            let mut fields = Vec::new();
            if previous.kind == item.kind {
                let (was, is) = (&previous.fields, &item.fields);
                fields = self.fields(&after.id, was, is, &mut judged);
            } else {
                judged.raise(item.presence, f64::INFINITY);
                let kind = |kind| Field::text("kind", item.presence, kind);
                let (was, is) = (kind(previous.kind), kind(item.kind));
                fields.push(field_change(Some(&was), Some(&is), None, item.presence));
            }
            self.count_pair(after.kind, Some(item), judged.class, false);
            if let Some(class) = judged.class {
                worst.raise(class, judged.ratio);
                if class > Class::Noise {
                    changes.push(item_change(item, Action::Changed, fields));
                }
            }
        }
        gone.extend(old.into_values());
        for item in gone {
            worst.raise(item.presence, f64::INFINITY);
            self.count(after.kind, Some(item), Action::Removed);
            changes.push(item_change(item, Action::Removed, Vec::new()));
        }
        changes
    }

    /// How far a value moved; nothing if it is the same.
    fn moved(&self, before: &Value, after: &Value) -> Option<Moved> {
        let far = |delta: f64, quantity: Quantity, was: f64| {
            let amount = delta.abs();
            if amount <= quantity.resolution() {
                return None;
            }
            Some(Moved {
                delta: Some(delta),
                quantity: Some(quantity),
                ratio: amount / self.tolerances.limit(quantity, was),
            })
        };
        let other = || Moved {
            delta: None,
            quantity: None,
            ratio: f64::INFINITY,
        };
        match (before, after) {
            (Value::Number(a, quantity), Value::Number(b, unit)) if quantity == unit => {
                far(b - a, *quantity, *a)
            }
            (Value::Place(a), Value::Place(b)) => far(distance(*a, *b), Quantity::Length, 0.0),
            (Value::Curve(a), Value::Curve(b)) if a.len() == b.len() => {
                let apart = a.iter().zip(b).map(|(a, b)| distance(*a, *b));
                far(apart.fold(0.0, f64::max), Quantity::Length, 0.0)
            }
            (Value::Text(a), Value::Text(b)) => (a != b).then(other),
            (Value::Id(a), Value::Id(b)) => {
                let same = self.renames.id(a).as_ref() == Some(b);
                (!same).then(other)
            }
            _ => Some(other()),
        }
    }

    /// Keeps the largest change below tolerance per quantity.
    fn hide(&mut self, part: &str, field: &Field, moved: &Moved) {
        let (Some(quantity), Some(delta)) = (moved.quantity, moved.delta) else {
            return;
        };
        let delta = quantity.shown_finely(delta);
        let hidden = self.hidden.entry(quantity).or_insert_with(|| Hidden {
            quantity,
            delta,
            unit: quantity.unit().to_owned(),
            part: part.to_owned(),
            field: field.name.to_string(),
            count: 0,
        });
        hidden.count += 1;
        if delta.abs() > hidden.delta.abs() {
            hidden.delta = delta;
            part.clone_into(&mut hidden.part);
            hidden.field = field.name.to_string();
        }
    }

    /// The row in which a part or an opening is counted; other items are no parts of their own.
    fn row(&mut self, kind: Kind, item: Option<&Item>) -> Option<&mut Count> {
        let (place, what) = match item {
            None => (0, kind.plural()),
            Some(item) if is_opening(item) => (1, "openings"),
            Some(_) => return None,
        };
        let row = self.counts.entry((kind, place));
        Some(row.or_insert_with(|| Count {
            what: what.to_owned(),
            ..Count::default()
        }))
    }

    fn count(&mut self, kind: Kind, item: Option<&Item>, action: Action) {
        if let Some(row) = self.row(kind, item) {
            if action == Action::Removed {
                row.before += 1;
                row.removed += 1;
            } else {
                row.after += 1;
                row.added += 1;
            }
        }
    }

    fn count_pair(
        &mut self,
        kind: Kind,
        item: Option<&Item>,
        class: Option<Class>,
        new_name: bool,
    ) {
        if let Some(row) = self.row(kind, item) {
            row.before += 1;
            row.after += 1;
            row.renamed += usize::from(new_name);
            *match class {
                None => &mut row.same,
                Some(Class::Noise) => &mut row.noise,
                Some(Class::Redraw) => &mut row.redraw,
                Some(Class::Reassemble) => &mut row.reassemble,
                Some(Class::Recut) => &mut row.recut,
            } += 1;
        }
    }
}

fn is_opening(item: &Item) -> bool {
    matches!(item.kind, "hole" | "notch")
}
