//! The graph of a structure: every stage with its inputs and what it needs, in the order in which
//! data passes.
//!
//! | stage | per | reads of the project | needs |
//! |---|---|---|---|
//! | `surface` | structure | `surface`, contents of the mesh file | |
//! | `curvature` | structure | | `surface` |
//! | `split` | structure, with a workflow | `points`, `patches`, `split` | `surface`, `curvature` |
//! | `anchors` | structure | `points` | `surface` |
//! | `anchor` | point | | `anchors` |
//! | `line` | line | | `surface`, the anchors at its ends |
//! | `station` | point on a line | its share | `surface`, `line` |
//! | `patch` | patch | shares of its corners on their lines | `surface`, four `line` |
//! | `network` | structure | names, shares of corners on their lines | `surface`, `line`s, `patch`es |
//! | `sides` | patch | | `patch` |
//! | `distances` | patch and family | | `patch` |
//! | `angles` | patch | `members`, `split.slope`, `lamella.width` | `sides`, `distances` |
//! | `cladding` | patch | the same, `alpha` | `sides`, `distances`, `angles` |
//! | `feasibility` | patch | `split.slope` | `surface`, `curvature`, `patch`, `distances` |
//! | `judgement` | patch | `split`, names for proposals | `feasibility`, `angles`, `cladding` |
//! | `check` | patch, for `egg check` | the same, `members` | `patch`, `feasibility`, `angles`, `cladding` |
//! | `checks` | structure, for `egg check` | | `check` |
//! | `closing` | rings that shall close | `members`, `distribution.weights`, whether `alpha` is given | `patch`, `distances`, `angles`, `cladding` |
//! | `closed-cladding` | patch of such a ring | as `cladding` | `sides`, `distances`, `angles`, `closing` |
//! | `closed-schedule` | such a ring | | `closing` |
//! | `schedule` | strip | `members`, `distribution.weights`, shares of corners | `cladding` |
//! | `strip` | strip | the same | `patch`, `cladding`, `schedule` |
//! | `members` | patch and family | | `strip` |
//! | `strip-chapter` | strip | names | `schedule`, `strip` |
//! | `grid` | patch | | `patch`, `members` |
//! | `lamellae` | patch | `lamella`, density, bolt, shell, clearance, end margin | `members`, `grid` |
//! | `skeleton` | structure | names | `surface`, `curvature`, anchors, lines |
//! | `chapter` | patch | names, material | the patch's results |
//! | `splices` | structure | splice, stock, bed, margins, bolt, clearance, grain, stiffness, strength | chapters |
//! | `spliced` | patch | | `chapter`, `splices` |
//! | `workshop` | patch | hardware, kerf, spacing, grain | `chapter` |
//! | `nest` | structure | stock, bed, margins, kerf, grain | chapters |
//! | `stickers` | structure | `hardware.sticker` | chapters |
//! | `supports` | structure | `supports`, bolt | skeleton, chapters |
//! | `bill` | structure | hardware, materials, prices | chapters, `nest`, `stickers`, `supports` |
//! | `plan` | structure | name | skeleton, chapters, `nest`, `stickers`, `supports`, `bill` |
//! | `*-files` | patch or structure | what the drawings show, and no more | chapters and what is drawn |
//!
//! Patches of rings that shall close have the plans of `closed-cladding`, and the rings the schedules
//! of `closed-schedule`: what needs `cladding` and `schedule` above then has these.
//!
//! `splices` and `spliced` are there where the project asks for joints; what needs chapters then
//! has the spliced ones.
//!
//! One file declares what belongs to one room, in the order of the table: `layout`, `cladding`,
//! `splitting`, `closing`, `members`, `grid`, `plan`, `fabrication`, `files`.
//!
//! Names of points and patches are targets of instances, not inputs, up to judgements and chapters
//! (and of `split`, which makes new ones): a patch that is renamed keeps its geometry. Points and
//! patches are declared by name, so their order in the file does not matter either.

mod cladding;
mod closing;
mod fabrication;
mod files;
mod grid;
mod layout;
mod members;
mod plan;
mod splitting;

pub use super::unfolding::laid_out;

use super::passages::strip_groups;
use super::stages::cladding::CHECKS;
use super::stages::plan::PLAN;
use super::stages::splitting::SPLIT;
use super::stages::surface::{CURVATURE, SURFACE, SurfaceInput};
use super::unfolding::Origins;
use super::{Built, Graph, Node, SourceFile, Warnings};
use crate::diagnostics::{KeyPath, SpanTable};
use crate::layout::Network;
use crate::plan::Plan;
use crate::project::model::{Family, Patch, Point, Project, Workflow};
use crate::splitting::{Draft, PatchCheck};
use crate::surface::{Curvature, ReadOptions, SurfaceMesh, SurfacePoint};
use std::sync::Arc;

/// How far a graph goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Up to the plan: everything that can be wrong with a design.
    Plan,
    /// Up to the plan, with a record of the criteria of every patch.
    Checks,
    /// Up to the files.
    Files,
}

/// What a graph is declared from.
#[derive(Debug, Clone, Copy)]
pub struct Design<'a> {
    /// A checked project.
    pub project: &'a Project,
    /// Where things stand in its file.
    pub spans: &'a SpanTable,
    /// The mesh that it names.
    pub mesh: &'a SourceFile,
}

