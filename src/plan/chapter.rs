//! From results of stages to records: the chapters of a plan.
//!
//! A chapter is a plan that holds the records of one patch only, or of the skeleton of points and
//! edges only. Drawings of a patch are made from its chapter, so they change only with it; the
//! whole plan is its chapters put together and sorted by id.

use super::document::{
    Cladding, CladdingFunction, CrossingRecord, Diagonals, EdgeRecord, Eta, LamellaRecord,
    MemberRecord, OpeningRecord, PatchCurvature, PatchRecord, Plan, PointRecord, Positions, Range,
    RingRecord, SideRecord, StripRecord, SurfaceRecord,
};
use crate::cladding::{Clad, CladdingFunction as Function};
use crate::grid::{Crossing, Lamella, Opening, Section};
use crate::layout::{Domain, Side};
use crate::members::schedule::Schedule;
use crate::members::{Drift, Member, crossing_label, id_in, member_label};
use crate::splitting::Feasibility;
use crate::surface::{Curvature, Mesh, Point3, SurfacePoint};

/// The results that the chapter of a patch is made of.
#[derive(Debug, Clone, Copy)]
pub struct PatchResults<'a> {
    /// Mesh and sides.
    pub domain: &'a Domain,
    /// The flat patch and its cladding functions.
    pub clad: &'a Clad,
    /// Curvature, coverage, diagonals.
    pub feasibility: &'a Feasibility,
    /// Whether every check of the patch passed.
    pub feasible: bool,
    /// Members of the u-family.
    pub u: &'a [Member],
    /// Members of the v-family.
    pub v: &'a [Member],
    /// Where they cross.
    pub crossings: &'a [Crossing],
    /// What is cut, u-family first.
    pub lamellae: &'a [Lamella],
}

/// The names that a patch and its parts go by.
#[derive(Debug, Clone, Copy)]
pub struct PatchNames<'a> {
    /// Of the patch.
    pub patch: &'a str,
    /// Of its corners.
    pub corners: &'a [String; 4],
    /// Ids of the edges of the sides 1-2, 2-3, 3-4, 4-1, in the order of travel.
    pub sides: &'a [Vec<String>; 4],
    /// Of the material.
    pub material: &'a str,
}

/// The chapter of a patch.
pub fn patch_chapter(
    names: &PatchNames<'_>,
    results: &PatchResults<'_>,
    section: &Section,
) -> Plan {
    let mesh = results.domain.mesh();
    let members: Vec<MemberRecord> = results
        .u
        .iter()
        .chain(results.v)
        .map(|m| member_record(names.patch, mesh, m))
        .collect();
    Plan {
        patches: vec![patch_record(names, results)],
        crossings: results
            .crossings
            .iter()
            .map(|c| crossing_record(names.patch, mesh, c))
            .collect(),
        lamellae: results
            .lamellae
            .iter()
            .map(|l| lamella_record(names, l, section))
            .collect(),
        members,
        ..Plan::default()
    }
}

fn patch_record(names: &PatchNames<'_>, results: &PatchResults<'_>) -> PatchRecord {
    let PatchResults {
        domain,
        clad,
        feasibility,
        ..
    } = *results;
    let lengths = domain.lengths().to_array();
    let [e, f] = feasibility.diagonals;
    let [e_planar, f_planar] = clad.quad.diagonals();
    let [eta_u, eta_v] = feasibility.eta();
    let longest_member = results
        .u
        .iter()
        .chain(results.v)
        .map(Member::length_surface);
    PatchRecord {
        id: names.patch.to_owned(),
        corners: names.corners.clone(),
        sides: std::array::from_fn(|i| SideRecord {
            edges: names.sides[i].clone(),
            length: lengths[i],
        }),
        alpha_surface: domain.angle_at_a().unwrap_or(f64::NAN).to_degrees(),
        alpha_planar: clad.alpha.to_degrees(),
        planar_corners: clad.quad.corners.map(|p| [p.x, p.y]),
        diagonals: Diagonals {
            e,
            f,
            e_planar,
            f_planar,
        },
        eta: Eta { u: eta_u, v: eta_v },
        curvature: PatchCurvature {
            max: feasibility.curvature_max,
            peak: xyz(feasibility.peak),
            injectivity_bound: feasibility.injectivity_bound(),
            longest_geodesic: longest_member.fold(e.max(f), f64::max),
        },
        cladding: Cladding {
            u: cladding_function(&clad.u),
            v: cladding_function(&clad.v),
        },
        feasible: results.feasible,
    }
}

fn cladding_function(function: &Function) -> CladdingFunction {
    let [slope_min, slope_max] = function.slope_range();
    CladdingFunction {
        samples: function.samples().collect(),
        slope_min,
        slope_max,
    }
}

fn member_record(patch: &str, mesh: &Mesh, member: &Member) -> MemberRecord {
    MemberRecord {
        id: id_in(patch, &member_label(member.family, member.index)),
        patch: patch.to_owned(),
        family: member.family,
        index: member.index + 1,
        start: member.start,
        end: member.end,
        boundary: member.boundary,
        length_surface: member.length_surface(),
        length_planar: member.length_planar(),
        polyline: member.path.polyline(mesh).into_iter().map(xyz).collect(),
        planar: member.planar.map(|p| [p.x, p.y]),
    }
}

