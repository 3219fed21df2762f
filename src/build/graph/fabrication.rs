//! What a workshop makes of the chapters: joints, sheets, stickers, supports and the bill.

use super::{Basis, Told};
use crate::build::stages::fabrication::{
    BILL, BillInput, DrawingInput, Foils, NEST, NestInput, SPLICED, SPLICES, STICKERS, SUPPORTS,
    SupportInput, WORKSHOP,
};
use crate::build::{Graph, Node};
use crate::fabrication::nesting::{Nest, Settings};
use crate::fabrication::splicing::{self, Rules};
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
    let workshops: Vec<Node<()>> = basis
        .patches
        .iter()
        .zip(&chapters)
        .map(|(patch, chapter)| {
            let workshop = graph.add(&WORKSHOP, &patch.name, drawing_input(project), *chapter);
            told.push((patch.name.clone(), workshop.warnings()));
            workshop
        })
        .collect();
    let nest = graph.add(
        &NEST,
        "",
        NestInput {
            settings: Settings::new(&project.fabrication),
            grains: project
                .materials
                .iter()
                .map(|m| (m.name.clone(), m.grain))
                .collect(),
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

/// What drawings depend on. Prices are left out, so that an edit of one draws nothing again.
pub(super) fn drawing_input(project: &Project) -> DrawingInput {
    let mut fabrication = project.fabrication.clone();
    fabrication.stock.price = None;
    let mut materials = project.materials.clone();
    for material in &mut materials {
        material.price = None;
    }
    DrawingInput {
        name: project.name.clone(),
        hardware: project.hardware.clone(),
        fabrication,
        materials,
    }
}
