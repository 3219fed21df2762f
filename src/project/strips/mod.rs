//! Strips: families of members that run on from patch to patch across shared sides.
//!
//! A pure function of names, so that the checks of the project file and the layout agree on what
//! is chained. A u-member runs from side 1-2 to side 4-3, so the u-family lies on those two
//! sides and the v-family on the other two. Where two patches name the same two anchors, the
//! families on that side are one strip and have one count.
//!
//! A T-junction (an anchor `on` a side) joins strips without making their counts equal: every
//! member of a part runs on into the long side's patch, and two neighbouring parts share the
//! member at the anchor between them (paper, section 4.3). So where parts fill the long side,
//! `n_long - 1 = sum of (n_part - 1)`. See [`Junction`].

mod lines;
#[cfg(test)]
mod tests;

use super::model::{Anchor, Family, Project};
use std::collections::BTreeMap;

/// What strips depend on: corners and anchors on edges, by name.
#[derive(Debug, Clone, Default)]
pub struct Network<'a> {
    /// Corners of each patch, in order around it.
    pub patches: Vec<[&'a str; 4]>,
    /// Anchors that lie on a geodesic between two others; without cycles.
    pub on_edges: Vec<OnEdge<'a>>,
}

/// An anchor on an edge.
#[derive(Debug, Clone, Copy)]
pub struct OnEdge<'a> {
    /// The anchor.
    pub point: &'a str,
    /// The two anchors between which it lies.
    pub edge: [&'a str; 2],
    /// Share of the edge's length from the first, strictly between 0 and 1.
    pub at: f64,
}

/// One family of one patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Passage {
    /// Index into [`Network::patches`].
    pub patch: usize,
    /// Which family.
    pub family: Family,
}

/// One side of one patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// Index into [`Network::patches`].
    pub patch: usize,
    /// 0 for side 1-2, 1 for 2-3, 2 for 3-4, 3 for 4-1.
    pub number: usize,
}

impl Side {
    /// The family whose members start or end on this side.
    pub fn passage(self) -> Passage {
        let family = if self.number.is_multiple_of(2) {
            Family::U
        } else {
            Family::V
        };
        Passage {
            patch: self.patch,
            family,
        }
    }

    /// The two anchors of this side, in the patch's order.
    pub fn ends<'a>(self, network: &Network<'a>) -> [&'a str; 2] {
        let corners = &network.patches[self.patch];
        [corners[self.number], corners[(self.number + 1) % 4]]
    }

    fn opposite(self) -> Self {
        Self {
            patch: self.patch,
            number: (self.number + 2) % 4,
        }
    }
}

/// A chain of passages across shared sides; all have the same number of members.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Strip {
    /// From one end to the other; of a ring, once around from its first patch.
    pub passages: Vec<Passage>,
    /// Whether the last passage borders on the first.
    pub ring: bool,
}

/// A side that is one patch's as a whole and other patches' in parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Junction {
    /// The whole side.
    pub long: Side,
    /// Its parts, from the first corner of the long side to the second.
    pub parts: Vec<Side>,
    /// Whether the parts leave no gap; only then do the counts of the parts give the long one's.
    pub complete: bool,
}

/// Sides of more than two patches along one stretch: nothing on a surface can look like that.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Crowd {
    /// The sides, at least three.
    pub sides: Vec<Side>,
}

/// All strips of a network.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Strips {
    /// In the order of their first patches.
    pub strips: Vec<Strip>,
    /// T-junctions, in the order of the long sides.
    pub junctions: Vec<Junction>,
    /// Impossible neighbourhoods; strips do not run across them.
    pub crowds: Vec<Crowd>,
    index: BTreeMap<Passage, usize>,
}

impl Strips {
    /// The strip that a family of a patch belongs to, an index into [`Strips::strips`].
    pub fn of(&self, passage: Passage) -> Option<usize> {
        self.index.get(&passage).copied()
    }

    /// Strips that T-junctions connect, as sorted lists of indices: their members depend on each
    /// other.
    pub fn groups(&self) -> Vec<Vec<usize>> {
        let mut group: Vec<usize> = (0..self.strips.len()).collect();
        for junction in &self.junctions {
            for part in &junction.parts {
                let pair = (self.of(junction.long.passage()), self.of(part.passage()));
                if let (Some(long), Some(part)) = pair {
                    let (low, high) = (group[long].min(group[part]), group[long].max(group[part]));
                    for member in group.iter_mut().filter(|member| **member == high) {
                        *member = low;
                    }
                }
            }
        }
        let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (strip, group) in group.into_iter().enumerate() {
            groups.entry(group).or_default().push(strip);
        }
        groups.into_values().collect()
    }
}

impl<'a> Network<'a> {
    /// The network of a checked project.
    pub fn of(project: &'a Project) -> Self {
        let patches = project
            .patches
            .iter()
            .map(|patch| patch.corners.each_ref().map(String::as_str))
            .collect();
        let on_edges = project
            .points
            .iter()
            .filter_map(|point| match &point.anchor {
                Anchor::On { edge, at } => Some(OnEdge {
                    point: &point.name,
                    edge: edge.each_ref().map(String::as_str),
                    at: *at,
                }),
                _ => None,
            });
        Self {
            patches,
            on_edges: on_edges.collect(),
        }
    }

    /// Chains families into strips.
    pub fn strips(&self) -> Strips {
        let sides: Vec<Side> = (0..self.patches.len())
            .flat_map(|patch| (0..4).map(move |number| Side { patch, number }))
            .collect();
        let mut by_edge: BTreeMap<[&str; 2], Vec<Side>> = BTreeMap::new();
        for &side in &sides {
            by_edge
                .entry(sorted(side.ends(self)))
                .or_default()
                .push(side);
        }
        let (junctions, crowds) = self.lines(&by_edge);
        let mut neighbour: BTreeMap<Side, Side> = BTreeMap::new();
        for sides in by_edge.values() {
            if let [first, second] = sides[..] {
                neighbour.insert(first, second);
                neighbour.insert(second, first);
            }
        }
        let mut strips = Vec::new();
        let mut index = BTreeMap::new();
        // Where each family starts: u on side 1-2, v on side 4-1.
        for side in sides.iter().filter(|side| matches!(side.number, 0 | 3)) {
            if !index.contains_key(&side.passage()) {
                let strip = walk(*side, &neighbour);
                for passage in &strip.passages {
                    index.insert(*passage, strips.len());
                }
                strips.push(strip);
            }
        }
        Strips {
            strips,
            junctions,
            crowds,
            index,
        }
    }
}

/// The strip through a side: back to its start, then along it.
fn walk(side: Side, neighbour: &BTreeMap<Side, Side>) -> Strip {
    // `start` is the side by which the first passage is entered.
    let mut start = side;
    let mut ring = false;
    while let Some(before) = neighbour.get(&start) {
        start = before.opposite();
        if start.passage() == side.passage() {
            ring = true;
            start = side;
            break;
        }
    }
    let mut passages = vec![start.passage()];
    let mut entered = start;
    while let Some(&next) = neighbour.get(&entered.opposite()) {
        if next.passage() == start.passage() {
            break;
        }
        passages.push(next.passage());
        entered = next;
    }
    Strip { passages, ring }
}

/// An edge without direction.
pub(crate) fn sorted(edge: [&str; 2]) -> [&str; 2] {
    if edge[0] <= edge[1] {
        edge
    } else {
        [edge[1], edge[0]]
    }
}
