//! Which families of which patches run into each other: the strips of a structure, found from the
//! lines that their sides lie on.

use super::stages::members::{PassageInput, StripInput};
use crate::layout::{Network, SidePiece};
use crate::members::threads::LinePiece;
use crate::project::model::{Distribution, Family, Patch};
use std::collections::BTreeMap;

/// A strip: families of patches whose members depend on each other.
#[derive(Debug)]
pub(super) struct StripGroup {
    /// `west.u`: its first family by name.
    pub(super) name: String,
    /// Patches, by index, and families; in an order that does not depend on names of patches.
    pub(super) passages: Vec<(usize, Family)>,
    /// What its stages depend on.
    pub(super) input: StripInput,
}

/// Target of a family of a patch: `west.u`.
pub(super) fn family_target(patch: &str, family: Family) -> String {
    match family {
        Family::U => format!("{patch}.u"),
        Family::V => format!("{patch}.v"),
    }
}

/// The strips of patches in the order of the network, which holds their sides.
pub(super) fn strip_groups(
    distribution: &Distribution,
    patches: &[Patch],
    network: &Network,
) -> Vec<StripGroup> {
    // By corners, and not by name: a strip is the same strip when one of its patches is renamed.
    let mut order: Vec<usize> = (0..patches.len()).collect();
    order.sort_by(|&a, &b| {
        let corners = patches[a].corners.cmp(&patches[b].corners);
        corners.then_with(|| patches[a].name.cmp(&patches[b].name))
    });
    let all: Vec<(usize, Family)> = order
        .into_iter()
        .flat_map(|i| [(i, Family::U), (i, Family::V)])
        .collect();
    let pieces: Vec<[LinePiece; 2]> = all
        .iter()
        .map(|&(patch, family)| pieces(network, patch, family))
        .collect();
    let mut group_of: Vec<Option<usize>> = vec![None; all.len()];
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for first in 0..all.len() {
        if group_of[first].is_some() {
            continue;
        }
        let mut group = vec![first];
        group_of[first] = Some(groups.len());
        let mut next = 0;
        while next < group.len() {
            let here = pieces[group[next]];
            for other in 0..all.len() {
                let meet = || {
                    here.iter()
                        .any(|a| pieces[other].iter().any(|b| overlap(*a, *b)))
                };
                if group_of[other].is_none() && meet() {
                    group_of[other] = Some(groups.len());
                    group.push(other);
                }
            }
            next += 1;
        }
        groups.push(group);
    }
    let mut strips: Vec<StripGroup> = groups
        .into_iter()
        .map(|group| {
            let mut lines = BTreeMap::new();
            let passages = group
                .iter()
                .map(|&i| {
                    let (patch, family) = all[i];
                    let [start, end] = pieces[i].map(|piece| local(piece, &mut lines));
                    passage(distribution, &patches[patch], family, start, end)
                })
                .collect();
            let names = group.iter().map(|&i| {
                let (patch, family) = all[i];
                family_target(&patches[patch].name, family)
            });
            StripGroup {
                name: names.min().unwrap_or_default(),
                passages: group.iter().map(|&i| all[i]).collect(),
                input: StripInput {
                    passages,
                    closed: group.iter().any(|&i| {
                        let (patch, family) = all[i];
                        let named = |(name, asked): &(String, Family)| {
                            *name == patches[patch].name && *asked == family
                        };
                        distribution.closed.iter().any(named)
                    }),
                },
            }
        })
        .collect();
    strips.sort_by(|a, b| a.name.cmp(&b.name));
    strips
}

/// Lines are numbered within their strip, so that strips elsewhere do not enter its key.
fn local(piece: LinePiece, lines: &mut BTreeMap<u32, u32>) -> LinePiece {
    let next = lines.len() as u32;
    LinePiece {
        line: *lines.entry(piece.line).or_insert(next),
        ..piece
    }
}

fn overlap(a: LinePiece, b: LinePiece) -> bool {
    let range = |p: LinePiece| (p.from.min(p.to), p.from.max(p.to));
    let ((a0, a1), (b0, b1)) = (range(a), range(b));
    a.line == b.line && a1.min(b1) > a0.max(b0)
}

/// The sides on which a family starts and ends, in the direction in which its members are counted.
fn pieces(network: &Network, patch: usize, family: Family) -> [LinePiece; 2] {
    let [ab, bc, cd, da] = network.sides[patch];
    let along = |piece: SidePiece| {
        let station = |i: usize| network.lines[piece.line].stations[i].share;
        LinePiece {
            line: piece.line as u32,
            from: station(piece.from),
            to: station(piece.to),
        }
    };
    let against = |piece| {
        let LinePiece { line, from, to } = along(piece);
        LinePiece {
            line,
            from: to,
            to: from,
        }
    };
    match family {
        Family::U => [along(ab), against(cd)],
        Family::V => [against(da), along(bc)],
    }
}

fn passage(
    distribution: &Distribution,
    patch: &Patch,
    family: Family,
    start: LinePiece,
    end: LinePiece,
) -> PassageInput {
    let [start_side, end_side] = match family {
        Family::U => [[0, 1], [3, 2]],
        Family::V => [[0, 3], [1, 2]],
    };
    let weight = |side: [usize; 2]| {
        let [a, b] = side.map(|corner| &patch.corners[corner]);
        let said = distribution
            .weights
            .iter()
            .find(|([p, q], _)| (p, q) == (a, b) || (q, p) == (a, b));
        said.map_or(1.0, |(_, weight)| *weight)
    };
    PassageInput {
        family,
        start,
        end,
        count: count(patch, family),
        weights: [weight(start_side), weight(end_side)],
    }
}

/// Number of members of a family; a checked project says it, and two are the least there can be.
pub(super) fn count(patch: &Patch, family: Family) -> u32 {
    let said = match family {
        Family::U => patch.u,
        Family::V => patch.v,
    };
    said.unwrap_or(2).max(2)
}
