//! On which sheets changed lamellae lie.

use crate::diff::document::{Action, Change};
use crate::diff::part::{Kind, Part};
use std::collections::BTreeMap;

/// Says on which sheets changed lamellae and their pieces lie.
pub(super) fn note_sheets(changes: &mut [Change], before: &[Part], after: &[Part]) {
    let sheets = |parts: &[Part]| {
        let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for sheet in parts.iter().filter(|part| part.kind == Kind::Sheet) {
            for item in &sheet.items {
                places
                    .entry(item.id.clone())
                    .or_default()
                    .push(sheet.id.clone());
            }
        }
        places
    };
    let pieces = |parts: &[Part]| -> BTreeMap<String, Vec<String>> {
        let lamellae = parts.iter().filter(|part| part.kind == Kind::Lamella);
        lamellae
            .map(|part| {
                let pieces = part.items.iter().filter(|item| item.kind == "piece");
                let pieces: Vec<String> = pieces.map(|item| item.id.clone()).collect();
                (part.id.clone(), pieces)
            })
            .filter(|(_, pieces)| !pieces.is_empty())
            .collect()
    };
    let sides = [before, after].map(|parts| (sheets(parts), pieces(parts)));
    for change in changes
        .iter_mut()
        .filter(|change| change.kind == Kind::Lamella)
    {
        let (sheets, pieces) = match change.action {
            Action::Removed => &sides[0],
            _ => &sides[1],
        };
        let whole = std::slice::from_ref(&change.id);
        let parts = pieces.get(&change.id).map_or(whole, Vec::as_slice);
        let mut used: Vec<String> = parts
            .iter()
            .filter_map(|part| sheets.get(part))
            .flatten()
            .cloned()
            .collect();
        used.sort();
        used.dedup();
        change.used_on = used;
    }
}
