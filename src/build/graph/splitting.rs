//! Whether patches can be covered, and the splitting of those that cannot.

use super::cladding::Cover;
use super::{Basis, Told, key};
use crate::build::passages::count;
use crate::build::stages::cladding::{
    CHECK, CHECKS, CheckInput, FEASIBILITY, FeasibilityInput, JUDGEMENT,
};
use crate::build::stages::splitting::{SPLIT, SplitInput};
use crate::build::unfolding::draft_of;
use crate::build::{Graph, Node};
use crate::project::model::{Family, Patch, Project, Split};
use crate::splitting::{Criteria, Draft, Feasibility, SplitLimits};
use crate::surface::{Curvature, SurfaceMesh};

/// Declares the stage that splits the patches of a project.
pub(super) fn split(
    graph: &mut Graph<'_>,
    project: &Project,
    surface: Node<SurfaceMesh>,
    curvature: Node<Curvature>,
) -> Node<Draft> {
    let draft = draft_of(project);
    let keys: Vec<(String, String)> = draft
        .patches
        .iter()
        .enumerate()
        .map(|(i, p)| (format!("draft.patches[{i}]"), key(&["patches", &p.name])))
        .chain(
            draft
                .points
                .iter()
                .enumerate()
                .map(|(i, p)| (format!("draft.points[{i}]"), key(&["points", &p.name]))),
        )
        .collect();
    let Split {
        workflow,
        eta_max,
        slope,
        min_side,
        max_patches,
        max_side,
    } = project.split;
    let limits = SplitLimits {
        workflow,
        eta_max,
        slope,
        min_side,
        max_patches,
        max_side,
    };
    let node = graph.add(
        &SPLIT,
        "",
        SplitInput { draft, limits },
        (surface, curvature),
    );
    graph.origin(node, "limits", "split");
    for (field, key) in keys {
        graph.origin(node, field, key);
    }
    node
}

/// Whether a patch can be covered.
#[derive(Clone, Copy)]
pub(super) struct Verdict {
    pub(super) feasibility: Node<Feasibility>,
    pub(super) judgement: Node<bool>,
}

/// Declares whether a patch can be covered.
pub(super) fn judge(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    index: usize,
    cover: &Cover,
    told: &mut Told,
) -> Verdict {
    let project = basis.design.project;
    let patch = &basis.patches[index];
    let name = &patch.name;
    let here = basis.origins.patch_key(name);
    let [u, v] = cover.distances;
    let slope = project.split.slope;
    let needs = (basis.surface, basis.curvature, cover.domain, u, v);
    let feasibility = graph.add(&FEASIBILITY, name, FeasibilityInput { slope }, needs);
    graph.origin(feasibility, "", here.clone());
    graph.origin(feasibility, "slope", "split.slope");
    let needs = (feasibility, cover.angles, cover.clad.attempt());
    let judgement = graph.add(&JUDGEMENT, name, criteria(project, patch), needs);
    graph.origin(judgement, "", here.clone());
    graph.origin(judgement, "eta_max", "split.eta_max");
    graph.origin(judgement, "slope", "split.slope");
    told.push((name.clone(), judgement.warnings()));
    Verdict {
        feasibility,
        judgement,
    }
}

/// What a patch is judged by.
fn criteria(project: &Project, patch: &Patch) -> Criteria {
    Criteria {
        eta_max: project.split.eta_max,
        slope: project.split.slope,
        patch: patch.name.clone(),
        corners: patch.corners.clone(),
    }
}

/// Declares the criteria of all patches in one result, for `egg check`.
pub(super) fn checks(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    covers: &[Cover],
    verdicts: &[Verdict],
) {
    let mut nodes = Vec::with_capacity(covers.len());
    for (patch, (cover, verdict)) in basis.patches.iter().zip(covers.iter().zip(verdicts)) {
        let needs = (
            cover.domain.attempt(),
            verdict.feasibility.attempt(),
            cover.angles.attempt(),
            cover.clad.attempt(),
        );
        let input = CheckInput {
            criteria: criteria(basis.design.project, patch),
            members: [Family::U, Family::V].map(|family| count(patch, family)),
        };
        let node = graph.add(&CHECK, &patch.name, input, needs);
        let here = basis.origins.patch_key(&patch.name);
        graph.origin(node, "criteria.eta_max", "split.eta_max");
        graph.origin(node, "criteria.slope", "split.slope");
        graph.origin(node, "", here.clone());
        nodes.push(node);
    }
    graph.add(&CHECKS, "", (), nodes);
}
