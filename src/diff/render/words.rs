//! How changes are said: phrases, rows of equal changes, ranges of ids, the verdict.

use crate::diff::class::Class;
use crate::diff::document::{
    Action, Change, Difference, FieldChange, Hidden, ItemChange, Reading, Side, Total,
};
use crate::diff::part::{Kind, by_number};
use crate::diff::quantity::{Quantity, number};
use std::collections::BTreeMap;

/// Changes that are said in the same words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) kind: Kind,
    pub(super) action: Action,
    pub(super) ids: Vec<String>,
    pub(super) what: Vec<String>,
    pub(super) used_on: Vec<String>,
}

/// Fewest changes that are told together by what they have in common.
const ALIKE: usize = 3;

/// Changes as rows. Equal changes are one row, where the first of them stood; so are several that
/// differ in where they start only: `length +4 mm` for all instead of a row for each length.
pub(super) fn rows<'a>(changes: impl Iterator<Item = &'a Change>, arrow: &str) -> Vec<Row> {
    let changes: Vec<&Change> = changes.collect();
    let key =
        |change: &Change, form: Form| (change.kind, change.action, phrases(change, arrow, form));
    let mut alike: BTreeMap<(Kind, Action, Vec<String>), usize> = BTreeMap::new();
    for change in &changes {
        *alike.entry(key(change, Form::Deltas)).or_default() += 1;
    }
    let mut rows: Vec<Row> = Vec::new();
    let mut places: BTreeMap<(Kind, Action, Vec<String>), usize> = BTreeMap::new();
    for change in changes {
        let (full, short) = (key(change, Form::Full), key(change, Form::Deltas));
        let key = if alike[&short] >= ALIKE {
            short
        } else {
            full.clone()
        };
        let place = *places.entry(key.clone()).or_insert(rows.len());
        if place == rows.len() {
            rows.push(Row {
                kind: change.kind,
                action: change.action,
                ids: Vec::new(),
                what: full.2.clone(),
                used_on: Vec::new(),
            });
        }
        let row = &mut rows[place];
        if row.what != full.2 {
            row.what = key.2;
        }
        row.ids.push(change.id.clone());
        for sheet in &change.used_on {
            if !row.used_on.contains(sheet) {
                row.used_on.push(sheet.clone());
            }
        }
        row.used_on.sort();
    }
    rows
}

/// How much of a changed number is told.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Before, after, and by how much.
    Full,
    /// By how much.
    Deltas,
}

/// What happened to a part, in short phrases for a terminal.
pub fn phrases_of(change: &Change) -> Vec<String> {
    phrases(change, "->", Form::Full)
}

/// What happened to a part, in short phrases.
pub(super) fn phrases(change: &Change, arrow: &str, form: Form) -> Vec<String> {
    let mut said = Vec::new();
    match change.action {
        Action::Added => {
            said.push("new".to_owned());
            said.extend(change.fields.iter().filter_map(|field| {
                let value = shown(field.after.as_ref()?, field);
                Some(format!("{} {value}", field.name))
            }));
            return said;
        }
        Action::Removed => return vec!["gone".to_owned()],
        Action::Changed | Action::Renamed => {}
    }
    if let Some(previous) = &change.previous_id {
        said.push(format!("was {previous}"));
    }
    // Ids in a part's own values that only follow a rename say nothing new.
    let moved = change.fields.iter().filter(|field| is_move(field));
    said.extend(
        change
            .fields
            .iter()
            .filter(|field| !is_move(field))
            .map(|field| field_phrase(field, arrow, form)),
    );
    let farthest = moved.max_by(|a, b| magnitude(a).total_cmp(&magnitude(b)));
    if let Some(field) = farthest {
        let far = value_with_unit(magnitude(field), field);
        said.push(match change.kind {
            Kind::Member => format!("moved {far} at most"),
            _ => format!("{} moved {far}", field.name),
        });
    }
    said.extend(item_phrases(&change.items, arrow));
    said
}

