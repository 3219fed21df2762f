//! Cuts of a draft: where they end, what the parts are called, how they share the members.
//!
//! A cut ends on sides. The anchors there stand `on` these sides, so a neighbour across a side
//! stays whole: its side gets a T-junction. Where a neighbour has been cut close by already, the
//! same anchor serves both.
//!
//! Members are counted in *spaces*: those between the members of a family, shared by the parts of a
//! patch. A cut takes the place of a member, so counts along shared sides go on to agree.

use super::Proposal;
use super::draft::{Draft, DraftPatch};
use crate::layout::{Network, SidePiece};
use crate::project::model::{Anchor, Family, Point};
use serde::{Deserialize, Serialize};

/// What a cut has to keep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rules {
    /// Shortest side, metres.
    pub(super) min_side: f64,
    /// Most patches.
    pub(super) max_patches: usize,
    /// Decimals of a metre in the coordinates of new anchors.
    pub(super) decimals: usize,
    /// Whether cuts near the middle of a side are made in the middle.
    pub(super) centre: bool,
}

/// Why a patch is not cut.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Refusal {
    /// A family has too few members to share.
    Members(Family),
    /// The parts would have sides shorter than the limit, metres.
    MinSide(f64),
    /// There would be more patches than allowed.
    MaxPatches(usize),
    /// The parts would be no quadrilaterals.
    Folded,
    /// What stands against it is nothing that a cut changes.
    NoHelp,
    /// Members through the corners of its parts would not go on in order in its neighbours.
    Order(Family),
}

/// A cut nearer to the middle than this share of a side is made in the middle: symmetric patches
/// have symmetric parts, whatever the triangles.
const MIDDLE: f64 = 0.04;
/// An anchor nearer than this share of the side serves two cuts.
const SNAP: f64 = 0.12;
/// Where the project gives no least length, no part of a side is shorter than this share of it.
const LEAST_SHARE: f64 = 0.12;
/// Names grow by a digit with every cut; what they begin with is kept short enough.
const STEM: usize = 24;

/// An end of a cut: a side of a patch and a place on it.
struct Foot {
    name: String,
    /// The anchor to add, unless one that is there serves.
    anchor: Option<Anchor>,
    share: f64,
}

