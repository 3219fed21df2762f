//! Points, lines and domains of patches.

use super::{Basis, Told};
use crate::build::stages::layout::{
    ANCHOR, ANCHORS, Anchors, LINE, NETWORK, NetworkInput, PATCH, PatchInput, STATION,
};
use crate::build::{Graph, Node};
use crate::layout::{Domain, Network, Side, SidePiece, edge_id};
use crate::project::model::Point;
use crate::surface::SurfacePoint;
use std::collections::BTreeMap;

/// Lines and points, declared when they are first asked for: a line needs its ends, and an end may
/// stand on another line.
pub(super) struct Lines<'a> {
    basis: &'a Basis<'a>,
    anchors: Node<Anchors>,
    points: BTreeMap<String, Node<SurfacePoint>>,
    declared: BTreeMap<usize, Node<Side>>,
}

impl<'a> Lines<'a> {
    /// Declares where the points stand that have a place of their own.
    pub(super) fn declare(
        graph: &mut Graph<'_>,
        basis: &'a Basis<'a>,
        points: &[Point],
        told: &mut Told,
    ) -> Self {
        let list = points
            .iter()
            .map(|p| (p.name.clone(), p.anchor.clone()))
            .collect();
        let anchors = graph.add(&ANCHORS, "", list, basis.surface);
        for (i, point) in points.iter().enumerate() {
            let key = basis.origins.point_key(&point.name);
            graph.origin(anchors, format!("[{i}]"), key);
        }
        told.push((String::new(), anchors.warnings()));
        Self {
            basis,
            anchors,
            points: BTreeMap::new(),
            declared: BTreeMap::new(),
        }
    }

    /// An anchor, by name.
    pub(super) fn point(&mut self, graph: &mut Graph<'_>, name: &str) -> Node<SurfacePoint> {
        if let Some(node) = self.points.get(name) {
            return *node;
        }
        // A station strictly inside a line stands on it; the ends of a line have a place of
        // their own, or stand on another line.
        let host = self
            .basis
            .network
            .lines
            .iter()
            .enumerate()
            .find_map(|(index, line)| {
                let last = line.stations.len() - 1;
                let station = line.stations[1..last].iter().find(|s| s.name == name)?;
                Some((index, station.share))
            });
        let node = match host {
            Some((index, share)) => {
                let line = self.line(graph, index);
                let node = graph.add(&STATION, name, share, (self.basis.surface, line));
                graph.origin(node, "", self.basis.origins.point_key(name));
                node
            }
            None => graph.add(&ANCHOR, name, name.to_owned(), self.anchors),
        };
        self.points.insert(name.to_owned(), node);
        node
    }

    /// A line, by its index in the network.
    pub(super) fn line(&mut self, graph: &mut Graph<'_>, index: usize) -> Node<Side> {
        if let Some(node) = self.declared.get(&index) {
            return *node;
        }
        let basis = self.basis;
        let line = &basis.network.lines[index];
        let ends = line.ends().map(|name| self.point(graph, name));
        let needs = (basis.surface, ends[0], ends[1]);
        let node = graph.add(&LINE, line.id(), (), needs);
        graph.origin(node, "", basis.origins.point_key(line.ends()[0]));
        for (field, name) in ["from", "to"].into_iter().zip(line.ends()) {
            graph.name(node, field, name);
        }
        self.declared.insert(index, node);
        node
    }
}

/// The part of the surface inside of a patch.
pub(super) fn domain(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    lines: &mut Lines<'_>,
    index: usize,
) -> Node<Domain> {
    let patch = &basis.patches[index];
    let here = basis.origins.patch_key(&patch.name);
    let pieces = basis.network.sides[index];
    let corners = pieces.map(|piece| {
        [piece.from, piece.to].map(|i| basis.network.lines[piece.line].stations[i].share)
    });
    let [first, second, third, fourth] = pieces.map(|piece| lines.line(graph, piece.line));
    let needs = (basis.surface, (first, second, third, fourth));
    let domain = graph.add(&PATCH, &patch.name, PatchInput { corners }, needs);
    graph.origin(domain, "", here.clone());
    graph.origin(domain, "corners", format!("{here}.corners"));
    graph.name(domain, "", &patch.name);
    for (i, corner) in patch.corners.iter().enumerate() {
        graph.name(domain, format!("corners[{i}]"), corner);
    }
    domain
}

/// The check of all patches together.
pub(super) fn check_neighbours(
    graph: &mut Graph<'_>,
    basis: &Basis<'_>,
    lines: &mut Lines<'_>,
    domains: Vec<Node<Domain>>,
    told: &mut Told,
) {
    let network = basis.network;
    let input = NetworkInput {
        network: network.clone(),
        patches: basis
            .patches
            .iter()
            .map(|patch| (patch.name.clone(), patch.corners.clone()))
            .collect(),
    };
    let sides = (0..network.lines.len())
        .map(|index| lines.line(graph, index))
        .collect();
    let node = graph.add(&NETWORK, "", input, (basis.surface, sides, domains));
    for (i, patch) in basis.patches.iter().enumerate() {
        let here = basis.origins.patch_key(&patch.name);
        graph.origin(node, format!("patches[{i}]"), here);
    }
    told.push((String::new(), node.warnings()));
}

/// Ids of the edges of the sides of a patch, in the order of travel.
pub(super) fn edges_of(network: &Network, sides: &[SidePiece; 4]) -> [Vec<String>; 4] {
    sides.map(|piece| {
        let stations = &network.lines[piece.line].stations;
        piece
            .segments()
            .map(|(i, j)| edge_id(&stations[i].name, &stations[j].name))
            .collect()
    })
}
