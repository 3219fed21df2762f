//! The side table that turns key paths into byte ranges of the project file.
//!
//! The model holds no positions, so that moving a line changes no stage's input. Positions live
//! here and are asked for only when a report is rendered.

use super::key_path::parent;
use std::collections::BTreeMap;
use std::ops::Range;

/// Byte ranges of every key and value of a project file, by key path.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SpanTable {
    /// Length of the file: the place of what is missing from the root.
    end: usize,
    places: BTreeMap<String, Spans>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Spans {
    name: Option<Range<usize>>,
    value: Range<usize>,
}

impl SpanTable {
    /// An empty table for a file of so many bytes.
    pub fn new(end: usize) -> Self {
        Self {
            end,
            places: BTreeMap::new(),
        }
    }

    /// Enters a place: where its key is written (list items have none) and what to show for its
    /// value. Of a path entered twice the first stays.
    pub fn insert(
        &mut self,
        path: impl Into<String>,
        name: Option<Range<usize>>,
        value: Range<usize>,
    ) {
        self.places
            .entry(path.into())
            .or_insert(Spans { name, value });
    }

    /// Whether the file says anything at this path.
    pub fn contains(&self, path: &str) -> bool {
        self.places.contains_key(path)
    }

    /// Where the value at this path stands, or the nearest one that it is a part of; `None` where
    /// that is a whole table, so that the file says nothing about it.
    pub fn stands(&self, path: &str) -> Option<Range<usize>> {
        let (found, spans) = self.nearest(path)?;
        let inside = format!("{found}.");
        let mut after = self.places.range(inside.clone()..);
        let holds_keys = after
            .next()
            .is_some_and(|(next, _)| next.starts_with(&inside));
        (found == path || !holds_keys).then(|| spans.value.clone())
    }

    /// Whether the file says anything at this path or at one of its ancestors; it always does at
    /// the root.
    pub fn reaches(&self, path: &str) -> bool {
        path.is_empty() || self.nearest(path).is_some()
    }

    /// Where the value stands; of a missing path, where its nearest ancestor stands; the end of
    /// the file where that is the root.
    pub fn value(&self, path: &str) -> Range<usize> {
        self.nearest(path)
            .map_or(self.end..self.end, |(_, spans)| spans.value.clone())
    }

    /// Where the key itself is written; falls back to [`SpanTable::value`].
    pub fn name(&self, path: &str) -> Range<usize> {
        match self.nearest(path) {
            Some((found, spans)) if found == path => {
                spans.name.clone().unwrap_or_else(|| spans.value.clone())
            }
            Some((_, spans)) => spans.value.clone(),
            None => self.end..self.end,
        }
    }

    /// Paths of all values that hold no others, in order, with where they stand.
    pub fn leaves(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        let holds = |path: &String| {
            let below = self.places.range(path.clone()..).skip(1);
            below
                .map_while(|(other, _)| other.strip_prefix(path.as_str()))
                .any(|rest| rest.starts_with(['.', '[']))
        };
        self.places
            .iter()
            .filter(move |(path, _)| !holds(path))
            .map(|(path, spans)| (&**path, spans.value.clone()))
    }

    fn nearest<'a>(&self, path: &'a str) -> Option<(&'a str, &Spans)> {
        let mut path = path;
        loop {
            if let Some(spans) = self.places.get(path) {
                return Some((path, spans));
            }
            path = parent(path)?;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_key_resolves_to_its_nearest_ancestor() {
        let mut table = SpanTable::new(90);
        table.insert("patches.west", Some(10..14), 9..15);
        table.insert("patches.west.alpha", Some(20..25), 28..30);
        assert_eq!(table.value("patches.west.alpha"), 28..30);
        assert_eq!(table.name("patches.west.alpha"), 20..25);
        assert_eq!(table.value("patches.west.members.u"), 9..15);
        assert_eq!(table.name("patches.west.members.u"), 9..15);
        assert_eq!(table.value("lamella.width"), 90..90);
        assert_eq!(table.stands("patches.west.alpha.x"), Some(28..30));
        assert_eq!(table.stands("patches.west"), Some(9..15));
        assert_eq!(table.stands("patches.west.members.u"), None);
        assert!(table.reaches("patches.west.alpha.x") && table.reaches(""));
        assert!(!table.reaches("lamella.width"));
        let leaves: Vec<&str> = table.leaves().map(|(path, _)| path).collect();
        assert_eq!(leaves, ["patches.west.alpha"]);
    }
}
