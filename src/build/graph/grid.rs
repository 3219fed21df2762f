//! Crossings and lamellae of patches.

use super::{Basis, Told, key};
use crate::build::stages::members::{GRID, LAMELLAE};
use crate::build::{Graph, Node};
use crate::grid::{Crossing, Lamella, Section};
use crate::layout::Domain;
use crate::members::Member;
use crate::project::model::{Patch, Project};

/// What the members of a patch make together.
pub(super) struct PatchGrid {
    /// Members of the u- and the v-family.
    pub(super) members: [Node<Vec<Member>>; 2],
    pub(super) crossings: Node<Vec<Crossing>>,
    pub(super) lamellae: Node<Vec<Lamella>>,
    pub(super) section: Section,
}

/// Declares crossings and lamellae of a patch.
pub(super) fn cross(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    index: usize,
    domain: Node<Domain>,
    members: [Node<Vec<Member>>; 2],
    told: &mut Told,
) -> PatchGrid {
    let patch = &basis.patches[index];
    let name = &patch.name;
    let here = basis.origins.patch_key(name);
    let [u, v] = members;
    let crossings = graph.add(&GRID, name, (), (domain, u, v));
    graph.origin(crossings, "", here.clone());
    let section = section(basis.design.project, patch);
    let lamellae = graph.add(&LAMELLAE, name, section.clone(), (u, v, crossings));
    graph.origin(lamellae, "", here.clone());
    for field in ["width", "thickness"] {
        graph.origin(lamellae, field, basis.lamella_key(name, field));
    }
    graph.origin(lamellae, "end_margin", "fabrication.end_margin");
    graph.origin(lamellae, "clearance", "fabrication.clearance");
    graph.origin(lamellae, "bolt", "hardware.bolt");
    graph.origin(lamellae, "slider", "hardware.shell");
    graph.origin(
        lamellae,
        "density",
        key(&["materials", &patch.lamella.material, "density"]),
    );
    told.push((name.clone(), lamellae.warnings()));
    PatchGrid {
        members,
        crossings,
        lamellae,
        section,
    }
}

/// What shapes the lamellae of a patch.
fn section(project: &Project, patch: &Patch) -> Section {
    let hardware = &project.hardware;
    let material = project
        .materials
        .iter()
        .find(|m| m.name == patch.lamella.material);
    Section {
        width: patch.lamella.width,
        thickness: patch.lamella.thickness,
        end_margin: project
            .fabrication
            .end_margin
            .unwrap_or(patch.lamella.width),
        bolt: hardware.bolt.diameter,
        slider: hardware
            .shell
            .as_ref()
            .map_or(hardware.bolt.diameter, |s| s.diameter),
        clearance: project.fabrication.clearance,
        // A checked project knows the materials of its lamellae.
        density: material.map_or(0.0, |m| m.density),
    }
}
