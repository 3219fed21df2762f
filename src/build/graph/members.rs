//! Members of all strips, and of each family of each patch out of them.

use super::cladding::Cover;
use super::{Basis, Told};
use crate::build::passages::{StripGroup, family_target};
use crate::build::stages::members::{MEMBERS, SCHEDULE, STRIP, STRIP_CHAPTER, StripChapterInput};
use crate::build::{Graph, Node};
use crate::cladding::Clad;
use crate::members::Member;
use crate::members::schedule::Schedule;
use crate::plan::Plan;
use crate::project::model::Family;
use std::collections::BTreeMap;

/// Members of a family of a patch, by its index.
pub(super) type MembersOf = BTreeMap<(usize, Family), Node<Vec<Member>>>;

/// Declares the strips: the members of all patches, and what the plan says of each strip.
pub(super) fn weave(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    groups: Vec<StripGroup>,
    covers: &[Cover],
    closed: &BTreeMap<String, Node<Schedule>>,
    told: &mut Told,
) -> (MembersOf, Vec<Node<Plan>>) {
    let mut members = MembersOf::new();
    let mut chapters = Vec::new();
    let patches = basis.patches;
    for group in groups {
        let covers_in = || group.passages.iter().map(|&(patch, _)| &covers[patch]);
        let clads: Vec<Node<Clad>> = covers_in().map(|cover| cover.clad).collect();
        let domains = covers_in().map(|cover| cover.domain).collect();
        let schedule = closed.get(&group.name).copied().unwrap_or_else(|| {
            graph.add(&SCHEDULE, &group.name, group.input.clone(), clads.clone())
        });
        let needs = (domains, clads, schedule);
        let closed = group.input.closed;
        let strip = graph.add(&STRIP, &group.name, group.input, needs);
        told.push((group.name.clone(), strip.warnings()));
        let families = group.passages.iter();
        let families = families.map(|&(patch, family)| family_target(&patches[patch].name, family));
        let input = StripChapterInput {
            families: families.collect(),
            closed,
        };
        chapters.push(graph.add(&STRIP_CHAPTER, &group.name, input, (schedule, strip)));
        for (i, &(patch, family)) in group.passages.iter().enumerate() {
            let name = &patches[patch].name;
            let here = basis.origins.patch_key(name);
            let field = format!("passages[{i}]");
            strip_origins(graph, schedule, &field, &here);
            strip_origins(graph, strip, &field, &here);
            let node = graph.add(&MEMBERS, family_target(name, family), i as u32, strip);
            members.insert((patch, family), node);
        }
    }
    (members, chapters)
}

/// Where the fields of a passage come from.
pub(super) fn strip_origins<T>(graph: &mut Graph<'_>, node: Node<T>, field: &str, patch: &str) {
    graph.origin(node, format!("{field}.count"), format!("{patch}.members"));
    graph.origin(node, format!("{field}.weights"), "distribution.weights");
    graph.origin(node, field.to_owned(), patch.to_owned());
}