impl Draft {
    /// Cuts a patch; `lengths` are those of the sides AB, BC, DC, AD.
    pub(super) fn cut(
        &mut self,
        patch: usize,
        proposal: &Proposal,
        lengths: [f64; 4],
        rules: &Rules,
    ) -> Result<(), Refusal> {
        let parts = match proposal {
            Proposal::Edge { .. } => 2,
            Proposal::Corner { .. } => 4,
        };
        if self.patches.len() - 1 + parts > rules.max_patches {
            return Err(Refusal::MaxPatches(rules.max_patches));
        }
        let network = self.network();
        let foot =
            |side: usize, share: f64| self.foot(&network, patch, side, share, lengths, rules);
        let old = self.patches[patch].clone();
        let [a, b, c, d] = old.corners.clone();
        let spaces =
            |family: usize, feet: [(usize, &Foot); 2]| self.spaces(&network, patch, family, feet);
        let (quads, anchors): (Vec<([String; 4], [u32; 2])>, Vec<Point>) = match *proposal {
            Proposal::Edge {
                along: Family::U,
                from,
                to,
            } => {
                let (p, q) = (foot(0, from)?, foot(2, to)?);
                let [k, rest] = spaces(0, [(0, &p), (2, &q)])?;
                let [_, v] = old.members;
                let quads = vec![
                    ([a, p.name.clone(), q.name.clone(), d], [k + 1, v]),
                    ([p.name.clone(), b, c, q.name.clone()], [rest + 1, v]),
                ];
                (quads, points([p, q]))
            }
            Proposal::Edge {
                along: Family::V,
                from,
                to,
            } => {
                let (p, q) = (foot(3, from)?, foot(1, to)?);
                let [k, rest] = spaces(1, [(3, &p), (1, &q)])?;
                let [u, _] = old.members;
                let quads = vec![
                    ([a, b, q.name.clone(), p.name.clone()], [u, k + 1]),
                    ([p.name.clone(), q.name.clone(), c, d], [u, rest + 1]),
                ];
                (quads, points([p, q]))
            }
            Proposal::Corner { at, shares } => {
                let [ab, bc] = [foot(0, shares[0])?, foot(1, shares[1])?];
                let [dc, ad] = [foot(2, shares[2])?, foot(3, shares[3])?];
                let [ku, rest_u] = spaces(0, [(0, &ab), (2, &dc)])?;
                let [kv, rest_v] = spaces(1, [(3, &ad), (1, &bc)])?;
                let m = self.new_name(&format!("{}-peak", stem(&old.name)));
                let [p, q, r, s] = [&ab, &bc, &dc, &ad].map(|foot| foot.name.clone());
                let quads = vec![
                    ([a, p.clone(), m.clone(), s.clone()], [ku + 1, kv + 1]),
                    ([p, b, q.clone(), m.clone()], [rest_u + 1, kv + 1]),
                    ([m.clone(), q, c, r.clone()], [rest_u + 1, rest_v + 1]),
                    ([s, m.clone(), r, d], [ku + 1, rest_v + 1]),
                ];
                let mut anchors = points([ab, bc, dc, ad]);
                anchors.push(Point {
                    name: m,
                    anchor: Anchor::Near([at.x, at.y, at.z].map(|x| rounded(x, rules.decimals))),
                });
                (quads, anchors)
            }
        };
        self.points.extend(anchors);
        let parts = quads
            .into_iter()
            .enumerate()
            .map(|(i, (corners, members))| DraftPatch {
                name: self.free_name(&part_name(&old, i)),
                origin: old.origin.clone(),
                corners,
                members,
                alpha: None,
                width: old.width,
            });
        let parts: Vec<DraftPatch> = parts.collect();
        self.patches.splice(patch..=patch, parts);
        Ok(())
    }

    /// The anchor for an end of a cut: one that stands close by, or a new one.
    fn foot(
        &self,
        network: &Network,
        patch: usize,
        side: usize,
        share: f64,
        lengths: [f64; 4],
        rules: &Rules,
    ) -> Result<Foot, Refusal> {
        let least = (rules.min_side / lengths[side]).max(LEAST_SHARE);
        if least > 0.5 {
            return Err(Refusal::MinSide(rules.min_side));
        }
        let mut share = share.clamp(least, 1.0 - least);
        if rules.centre && (share - 0.5).abs() < MIDDLE {
            share = 0.5;
        }
        // From the middle, so that mirror images are rounded to mirror images.
        let share = rounded(0.5 + ((share - 0.5) * 1000.0).round() / 1000.0, 3);
        let near = stations(network, patch, side)
            .into_iter()
            .filter(|(_, at)| (at - share).abs() < SNAP && *at >= least && *at <= 1.0 - least)
            .min_by(|(_, a), (_, b)| (a - share).abs().total_cmp(&(b - share).abs()));
        if let Some((name, at)) = near {
            return Ok(Foot {
                name,
                anchor: None,
                share: at,
            });
        }
        let old = &self.patches[patch];
        let (i, j) = ENDS[side];
        let number = ["12", "23", "34", "41"][side];
        Ok(Foot {
            name: self.new_name(&format!("{}-s{number}", stem(&old.name))),
            anchor: Some(Anchor::On {
                edge: [old.corners[i].clone(), old.corners[j].clone()],
                at: share,
            }),
            share,
        })
    }

