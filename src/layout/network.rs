//! The network of lines on the surface, from names alone: which geodesics are needed, which
//! anchors stand on them, and which piece of which line a side of a patch is.
//!
//! A *line* is a shortest geodesic between two anchors. Anchors declared `on` it are its further
//! *stations*. A side between two stations of one line is that piece of the line: a piece of a
//! shortest geodesic is one itself, and both patches beside a T-junction follow the same curve to
//! the last bit.

use crate::project::model::{Anchor, Patch, Point};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// All lines of a structure, sorted by the names of their ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Network {
    /// The lines.
    pub lines: Vec<Line>,
    /// For each patch, in the order given, its sides 1-2, 2-3, 3-4, 4-1.
    pub sides: Vec<[SidePiece; 4]>,
}

/// A shortest geodesic between two anchors, with all anchors on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// At least its two ends, by ascending share; the name of the first end sorts before that of
    /// the last.
    pub stations: Vec<Station>,
}

/// An anchor on a line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Station {
    /// Name of the anchor.
    pub name: String,
    /// Share of the line's length from its first end.
    pub share: f64,
}

/// A piece of a line in the direction of travel around a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SidePiece {
    /// Index of the line.
    pub line: usize,
    /// Index of the station at which the side begins.
    pub from: usize,
    /// Index of the station at which it ends; may be smaller.
    pub to: usize,
}

impl Line {
    /// `a-b`.
    pub fn id(&self) -> String {
        edge_id(
            &self.stations[0].name,
            &self.stations[self.stations.len() - 1].name,
        )
    }

    /// Names of its ends.
    pub fn ends(&self) -> [&str; 2] {
        [
            &self.stations[0].name,
            &self.stations[self.stations.len() - 1].name,
        ]
    }
}

impl SidePiece {
    /// Its consecutive pairs of stations, smaller index first, in the order of travel.
    pub fn segments(self) -> impl Iterator<Item = (usize, usize)> {
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        let forward = self.from < self.to;
        (low..high).map(move |i| {
            let i = if forward { i } else { low + high - 1 - i };
            (i, i + 1)
        })
    }
}

/// Id of the edge between two anchors: the smaller name first, whichever way it is travelled.
pub fn edge_id(a: &str, b: &str) -> String {
    if a <= b {
        format!("{a}-{b}")
    } else {
        format!("{b}-{a}")
    }
}

impl Network {
    /// Finds lines, stations and sides of a checked project: every name is defined and no anchor
    /// stands on itself. A name that is not defined counts as an anchor of its own.
    pub fn new(points: &[Point], patches: &[Patch]) -> Self {
        let mut resolver = Resolver {
            points: points
                .iter()
                .map(|p| (p.name.as_str(), &p.anchor))
                .collect(),
            hosts: BTreeMap::new(),
            lines: BTreeMap::new(),
        };
        for point in points {
            resolver.host(&point.name, 0);
        }
        let pieces: Vec<[Piece; 4]> = patches
            .iter()
            .map(|patch| {
                std::array::from_fn(|i| {
                    resolver.piece(&patch.corners[i], &patch.corners[(i + 1) % 4])
                })
            })
            .collect();
        resolver.finish(&pieces)
    }
}

type Ends = (String, String);

/// A piece of a line as shares.
struct Piece {
    line: Ends,
    from: f64,
    to: f64,
}

struct Resolver<'a> {
    points: BTreeMap<&'a str, &'a Anchor>,
    /// For anchors that stand on a line: the line and the share.
    hosts: BTreeMap<String, Option<(Ends, f64)>>,
    /// Shares of the anchors on each line, by name.
    lines: BTreeMap<Ends, BTreeMap<String, f64>>,
}

