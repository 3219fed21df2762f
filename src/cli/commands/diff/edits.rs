//! What was edited in the project file: values by their key paths, as they are written. A value
//! that is written in another unit is an edit too; that no part changes then is the difference's
//! business.

use super::sides::{Loaded, Source};
use crate::diff::{Edit, Rename};
use std::collections::BTreeMap;

/// Values that are written differently on both sides, and what happened to the mesh.
pub(super) fn between(before: &Loaded, after: &Loaded) -> Vec<Edit> {
    let (Some(old), Some(new)) = (&before.source, &after.source) else {
        return Vec::new();
    };
    let mut values: BTreeMap<String, Edit> = BTreeMap::new();
    let each = |source: &Source| -> Vec<(String, String, String)> {
        let text = &source.text;
        let mut paths: Vec<&str> = source
            .spans
            .leaves()
            .map(|(path, _)| list_of(path))
            .collect();
        paths.dedup();
        paths
            .into_iter()
            .filter_map(|path| {
                let range = source.spans.value(path);
                let value = text.get(range.clone())?.split_whitespace();
                let value = value.collect::<Vec<_>>().join(" ");
                let line = text.get(..range.start)?.matches('\n').count() + 1;
                Some((path.to_owned(), value, format!("{}:{line}", source.name)))
            })
            .collect()
    };
    for (key, value, place) in each(old) {
        values.insert(
            key.clone(),
            Edit {
                key,
                before: Some(value),
                after: None,
                place: Some(place),
            },
        );
    }
    for (key, value, place) in each(new) {
        let edit = values.entry(key.clone()).or_insert(Edit {
            key,
            before: None,
            after: None,
            place: None,
        });
        edit.after = Some(value);
        edit.place = Some(place);
    }
    let mut edits: Vec<Edit> = values
        .into_values()
        .filter(|edit| edit.before != edit.after)
        .collect();
    edits.extend(mesh(old, new));
    edits
}

/// The list that an item stands in, read as one value; a path to anything else as it is.
fn list_of(path: &str) -> &str {
    match path
        .strip_suffix(']')
        .and_then(|rest| rest.rsplit_once('['))
    {
        Some((list, index)) if index.bytes().all(|c| c.is_ascii_digit()) => list,
        _ => path,
    }
}

/// Edits without those that only follow a new name of a point or a patch.
pub(super) fn without_renames(edits: Vec<Edit>, renames: &[Rename]) -> Vec<Edit> {
    if renames.is_empty() {
        return edits;
    }
    let named = |what: &str, name: &str| {
        let of = |rename: &&Rename| rename.what == what && rename.before == name;
        renames.iter().find(of).map(|rename| rename.after.clone())
    };
    let renamed = |key: &str| -> String {
        let mut parts: Vec<String> = key.split('.').map(str::to_owned).collect();
        let what = match parts.first().map(String::as_str) {
            Some("patches" | "lamella") => "patch",
            Some("points") => "point",
            _ => return key.to_owned(),
        };
        if let Some(part) = parts.get_mut(1) {
            let (name, index) = part.split_at(part.find('[').unwrap_or(part.len()));
            if let Some(new) = named(what, name) {
                *part = format!("{new}{index}");
            }
        }
        parts.join(".")
    };
    let value = |text: &str| match text
        .strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'))
    {
        Some(name) => named("point", name).map_or(text.to_owned(), |new| format!("\"{new}\"")),
        None => text.to_owned(),
    };
    let old: BTreeMap<String, String> = edits
        .iter()
        .filter_map(|edit| Some((renamed(&edit.key), value(edit.before.as_ref()?))))
        .collect();
    let new: BTreeMap<String, String> = edits
        .iter()
        .filter_map(|edit| Some((edit.key.clone(), edit.after.clone()?)))
        .collect();
    let follows = |key: &str| {
        old.get(key)
            .is_some_and(|value| new.get(key) == Some(value))
    };
    edits
        .into_iter()
        .filter(|edit| !(follows(&edit.key) || follows(&renamed(&edit.key))))
        .collect()
}

/// What happened to the contents of the mesh.
fn mesh(old: &Source, new: &Source) -> Option<Edit> {
    let (before, after) = (old.mesh.as_ref()?, new.mesh.as_ref()?);
    if before == after {
        return None;
    }
    let [a, b] = [before, after].map(|bytes| vertices(bytes));
    let count = |list: &[[f64; 3]]| format!("{} vertices", list.len());
    let told = if a.len() == b.len() {
        let far = |(a, b): (&[f64; 3], &[f64; 3])| {
            let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
            new.metres_per_unit * 1e3 * squares.sum::<f64>().sqrt()
        };
        let far: Vec<f64> = a.iter().zip(&b).map(far).filter(|far| *far > 0.0).collect();
        let most = far.iter().copied().fold(0.0, f64::max);
        match far.len() {
            0 => format!("{}, written differently", count(&b)),
            moved => format!("{}, {moved} of them moved, {most:.3} mm at most", count(&b)),
        }
    } else {
        count(&b)
    };
    Some(Edit {
        key: "surface.mesh".to_owned(),
        before: Some(count(&a)),
        after: Some(told),
        place: Some(new.mesh_name.clone()),
    })
}

/// Coordinates of the vertices of an OBJ file, as they are written.
fn vertices(bytes: &[u8]) -> Vec<[f64; 3]> {
    let text = String::from_utf8_lossy(bytes);
    let vertex = |line: &str| {
        let mut words = line.trim().strip_prefix("v ")?.split_whitespace();
        let mut next = || words.next()?.parse::<f64>().ok();
        Some([next()?, next()?, next()?])
    };
    text.lines().filter_map(vertex).collect()
}