/// Whether a value is a place or a curve, of which only the distance is told.
fn is_move(field: &FieldChange) -> bool {
    field.before.is_none() && field.after.is_none() && field.delta.is_some()
}

fn magnitude(field: &FieldChange) -> f64 {
    field.delta.map_or(0.0, f64::abs)
}

fn value_with_unit(value: f64, field: &FieldChange) -> String {
    let Some(quantity) = field.quantity else {
        return value.to_string();
    };
    match quantity.unit() {
        "" => number(value, quantity),
        unit => format!("{} {unit}", number(value, quantity)),
    }
}

fn shown(reading: &Reading, field: &FieldChange) -> String {
    match reading {
        Reading::Number(value) => value_with_unit(*value, field),
        Reading::Text(text) => text.clone(),
    }
}

/// `length 1180.2 -> 1183.4 mm (+3.2)`.
fn field_phrase(field: &FieldChange, arrow: &str, form: Form) -> String {
    let name = &field.name;
    match (&field.before, &field.after) {
        (Some(Reading::Number(before)), Some(Reading::Number(after))) => {
            let plain = field.quantity.map_or(String::new(), |q| number(*before, q));
            let delta = field.delta.unwrap_or(after - before);
            let delta = signed(delta, field);
            if form == Form::Deltas && field.quantity == Some(Quantity::Length) {
                return format!("{name} {delta} {}", field.unit);
            }
            let after = value_with_unit(*after, field);
            format!("{name} {plain} {arrow} {after} ({delta})")
        }
        (Some(before), Some(after)) => {
            format!(
                "{name} {} {arrow} {}",
                shown(before, field),
                shown(after, field)
            )
        }
        (None, Some(after)) => format!("{name} {} is new", shown(after, field)),
        (Some(before), None) => format!("{name} {} is gone", shown(before, field)),
        (None, None) => format!("{name} changed"),
    }
}

fn signed(delta: f64, field: &FieldChange) -> String {
    let text = field.quantity.map_or(String::new(), |q| number(delta, q));
    if delta > 0.0 {
        format!("+{text}")
    } else {
        text
    }
}

/// Items, those of one kind and one fate together: `3 notches moved 0.8 mm at most (u03-v05)`.
fn item_phrases(items: &[ItemChange], arrow: &str) -> Vec<String> {
    let mut said = Vec::new();
    for (action, fate) in [(Action::Added, "new"), (Action::Removed, "gone")] {
        let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
        for item in items.iter().filter(|item| item.action == action) {
            *kinds.entry(&item.kind).or_default() += 1;
        }
        said.extend(
            kinds
                .iter()
                .map(|(kind, count)| format!("{} {fate}", several(*count, kind))),
        );
    }
    let mut words: BTreeMap<(&str, &str), Vec<(&ItemChange, &FieldChange)>> = BTreeMap::new();
    let changed = || items.iter().filter(|item| item.action == Action::Changed);
    for item in changed() {
        for field in item.fields.iter().filter(|field| !moves_item(field)) {
            words
                .entry((&item.kind, &field.name))
                .or_default()
                .push((item, field));
        }
    }
    for ((kind, _), list) in words {
        let mut each: Vec<String> = list
            .iter()
            .map(|(_, f)| field_phrase(f, arrow, Form::Full))
            .collect();
        each.dedup();
        let count = several(list.len(), kind);
        match each.as_slice() {
            [one] => said.push(format!("{count}: {one}")),
            _ => said.push(format!("{count}: {} changed", list[0].1.name)),
        }
    }
    let mut moves: BTreeMap<&str, Vec<(f64, &ItemChange, &FieldChange)>> = BTreeMap::new();
    for item in changed() {
        let farthest = item
            .fields
            .iter()
            .filter(|field| moves_item(field))
            .max_by(|a, b| magnitude(a).total_cmp(&magnitude(b)));
        if let Some(field) = farthest {
            moves
                .entry(&item.kind)
                .or_default()
                .push((magnitude(field), item, field));
        }
    }
    for (kind, list) in moves {
        let Some((far, item, field)) = list.iter().max_by(|a, b| a.0.total_cmp(&b.0)) else {
            continue;
        };
        let far = value_with_unit(*far, field);
        let label = item.id.rsplit('.').next().unwrap_or(&item.id);
        said.push(match list.len() {
            1 => format!("1 {kind} moved {far} ({label})"),
            count => format!("{} moved {far} at most ({label})", several(count, kind)),
        });
    }
    said
}