fn crossing_record(patch: &str, mesh: &Mesh, crossing: &Crossing) -> CrossingRecord {
    use crate::project::model::Family;
    let positions = |p: crate::grid::Positions| Positions {
        surface: p.surface,
        planar: p.planar,
    };
    CrossingRecord {
        id: id_in(patch, &crossing_label(crossing.u, crossing.v)),
        u: id_in(patch, &member_label(Family::U, crossing.u)),
        v: id_in(patch, &member_label(Family::V, crossing.v)),
        position: xyz(crossing.point.position(mesh)),
        normal: crossing.point.normal(mesh).into(),
        planar: [crossing.planar.x, crossing.planar.y],
        on_u: positions(crossing.on_u),
        on_v: positions(crossing.on_v),
        angle_surface: crossing.angle_surface.to_degrees(),
        angle_planar: crossing.angle_planar.to_degrees(),
    }
}

fn lamella_record(names: &PatchNames<'_>, lamella: &Lamella, section: &Section) -> LamellaRecord {
    let id = id_in(names.patch, &member_label(lamella.family, lamella.index));
    LamellaRecord {
        member: id.clone(),
        id,
        material: names.material.to_owned(),
        length: lamella.length,
        end_margin: section.end_margin,
        width: section.width,
        thickness: section.thickness,
        mass: lamella.mass,
        pieces: Vec::new(),
        openings: lamella
            .openings
            .iter()
            .map(|o| opening_record(names.patch, o))
            .collect(),
    }
}

fn opening_record(patch: &str, opening: &Opening) -> OpeningRecord {
    let crossing = id_in(patch, &opening.label());
    let Opening {
        from,
        to,
        diameter,
        notch,
        ..
    } = *opening;
    if notch {
        OpeningRecord::Notch {
            from,
            to,
            diameter,
            crossing,
        }
    } else {
        OpeningRecord::Hole {
            at: from,
            diameter,
            crossing,
        }
    }
}

/// A piece of a line that is an edge of the plan.
#[derive(Debug, Clone, Copy)]
pub struct EdgePiece<'a> {
    /// Name of the anchor where it begins.
    pub from: &'a str,
    /// Name of the anchor where it ends.
    pub to: &'a str,
    /// The line.
    pub line: &'a Side,
    /// Shares of the line at which it begins and ends.
    pub shares: [f64; 2],
}

/// The chapter of the surface, the points and the edges.
pub fn skeleton_chapter<'a>(
    mesh: &Mesh,
    curvature: &Curvature,
    points: impl Iterator<Item = (&'a str, SurfacePoint)>,
    edges: impl Iterator<Item = EdgePiece<'a>>,
) -> Plan {
    let [min, max] = curvature.gaussian_range(mesh);
    let (low, high) = mesh.bounding_box();
    Plan {
        surface: SurfaceRecord {
            vertices: mesh.positions().len() as u32,
            faces: mesh.faces().len() as u32,
            area: mesh.area(),
            bounding_box: [xyz(low), xyz(high)],
            gaussian_curvature: Range { min, max },
        },
        points: points
            .map(|(id, point)| PointRecord {
                id: id.to_owned(),
                position: xyz(point.position(mesh)),
                normal: point.normal(mesh).into(),
            })
            .collect(),
        edges: edges.map(|edge| edge_record(mesh, &edge)).collect(),
        ..Plan::default()
    }
}

fn edge_record(mesh: &Mesh, edge: &EdgePiece<'_>) -> EdgeRecord {
    let piece = edge.line.piece(mesh, edge.shares[0], edge.shares[1]);
    EdgeRecord {
        id: crate::layout::edge_id(edge.from, edge.to),
        from: edge.from.to_owned(),
        to: edge.to.to_owned(),
        length: piece.length(),
        polyline: piece.path().polyline(mesh).into_iter().map(xyz).collect(),
    }
}

/// What a strip consists of.
#[derive(Debug, Clone, Copy)]
pub struct StripNames<'a> {
    /// Its families: `west.v`.
    pub families: &'a [String],
    /// Whether it was asked to close.
    pub closed: bool,
}

/// The chapter of a strip.
pub fn strip_chapter(names: &StripNames<'_>, schedule: &Schedule, drift: Option<Drift>) -> Plan {
    let mut families = names.families.to_vec();
    families.sort_unstable();
    Plan {
        strips: vec![StripRecord {
            id: families.first().cloned().unwrap_or_default(),
            families,
            evenness_gained: schedule.evenness_gained,
            ring: drift.map(|drift| RingRecord {
                closed: names.closed,
                drift: drift.metres,
            }),
        }],
        ..Plan::default()
    }
}

/// Puts chapters together; records are sorted by id.
pub fn bind<'a>(name: &str, chapters: impl Iterator<Item = &'a Plan>) -> Plan {
    let mut plan = Plan {
        name: name.to_owned(),
        ..Plan::default()
    };
    for chapter in chapters {
        if chapter.surface.faces > 0 {
            plan.surface = chapter.surface.clone();
        }
        plan.points.extend_from_slice(&chapter.points);
        plan.edges.extend_from_slice(&chapter.edges);
        plan.patches.extend_from_slice(&chapter.patches);
        plan.strips.extend_from_slice(&chapter.strips);
        plan.members.extend_from_slice(&chapter.members);
        plan.crossings.extend_from_slice(&chapter.crossings);
        plan.lamellae.extend_from_slice(&chapter.lamellae);
    }
    plan.points.sort_by(|a, b| a.id.cmp(&b.id));
    plan.edges.sort_by(|a, b| a.id.cmp(&b.id));
    plan.patches.sort_by(|a, b| a.id.cmp(&b.id));
    plan.strips.sort_by(|a, b| a.id.cmp(&b.id));
    plan.members.sort_by(|a, b| a.id.cmp(&b.id));
    plan.crossings.sort_by(|a, b| a.id.cmp(&b.id));
    plan.lamellae.sort_by(|a, b| a.id.cmp(&b.id));
    plan
}

fn xyz(point: Point3) -> [f64; 3] {
    point.coords.into()
}
