//! Chapters of the plan, and the plan.

use super::cladding::Cover;
use super::fabrication::Fabricated;
use super::grid::PatchGrid;
use super::layout::{Lines, edges_of};
use super::splitting::Verdict;
use super::{Basis, Told};
use crate::build::stages::plan::{
    CHAPTER, ChapterInput, EdgeInput, PLAN, PlanInput, SKELETON, SkeletonInput,
};
use crate::build::{Graph, Node, Warnings};
use crate::plan::Plan;
use crate::surface::SurfacePoint;
use std::collections::BTreeMap;

/// Declares what the plan says of surface, points and edges.
pub(super) fn skeleton(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    lines: &mut Lines<'_>,
    points: &[(String, Node<SurfacePoint>)],
) -> Node<Plan> {
    let network = basis.network;
    // Each stretch between neighbouring stations that is part of a side is an edge.
    let mut edges: BTreeMap<(usize, usize), EdgeInput> = BTreeMap::new();
    let mut used: Vec<usize> = Vec::new();
    for piece in network.sides.iter().flatten() {
        for (i, j) in piece.segments() {
            let stations = &network.lines[piece.line].stations;
            let position = used
                .iter()
                .position(|&l| l == piece.line)
                .unwrap_or_else(|| {
                    used.push(piece.line);
                    used.len() - 1
                });
            let (mut from, mut to) = (&stations[i], &stations[j]);
            if from.name > to.name {
                (from, to) = (to, from);
            }
            edges.entry((piece.line, i)).or_insert_with(|| EdgeInput {
                from: from.name.clone(),
                to: to.name.clone(),
                line: position as u32,
                shares: [from.share, to.share],
            });
        }
    }
    let line_nodes = used.iter().map(|&index| lines.line(graph, index)).collect();
    let input = SkeletonInput {
        points: points.iter().map(|(name, _)| name.clone()).collect(),
        edges: edges.into_values().collect(),
    };
    let point_nodes = points.iter().map(|(_, node)| *node).collect();
    graph.add(
        &SKELETON,
        "",
        input,
        (basis.surface, basis.curvature, point_nodes, line_nodes),
    )
}

/// Declares all records of a patch.
pub(super) fn chapter(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    index: usize,
    cover: &Cover,
    verdict: &Verdict,
    grid: PatchGrid,
) -> Node<Plan> {
    let patch = &basis.patches[index];
    let name = &patch.name;
    let input = ChapterInput {
        patch: name.clone(),
        corners: patch.corners.clone(),
        sides: edges_of(basis.network, &basis.network.sides[index]),
        material: patch.lamella.material.clone(),
        section: grid.section,
    };
    let [u, v] = grid.members;
    let needs = (
        cover.domain,
        cover.clad,
        verdict.feasibility,
        verdict.judgement,
        u,
        v,
        grid.crossings,
        grid.lamellae,
    );
    let chapter = graph.add(&CHAPTER, name, input, needs);
    graph.origin(chapter, "", basis.origins.patch_key(name));
    graph.origin(chapter, "material", basis.lamella_key(name, "material"));
    chapter
}

/// Declares the plan, of the skeleton, of chapters of strips, and of what is made of the chapters
/// of patches.
pub(super) fn plan(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    skeleton: Node<Plan>,
    strips: Vec<Node<Plan>>,
    made: &Fabricated,
    told: &Told,
) -> Node<Plan> {
    let project = basis.design.project;
    let (subjects, warnings): (Vec<String>, Vec<Warnings>) = told.iter().cloned().unzip();
    let plan = graph.add(
        &PLAN,
        "",
        PlanInput {
            name: project.name.clone(),
            subjects,
            allowed: project.allowed_lints.clone(),
        },
        (
            skeleton,
            made.chapters.iter().copied().chain(strips).collect(),
            made.nest,
            made.foils,
            made.supports,
            made.bill,
            warnings,
        ),
    );
    graph.origin(plan, "name", "project.name");
    graph.origin(plan, "allowed", "lints.allow");
    plan
}