/// Whether a value of an item says where it is.
fn moves_item(field: &FieldChange) -> bool {
    is_move(field) || matches!(&*field.name, "at" | "from" | "to")
}

/// `1 notch`, `3 notches`.
pub(super) fn several(count: usize, kind: &str) -> String {
    match (count, kind) {
        (1, _) => format!("1 {kind}"),
        (_, "notch") => format!("{count} notches"),
        (_, "patch") => format!("{count} patches"),
        (_, "lamella") => format!("{count} lamellae"),
        (_, "family") => format!("{count} families"),
        _ => format!("{count} {kind}s"),
    }
}

/// Ids in order, those with following numbers as ranges: `west.u02..u08, west.v01`.
pub(super) fn ranges(ids: &[String]) -> String {
    let mut sorted: Vec<&String> = ids.iter().collect();
    sorted.sort_by(|a, b| by_number(a, b));
    sorted.dedup();
    let split = |id: &str| -> Option<(String, u64)> {
        let at = id.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        let number = id[at..].parse().ok()?;
        // In `u03-v05` the last number does not count the things themselves.
        let label = id[..at].rsplit('.').next().unwrap_or("");
        (!label.contains('-') || !id.contains('.')).then(|| (id[..at].to_owned(), number))
    };
    let mut runs: Vec<(&str, &str)> = Vec::new();
    for id in sorted {
        if let Some((_, last)) = runs.last_mut()
            && let (Some((a, x)), Some((b, y))) = (split(last), split(id))
            && a == b
            && x + 1 == y
        {
            *last = id;
            continue;
        }
        runs.push((id, id));
    }
    let words = runs.into_iter().map(|(first, last)| {
        if first == last {
            return first.to_owned();
        }
        let short = match last.rsplit_once('.') {
            Some((_, label)) => label,
            None => last,
        };
        format!("{first}..{short}")
    });
    words.collect::<Vec<_>>().join(", ")
}

/// The whole in one sentence.
pub(super) fn verdict(difference: &Difference) -> String {
    let Some(class) = difference.summary.class else {
        let hidden = hidden(difference);
        return if hidden.is_empty() {
            "no part changes".to_owned()
        } else {
            format!("no part changes above tolerance; {hidden}")
        };
    };
    match class {
        Class::Recut => to_cut(difference),
        Class::Reassemble => "nothing to cut: parts are placed or joined differently".to_owned(),
        Class::Redraw | Class::Noise => {
            "nothing to cut: only drawings, labels or prices change".to_owned()
        }
    }
}

/// What has to be cut, and what need not be kept.
fn to_cut(difference: &Difference) -> String {
    let (mut cut, mut gone) = (Vec::new(), Vec::new());
    for (what, one) in [
        ("lamellae", "lamella"),
        ("stickers", "sticker"),
        ("supports", "support"),
    ] {
        let Some(count) = difference
            .summary
            .counts
            .iter()
            .find(|count| count.what == what)
        else {
            continue;
        };
        match (count.recut, count.added) {
            (0, 0) => {}
            (0, added) => cut.push(format!(
                "{added} new {}",
                if added == 1 { one } else { what }
            )),
            (recut, 0) => cut.push(format!("{recut} of {} {what} anew", count.before)),
            (recut, added) => {
                cut.push(format!(
                    "{recut} of {} {what} anew, {added} new",
                    count.before
                ));
            }
        }
        if count.removed > 0 {
            gone.push(several(count.removed, one));
        }
    }
    let cut = if cut.is_empty() {
        "nothing to cut".to_owned()
    } else {
        format!("to cut: {}", cut.join("; "))
    };
    if gone.is_empty() {
        cut
    } else {
        format!("{cut}; gone: {}", gone.join(", "))
    }
}