/// Declares the graph of a design.
///
/// With `split.workflow` the graph unfolds in two steps: what the patches are is the result of the
/// stage `split`, everything after it is declared when that is known.
pub fn declare<'p>(graph: &mut Graph<'p>, design: Design<'p>, extent: Extent) {
    let Design {
        project,
        spans,
        mesh,
    } = design;
    let surface = graph.add(
        &SURFACE,
        "",
        SurfaceInput {
            mesh: mesh.clone(),
            options: ReadOptions::of(&project.surface),
        },
        (),
    );
    graph.origin(surface, "", "surface");
    let curvature = graph.add(&CURVATURE, "", (), surface);
    if project.split.workflow == Workflow::Off {
        let ground = Ground {
            surface,
            curvature,
            origins: Origins::default(),
            split: None,
        };
        structure(graph, design, &ground, extent);
        return;
    }
    let split = splitting::split(graph, project, surface, curvature);
    graph.unfold(split, move |graph, draft| {
        for part in draft.patches.iter().filter(|part| part.name != part.origin) {
            graph.part(&part.name, &part.origin);
        }
        let laid = laid_out(project, draft);
        let design = Design {
            project: &laid,
            spans,
            mesh,
        };
        let ground = Ground {
            surface,
            curvature,
            origins: Origins::of(project, draft),
            split: Some(split.warnings()),
        };
        structure(graph, design, &ground, extent);
    });
}

/// What a structure stands on.
struct Ground {
    surface: Node<SurfaceMesh>,
    curvature: Node<Curvature>,
    origins: Origins,
    /// What the splitting had to say.
    split: Option<Warnings>,
}

/// Whose warnings belong into the plan, and the patch or strip that each is about.
type Told = Vec<(String, Warnings)>;

/// What all parts of a structure are declared from.
struct Basis<'a> {
    design: Design<'a>,
    surface: Node<SurfaceMesh>,
    curvature: Node<Curvature>,
    /// By name.
    patches: &'a [Patch],
    /// Its sides are those of the patches, in their order.
    network: &'a Network,
    origins: &'a Origins,
}

impl Basis<'_> {
    /// Where the project says a lamella's field of a patch: the patch's own, or the common one.
    fn lamella_key(&self, patch: &str, field: &str) -> String {
        let own = key(&["lamella", self.origins.patch(patch), field]);
        if self.design.spans.contains(&own) {
            own
        } else {
            key(&["lamella", field])
        }
    }
}

/// Declares everything after the patches are known.
fn structure(graph: &mut Graph<'_>, design: Design<'_>, ground: &Ground, extent: Extent) {
    let project = design.project;
    let mut points: Vec<Point> = project.points.clone();
    points.sort_by(|a, b| a.name.cmp(&b.name));
    let mut patches: Vec<Patch> = project.patches.clone();
    patches.sort_by(|a, b| a.name.cmp(&b.name));
    let network = Network::new(&points, &patches);
    let basis = &Basis {
        design,
        surface: ground.surface,
        curvature: ground.curvature,
        patches: &patches,
        network: &network,
        origins: &ground.origins,
    };
    let told = &mut vec![(String::new(), ground.surface.warnings())];
    told.extend(ground.split.map(|warnings| (String::new(), warnings)));

    let lines = &mut layout::Lines::declare(graph, basis, &points, told);
    let anchors: Vec<(String, Node<SurfacePoint>)> = points
        .iter()
        .map(|point| (point.name.clone(), lines.point(graph, &point.name)))
        .collect();
    let skeleton = plan::skeleton(graph, basis, lines, &anchors);
    let mut covers = Vec::with_capacity(patches.len());
    let mut verdicts = Vec::with_capacity(patches.len());
    let mut told_of_covers = Vec::with_capacity(patches.len());
    for index in 0..patches.len() {
        let domain = layout::domain(graph, basis, lines, index);
        let mut told = Told::new();
        covers.push(cladding::cover(graph, basis, index, domain, &mut told));
        told_of_covers.push(told);
    }
    let strips = strip_groups(&project.distribution, &patches, &network);
    let closed = closing::close(graph, basis, &strips, &mut covers);
    for (index, of_cover) in told_of_covers.into_iter().enumerate() {
        told.extend(of_cover);
        verdicts.push(splitting::judge(graph, basis, index, &covers[index], told));
    }
    let domains = covers.iter().map(|cover| cover.domain).collect();
    layout::check_neighbours(graph, basis, lines, domains, told);
    let (members, strips) = members::weave(graph, basis, strips, &covers, &closed, told);
    let mut chapters = Vec::with_capacity(patches.len());
    for (index, (cover, verdict)) in covers.iter().zip(&verdicts).enumerate() {
        let members = [Family::U, Family::V].map(|family| members[&(index, family)]);
        let grid = grid::cross(graph, basis, index, cover.domain, members, told);
        chapters.push(plan::chapter(graph, basis, index, cover, verdict, grid));
    }
    let made = fabrication::fabricate(graph, basis, skeleton, chapters, told);
    let plan = plan::plan(graph, basis, skeleton, strips, &made, told);
    match extent {
        Extent::Plan => {}
        Extent::Checks => splitting::checks(graph, basis, &covers, &verdicts),
        Extent::Files => files::publish(graph, basis, skeleton, &made, plan),
    }
}

/// The plan of a finished build.
pub fn plan_of(built: &Built) -> Option<Arc<Plan>> {
    built.output(&PLAN, "")
}

/// The criteria of all patches, by name; `None` if the surface or the project is at fault.
pub fn checks_of(built: &Built) -> Option<Arc<Vec<PatchCheck>>> {
    built.output(&CHECKS, "")
}

/// The points and patches that a project with a workflow is split into.
pub fn split_of(built: &Built) -> Option<Arc<Draft>> {
    built.output(&SPLIT, "")
}

/// A key path of the project.
fn key(parts: &[&str]) -> String {
    KeyPath::of(parts.iter().copied()).into()
}
