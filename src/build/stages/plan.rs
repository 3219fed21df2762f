//! Chapters of the plan, and the plan.

use super::fabrication::{Foils, equip};
use super::plain;
use crate::build::{Node, Numerics, Stage, Warnings};
use crate::cladding::Clad;
use crate::diagnostics::without_allowed;
use crate::fabrication::nesting::Nest;
use crate::grid::{Crossing, Lamella, Section};
use crate::layout::{Domain, Side};
use crate::members::Member;
use crate::plan::{
    BomRow, DiagnosticRecord, EdgePiece, PatchNames, PatchResults, Plan, SupportRecord, bind,
    patch_chapter, skeleton_chapter,
};
use crate::splitting::Feasibility;
use crate::surface::{Curvature, SurfaceMesh, SurfacePoint};
use serde::Serialize;

/// Names of the skeleton, in the order of the nodes that carry them.
#[derive(Debug, Serialize)]
pub(in crate::build) struct SkeletonInput {
    pub(in crate::build) points: Vec<String>,
    pub(in crate::build) edges: Vec<EdgeInput>,
}

/// An edge of the plan: a piece of a line.
#[derive(Debug, Serialize)]
pub(in crate::build) struct EdgeInput {
    pub(in crate::build) from: String,
    pub(in crate::build) to: String,
    /// Index into the lines that the stage receives.
    pub(in crate::build) line: u32,
    pub(in crate::build) shares: [f64; 2],
}

type SkeletonNeeds = (
    Node<SurfaceMesh>,
    Node<Curvature>,
    Vec<Node<SurfacePoint>>,
    Vec<Node<Side>>,
);

/// Surface, points and edges.
pub(in crate::build) const SKELETON: Stage<SkeletonInput, SkeletonNeeds, Plan> = Stage {
    name: "skeleton",
    version: 4,
    numerics: Numerics::Portable,
    run: |input, (surface, curvature, points, lines), _| {
        let points = input
            .points
            .iter()
            .map(String::as_str)
            .zip(points.into_iter().copied());
        let edges = input.edges.iter().filter_map(|edge| {
            Some(EdgePiece {
                from: &edge.from,
                to: &edge.to,
                line: lines.get(edge.line as usize)?,
                shares: edge.shares,
            })
        });
        plain(skeleton_chapter(&surface.mesh, curvature, points, edges))
    },
};

/// What a patch and its parts are called and made of.
#[derive(Debug, Serialize)]
pub(in crate::build) struct ChapterInput {
    pub(in crate::build) patch: String,
    pub(in crate::build) corners: [String; 4],
    pub(in crate::build) sides: [Vec<String>; 4],
    pub(in crate::build) material: String,
    pub(in crate::build) section: Section,
}

type ChapterNeeds = (
    Node<Domain>,
    Node<Clad>,
    Node<Feasibility>,
    Node<bool>,
    Node<Vec<Member>>,
    Node<Vec<Member>>,
    Node<Vec<Crossing>>,
    Node<Vec<Lamella>>,
);

/// All records of a patch.
pub(in crate::build) const CHAPTER: Stage<ChapterInput, ChapterNeeds, Plan> = Stage {
    name: "chapter",
    version: 3,
    numerics: Numerics::Portable,
    run: |input, (domain, clad, feasibility, feasible, u, v, crossings, lamellae), _| {
        let names = PatchNames {
            patch: &input.patch,
            corners: &input.corners,
            sides: &input.sides,
            material: &input.material,
        };
        let results = PatchResults {
            domain,
            clad,
            feasibility,
            feasible: *feasible,
            u,
            v,
            crossings,
            lamellae,
        };
        plain(patch_chapter(&names, &results, &input.section))
    },
};

/// What the plan itself is called, and whom each list of diagnostics is about.
#[derive(Debug, Serialize)]
pub(in crate::build) struct PlanInput {
    pub(in crate::build) name: String,
    pub(in crate::build) subjects: Vec<String>,
    /// Names of lints that are not told.
    pub(in crate::build) allowed: Vec<String>,
}

type PlanNeeds = (
    Node<Plan>,
    Vec<Node<Plan>>,
    Node<Nest>,
    Node<Foils>,
    Node<Vec<SupportRecord>>,
    Node<Vec<BomRow>>,
    Vec<Warnings>,
);

/// The plan.
pub(in crate::build) const PLAN: Stage<PlanInput, PlanNeeds, Plan> = Stage {
    name: "plan",
    version: 3,
    numerics: Numerics::Portable,
    run: |input, (skeleton, chapters, nest, foils, supports, bill, warnings), _| {
        let all = std::iter::once(skeleton).chain(chapters);
        let mut plan = bind(&input.name, all);
        plan.sheets.clone_from(&nest.sheets);
        equip(&mut plan, foils, supports);
        plan.nesting = nest.records();
        plan.bill_of_materials.clone_from(bill);
        for (subject, told) in input.subjects.iter().zip(warnings) {
            let told = without_allowed(told.to_vec(), &input.allowed);
            plan.diagnostics.extend(told.iter().map(|diagnostic| {
                let mut record = DiagnosticRecord::from(diagnostic);
                if record.subject.is_none() && !subject.is_empty() {
                    record.subject = Some(subject.clone());
                }
                record
            }));
        }
        plain(plan)
    },
};
