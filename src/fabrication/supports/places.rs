//! Where supports stand: corners and crossings on the rim of the structure, or what is listed.
//!
//! The *rim* are the edges that belong to one patch only. Corners where patches meet all around
//! lie inside the structure and get no support unless they are listed.

use super::super::index::PlanIndex;
use super::super::nodes::{Node, nodes};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::plan::{CrossingRecord, MemberRecord, PatchRecord, Plan};
use crate::project::model::{Family, SupportPlaces};
use std::collections::{BTreeMap, BTreeSet};

/// A point of the structure that is to be supported.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place<'a> {
    /// The anchor or crossing.
    pub(super) at: &'a str,
    /// On the surface, metres.
    pub(super) position: [f64; 3],
    /// Unit normal of the surface.
    pub(super) normal: [f64; 3],
    /// Ids of the crossings there.
    pub(super) crossings: Vec<&'a str>,
    /// Thickness of all lamellae there, metres.
    pub(super) stack: f64,
    /// Width of the widest lamella there, metres.
    pub(super) width: f64,
}

/// Places in the order of their ids, and what is wrong with them.
pub(super) fn places<'a>(
    plan: &'a Plan,
    at: &'a SupportPlaces,
    bolt: f64,
) -> (Vec<Place<'a>>, Vec<Diagnostic>) {
    let index = PlanIndex::new(plan);
    let nodes = nodes(&plan.crossings, &index, 0.25 * bolt);
    let rim = Rim::new(plan);
    let mut wanted: Vec<(&str, Option<usize>)> = match at {
        SupportPlaces::Corners => rim
            .corners()
            .into_iter()
            .map(|corner| (corner, None))
            .collect(),
        SupportPlaces::EveryBoundaryCrossing => plan
            .crossings
            .iter()
            .filter(|crossing| rim.has(crossing, &index))
            .map(|crossing| (crossing.id.as_str(), None))
            .collect(),
        SupportPlaces::Listed(ids) => ids
            .iter()
            .enumerate()
            .map(|(i, id)| (id.as_str(), Some(i)))
            .collect(),
    };
    wanted.sort_unstable();
    let mut told = Vec::new();
    let mut taken: BTreeMap<usize, &str> = BTreeMap::new();
    let mut places = Vec::new();
    for (id, listed) in wanted {
        let Some((position, normal)) = point(plan, &index, id) else {
            // The project's check knows all ids; a plan that was edited by hand may not.
            continue;
        };
        let Some(node) = node_at(&nodes, position, bolt) else {
            if let Some(i) = listed {
                told.push(carries_nothing(id, i));
            }
            continue;
        };
        if let Some(first) = taken.get(&node) {
            if let Some(i) = listed {
                told.push(said_twice(id, first, i));
            }
            continue;
        }
        taken.insert(node, id);
        places.push(place(id, position, normal, &nodes[node], &index));
    }
    (places, told)
}

fn place<'a>(
    at: &'a str,
    position: [f64; 3],
    normal: [f64; 3],
    node: &Node<'a>,
    index: &PlanIndex<'_>,
) -> Place<'a> {
    let width = node
        .crossings
        .iter()
        .flat_map(|crossing| [&crossing.u, &crossing.v])
        .filter_map(|member| Some(index.lamella_of(member)?.width))
        .fold(0.0, f64::max);
    Place {
        at,
        position,
        normal,
        crossings: node.crossings.iter().map(|c| c.id.as_str()).collect(),
        stack: node.lamellae_thickness,
        width,
    }
}

/// Place and normal of an anchor or a crossing.
fn point(plan: &Plan, index: &PlanIndex<'_>, id: &str) -> Option<([f64; 3], [f64; 3])> {
    let anchor = plan.points.iter().find(|point| point.id == id);
    anchor
        .map(|point| (point.position, point.normal))
        .or_else(|| {
            let crossing = index.crossing(id)?;
            Some((crossing.position, crossing.normal))
        })
}

