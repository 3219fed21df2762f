//! Claddings of patches: distance maps, the range of flat angles, the cladding functions.

use super::{Basis, Told};
use crate::build::passages::{count, family_target};
use crate::build::stages::cladding::{
    ANGLES, AnglesInput, CLADDING, CladdingInput, DISTANCES, SIDES,
};
use crate::build::{Graph, Node};
use crate::cladding::{AngleChoice, Clad, DistanceTable};
use crate::layout::{Domain, SideLengths};
use crate::project::model::Family;

/// How a patch is covered.
#[derive(Clone, Copy)]
pub(super) struct Cover {
    pub(super) domain: Node<Domain>,
    pub(super) sides: Node<SideLengths>,
    /// From the sides that the u- and the v-family run between.
    pub(super) distances: [Node<DistanceTable>; 2],
    pub(super) angles: Node<AngleChoice>,
    /// Of the patch alone, or as its rings close.
    pub(super) clad: Node<Clad>,
}

/// Declares how a patch is covered.
pub(super) fn cover(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    index: usize,
    domain: Node<Domain>,
    told: &mut Told,
) -> Cover {
    let project = basis.design.project;
    let patch = &basis.patches[index];
    let name = &patch.name;
    let here = basis.origins.patch_key(name);
    let sides = graph.add(&SIDES, name, (), domain);
    let distances = [Family::U, Family::V].map(|family| {
        let node = graph.add(&DISTANCES, family_target(name, family), family, domain);
        graph.origin(node, "", here.clone());
        told.push((name.clone(), node.warnings()));
        node
    });
    let [u, v] = distances;
    let slope = project.split.slope;
    let members = [Family::U, Family::V].map(|family| count(patch, family));
    let width = patch.lamella.width;
    let input = AnglesInput {
        slope,
        members,
        width,
    };
    let angles = graph.add(&ANGLES, name, input, (sides, u, v));
    let input = CladdingInput {
        alpha: patch.alpha,
        slope,
        members,
        width,
    };
    let clad = graph.add(&CLADDING, name, input, ((sides, u, v), angles));
    graph.origin(clad, "", here.clone());
    for (field, key) in [
        ("slope", "split.slope".to_owned()),
        ("width", basis.lamella_key(name, "width")),
    ] {
        graph.origin(angles, field, key.clone());
        graph.origin(clad, field, key);
    }
    graph.origin(angles, "members", format!("{here}.members"));
    Cover {
        domain,
        sides,
        distances,
        angles,
        clad,
    }
}