    /// How a cut between two feet shares the spaces of a family. Neighbours that are cut at or
    /// between the same anchors have their say.
    fn spaces(
        &self,
        network: &Network,
        patch: usize,
        family: usize,
        feet: [(usize, &Foot); 2],
    ) -> Result<[u32; 2], Refusal> {
        let which = [Family::U, Family::V][family];
        let total = self.patches[patch].members[family] - 1;
        let (mut low, mut high) = (1, total.saturating_sub(1));
        for (side, foot) in feet {
            for (name, at) in stations(network, patch, side) {
                let Some(spaces) = self.spaces_beyond(network, patch, side, at) else {
                    continue;
                };
                if name == foot.name {
                    (low, high) = (low.max(spaces), high.min(spaces));
                } else if at < foot.share {
                    low = low.max(spaces + 1);
                } else {
                    high = high.min(spaces.saturating_sub(1));
                }
            }
        }
        if total < 2 {
            return Err(Refusal::Members(which));
        }
        if low > high {
            return Err(Refusal::Order(which));
        }
        let mean = 0.5 * (feet[0].1.share + feet[1].1.share);
        let wanted = (mean * f64::from(total)).round() as u32;
        let first = wanted.clamp(low, high);
        Ok([first, total - first])
    }

    /// Spaces of the patches across a side from its beginning up to a share; `None` if they do not
    /// fill that stretch, or not with as many spaces as the side has in all.
    fn spaces_beyond(
        &self,
        network: &Network,
        patch: usize,
        side: usize,
        until: f64,
    ) -> Option<u32> {
        let here = directed(network, patch, side);
        let own = self.patches[patch].members[side % 2] - 1;
        let mut pieces: Vec<([f64; 2], u32)> = Vec::new();
        for (other, draft) in self.patches.iter().enumerate() {
            for number in (0..4).filter(|_| other != patch) {
                let there = directed(network, other, number);
                if there.line != here.line {
                    continue;
                }
                let [mut from, mut to] = there
                    .shares
                    .map(|s| (s - here.shares[0]) / (here.shares[1] - here.shares[0]));
                if from > to {
                    (from, to) = (to, from);
                }
                if from > -EXACT && to < 1.0 + EXACT {
                    pieces.push(([from, to], draft.members[number % 2] - 1));
                }
            }
        }
        pieces.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        let (mut at, mut spaces, mut found) = (0.0, 0, None);
        for ([from, to], part) in pieces {
            if (from - at).abs() > EXACT {
                return None;
            }
            at = to;
            spaces += part;
            if (at - until).abs() < EXACT {
                found = Some(spaces);
            }
        }
        found.filter(|_| (at - 1.0).abs() < EXACT && spaces == own)
    }
}

/// Shares of a line closer than this are one place.
const EXACT: f64 = 1e-9;

/// Corners at the ends of the sides AB, BC, DC, AD, in these directions.
const ENDS: [(usize, usize); 4] = [(0, 1), (1, 2), (3, 2), (0, 3)];

/// A side as a piece of a line, in the direction in which members are counted.
struct Directed {
    line: usize,
    shares: [f64; 2],
}

fn directed(network: &Network, patch: usize, side: usize) -> Directed {
    let SidePiece { line, from, to } = network.sides[patch][side];
    // Sides are kept in the order AB, BC, CD, DA.
    let (from, to) = if side < 2 { (from, to) } else { (to, from) };
    let share = |i: usize| network.lines[line].stations[i].share;
    Directed {
        line,
        shares: [share(from), share(to)],
    }
}

/// Anchors strictly inside a side, with their shares of it.
fn stations(network: &Network, patch: usize, side: usize) -> Vec<(String, f64)> {
    let here = directed(network, patch, side);
    network.lines[here.line]
        .stations
        .iter()
        .map(|station| {
            let share = (station.share - here.shares[0]) / (here.shares[1] - here.shares[0]);
            (station.name.clone(), share)
        })
        .filter(|(_, share)| *share > EXACT && *share < 1.0 - EXACT)
        .collect()
}

