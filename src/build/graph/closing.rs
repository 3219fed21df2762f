//! Rings that shall close: the plans of their patches are chosen together, and their members with
//! them. Other patches need nothing of it.

use super::Basis;
use super::cladding::Cover;
use super::members::strip_origins;
use crate::build::passages::{StripGroup, count};
use crate::build::stages::closing::{
    CLOSED_CLADDING, CLOSED_SCHEDULE, CLOSING, ClosedCladdingInput, ClosingInput, ClosingPassage,
    ClosingPatch,
};
use crate::build::{Graph, Node};
use crate::cladding::Clad;
use crate::members::closing::Closed;
use crate::members::schedule::Schedule;
use crate::project::model::Family;
use std::collections::{BTreeMap, BTreeSet};

/// Declares the closing of rings. Puts the plans that come of it into `covers`, and returns the
/// schedules of closed rings, by the names of their strips.
pub(super) fn close(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    groups: &[StripGroup],
    covers: &mut [Cover],
) -> BTreeMap<String, Node<Schedule>> {
    let mut schedules = BTreeMap::new();
    for rings in together(groups) {
        let among: Vec<usize> = patches_of(&rings).into_iter().collect();
        let closing = closing(graph, basis, &rings, &among, covers);
        for (i, ring) in rings.iter().enumerate() {
            let schedule = graph.add(&CLOSED_SCHEDULE, &ring.name, i as u32, closing);
            schedules.insert(ring.name.clone(), schedule);
        }
        for (i, &patch) in among.iter().enumerate() {
            covers[patch].clad = clad(graph, basis, patch, i as u32, covers[patch], closing);
        }
    }
    schedules
}

/// Rings that shall close, those that share patches together.
fn together(groups: &[StripGroup]) -> Vec<Vec<&StripGroup>> {
    let mut all: Vec<Vec<&StripGroup>> = Vec::new();
    for ring in groups.iter().filter(|group| group.input.closed) {
        let own = patches_of(&[ring]);
        let meets = |rings: &Vec<&StripGroup>| !patches_of(rings).is_disjoint(&own);
        let (mut joined, apart): (Vec<_>, Vec<_>) = all.into_iter().partition(meets);
        all = apart;
        joined.push(vec![ring]);
        all.push(joined.concat());
    }
    all
}

fn patches_of(rings: &[&StripGroup]) -> BTreeSet<usize> {
    let passages = rings.iter().flat_map(|ring| &ring.passages);
    passages.map(|&(patch, _)| patch).collect()
}

fn closing(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    rings: &[&StripGroup],
    among: &[usize],
    covers: &[Cover],
) -> Node<Closed> {
    let ring_of = |ring: &&StripGroup| {
        let passages = ring.passages.iter().zip(&ring.input.passages);
        let passage = passages.map(|(&(patch, _), passage)| ClosingPassage {
            patch: among.binary_search(&patch).unwrap_or_default() as u32,
            family: passage.family,
            start: passage.start,
            end: passage.end,
            count: passage.count,
            weights: passage.weights,
        });
        passage.collect()
    };
    let free = |&patch: &usize| ClosingPatch {
        free: basis.patches[patch].alpha.is_none(),
    };
    let input = ClosingInput {
        patches: among.iter().map(free).collect(),
        rings: rings.iter().map(ring_of).collect(),
    };
    let all = || among.iter().map(|&patch| &covers[patch]);
    let needs = (
        all().map(|cover| cover.domain).collect(),
        all().map(|cover| cover.distances[0]).collect(),
        all().map(|cover| cover.distances[1]).collect(),
        all().map(|cover| cover.angles).collect(),
        all().map(|cover| cover.clad).collect(),
    );
    let node = graph.add(&CLOSING, &rings[0].name, input, needs);
    for (i, &patch) in among.iter().enumerate() {
        let name = &basis.patches[patch].name;
        let here = basis.origins.patch_key(name);
        graph.name(node, format!("patches[{i}]"), name);
        graph.origin(node, format!("patches[{i}].free"), format!("{here}.alpha"));
        graph.origin(node, format!("patches[{i}]"), here);
    }
    for (r, ring) in rings.iter().enumerate() {
        for (i, &(patch, _)) in ring.passages.iter().enumerate() {
            let here = basis.origins.patch_key(&basis.patches[patch].name);
            strip_origins(graph, node, &format!("rings[{r}][{i}]"), &here);
        }
    }
    node
}

/// The plan of a patch with the angle that its rings chose.
fn clad(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    index: usize,
    among: u32,
    cover: Cover,
    closing: Node<Closed>,
) -> Node<Clad> {
    let patch = &basis.patches[index];
    let here = basis.origins.patch_key(&patch.name);
    let input = ClosedCladdingInput {
        patch: among,
        slope: basis.design.project.split.slope,
        members: [Family::U, Family::V].map(|family| count(patch, family)),
        width: patch.lamella.width,
    };
    let [u, v] = cover.distances;
    let needs = (cover.sides, u, v, cover.angles, closing);
    let node = graph.add(&CLOSED_CLADDING, &patch.name, input, needs);
    graph.origin(node, "", here.clone());
    graph.origin(node, "slope", "split.slope");
    graph.origin(node, "width", basis.lamella_key(&patch.name, "width"));
    graph.origin(node, "members", format!("{here}.members"));
    node
}
