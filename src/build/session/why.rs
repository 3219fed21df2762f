//! Reasons: the recipe that is wanted against the one that was used last.

use super::super::declare::{Declared, Instance};
use super::super::key::recipe::{self, Field, Ingredient, Recipe};
use super::super::key::{Digest, PortKind};
use super::super::reason::Reason;
use super::super::store::Found;
use super::{Session, Status, Supplies};
use std::collections::{BTreeMap, BTreeSet};

/// Of more changed fields than this, the rest is left out.
const FIELDS_TOLD: usize = 20;
/// The same for dependencies.
const DEPENDENCIES_TOLD: usize = 50;

impl Session<'_, '_> {
    /// The recipe of an instance, as far as its dependencies are known.
    pub(super) fn recipe(&self, index: usize) -> Recipe {
        let declared = self.declared(index);
        let mut encoded = Vec::new();
        // A part of an encoding yields the fields before the error; no key exists then.
        declared.work.encode_input(&mut encoded).ok();
        let ingredients = declared.ports.list.iter().filter_map(|port| {
            let digest = match self.through(port.node, port.kind)? {
                Supplies::Result(digest) => digest,
                Supplies::Nothing => Digest::of(&[]),
                Supplies::Failed { .. } => return None,
            };
            Some(Ingredient {
                from: (*self.declared(port.node).instance).clone(),
                port: port.kind,
                digest,
            })
        });
        Recipe {
            version: match self.build_id {
                Some(id) => format!("{} ({id})", declared.work.version()),
                None => declared.work.version().to_string(),
            },
            numerics: declared.work.numerics().to_owned(),
            fields: recipe::fields(&encoded),
            ingredients: ingredients.collect(),
        }
    }

    /// Why an instance whose key is not in the store has to run.
    pub(super) fn why(&self, index: usize) -> Vec<Reason> {
        self.changes(index, Dependencies::Known)
    }

    /// Why an instance has to run whatever its dependencies will give; empty if only they decide.
    pub(super) fn why_anyhow(&self, index: usize) -> Vec<Reason> {
        self.changes(index, Dependencies::Pending)
    }

    fn changes(&self, index: usize, dependencies: Dependencies) -> Vec<Reason> {
        let Some(record) = self.entries[index].record else {
            return vec![Reason::FirstBuild];
        };
        let Found::Whole(old) = self.store.trace(record.key) else {
            return match dependencies {
                Dependencies::Known => vec![Reason::EntryMissing],
                Dependencies::Pending => Vec::new(),
            };
        };
        let (old, new) = (old.recipe, self.recipe(index));
        let declared = self.declared(index);
        let mut reasons = Vec::new();
        if old.version != new.version {
            reasons.push(Reason::StageVersionChanged {
                old: old.version,
                new: new.version,
            });
        }
        if old.numerics != new.numerics {
            reasons.push(Reason::NumericsChanged {
                old: old.numerics,
                new: new.numerics,
            });
        }
        fields(declared, &old.fields, &new.fields, &mut reasons);
        let pending = dependencies == Dependencies::Pending;
        ingredients(&old.ingredients, &new.ingredients, &mut reasons, |gone| {
            // While dependencies are pending, one that is not known yet is not gone.
            !pending || !self.names.contains_key(&gone.from)
        });
        if reasons.is_empty() && !pending {
            reasons.push(Reason::EntryMissing);
        }
        reasons
    }

    /// Dependencies that have no result yet.
    pub(super) fn pending(&self, index: usize) -> impl Iterator<Item = usize> {
        self.entries[index]
            .needs
            .iter()
            .copied()
            .filter(|&need| matches!(self.entries[need].status, Status::Due | Status::Waiting))
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Dependencies {
    Known,
    Pending,
}

/// Fields that differ, in the order of the new input.
fn fields(declared: &Declared, old: &[Field], new: &[Field], reasons: &mut Vec<Reason>) {
    let find = |fields: &[Field], path: &str| {
        let field = fields.iter().find(|field| field.path == path);
        field.map(|field| field.value.clone())
    };
    let gone = old.iter().filter(|field| find(new, &field.path).is_none());
    let changed = new.iter().chain(gone).filter_map(|field| {
        let (old, new) = (find(old, &field.path), find(new, &field.path));
        (old != new).then(|| Reason::InputChanged {
            key: declared.key_of(&field.path),
            field: field.path.clone(),
            old,
            new,
        })
    });
    reasons.extend(changed.take(FIELDS_TOLD));
}

/// Dependencies that differ, each once.
fn ingredients(
    old: &[Ingredient],
    new: &[Ingredient],
    reasons: &mut Vec<Reason>,
    is_gone: impl Fn(&Ingredient) -> bool,
) {
    let digests = |ingredients: &[Ingredient]| -> BTreeMap<(Instance, PortKind), Digest> {
        let entry = |one: &Ingredient| ((one.from.clone(), one.port), one.digest);
        ingredients.iter().map(entry).collect()
    };
    let (before, now) = (digests(old), digests(new));
    let gone = |one: &&Ingredient| !now.contains_key(&(one.from.clone(), one.port)) && is_gone(one);
    let mut told = BTreeSet::new();
    for one in new.iter().chain(old.iter().filter(gone)) {
        if told.len() == DEPENDENCIES_TOLD {
            break;
        }
        let port = (one.from.clone(), one.port);
        let (old, new) = (before.get(&port).copied(), now.get(&port).copied());
        if old != new && told.insert(port) {
            reasons.push(Reason::DependencyChanged {
                instance: one.from.clone(),
                old,
                new,
            });
        }
    }
}
