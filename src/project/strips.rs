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

    /// Every line (a side, or an edge that carries anchors) with what lies along it.
    fn lines(&self, by_edge: &BTreeMap<[&'a str; 2], Vec<Side>>) -> (Vec<Junction>, Vec<Crowd>) {
        let mut carried: BTreeMap<[&str; 2], Vec<&OnEdge<'_>>> = BTreeMap::new();
        let mut partners: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for anchor in &self.on_edges {
            let edge = sorted(anchor.edge);
            let anchors = carried.entry(edge).or_default();
            anchors.push(anchor);
            if anchors.len() == 1 {
                partners.entry(edge[0]).or_default().push(edge[1]);
                partners.entry(edge[1]).or_default().push(edge[0]);
            }
        }
        let mut at_point: BTreeMap<&str, Vec<Side>> = BTreeMap::new();
        for side in by_edge.values().flatten() {
            at_point.entry(side.ends(self)[0]).or_default().push(*side);
        }
        let mut junctions = Vec::new();
        let mut crowds = Vec::new();
        let plain = by_edge.keys().filter(|edge| !carried.contains_key(*edge));
        for line in carried.keys().chain(plain) {
            let shares = positions(line, &carried, &partners);
            let mut along: Vec<Stretch> = shares
                .keys()
                .filter_map(|point| at_point.get(point))
                .flatten()
                .filter_map(|&side| Stretch::of(side, side.ends(self), &shares))
                .collect();
            along.sort_by(|a, b| a.from.total_cmp(&b.from).then(a.side.cmp(&b.side)));
            if let Some(crowd) = crowd(&along) {
                crowds.push(crowd);
                continue;
            }
            let whole = |stretch: &Stretch| stretch.from == 0.0 && stretch.to == 1.0;
            let (long, parts): (Vec<Stretch>, Vec<Stretch>) = along.into_iter().partition(whole);
            if let ([long], [_, ..]) = (long.as_slice(), parts.as_slice()) {
                junctions.push(self.junction(long.side, *line, &parts));
            }
        }
        junctions.sort_by_key(|junction| junction.long);
        crowds.sort();
        crowds.dedup();
        (junctions, crowds)
    }

    fn junction(&self, long: Side, line: [&str; 2], parts: &[Stretch]) -> Junction {
        let meet = parts.windows(2).all(|pair| pair[0].to == pair[1].from);
        let ends = (parts.first().map(|p| p.from), parts.last().map(|p| p.to));
        let mut sides: Vec<Side> = parts.iter().map(|part| part.side).collect();
        if long.ends(self)[0] != line[0] {
            sides.reverse();
        }
        Junction {
            long,
            parts: sides,
            complete: meet && ends == (Some(0.0), Some(1.0)),
        }
    }
}

/// The stretch of a line that a side covers, as shares of the line.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    from: f64,
    to: f64,
    side: Side,
}

impl Stretch {
    fn of(side: Side, ends: [&str; 2], shares: &BTreeMap<&str, f64>) -> Option<Self> {
        let (a, b) = (*shares.get(ends[0])?, *shares.get(ends[1])?);
        Some(Self {
            from: a.min(b),
            to: a.max(b),
            side,
        })
    }
}

/// Shares of all anchors that lie on a line, directly or on a part of it.
fn positions<'a>(
    line: &[&'a str; 2],
    carried: &BTreeMap<[&'a str; 2], Vec<&OnEdge<'a>>>,
    partners: &BTreeMap<&'a str, Vec<&'a str>>,
) -> BTreeMap<&'a str, f64> {
    let mut shares = BTreeMap::from([(line[0], 0.0), (line[1], 1.0)]);
    let mut fresh = vec![line[0], line[1]];
    while let Some(point) = fresh.pop() {
        for &partner in partners.get(point).into_iter().flatten() {
            let Some(&far) = shares.get(partner) else {
                continue;
            };
            let near = shares[point];
            for anchor in &carried[&sorted([point, partner])] {
                let (start, end) = if anchor.edge[0] == point {
                    (near, far)
                } else {
                    (far, near)
                };
                if !shares.contains_key(anchor.point) {
                    shares.insert(anchor.point, start + anchor.at * (end - start));
                    fresh.push(anchor.point);
                }
            }
        }
    }
    shares
}

