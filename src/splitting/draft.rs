//! A network of patches that is being split: anchors, patches, cuts.
//!
//! A cut ends on sides. The anchors there stand `on` these sides, so a neighbour across a side
//! stays whole: its side gets a T-junction. Where a neighbour has been cut close by already, the
//! same anchor serves both.
//!
//! Members are counted in *spaces*: those between the members of a family, shared by the parts of a
//! patch. A cut takes the place of a member, so counts along shared sides go on to agree.

use super::Proposal;
use crate::layout::{Network, SidePiece};
use crate::project::model::{Anchor, Family, Lamella, Patch, Point};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A patch of the draft.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DraftPatch {
    /// Its name.
    pub name: String,
    /// The patch of the project file that it is (a part of).
    pub origin: String,
    /// Names of its corners, in order.
    pub corners: [String; 4],
    /// Members of the u- and the v-family, boundary members included.
    pub members: [u32; 2],
    /// The user's planar angle, radians; none for parts.
    pub alpha: Option<f64>,
    /// Width of its lamellae, metres.
    pub width: f64,
}

/// Points and patches.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Draft {
    /// Anchors.
    pub points: Vec<Point>,
    /// Patches.
    pub patches: Vec<DraftPatch>,
}

/// What a cut has to keep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rules {
    /// Shortest side, metres.
    pub(super) min_side: f64,
    /// Most patches.
    pub(super) max_patches: usize,
    /// Decimals of a metre in the coordinates of new anchors.
    pub(super) decimals: usize,
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
    /// The network of its lines.
    pub(super) fn network(&self) -> Network {
        Network::new(&self.points, &self.as_patches())
    }

    /// Its patches as those of a project; lamellae have their width only.
    pub fn as_patches(&self) -> Vec<Patch> {
        let patch = |p: &DraftPatch| Patch {
            name: p.name.clone(),
            corners: p.corners.clone(),
            u: Some(p.members[0]),
            v: Some(p.members[1]),
            alpha: p.alpha,
            lamella: Lamella {
                width: p.width,
                thickness: 0.0,
                material: String::new(),
            },
        };
        self.patches.iter().map(patch).collect()
    }

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
                name: part_name(&old, i),
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
        if (share - 0.5).abs() < MIDDLE {
            share = 0.5;
        }
        let share = (share * 1000.0).round() / 1000.0;
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

    /// A name that no point has, beginning with a given one.
    fn new_name(&self, wanted: &str) -> String {
        let taken: BTreeSet<&str> = self.points.iter().map(|p| p.name.as_str()).collect();
        if !taken.contains(wanted) {
            return wanted.to_owned();
        }
        (2..)
            .map(|n| format!("{wanted}-{n}"))
            .find(|name| !taken.contains(name.as_str()))
            .unwrap_or_default()
    }

    /// Removes anchors that were added and that no patch has as a corner and no anchor stands on.
    pub(super) fn sweep(&mut self, given: &BTreeSet<String>) {
        loop {
            let mut used: BTreeSet<&str> = given.iter().map(String::as_str).collect();
            used.extend(
                self.patches
                    .iter()
                    .flat_map(|p| &p.corners)
                    .map(String::as_str),
            );
            for point in &self.points {
                if let Anchor::On { edge, .. } = &point.anchor {
                    used.extend(edge.iter().map(String::as_str));
                }
            }
            let keep: Vec<bool> = self
                .points
                .iter()
                .map(|p| used.contains(p.name.as_str()))
                .collect();
            if keep.iter().all(|k| *k) {
                return;
            }
            let mut keep = keep.into_iter();
            self.points.retain(|_| keep.next().unwrap_or(true));
        }
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

fn stem(name: &str) -> &str {
    // Names are ASCII.
    name.get(..STEM).unwrap_or(name)
}