fn node_at(nodes: &[Node<'_>], position: [f64; 3], bolt: f64) -> Option<usize> {
    nodes.iter().position(|node| {
        node.crossings
            .iter()
            .any(|crossing| distance(crossing.position, position) <= 0.25 * bolt)
    })
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    libm::sqrt(a.iter().zip(b).map(|(p, q)| (p - q) * (p - q)).sum())
}

/// The edges that belong to one patch only.
struct Rim<'a> {
    plan: &'a Plan,
    /// How many patches an edge belongs to.
    patches: BTreeMap<&'a str, usize>,
    lengths: BTreeMap<&'a str, f64>,
}

impl<'a> Rim<'a> {
    fn new(plan: &'a Plan) -> Self {
        let mut patches: BTreeMap<&str, usize> = BTreeMap::new();
        let sides = plan.patches.iter().flat_map(|patch| &patch.sides);
        for edge in sides.flat_map(|side| &side.edges) {
            *patches.entry(edge).or_default() += 1;
        }
        let lengths = plan.edges.iter().map(|e| (e.id.as_str(), e.length));
        Self {
            plan,
            patches,
            lengths: lengths.collect(),
        }
    }

    fn is_rim(&self, edge: &str) -> bool {
        self.patches.get(edge) == Some(&1)
    }

    /// Corners of patches at which an edge of the rim ends.
    fn corners(&self) -> BTreeSet<&'a str> {
        let ends: BTreeSet<&str> = self
            .plan
            .edges
            .iter()
            .filter(|edge| self.is_rim(&edge.id))
            .flat_map(|edge| [edge.from.as_str(), edge.to.as_str()])
            .collect();
        let corners = self.plan.patches.iter().flat_map(|patch| &patch.corners);
        corners
            .map(String::as_str)
            .filter(|corner| ends.contains(corner))
            .collect()
    }

    /// Whether a crossing lies on the rim.
    fn has(&self, crossing: &CrossingRecord, index: &PlanIndex<'_>) -> bool {
        let on = [
            (&crossing.u, crossing.on_u.surface),
            (&crossing.v, crossing.on_v.surface),
        ];
        on.into_iter().any(|(member, along)| {
            let member = index.member(member).filter(|member| member.boundary);
            let patch =
                member.and_then(|m| self.plan.patches.iter().find(|patch| patch.id == m.patch));
            let (Some(member), Some(patch)) = (member, patch) else {
                return false;
            };
            self.touches(patch, member, along)
        })
    }

    /// Whether a boundary member is on the rim at an arc length: on the edge there, or on either
    /// of the two that meet there.
    fn touches(&self, patch: &PatchRecord, member: &MemberRecord, along: f64) -> bool {
        // Sides run around the patch; members of a family all run the same way.
        let (side, reversed) = match (member.family, member.index) {
            (Family::U, 1) => (3, true),
            (Family::U, _) => (1, false),
            (Family::V, 1) => (0, false),
            (Family::V, _) => (2, true),
        };
        let edges = &patch.sides[side].edges;
        let mut walk: Vec<&str> = edges.iter().map(String::as_str).collect();
        if reversed {
            walk.reverse();
        }
        let slack = 1e-6 * member.length_surface;
        let mut from = 0.0;
        for edge in walk {
            let to = from + self.lengths.get(edge).copied().unwrap_or_default();
            if self.is_rim(edge) && (from - slack..=to + slack).contains(&along) {
                return true;
            }
            from = to;
        }
        false
    }
}

fn carries_nothing(id: &str, listed: usize) -> Diagnostic {
    Diagnostic::error(
        codes::SUPPORT_CARRIES_NOTHING,
        format!("a support at `{id}` carries nothing: no lamellae cross there"),
    )
    .at_key(format!("supports.at[{listed}]"), "nothing to bolt to")
    .help("name a corner of a patch, or a crossing such as `west.u01-v04`")
    .about(id)
}

fn said_twice(id: &str, first: &str, listed: usize) -> Diagnostic {
    Diagnostic::warning(
        codes::SUPPORT_TWICE,
        format!("`{id}` and `{first}` are one place: one support is made"),
    )
    .at_key(format!("supports.at[{listed}]"), "the same place")
    .about(id)
}
