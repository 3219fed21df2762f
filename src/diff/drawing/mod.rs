//! Overlays of two plans: the structure from above, each flat patch and each sheet on which
//! something changed, with what was before and what is after in one picture.
//!
//! Drawings are part of the difference document, in millimetres with y up, so that every renderer
//! shows the same. They say what a shape *is* (before, after, same); how that looks is the
//! renderer's business.

mod above;
mod flat;
mod shape;
mod sheets;

use super::class::Class;
use super::document::Change;
use super::part::{Kind, by_number};
use super::renames::Renames;
use crate::plan::Plan;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

pub use shape::{Label, Move, Outline, Shape, State};

/// A picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Drawing {
    /// Part of a file name: `above`, `patch-west`, `sheet-01`.
    pub id: String,
    /// What it shows.
    pub title: String,
    /// Millimetres.
    pub size: [f64; 2],
    /// Shapes in the order of painting.
    pub shapes: Vec<Shape>,
    /// What went from one place to another.
    pub moves: Vec<Move>,
    /// Names.
    pub labels: Vec<Label>,
}

/// What drawings are made from.
struct Scene<'a> {
    before: &'a Plan,
    after: &'a Plan,
    renames: &'a Renames,
    /// Changes that ask for something, by kind and id after.
    changes: BTreeMap<(Kind, &'a str), &'a Change>,
}

impl<'a> Scene<'a> {
    /// The worst that happened to a thing of one of these kinds.
    fn class(&self, kinds: &[Kind], id: &str) -> Option<Class> {
        let found = kinds
            .iter()
            .filter_map(|kind| self.changes.get(&(*kind, id)));
        found.map(|change| change.class).max()
    }

    /// Records of both sides by their id after; records that are gone, and have no such id, come
    /// with the one they had.
    fn pairs<T>(
        &self,
        before: &'a [T],
        after: &'a [T],
        id: fn(&T) -> &str,
    ) -> Vec<(&'a str, Option<&'a T>, Option<&'a T>)> {
        let mut old: BTreeMap<String, &T> = BTreeMap::new();
        let mut pairs: Vec<(&str, Option<&T>, Option<&T>)> = Vec::new();
        for record in before {
            match self.renames.id(id(record)) {
                Some(new) => {
                    old.insert(new, record);
                }
                None => pairs.push((id(record), Some(record), None)),
            }
        }
        for record in after {
            pairs.push((id(record), old.remove(id(record)), Some(record)));
        }
        pairs.extend(
            old.into_values()
                .map(|record| (id(record), Some(record), None)),
        );
        pairs.sort_by(|a, b| by_number(a.0, b.0));
        pairs
    }
}

/// Pictures of everything that changed visibly.
pub(super) fn drawings(
    before: &Plan,
    after: &Plan,
    renames: &Renames,
    changes: &[Change],
) -> Vec<Drawing> {
    let scene = Scene {
        before,
        after,
        renames,
        changes: changes
            .iter()
            .map(|change| ((change.kind, &*change.id), change))
            .collect(),
    };
    let mut drawings = Vec::new();
    drawings.extend(above::draw(&scene));
    drawings.extend(flat::draw(&scene));
    drawings.extend(sheets::draw(&scene));
    drawings
}
