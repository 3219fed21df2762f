//! What a workshop makes of the chapters: joints, sheets, stickers, supports and the bill.

use super::{Basis, Told};
use crate::build::stages::fabrication::{
    BILL, BillInput, Foils, NEST, NestInput, SPLICED, SPLICES, STICKERS, SUPPORTS, SupportInput,
    WORKSHOP,
};
use crate::build::{Graph, Node};
use crate::fabrication::nesting::{Nest, Settings};
use crate::fabrication::splicing::{self, Rules};
use crate::fabrication::{Grains, Inputs};
use crate::plan::{BomRow, Plan, SupportRecord};
use crate::project::model::Project;

/// What a workshop makes.
pub(super) struct Fabricated {
    /// Of patches, with the pieces of their lamellae.
    pub(super) chapters: Vec<Node<Plan>>,
    pub(super) nest: Node<Nest>,
    pub(super) foils: Node<Foils>,
    pub(super) supports: Node<Vec<SupportRecord>>,
    pub(super) bill: Node<Vec<BomRow>>,
}

/// Declares what a workshop makes.
pub(super) fn fabricate(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    skeleton: Node<Plan>,
    chapters: Vec<Node<Plan>>,
    told: &mut Told,
) -> Fabricated {
    let project = basis.design.project;
    let chapters = spliced(graph, basis, chapters, told);
    let workshops = workshops(graph, basis, &chapters, told);
    let nest = graph.add(
        &NEST,
        "",
        NestInput {
            settings: Settings::new(&project.fabrication),
            grains: Grains::of(&project.materials),
        },
        (chapters.clone(), workshops.clone()),
    );
    graph.origin(nest, "settings", "fabrication");
    told.push((String::new(), nest.warnings()));
    let foils = graph.add(
        &STICKERS,
        "",
        project.hardware.sticker.clone(),
        (chapters.clone(), workshops.clone()),
    );
    graph.origin(foils, "", "hardware.sticker");
    told.push((String::new(), foils.warnings()));
    let supports = graph.add(
        &SUPPORTS,
        "",
        SupportInput {
            supports: project.supports.clone(),
            bolt: project.hardware.bolt.clone(),
            asked: basis.design.spans.contains("supports"),
        },
        (skeleton, chapters.clone(), workshops),
    );
    graph.origin(supports, "supports", "supports");
    graph.origin(supports, "bolt", "hardware.bolt");
    told.push((String::new(), supports.warnings()));
    let bill = graph.add(
        &BILL,
        "",
        BillInput {
            hardware: project.hardware.clone(),
            materials: project.materials.clone(),
            stock: project.fabrication.stock.clone(),
        },
        (chapters.clone(), nest, foils, supports),
    );
    graph.origin(bill, "hardware", "hardware");
    graph.origin(bill, "stock", "fabrication.stock");
    told.push((String::new(), bill.warnings()));
    Fabricated {
        chapters,
        nest,
        foils,
        supports,
        bill,
    }
}

/// What a workshop objects to in each chapter.
fn workshops(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    chapters: &[Node<Plan>],
    told: &mut Told,
) -> Vec<Node<()>> {
    let patches = basis.patches.iter().zip(chapters);
    patches
        .map(|(patch, chapter)| {
            let workshop = inputs(basis.design.project).workshop();
            let node = graph.add(&WORKSHOP, &patch.name, workshop, *chapter);
            for (field, key) in [
                ("hardware", "hardware"),
                ("kerf", "fabrication.kerf"),
                ("spacing", "fabrication.spacing"),
                ("grains", "materials"),
            ] {
                graph.origin(node, field, key);
            }
            told.push((patch.name.clone(), node.warnings()));
            node
        })
        .collect()
}

/// What the files of a project depend on, to take a little of it.
pub(super) fn inputs(project: &Project) -> Inputs<'_> {
    Inputs {
        hardware: &project.hardware,
        fabrication: &project.fabrication,
        materials: &project.materials,
    }
}

/// Chapters with the pieces of lamellae that are longer than the stock, where the project allows
/// joints.
fn spliced(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    chapters: Vec<Node<Plan>>,
    told: &mut Told,
) -> Vec<Node<Plan>> {
    let project = basis.design.project;
    let Some(kind) = project.fabrication.splice else {
        return chapters;
    };
    let settings = Settings::new(&project.fabrication);
    let rules = Rules {
        kind,
        bolt: project.hardware.bolt.diameter,
        clearance: project.fabrication.clearance,
        stock: project
            .materials
            .iter()
            .map(|m| splicing::Stock {
                material: m.name.clone(),
                longest: settings.longest(m.grain),
                elastic_modulus: m.elastic_modulus,
                bending_strength: m.bending_strength,
            })
            .collect(),
    };
    let splices = graph.add(&SPLICES, "", rules, chapters.clone());
    for (field, key) in [
        ("kind", "fabrication.splice"),
        ("stock", "fabrication.stock"),
        ("bolt", "hardware.bolt"),
        ("clearance", "fabrication.clearance"),
    ] {
        graph.origin(splices, field, key);
    }
    told.push((String::new(), splices.warnings()));
    basis
        .patches
        .iter()
        .zip(chapters)
        .map(|(patch, chapter)| graph.add(&SPLICED, &patch.name, (), (chapter, splices)))
        .collect()
}
