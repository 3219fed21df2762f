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
//! | `workshop` | patch | hardware, fabrication, materials | `chapter` |
//! | `nest` | structure | stock, bed, margins, kerf, grain | chapters |
//! | `stickers` | structure | `hardware.sticker` | chapters |
//! | `supports` | structure | `supports`, bolt | skeleton, chapters |
//! | `bill` | structure | hardware, materials, prices | chapters, `nest`, `stickers`, `supports` |
//! | `plan` | structure | name | skeleton, chapters, `nest`, `stickers`, `supports`, `bill` |
//! | `*-files` | patch or structure | what the drawings show | chapters and what is drawn |
//!
//! `splices` and `spliced` are there where the project asks for joints; what needs chapters then
//! has the spliced ones.
//!
//! Names of points and patches are targets of instances, not inputs, up to judgements and chapters
//! (and of `split`, which makes new ones): a patch that is renamed keeps its geometry. Points and
//! patches are declared by name, so their order in
//! the file does not matter either.

use super::passages::{count, family_target, strip_groups};
use super::stages::cladding::{
    ANGLES, AnglesInput, CHECK, CHECKS, CLADDING, CheckInput, CladdingInput, DISTANCES,
    FEASIBILITY, FeasibilityInput, JUDGEMENT, SIDES,
};
use super::stages::fabrication::{
    ABOVE_FILES, BILL, BillInput, CLADDING_FILES, COUPON_FILES, CouponInput, DrawingInput,
    LAYOUT_FILES, NEST, NETWORK_FILES, NestInput, NetworkDrawingInput, PART_FILES, PLAN_FILE,
    SHEET_FILES, SPLICED, SPLICES, STICKER_FILES, STICKERS, SUPPORT_FILES, SUPPORTS, SupportInput,
    TABLE_FILES, WORKSHOP,
};
use super::stages::layout::{
    ANCHOR, ANCHORS, Anchors, LINE, NETWORK, NetworkInput, PATCH, PatchInput, STATION,
};
use super::stages::members::{
    GRID, LAMELLAE, MEMBERS, SCHEDULE, STRIP, STRIP_CHAPTER, StripChapterInput,
};
use super::stages::plan::{
    CHAPTER, ChapterInput, EdgeInput, PLAN, PlanInput, SKELETON, SkeletonInput,
};
use super::stages::splitting::{SPLIT, SplitInput};
use super::stages::surface::{CURVATURE, SURFACE, SurfaceInput};
pub use super::unfolding::laid_out;
use super::unfolding::{Origins, draft_of};
use super::{Built, Graph, Node, SourceFile, Warnings};
use crate::cladding::{AngleChoice, Clad};
use crate::diagnostics::{KeyPath, SpanTable};
use crate::fabrication::NamedQuad;
use crate::fabrication::coupon::{self, CouponSection};
use crate::fabrication::nesting::Settings;
use crate::fabrication::splicing::{self, Rules};
use crate::grid::Section;
use crate::layout::{Domain, Network, Side, SidePiece, edge_id};
use crate::members::Member;
use crate::plan::Plan;
use crate::project::model::{Family, Patch, Point, Project, Split, Workflow};
use crate::splitting::{Criteria, Draft, Feasibility, PatchCheck, SplitLimits};
use crate::surface::{Curvature, ReadOptions, SurfaceMesh, SurfacePoint};
use std::collections::BTreeMap;
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
    let split = split(graph, project, surface, curvature);
    graph.unfold(split, move |graph, draft| {
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

/// The stage that splits the patches of a project.
fn split(
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

/// What a structure stands on.
struct Ground {
    surface: Node<SurfaceMesh>,
    curvature: Node<Curvature>,
    origins: Origins,
    /// What the splitting had to say.
    split: Option<Warnings>,
}

/// Declares everything after the patches are known.
fn structure(graph: &mut Graph<'_>, design: Design<'_>, ground: &Ground, extent: Extent) {
    let project = design.project;
    let &Ground {
        surface,
        curvature,
        ref origins,
        split,
    } = ground;
    let mut points: Vec<Point> = project.points.clone();
    points.sort_by(|a, b| a.name.cmp(&b.name));
    let mut patches: Vec<Patch> = project.patches.clone();
    patches.sort_by(|a, b| a.name.cmp(&b.name));

    let network = Network::new(&points, &patches);
    let mut lines = Lines::declare(graph, surface, &points, &network, origins);
    let nodes: Vec<(String, Node<SurfacePoint>)> = points
        .iter()
        .map(|point| (point.name.clone(), lines.point(graph, &point.name)))
        .collect();
    let told = &mut vec![(String::new(), surface.warnings())];
    told.extend(split.map(|warnings| (String::new(), warnings)));
    told.push((String::new(), lines.anchors.warnings()));
    let skeleton = skeleton(graph, surface, curvature, &network, &mut lines, &nodes);
    let basis = Basis {
        design,
        surface,
        curvature,
        network: &network,
        origins,
    };
    let planned: Vec<PlannedPatch> = patches
        .iter()
        .enumerate()
        .map(|(i, patch)| plan_patch(graph, &basis, &mut lines, patch, i, told))
        .collect();
    let neighbours = check_neighbours(graph, &basis, &mut lines, &patches, &planned);
    told.push((String::new(), neighbours.warnings()));
    let (members, strips) = weave_strips(graph, &basis, &patches, &planned, told);
    let chapters: Vec<Node<Plan>> = patches
        .iter()
        .enumerate()
        .map(|(i, patch)| chapter(graph, &basis, patch, i, &planned[i], &members, told))
        .collect();

    let chapters = spliced(graph, project, &patches, chapters, told);

    let drawing = || drawing_input(project);
    let workshops: Vec<Node<()>> = patches
        .iter()
        .zip(&chapters)
        .map(|(patch, chapter)| {
            let workshop = graph.add(&WORKSHOP, &patch.name, drawing(), *chapter);
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
            asked: design.spans.contains("supports"),
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
            chapters.iter().copied().chain(strips).collect(),
            nest,
            foils,
            supports,
            bill,
            warnings,
        ),
    );
    graph.origin(plan, "name", "project.name");
    graph.origin(plan, "allowed", "lints.allow");
    match extent {
        Extent::Plan => return,
        Extent::Checks => {
            checks(graph, &basis, &patches, &planned);
            return;
        }
        Extent::Files => {}
    }

    let plan_file = graph.add(&PLAN_FILE, "", (), plan);
    graph.publish(plan_file);
    for (patch, chapter) in patches.iter().zip(&chapters) {
        let plot = graph.add(&CLADDING_FILES, &patch.name, (), *chapter);
        graph.publish(plot);
        let flat = graph.add(&LAYOUT_FILES, &patch.name, drawing(), *chapter);
        drawing_origins(graph, flat);
        graph.publish(flat);
        let parts = graph.add(&PART_FILES, &patch.name, drawing(), *chapter);
        drawing_origins(graph, parts);
        graph.publish(parts);
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
        (skeleton, chapters.clone()),
    );
    graph.origin(above, "", "project.name");
    graph.publish(above);
    let names = NetworkDrawingInput {
        name: project.name.clone(),
        patches: patches
            .iter()
            .zip(&network.sides)
            .map(|(patch, sides)| {
                NamedQuad::new(&patch.name, &patch.corners, edges_of(&network, sides))
            })
            .collect(),
    };
    let drawn = graph.add(&NETWORK_FILES, "", names, skeleton);
    graph.origin(drawn, "name", "project.name");
    graph.publish(drawn);
    let sheets = graph.add(&SHEET_FILES, "", drawing(), (chapters.clone(), nest));
    drawing_origins(graph, sheets);
    graph.publish(sheets);
    let stickers = graph.add(&STICKER_FILES, "", drawing(), foils);
    drawing_origins(graph, stickers);
    graph.publish(stickers);
    let needs = (skeleton, chapters, supports);
    let feet = graph.add(&SUPPORT_FILES, "", drawing(), needs);
    drawing_origins(graph, feet);
    graph.publish(feet);
    let tables = graph.add(&TABLE_FILES, "", drawing(), plan);
    drawing_origins(graph, tables);
    graph.publish(tables);
}

/// What drawings depend on. Prices are left out, so that an edit of one draws nothing again.
fn drawing_input(project: &Project) -> DrawingInput {
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

/// Chapters with the pieces of lamellae that are longer than the stock, where the project allows
/// joints.
fn spliced(
    graph: &mut Graph<'_>,
    project: &Project,
    patches: &[Patch],
    chapters: Vec<Node<Plan>>,
    told: &mut Vec<(String, Warnings)>,
) -> Vec<Node<Plan>> {
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
    patches
        .iter()
        .zip(chapters)
        .map(|(patch, chapter)| graph.add(&SPLICED, &patch.name, (), (chapter, splices)))
        .collect()
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

fn drawing_origins(graph: &mut Graph<'_>, node: Node<super::Files>) {
    graph.origin(node, "name", "project.name");
    graph.origin(node, "hardware", "hardware");
    graph.origin(node, "fabrication", "fabrication");
}

/// Lines and points, declared when they are first asked for: a line needs its ends, and an end may
/// stand on another line.
struct Lines<'n> {
    origins: &'n Origins,
    surface: Node<SurfaceMesh>,
    anchors: Node<Anchors>,
    network: &'n Network,
    points: BTreeMap<String, Node<SurfacePoint>>,
    declared: BTreeMap<usize, Node<Side>>,
}

impl<'n> Lines<'n> {
    fn declare(
        graph: &mut Graph<'_>,
        surface: Node<SurfaceMesh>,
        points: &[Point],
        network: &'n Network,
        origins: &'n Origins,
    ) -> Self {
        let list = points
            .iter()
            .map(|p| (p.name.clone(), p.anchor.clone()))
            .collect();
        let anchors = graph.add(&ANCHORS, "", list, surface);
        for (i, point) in points.iter().enumerate() {
            graph.origin(anchors, format!("[{i}]"), origins.point_key(&point.name));
        }
        Self {
            origins,
            surface,
            anchors,
            network,
            points: BTreeMap::new(),
            declared: BTreeMap::new(),
        }
    }

    /// An anchor, by name.
    fn point(&mut self, graph: &mut Graph<'_>, name: &str) -> Node<SurfacePoint> {
        if let Some(node) = self.points.get(name) {
            return *node;
        }
        // A station strictly inside a line stands on it; the ends of a line have a place of
        // their own, or stand on another line.
        let host = self
            .network
            .lines
            .iter()
            .enumerate()
            .find_map(|(index, line)| {
                let last = line.stations.len() - 1;
                let station = line.stations[1..last].iter().find(|s| s.name == name)?;
                Some((index, station.share))
            });
        let node = match host {
            Some((index, share)) => {
                let line = self.line(graph, index);
                let node = graph.add(&STATION, name, share, (self.surface, line));
                graph.origin(node, "", self.origins.point_key(name));
                node
            }
            None => graph.add(&ANCHOR, name, name.to_owned(), self.anchors),
        };
        self.points.insert(name.to_owned(), node);
        node
    }

    /// A line, by its index in the network.
    fn line(&mut self, graph: &mut Graph<'_>, index: usize) -> Node<Side> {
        if let Some(node) = self.declared.get(&index) {
            return *node;
        }
        let network = self.network;
        let line = &network.lines[index];
        let ends = line.ends().map(|name| self.point(graph, name));
        let node = graph.add(&LINE, line.id(), (), (self.surface, ends[0], ends[1]));
        graph.origin(node, "", self.origins.point_key(line.ends()[0]));
        for (field, name) in ["from", "to"].into_iter().zip(line.ends()) {
            graph.name(node, field, name);
        }
        self.declared.insert(index, node);
        node
    }
}

fn skeleton(
    graph: &mut Graph<'_>,
    surface: Node<SurfaceMesh>,
    curvature: Node<Curvature>,
    network: &Network,
    lines: &mut Lines<'_>,
    points: &[(String, Node<SurfacePoint>)],
) -> Node<Plan> {
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
        (surface, curvature, point_nodes, line_nodes),
    )
}

/// What all patches share.
struct Basis<'a> {
    design: Design<'a>,
    surface: Node<SurfaceMesh>,
    curvature: Node<Curvature>,
    network: &'a Network,
    origins: &'a Origins,
}

/// A patch up to its plan.
struct PlannedPatch {
    domain: Node<Domain>,
    clad: Node<Clad>,
    feasibility: Node<Feasibility>,
    judgement: Node<bool>,
    angles: Node<AngleChoice>,
}

fn plan_patch(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    lines: &mut Lines<'_>,
    patch: &Patch,
    index: usize,
    told: &mut Vec<(String, Warnings)>,
) -> PlannedPatch {
    let Basis {
        design,
        surface,
        curvature,
        network,
        origins,
    } = *basis;
    let project = design.project;
    let name = &patch.name;
    let here = origins.patch_key(name);
    let pieces = network.sides[index];
    let corners = pieces
        .map(|piece| [piece.from, piece.to].map(|i| network.lines[piece.line].stations[i].share));
    let [first, second, third, fourth] = pieces.map(|piece| lines.line(graph, piece.line));
    let needs = (surface, (first, second, third, fourth));
    let domain = graph.add(&PATCH, name, PatchInput { corners }, needs);
    graph.origin(domain, "", &here);
    graph.origin(domain, "corners", format!("{here}.corners"));
    graph.name(domain, "", name);
    for (i, corner) in patch.corners.iter().enumerate() {
        graph.name(domain, format!("corners[{i}]"), corner);
    }

    let sides = graph.add(&SIDES, name, (), domain);
    let [u, v] = [Family::U, Family::V].map(|family| {
        let node = graph.add(&DISTANCES, family_target(name, family), family, domain);
        graph.origin(node, "", &here);
        told.push((name.clone(), node.warnings()));
        node
    });
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
    graph.origin(clad, "", &here);
    for (field, key) in [
        ("slope", "split.slope".to_owned()),
        ("width", lamella_key(basis, name, "width")),
    ] {
        graph.origin(angles, field, &key);
        graph.origin(clad, field, key);
    }
    graph.origin(angles, "members", format!("{here}.members"));

    let needs = (surface, curvature, domain, u, v);
    let feasibility = graph.add(&FEASIBILITY, name, FeasibilityInput { slope }, needs);
    graph.origin(feasibility, "", &here);
    graph.origin(feasibility, "slope", "split.slope");
    let needs = (feasibility, angles, clad.attempt());
    let judgement = graph.add(&JUDGEMENT, name, criteria(project, patch), needs);
    graph.origin(judgement, "", &here);
    graph.origin(judgement, "eta_max", "split.eta_max");
    graph.origin(judgement, "slope", "split.slope");
    told.push((name.clone(), judgement.warnings()));
    PlannedPatch {
        domain,
        clad,
        feasibility,
        judgement,
        angles,
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

/// The criteria of all patches in one result, for `egg check`.
fn checks(graph: &mut Graph<'_>, basis: &Basis<'_>, patches: &[Patch], planned: &[PlannedPatch]) {
    let mut nodes = Vec::with_capacity(patches.len());
    for (patch, plan) in patches.iter().zip(planned) {
        let needs = (
            plan.domain.attempt(),
            plan.feasibility.attempt(),
            plan.angles.attempt(),
            plan.clad.attempt(),
        );
        let input = CheckInput {
            criteria: criteria(basis.design.project, patch),
            members: [Family::U, Family::V].map(|family| count(patch, family)),
        };
        let node = graph.add(&CHECK, &patch.name, input, needs);
        let here = basis.origins.patch_key(&patch.name);
        graph.origin(node, "criteria.eta_max", "split.eta_max");
        graph.origin(node, "criteria.slope", "split.slope");
        graph.origin(node, "", &here);
        nodes.push(node);
    }
    graph.add(&CHECKS, "", (), nodes);
}

/// The check of all patches together.
fn check_neighbours(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    lines: &mut Lines<'_>,
    patches: &[Patch],
    planned: &[PlannedPatch],
) -> Node<()> {
    let network = basis.network;
    let input = NetworkInput {
        network: network.clone(),
        patches: patches
            .iter()
            .map(|patch| (patch.name.clone(), patch.corners.clone()))
            .collect(),
    };
    let sides = (0..network.lines.len())
        .map(|index| lines.line(graph, index))
        .collect();
    let domains = planned.iter().map(|patch| patch.domain).collect();
    let node = graph.add(&NETWORK, "", input, (basis.surface, sides, domains));
    for (i, patch) in patches.iter().enumerate() {
        let here = basis.origins.patch_key(&patch.name);
        graph.origin(node, format!("patches[{i}]"), here);
    }
    node
}

type MembersOf = BTreeMap<(usize, Family), Node<Vec<Member>>>;

/// Members of all strips, and of each family of each patch out of them.
fn weave_strips(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    patches: &[Patch],
    planned: &[PlannedPatch],
    told: &mut Vec<(String, Warnings)>,
) -> (MembersOf, Vec<Node<Plan>>) {
    let mut members = MembersOf::new();
    let mut chapters = Vec::new();
    let distribution = &basis.design.project.distribution;
    for group in strip_groups(distribution, patches, basis.network) {
        let patches_in = || group.passages.iter().map(|&(patch, _)| &planned[patch]);
        let clads: Vec<Node<Clad>> = patches_in().map(|p| p.clad).collect();
        let domains = patches_in().map(|p| p.domain).collect();
        let schedule = graph.add(&SCHEDULE, &group.name, group.input.clone(), clads.clone());
        let needs = (domains, clads, schedule);
        let closed = group.input.closed;
        let strip = graph.add(&STRIP, &group.name, group.input, needs);
        told.push((group.name.clone(), strip.warnings()));
        let families = group.passages.iter();
        let families = families.map(|&(patch, family)| family_target(&patches[patch].name, family));
        let input = StripChapterInput {
            families: families.collect(),
            closed,
        };
        chapters.push(graph.add(&STRIP_CHAPTER, &group.name, input, (schedule, strip)));
        for (i, &(patch, family)) in group.passages.iter().enumerate() {
            let name = &patches[patch].name;
            let here = basis.origins.patch_key(name);
            strip_origins(graph, schedule, i, &here);
            strip_origins(graph, strip, i, &here);
            let node = graph.add(&MEMBERS, family_target(name, family), i as u32, strip);
            members.insert((patch, family), node);
        }
    }
    (members, chapters)
}

/// Where the fields of a passage come from.
fn strip_origins<T>(graph: &mut Graph<'_>, node: Node<T>, passage: usize, patch: &str) {
    let field = format!("passages[{passage}]");
    graph.origin(node, format!("{field}.count"), format!("{patch}.members"));
    graph.origin(node, format!("{field}.weights"), "distribution.weights");
    graph.origin(node, field, patch);
}

fn chapter(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    patch: &Patch,
    index: usize,
    planned: &PlannedPatch,
    members: &MembersOf,
    told: &mut Vec<(String, Warnings)>,
) -> Node<Plan> {
    let Basis {
        design, network, ..
    } = *basis;
    let name = &patch.name;
    let here = basis.origins.patch_key(name);
    let PlannedPatch {
        domain,
        clad,
        feasibility,
        judgement,
        angles: _,
    } = *planned;
    let [u, v] = [Family::U, Family::V].map(|family| members[&(index, family)]);
    let grid = graph.add(&GRID, name, (), (domain, u, v));
    graph.origin(grid, "", &here);
    let section = section(design.project, patch);
    let lamellae = graph.add(&LAMELLAE, name, section.clone(), (u, v, grid));
    graph.origin(lamellae, "", &here);
    for field in ["width", "thickness"] {
        graph.origin(lamellae, field, lamella_key(basis, name, field));
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

    let input = ChapterInput {
        patch: name.clone(),
        corners: patch.corners.clone(),
        sides: edges_of(network, &network.sides[index]),
        material: patch.lamella.material.clone(),
        section,
    };
    let needs = (domain, clad, feasibility, judgement, u, v, grid, lamellae);
    let chapter = graph.add(&CHAPTER, name, input, needs);
    graph.origin(chapter, "", &here);
    graph.origin(chapter, "material", lamella_key(basis, name, "material"));
    chapter
}

/// Ids of the edges of the sides of a patch, in the order of travel.
fn edges_of(network: &Network, sides: &[SidePiece; 4]) -> [Vec<String>; 4] {
    sides.map(|piece| {
        let stations = &network.lines[piece.line].stations;
        piece
            .segments()
            .map(|(i, j)| edge_id(&stations[i].name, &stations[j].name))
            .collect()
    })
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

/// Where the project says a lamella's field of a patch: the patch's own, or the common one.
fn lamella_key(basis: &Basis<'_>, patch: &str, field: &str) -> String {
    let own = key(&["lamella", basis.origins.patch(patch), field]);
    if basis.design.spans.contains(&own) {
        own
    } else {
        key(&["lamella", field])
    }
}

/// A key path of the project.
fn key(parts: &[&str]) -> String {
    KeyPath::of(parts.iter().copied()).into()
}
