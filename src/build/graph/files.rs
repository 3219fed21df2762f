//! The files of a build: the plan, drawings and tables.

use super::Basis;
use super::fabrication::{Fabricated, drawing_input};
use super::layout::edges_of;
use crate::build::stages::fabrication::{
    ABOVE_FILES, CLADDING_FILES, COUPON_FILES, CouponInput, DrawingInput, LAYOUT_FILES,
    NETWORK_FILES, NetworkDrawingInput, PART_FILES, PLAN_FILE, SHEET_FILES, STICKER_FILES,
    SUPPORT_FILES, TABLE_FILES,
};
use crate::build::{Files, Graph, Needs, Node, Stage};
use crate::fabrication::NamedQuad;
use crate::fabrication::coupon::{self, CouponSection};
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
    let plan_file = graph.add(&PLAN_FILE, "", (), plan);
    graph.publish(plan_file);
    for (patch, chapter) in basis.patches.iter().zip(&made.chapters) {
        let plot = graph.add(&CLADDING_FILES, &patch.name, (), *chapter);
        graph.publish(plot);
        draw(graph, &LAYOUT_FILES, &patch.name, project, *chapter);
        draw(graph, &PART_FILES, &patch.name, project, *chapter);
    }
    let coupon = graph.add(&COUPON_FILES, "", coupon(project), ());
    graph.origin(coupon, "sections", "lamella");
    graph.origin(coupon, "hardware", "hardware");
    graph.origin(coupon, "fabrication", "fabrication");
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
    let needs = (made.chapters.clone(), made.nest);
    draw(graph, &SHEET_FILES, "", project, needs);
    draw(graph, &STICKER_FILES, "", project, made.foils);
    let needs = (skeleton, made.chapters.clone(), made.supports);
    draw(graph, &SUPPORT_FILES, "", project, needs);
    draw(graph, &TABLE_FILES, "", project, plan);
}

/// Declares drawings that depend on the settings of the workshop.
fn draw<N: Needs>(
    graph: &mut Graph<'_>,
    stage: &'static Stage<DrawingInput, N, Files>,
    target: &str,
    project: &Project,
    needs: N,
) {
    let node = graph.add(stage, target, drawing_input(project), needs);
    graph.origin(node, "name", "project.name");
    graph.origin(node, "hardware", "hardware");
    graph.origin(node, "fabrication", "fabrication");
    graph.publish(node);
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
        fabrication: project.fabrication.clone(),
    }
}