/// What was not told because it is small; empty if there is nothing.
pub(super) fn hidden(difference: &Difference) -> String {
    let say = |hidden: &Hidden| {
        let delta = format!("{} {}", hidden.delta.abs(), hidden.unit);
        format!("{} ({} of {})", delta.trim(), hidden.field, hidden.part)
    };
    let list: Vec<String> = difference.summary.hidden.iter().map(say).collect();
    if list.is_empty() {
        String::new()
    } else {
        format!("largest drift hidden: {}", list.join(", "))
    }
}

/// A side: `HEAD~1 (3f2a9c01)`.
pub(super) fn side(side: &Side) -> String {
    match &side.commit {
        Some(commit) if !commit.starts_with(&side.label) => {
            format!("{} ({})", side.label, &commit[..commit.len().min(8)])
        }
        Some(commit) => commit[..commit.len().min(8)].to_owned(),
        None => side.label.clone(),
    }
}

/// The project's name, or both where they differ.
pub(super) fn project(difference: &Difference, arrow: &str) -> String {
    let (before, after) = (&difference.before.project, &difference.after.project);
    if before == after || before.is_empty() {
        after.clone()
    } else {
        format!("{before} {arrow} {after}")
    }
}

/// A sum as cells: name, before, after, what it gained; `None` if both sides have the same.
pub(super) fn total(total: &Total) -> Option<[String; 4]> {
    let value = |value: Option<f64>| match (value, total.unit.as_str()) {
        (None, _) => "-".to_owned(),
        (Some(value), "") => number(value, total.quantity),
        (Some(value), unit) => format!("{} {unit}", number(value, total.quantity)),
    };
    // The difference of what is shown: nobody has to wonder about digits that are not.
    let shown = |value: Option<f64>| {
        let text = number(value.unwrap_or(0.0), total.quantity);
        text.parse::<f64>().unwrap_or_default()
    };
    let delta = shown(total.after) - shown(total.before);
    let change = number(delta, total.quantity);
    if change == "0" {
        return None;
    }
    let sign = if delta > 0.0 { "+" } else { "" };
    Some([
        total.what.clone(),
        value(total.before),
        value(total.after),
        format!("{sign}{change}"),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_total_says_the_difference_of_the_numbers_that_it_shows_or_nothing() {
        let of = |before, after| {
            total(&Total {
                what: "sheets used".to_owned(),
                before: Some(before),
                after: Some(after),
                quantity: Quantity::Share,
                unit: "%".to_owned(),
            })
        };
        assert_eq!(of(24.64, 24.56), None);
        let [_, before, after, delta] = of(24.64, 24.46).expect("it changed");
        assert_eq!([&*before, &*after, &*delta], ["24.6 %", "24.5 %", "-0.1"]);
    }

    #[test]
    fn ids_that_follow_each_other_are_a_range() {
        let ids = |list: &[&str]| list.iter().map(|id| (*id).to_owned()).collect::<Vec<_>>();
        let some = ids(&[
            "west.u03", "west.u01", "west.u02", "west.v09", "west.v10", "a",
        ]);
        assert_eq!(ranges(&some), "a, west.u01..u03, west.v09..v10");
        assert_eq!(
            ranges(&ids(&["sheet-01", "sheet-02"])),
            "sheet-01..sheet-02"
        );
        assert_eq!(
            ranges(&ids(&["w.u01-v01", "w.u01-v02"])),
            "w.u01-v01, w.u01-v02"
        );
        assert_eq!(ranges(&[]), "");
    }
}
