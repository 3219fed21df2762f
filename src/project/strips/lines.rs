//! What lies along one line of the surface: whole sides, parts of them, T-junctions, crowds.

use super::{Crowd, Junction, Network, OnEdge, Side, sorted};
use std::collections::BTreeMap;

impl<'a> Network<'a> {
    /// What lies along every line: a side, or an edge that carries anchors and is no part of
    /// another.
    pub(super) fn lines(
        &self,
        by_edge: &BTreeMap<[&'a str; 2], Vec<Side>>,
    ) -> (Vec<Junction>, Vec<Crowd>) {
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
        let on: BTreeMap<&str, [&str; 2]> = self
            .on_edges
            .iter()
            .map(|anchor| (anchor.point, sorted(anchor.edge)))
            .collect();
        let bare = carried
            .keys()
            .filter(|edge| !by_edge.contains_key(*edge) && !is_part(edge, &on));
        for line in by_edge.keys().chain(bare) {
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
        (junctions, without_parts(crowds))
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

/// Whether an edge visibly lies on a longer one, so that the longer one shows all there is.
fn is_part(edge: &[&str; 2], on: &BTreeMap<&str, [&str; 2]>) -> bool {
    let [a, b] = edge.map(|end| on.get(end));
    let ends_at =
        |line: Option<&[&str; 2]>, end: &str| line.is_some_and(|line| line.contains(&end));
    ends_at(a, edge[1]) || ends_at(b, edge[0]) || a.is_some() && a == b
}

/// Crowds that are no part of another: the same sides may be met on several lines.
fn without_parts(mut crowds: Vec<Crowd>) -> Vec<Crowd> {
    crowds.sort_by(|a, b| b.sides.len().cmp(&a.sides.len()).then_with(|| a.cmp(b)));
    let mut kept: Vec<Crowd> = Vec::new();
    for crowd in crowds {
        let within = |other: &Crowd| crowd.sides.iter().all(|side| other.sides.contains(side));
        if !kept.iter().any(within) {
            kept.push(crowd);
        }
    }
    kept.sort();
    kept
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
