//! Nodes: crossings that share one bolt.
//!
//! Where patches meet, each has its own boundary lamella with holes at the same places, so
//! crossings of several patches lie at one point and one bolt goes through all their lamellae.

use super::hardware::{Fastener, Series};
use super::index::PlanIndex;
use crate::plan::{CrossingRecord, OpeningRecord, SupportRecord};
use crate::project::model::Hardware;
use std::collections::BTreeSet;

/// Crossings at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct Node<'a> {
    /// In the plan's order.
    pub crossings: Vec<&'a CrossingRecord>,
    /// Thickness of all lamellae that meet there, metres.
    pub lamellae_thickness: f64,
    /// Crossings with a notch on either lamella: these slide and carry stickers and shells.
    pub sliding: usize,
}

/// What goes through a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fixing {
    /// What holds it together; none if no bolt of the series is long enough.
    pub fastener: Option<Fastener>,
    /// How much is clamped, metres.
    pub stack: f64,
    /// Washers on it.
    pub washers: usize,
    /// Nuts on it: none where the bolt screws into a support.
    pub nuts: usize,
}

impl Node<'_> {
    /// Bolt, washers and nuts of the node.
    pub fn fixing(&self, supports: &[SupportRecord], hardware: &Hardware) -> Fixing {
        let foil = hardware.sticker.as_ref().map_or(0.0, |s| s.thickness);
        let stack = self.lamellae_thickness + 2.0 * foil * self.sliding as f64;
        let support = supports.iter().find(|support| {
            let mut here = self.crossings.iter();
            here.any(|crossing| support.crossings.contains(&crossing.id))
        });
        if let Some(support) = support {
            return Fixing {
                fastener: Some(Fastener::Bolt(support.bolt_length)),
                stack,
                washers: 1,
                nuts: 0,
            };
        }
        let series = Series::of(hardware.bolt.diameter);
        let fastener = series.and_then(|s| s.fastener(stack).ok());
        Fixing {
            fastener,
            stack,
            washers: 2,
            nuts: match fastener {
                Some(Fastener::Rod(_)) => 2,
                _ => 1,
            },
        }
    }
}

/// Groups crossings that are closer than a distance (metres), in the plan's order.
pub fn nodes<'a>(
    crossings: &'a [CrossingRecord],
    index: &PlanIndex<'_>,
    distance: f64,
) -> Vec<Node<'a>> {
    let mut by_x: Vec<usize> = (0..crossings.len()).collect();
    by_x.sort_by(|&a, &b| crossings[a].position[0].total_cmp(&crossings[b].position[0]));
    // Each crossing points to an earlier one of its node, or to itself.
    let mut first: Vec<usize> = (0..crossings.len()).collect();
    for (i, &a) in by_x.iter().enumerate() {
        for &b in &by_x[i + 1..] {
            let gap = |axis: usize| crossings[b].position[axis] - crossings[a].position[axis];
            if gap(0) > distance {
                break;
            }
            if gap(0) * gap(0) + gap(1) * gap(1) + gap(2) * gap(2) <= distance * distance {
                let (a, b) = (root(&first, a), root(&first, b));
                first[a.max(b)] = a.min(b);
            }
        }
    }
    let mut members: Vec<Vec<&CrossingRecord>> = vec![Vec::new(); crossings.len()];
    for (i, crossing) in crossings.iter().enumerate() {
        members[root(&first, i)].push(crossing);
    }
    members
        .into_iter()
        .filter(|crossings| !crossings.is_empty())
        .map(|crossings| node(crossings, index))
        .collect()
}

/// Whether the lamellae of a crossing slide on each other.
pub fn slides(crossing: &CrossingRecord, index: &PlanIndex<'_>) -> bool {
    [&crossing.u, &crossing.v]
        .into_iter()
        .filter_map(|member| index.opening(member, &crossing.id))
        .any(|opening| matches!(opening, OpeningRecord::Notch { .. }))
}

fn root(first: &[usize], mut i: usize) -> usize {
    while first[i] != i {
        i = first[i];
    }
    i
}

fn node<'a>(crossings: Vec<&'a CrossingRecord>, index: &PlanIndex<'_>) -> Node<'a> {
    let members: BTreeSet<&str> = crossings
        .iter()
        .flat_map(|crossing| [crossing.u.as_str(), crossing.v.as_str()])
        .collect();
    let thickness = |member: &str| index.lamella_of(member).map_or(0.0, |l| l.thickness);
    Node {
        lamellae_thickness: members.into_iter().map(thickness).sum(),
        sliding: crossings.iter().filter(|c| slides(c, index)).count(),
        crossings,
    }
}
