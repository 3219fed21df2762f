//! The files of a build: the plan, drawings and tables.

use super::Basis;
use super::fabrication::{Fabricated, inputs};
use super::layout::edges_of;
use crate::build::stages::fabrication::{
    ABOVE_FILES, CLADDING_FILES, COUPON_FILES, CouponInput, DrawingInput, LAYOUT_FILES,
    LayoutInput, NETWORK_FILES, NetworkDrawingInput, PART_FILES, PLAN_FILE, PartInput, SHEET_FILES,
    STICKER_FILES, SUPPORT_FILES, SheetInput, TABLE_FILES, TableInput,
};
use crate::build::{Files, Graph, Node};
use crate::fabrication::coupon::{self, CouponSection};
use crate::fabrication::{NamedQuad, Woods};
use crate::plan::Plan;
use crate::project::model::Project;

/// Declares all files.
pub(super) fn publish(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    skeleton: Node<Plan>,
    made: &Fabricated,
    plan: Node<Plan>,
) {
    let project = basis.design.project;
    let inputs = inputs(project);
    let colours = project.fabrication.colours;
    let plan_file = graph.add(&PLAN_FILE, "", (), plan);
    graph.publish(plan_file);
    for (patch, chapter) in basis.patches.iter().zip(&made.chapters) {
        let plot = graph.add(&CLADDING_FILES, &patch.name, (), *chapter);
        graph.publish(plot);
        let input = LayoutInput {
            name: project.name.clone(),
            bolt_diameter: project.hardware.bolt.diameter,
        };
        let flat = graph.add(&LAYOUT_FILES, &patch.name, input, *chapter);
        graph.origin(flat, "name", "project.name");
        graph.origin(flat, "bolt_diameter", "hardware.bolt");
        graph.publish(flat);
        let input = PartInput {
            style: inputs.part_style(),
            colours,
        };
        let parts = graph.add(&PART_FILES, &patch.name, input, *chapter);
        part_origins(graph, parts, "style");
        graph.origin(parts, "colours", "fabrication.colours");
        graph.publish(parts);
    }
    let coupon = graph.add(&COUPON_FILES, "", coupon(project), ());
    graph.origin(coupon, "sections", "lamella");
    graph.origin(coupon, "hardware", "hardware");
    graph.origin(coupon, "colours", "fabrication.colours");
    graph.publish(coupon);
    let above = graph.add(
        &ABOVE_FILES,
        "",
        project.name.clone(),
        (skeleton, made.chapters.clone()),
    );
    graph.origin(above, "", "project.name");
    graph.publish(above);
    let names = NetworkDrawingInput {
        name: project.name.clone(),
        patches: basis
            .patches
            .iter()
            .zip(&basis.network.sides)
            .map(|(patch, sides)| {
                let sides = edges_of(basis.network, sides);
                NamedQuad::new(&patch.name, &patch.corners, sides)
            })
            .collect(),
    };
    let drawn = graph.add(&NETWORK_FILES, "", names, skeleton);
    graph.origin(drawn, "name", "project.name");
    graph.publish(drawn);
    let input = SheetInput {
        name: project.name.clone(),
        settings: inputs.sheets(),
    };
    let needs = (made.chapters.clone(), made.nest);
    let sheets = graph.add(&SHEET_FILES, "", input, needs);
    graph.origin(sheets, "name", "project.name");
    part_origins(graph, sheets, "settings.parts");
    graph.origin(sheets, "settings.colours", "fabrication.colours");
    graph.origin(sheets, "settings.margin", "fabrication.margin");
    graph.origin(sheets, "settings.grains", "materials");
    graph.publish(sheets);
    let stickers = graph.add(&STICKER_FILES, "", drawing_input(project), made.foils);
    let needs = (skeleton, made.chapters.clone(), made.supports);
    let supports = graph.add(&SUPPORT_FILES, "", drawing_input(project), needs);
    for node in [stickers, supports] {
        graph.origin(node, "name", "project.name");
        graph.origin(node, "colours", "fabrication.colours");
        graph.publish(node);
    }
    let input = TableInput {
        hardware: project.hardware.clone(),
        woods: Woods::new(&project.materials),
    };
    let tables = graph.add(&TABLE_FILES, "", input, plan);
    graph.origin(tables, "hardware", "hardware");
    graph.origin(tables, "woods", "materials");
    graph.publish(tables);
}

/// Where the looks of parts come from, below a field of an input.
fn part_origins(graph: &mut Graph<'_>, node: Node<Files>, style: &str) {
    for (field, key) in [
        ("kerf", "fabrication.kerf"),
        ("label_height", "fabrication.label_height"),
        ("sticker_margin", "hardware.sticker"),
    ] {
        graph.origin(node, format!("{style}.{field}"), key);
    }
}

/// What test pieces a project needs.
fn coupon(project: &Project) -> CouponInput {
    let mut sections: Vec<CouponSection> = project
        .patches
        .iter()
        .map(|patch| CouponSection {
            material: patch.lamella.material.clone(),
            thickness: patch.lamella.thickness,
        })
        .collect();
    coupon::sort(&mut sections);
    CouponInput {
        sections,
        hardware: project.hardware.clone(),
        colours: project.fabrication.colours,
    }
}

/// What drawings of foils and supports depend on.
fn drawing_input(project: &Project) -> DrawingInput {
    DrawingInput {
        name: project.name.clone(),
        colours: project.fabrication.colours,
    }
}