fn points<const N: usize>(feet: [Foot; N]) -> Vec<Point> {
    feet.into_iter()
        .filter_map(|foot| {
            Some(Point {
                name: foot.name,
                anchor: foot.anchor?,
            })
        })
        .collect()
}

/// A length as it is read back from text with so many decimals.
fn rounded(metres: f64, decimals: usize) -> f64 {
    // Adding 0 makes -0 positive.
    format!("{metres:.decimals$}").parse().unwrap_or(metres) + 0.0
}

/// `west-1` of `west`, `west-12` of `west-1`.
fn part_name(old: &DraftPatch, i: usize) -> String {
    let number = i + 1;
    if old.name == old.origin {
        format!("{}-{number}", stem(&old.name))
    } else {
        format!("{}{number}", old.name)
    }
}

/// What names of parts and anchors begin with.
pub(super) fn stem(name: &str) -> &str {
    // Names are ASCII.
    name.get(..STEM).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const RULES: Rules = Rules {
        min_side: 0.0,
        max_patches: 100,
        decimals: 3,
        centre: true,
    };
    const LENGTHS: [f64; 4] = [10.0; 4];

    fn point(name: &str) -> Point {
        Point {
            name: name.into(),
            anchor: Anchor::Above([0.0, 0.0]),
        }
    }

    fn patch(name: &str, corners: [&str; 4], members: [u32; 2]) -> DraftPatch {
        DraftPatch {
            name: name.into(),
            origin: name.into(),
            corners: corners.map(Into::into),
            members,
            alpha: Some(1.0),
            width: 0.1,
        }
    }

    /// Two patches side by side: `b-c` is the end side of one and the start side of the other.
    fn two() -> Draft {
        Draft {
            points: ["a", "b", "c", "d", "e", "f"].map(point).to_vec(),
            patches: vec![
                patch("east", ["b", "e", "f", "c"], [5, 9]),
                patch("west", ["a", "b", "c", "d"], [7, 9]),
            ],
        }
    }

    fn edge(along: Family, share: f64) -> Proposal {
        Proposal::Edge {
            along,
            from: share,
            to: share,
        }
    }

    fn named<'a>(draft: &'a Draft, name: &str) -> &'a DraftPatch {
        draft.patches.iter().find(|p| p.name == name).unwrap()
    }

    #[test]
    fn parts_share_the_spaces_of_the_family_that_is_cut() {
        for (along, members) in [(Family::U, [[4, 9], [4, 9]]), (Family::V, [[7, 5], [7, 5]])] {
            let mut draft = two();
            draft.cut(1, &edge(along, 0.5), LENGTHS, &RULES).unwrap();
            let parts = ["west-1", "west-2"].map(|name| named(&draft, name));
            assert_eq!(parts.map(|p| p.members), members);
            assert!(
                parts
                    .iter()
                    .all(|p| p.alpha.is_none() && p.origin == "west")
            );
        }
    }

    #[test]
    fn a_neighbour_that_is_cut_close_by_uses_the_same_anchor_and_the_same_member() {
        let mut draft = two();
        draft
            .cut(1, &edge(Family::V, 0.3), LENGTHS, &RULES)
            .unwrap();
        assert_eq!(named(&draft, "east").corners, ["b", "e", "f", "c"]);
        // 0.35 is close to the anchor at 0.3; by itself it would take the third of eight spaces.
        draft
            .cut(0, &edge(Family::V, 0.35), LENGTHS, &RULES)
            .unwrap();
        let [west, east] = ["west-1", "east-1"].map(|name| named(&draft, name));
        assert_eq!(west.corners[2], "west-s23");
        assert_eq!(east.corners[3], "west-s23");
        assert_eq!(west.members[1], east.members[1]);
    }

    #[test]
    fn a_cut_beside_another_keeps_the_order_of_members_or_is_refused() {
        let mut draft = two();
        draft
            .cut(1, &edge(Family::V, 0.3), LENGTHS, &RULES)
            .unwrap();
        let before = named(&draft, "west-1").members[1];
        draft
            .cut(0, &edge(Family::V, 0.5), LENGTHS, &RULES)
            .unwrap();
        assert!(named(&draft, "east-1").members[1] > before);
        let mut crowded = two();
        for patch in &mut crowded.patches {
            patch.members[1] = 3;
        }
        crowded
            .cut(1, &edge(Family::V, 0.3), LENGTHS, &RULES)
            .unwrap();
        let refused = crowded.cut(0, &edge(Family::V, 0.5), LENGTHS, &RULES);
        assert_eq!(refused, Err(Refusal::Order(Family::V)));
    }

    #[test]
    fn a_corner_makes_four_parts_around_it_in_the_orientation_of_the_patch() {
        let mut draft = two();
        let corner = Proposal::Corner {
            at: [1.23456, -0.00001, 2.0].into(),
            shares: [0.52, 0.3, 0.6, 0.3],
        };
        draft.cut(1, &corner, LENGTHS, &RULES).unwrap();
        let corners: Vec<[&str; 4]> = draft.patches[1..]
            .iter()
            .map(|p| std::array::from_fn(|i| p.corners[i].as_str()))
            .collect();
        assert_eq!(
            corners,
            [
                ["a", "west-s12", "west-peak", "west-s41"],
                ["west-s12", "b", "west-s23", "west-peak"],
                ["west-peak", "west-s23", "c", "west-s34"],
                ["west-s41", "west-peak", "west-s34", "d"],
            ]
        );
        let anchor = |name: &str| &draft.points.iter().find(|p| p.name == name).unwrap().anchor;
        assert_eq!(*anchor("west-peak"), Anchor::Near([1.235, 0.0, 2.0]));
        let on = |edge: [&str; 2], at| Anchor::On {
            edge: edge.map(Into::into),
            at,
        };
        // Close to the middle is the middle; sides 3-4 and 4-1 are counted from 4 and from 1.
        assert_eq!(*anchor("west-s12"), on(["a", "b"], 0.5));
        assert_eq!(*anchor("west-s34"), on(["d", "c"], 0.6));
        assert_eq!(*anchor("west-s41"), on(["a", "d"], 0.3));
    }

    #[test]
    fn parts_of_parts_are_called_after_them_and_unused_anchors_are_swept() {
        let mut draft = two();
        let given: BTreeSet<String> = draft.points.iter().map(|p| p.name.clone()).collect();
        draft
            .cut(1, &edge(Family::U, 0.5), LENGTHS, &RULES)
            .unwrap();
        draft
            .cut(1, &edge(Family::V, 0.5), LENGTHS, &RULES)
            .unwrap();
        let names: Vec<&str> = draft.patches.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["east", "west-11", "west-12", "west-2"]);
        draft.sweep(&given);
        assert_eq!(draft.points.len(), 10);
        draft.patches = two().patches;
        draft.sweep(&given);
        assert_eq!(draft.points, two().points);
    }

    #[test]
    fn limits_are_kept() {
        let mut draft = two();
        let cut = edge(Family::U, 0.5);
        let few = Rules {
            max_patches: 2,
            ..RULES
        };
        assert_eq!(
            draft.cut(1, &cut, LENGTHS, &few),
            Err(Refusal::MaxPatches(2))
        );
        let long = Rules {
            min_side: 5.1,
            ..RULES
        };
        assert_eq!(
            draft.cut(1, &cut, LENGTHS, &long),
            Err(Refusal::MinSide(5.1))
        );
        assert_eq!(draft, two());
        let long = Rules {
            min_side: 4.0,
            ..RULES
        };
        draft.cut(1, &edge(Family::U, 0.1), LENGTHS, &long).unwrap();
        assert!(matches!(draft.points[6].anchor, Anchor::On { at: 0.4, .. }));
    }
}
