//! Merging (paper, Algorithm 2): neighbouring parts of a patch become one where the merged patch is
//! feasible.

use super::appraise::Measured;
use super::draft::{Draft, DraftPatch};
use super::split::{NoSplit, Workshop};
use crate::layout::Network;

/// Parts of a patch that are fewer together.
struct Merger {
    /// Indices of the parts, ascending.
    parts: Vec<usize>,
    /// What they become.
    merged: Vec<DraftPatch>,
}

/// Merges neighbouring parts of a patch while the merged patches are feasible and members still run
/// on in order.
pub(super) fn run(workshop: &mut Workshop<'_>) -> Result<(), NoSplit> {
    let limits = workshop.limits();
    let mut refused: Vec<Vec<[String; 4]>> = Vec::new();
    let key = |merger: &Merger| -> Vec<[String; 4]> {
        let merged = merger.merged.iter();
        merged.map(|patch| patch.corners.clone()).collect()
    };
    loop {
        let network = workshop.draft.network();
        let mut mergers = around_corners(&workshop.draft, &network);
        mergers.extend(pairs(&workshop.draft, &network));
        let next = mergers.iter().find(|m| !refused.contains(&key(m)));
        let Some(merger) = next else {
            return Ok(());
        };
        let before = workshop.draft.clone();
        let patches = &mut workshop.draft.patches;
        for &part in merger.parts.iter().rev() {
            patches.remove(part);
        }
        let at = merger.parts[0];
        patches.splice(at..at, merger.merged.iter().cloned());
        workshop.draft.sweep(&workshop.given);
        let measured = workshop.appraise()?;
        let merged = &measured[at..at + merger.merged.len()];
        let settled = |m: &Measured| m.as_ref().is_ok_and(|a| a.settled(&limits));
        if !merged.iter().all(settled) || !workshop.weaves(&measured) {
            workshop.draft = before;
            refused.push(key(merger));
        }
    }
}

/// How two neighbouring parts lie to each other.
#[derive(Clone, Copy, PartialEq)]
enum Lie {
    /// The second goes on where the u-coordinate of the first ends.
    Beside,
    /// The same for the v-coordinate.
    Above,
}

/// Two parts as one patch, if they lie so and their members agree. Whether its sides are straight
/// is for the caller to know.
fn joined(first: &DraftPatch, second: &DraftPatch, lie: Lie) -> Option<DraftPatch> {
    let ([a, b, c, d], [e, f, g, h]) = (&first.corners, &second.corners);
    let ([u, v], [s, t]) = (first.members, second.members);
    let (corners, members) = match lie {
        Lie::Beside if b == e && c == h && v == t => ([a, f, g, d], [u + s - 1, v]),
        Lie::Above if d == e && c == f && u == s => ([a, b, g, h], [u, v + t - 1]),
        _ => return None,
    };
    Some(DraftPatch {
        corners: corners.map(Clone::clone),
        members,
        ..first.clone()
    })
}

/// Pairs of parts that are one quadrilateral together: the outer sides on either end of their
/// common side are pieces of one line.
fn pairs(draft: &Draft, network: &Network) -> Vec<Merger> {
    let mut mergers = Vec::new();
    for (i, j) in neighbours(draft) {
        for (lie, sides) in [(Lie::Beside, [0, 2]), (Lie::Above, [1, 3])] {
            if let Some(merged) = joined(&draft.patches[i], &draft.patches[j], lie)
                && sides
                    .into_iter()
                    .all(|side| one_line(network, [i, j], side))
            {
                mergers.push(Merger {
                    parts: vec![i.min(j), i.max(j)],
                    merged: vec![merged],
                });
            }
        }
    }
    mergers
}

/// Four parts around a corner as two, with one side in the place of the two through the corner.
fn around_corners(draft: &Draft, network: &Network) -> Vec<Merger> {
    let mut mergers = Vec::new();
    let patches = &draft.patches;
    for (i, j) in neighbours(draft) {
        let corner = &patches[i].corners[2];
        let others: Vec<usize> = (0..patches.len())
            .filter(|k| patches[*k].corners.contains(corner))
            .collect();
        // The first has the corner as its third, the one beside it as its fourth.
        let Some(low) = joined(&patches[i], &patches[j], Lie::Beside) else {
            continue;
        };
        if others.len() != 4 {
            continue;
        }
        let at = |place: usize| {
            let mut others = others.iter().copied();
            others.find(|&k| patches[k].corners[place] == *corner)
        };
        let Some((k, l)) = at(0).zip(at(1)) else {
            continue;
        };
        let straight = one_line(network, [i, j], 0)
            && one_line(network, [l, k], 2)
            && one_line(network, [i, l], 3)
            && one_line(network, [j, k], 1);
        let same = |k: usize| patches[k].origin == patches[i].origin;
        if !straight || !same(k) || !same(l) {
            continue;
        }
        let beside = joined(&patches[l], &patches[k], Lie::Beside).map(|high| vec![low, high]);
        let above = joined(&patches[i], &patches[l], Lie::Above)
            .zip(joined(&patches[j], &patches[k], Lie::Above))
            .map(|(left, right)| vec![left, right]);
        mergers.extend([beside, above].into_iter().flatten().map(|merged| Merger {
            parts: others.clone(),
            merged,
        }));
    }
    mergers
}

/// Ordered pairs of parts of one patch.
fn neighbours(draft: &Draft) -> impl Iterator<Item = (usize, usize)> + '_ {
    let all = 0..draft.patches.len();
    let same = |i: usize, j: usize| draft.patches[i].origin == draft.patches[j].origin;
    all.clone()
        .flat_map(move |i| all.clone().map(move |j| (i, j)))
        .filter(move |&(i, j)| i != j && same(i, j))
}

/// Whether the same side of two patches lies on one line.
fn one_line(network: &Network, [i, j]: [usize; 2], side: usize) -> bool {
    network.sides[i][side].line == network.sides[j][side].line
}