/// Three or more sides over one stretch of a line, if there are any; `along` is sorted.
fn crowd(along: &[Stretch]) -> Option<Crowd> {
    let mut open: Vec<Stretch> = Vec::new();
    for stretch in along {
        open.retain(|other| other.to > stretch.from);
        open.push(*stretch);
        if open.len() > 2 {
            let mut sides: Vec<Side> = open.iter().map(|stretch| stretch.side).collect();
            sides.sort();
            return Some(Crowd { sides });
        }
    }
    None
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

#[cfg(test)]
mod tests {
    use super::*;

    fn show(strips: &Strips) -> Vec<String> {
        let passage = |p: &Passage| {
            format!(
                "{}{}",
                p.patch,
                if p.family == Family::U { "u" } else { "v" }
            )
        };
        strips
            .strips
            .iter()
            .map(|strip| {
                let chain: Vec<_> = strip.passages.iter().map(passage).collect();
                format!(
                    "{}{}",
                    chain.join(" "),
                    if strip.ring { " ring" } else { "" }
                )
            })
            .collect()
    }

    #[test]
    fn families_chain_across_a_shared_side_in_any_orientation() {
        // Two quads side by side; the second starts anywhere and may turn the other way round.
        let east = ["b", "c", "f", "e"];
        for turn in 0..4 {
            for mirrored in [false, true] {
                let mut corners = east;
                corners.rotate_left(turn);
                if mirrored {
                    corners.reverse();
                }
                let network = Network {
                    patches: vec![["a", "b", "e", "d"], corners],
                    on_edges: vec![],
                };
                let strips = network.strips();
                let shared = (0..4)
                    .map(|number| Side { patch: 1, number })
                    .find(|side| sorted(side.ends(&network)) == ["b", "e"])
                    .expect("both have the side b-e");
                let west = Passage {
                    patch: 0,
                    family: Family::V,
                };
                assert_eq!(strips.of(west), strips.of(shared.passage()));
                assert_eq!(strips.strips.len(), 3);
            }
        }
    }

    #[test]
    fn a_closed_chain_is_a_ring() {
        // Four patches around a drum: bottom a b c d, top e f g h.
        let network = Network {
            patches: vec![
                ["a", "b", "f", "e"],
                ["b", "c", "g", "f"],
                ["c", "d", "h", "g"],
                ["d", "a", "e", "h"],
            ],
            on_edges: vec![],
        };
        let strips = network.strips();
        assert_eq!(show(&strips), ["0u", "0v 1v 2v 3v ring", "1u", "2u", "3u"]);
    }

    #[test]
    fn a_strip_is_listed_from_end_to_end_wherever_it_is_met_first() {
        let network = Network {
            patches: vec![
                ["b", "c", "g", "f"],
                ["a", "b", "f", "e"],
                ["c", "d", "h", "g"],
            ],
            on_edges: vec![],
        };
        let strips = network.strips();
        let chain = &strips.strips[strips
            .of(Passage {
                patch: 0,
                family: Family::V,
            })
            .expect("in a strip")];
        let patches: Vec<_> = chain.passages.iter().map(|passage| passage.patch).collect();
        assert!(patches == [1, 0, 2] || patches == [2, 0, 1], "{patches:?}");
        assert!(!chain.ring);
    }

    fn tee(on_edges: Vec<OnEdge<'static>>) -> Network<'static> {
        // Patch 0 has the long side a-b; 1 and 2 stand on its two parts.
        Network {
            patches: vec![
                ["d", "c", "b", "a"],
                ["a", "t", "q", "p"],
                ["t", "b", "r", "q"],
            ],
            on_edges,
        }
    }

    #[test]
    fn parts_of_a_long_side_make_a_junction_in_the_order_of_the_long_side() {
        let network = tee(vec![OnEdge {
            point: "t",
            edge: ["b", "a"],
            at: 0.25,
        }]);
        let strips = network.strips();
        assert_eq!(show(&strips), ["0u", "0v", "1u", "1v 2v", "2u"]);
        // Side 3-4 of patch 0 runs from b to a, so the part at b comes first.
        assert_eq!(
            strips.junctions,
            [Junction {
                long: Side {
                    patch: 0,
                    number: 2
                },
                parts: vec![
                    Side {
                        patch: 2,
                        number: 0
                    },
                    Side {
                        patch: 1,
                        number: 0
                    }
                ],
                complete: true,
            }]
        );
        assert_eq!(strips.groups(), [vec![0, 2, 4], vec![1], vec![3]]);
        assert_eq!(tee(vec![]).strips().junctions, []);
    }

    #[test]
    fn an_anchor_on_a_part_lies_on_the_whole_and_a_gap_leaves_the_junction_incomplete() {
        let mut network = tee(vec![
            OnEdge {
                point: "s",
                edge: ["a", "b"],
                at: 0.5,
            },
            OnEdge {
                point: "t",
                edge: ["s", "b"],
                at: 0.5,
            },
        ]);
        assert!(network.strips().junctions[0].complete);
        network.patches.pop();
        let junctions = network.strips().junctions;
        assert_eq!(junctions.len(), 1);
        assert!(!junctions[0].complete);
    }

    #[test]
    fn three_sides_over_one_stretch_are_a_crowd_even_if_they_only_overlap() {
        let mut network = tee(vec![OnEdge {
            point: "t",
            edge: ["a", "b"],
            at: 0.5,
        }]);
        assert_eq!(network.strips().crowds, []);
        network.patches.push(["a", "b", "y", "x"]);
        assert_eq!(
            network.strips().crowds,
            [Crowd {
                sides: vec![
                    Side {
                        patch: 0,
                        number: 2
                    },
                    Side {
                        patch: 1,
                        number: 0
                    },
                    Side {
                        patch: 3,
                        number: 0
                    },
                ],
            }]
        );
    }
}