impl Resolver<'_> {
    /// The line that an anchor stands on. `depth` bounds the recursion should a cycle get here.
    fn host(&mut self, name: &str, depth: usize) -> Option<(Ends, f64)> {
        if let Some(known) = self.hosts.get(name) {
            return known.clone();
        }
        let host = match self.points.get(name) {
            Some(Anchor::On { edge, at }) if depth <= self.points.len() => {
                for end in edge {
                    self.host(end, depth + 1);
                }
                let Piece { line, from, to } = self.piece(&edge[0], &edge[1]);
                Some((line, from + at * (to - from)))
            }
            _ => None,
        };
        if let Some((line, share)) = &host {
            self.lines
                .entry(line.clone())
                .or_default()
                .insert(name.to_owned(), *share);
        }
        self.hosts.insert(name.to_owned(), host.clone());
        host
    }

    /// The piece of a line between two anchors whose hosts are known: of a line that both stand
    /// on, or a line of their own.
    fn piece(&mut self, a: &str, b: &str) -> Piece {
        let common = self.lines.iter().find_map(|(ends, stations)| {
            Some((ends.clone(), *stations.get(a)?, *stations.get(b)?))
        });
        if let Some((line, from, to)) = common {
            return Piece { line, from, to };
        }
        let forward = a <= b;
        let (first, last) = if forward { (a, b) } else { (b, a) };
        let ends = (first.to_owned(), last.to_owned());
        let stations = self.lines.entry(ends.clone()).or_default();
        stations.insert(first.to_owned(), 0.0);
        stations.insert(last.to_owned(), 1.0);
        let (from, to) = if forward { (0.0, 1.0) } else { (1.0, 0.0) };
        Piece {
            line: ends,
            from,
            to,
        }
    }

    fn finish(self, pieces: &[[Piece; 4]]) -> Network {
        let index: BTreeMap<&Ends, usize> = self
            .lines
            .keys()
            .enumerate()
            .map(|(i, ends)| (ends, i))
            .collect();
        let lines: Vec<Line> = self
            .lines
            .values()
            .map(|stations| {
                let mut stations: Vec<Station> = stations
                    .iter()
                    .map(|(name, &share)| Station {
                        name: name.clone(),
                        share,
                    })
                    .collect();
                stations.sort_by(|a, b| a.share.total_cmp(&b.share));
                Line { stations }
            })
            .collect();
        let side = |piece: &Piece| {
            let line = index[&piece.line];
            let station = |share: f64| {
                lines[line]
                    .stations
                    .iter()
                    .position(|s| s.share == share)
                    .unwrap_or(0)
            };
            SidePiece {
                line,
                from: station(piece.from),
                to: station(piece.to),
            }
        };
        let sides = pieces
            .iter()
            .map(|four| std::array::from_fn(|i| side(&four[i])))
            .collect();
        Network { lines, sides }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::model::Lamella;

    fn point(name: &str) -> Point {
        Point {
            name: name.into(),
            anchor: Anchor::Above([0.0, 0.0]),
        }
    }

    fn on(name: &str, a: &str, b: &str, at: f64) -> Point {
        Point {
            name: name.into(),
            anchor: Anchor::On {
                edge: [a.into(), b.into()],
                at,
            },
        }
    }

    fn patch(corners: [&str; 4]) -> Patch {
        let lamella = Lamella {
            width: 0.03,
            thickness: 0.003,
            material: "m".into(),
        };
        Patch {
            name: corners.concat(),
            corners: corners.map(Into::into),
            u: None,
            v: None,
            alpha: None,
            lamella,
        }
    }

    fn describe(network: &Network) -> Vec<String> {
        network
            .lines
            .iter()
            .map(|line| {
                let stations: Vec<String> = line
                    .stations
                    .iter()
                    .map(|s| format!("{} {}", s.name, s.share))
                    .collect();
                stations.join(", ")
            })
            .collect()
    }

    #[test]
    fn patches_share_the_line_between_the_same_anchors() {
        let points: Vec<_> = ["a", "b", "c", "d", "e", "f"].map(point).into();
        let network = Network::new(
            &points,
            &[patch(["a", "b", "e", "d"]), patch(["b", "c", "f", "e"])],
        );
        assert_eq!(network.lines.len(), 7);
        let (west, east) = (network.sides[0][1], network.sides[1][3]);
        assert_eq!(west.line, east.line);
        assert_eq!((west.from, west.to), (east.to, east.from));
        assert_eq!(network.lines[west.line].id(), "b-e");
    }

    #[test]
    fn a_t_junction_splits_the_long_side_for_its_neighbours_only() {
        let mut points: Vec<_> = ["a", "b", "c", "d", "p", "q", "r"].map(point).into();
        points.push(on("t", "b", "a", 0.25));
        let patches = [
            patch(["a", "b", "c", "d"]),
            patch(["p", "q", "t", "a"]),
            patch(["q", "r", "b", "t"]),
        ];
        let network = Network::new(&points, &patches);
        let long = network.sides[0][0];
        assert_eq!(describe(&network)[long.line], "a 0, t 0.75, b 1");
        assert_eq!(long.segments().collect::<Vec<_>>(), [(0, 1), (1, 2)]);
        let back = network.sides[1][2];
        assert_eq!((back.line, back.from, back.to), (long.line, 1, 0));
        assert_eq!(back.segments().collect::<Vec<_>>(), [(0, 1)]);
        let other = network.sides[2][2];
        assert_eq!((other.from, other.to), (2, 1));
    }

    #[test]
    fn an_anchor_on_a_piece_stands_on_the_whole_line() {
        let mut points: Vec<_> = ["a", "b", "c", "d"].map(point).into();
        points.insert(0, on("s", "t", "a", 0.5));
        points.push(on("t", "a", "b", 0.5));
        let network = Network::new(&points, &[patch(["a", "b", "c", "d"])]);
        assert_eq!(
            describe(&network)[network.sides[0][0].line],
            "a 0, s 0.25, t 0.5, b 1"
        );
    }

    #[test]
    fn the_order_of_the_file_does_not_matter() {
        let mut points: Vec<_> = ["a", "b", "c", "d", "p", "q", "r"].map(point).into();
        points.push(on("t", "a", "b", 0.25));
        let patches = [patch(["a", "b", "c", "d"]), patch(["p", "q", "t", "a"])];
        let forth = Network::new(&points, &patches);
        points.reverse();
        let back = Network::new(&points, &[patches[1].clone(), patches[0].clone()]);
        assert_eq!(forth.lines, back.lines);
        assert_eq!(forth.sides[0], back.sides[1]);
    }
}
