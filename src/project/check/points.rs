//! Anchors: edges between defined points, no cycles, no two names for one place.

use super::patches::Patches;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::ProjectFile;
use crate::project::file::anchors::AnchorFile;
use crate::project::file::reader::{Field, Sink, shortened};
use crate::project::model::{Anchor, Point, SupportPlaces, Supports};
use crate::project::suggest;
use std::collections::{BTreeMap, BTreeSet};

/// Points as far as they are good.
pub(super) struct Points<'f> {
    /// Names, sorted; `None` if the table could not be read, and no name can be judged.
    pub(super) names: Option<Vec<&'f str>>,
    anchors: Vec<(&'f str, Option<Place<'f>>)>,
}

/// An anchor in terms of the file.
#[derive(Debug, Clone, PartialEq)]
enum Place<'f> {
    Above([f64; 2]),
    Near([f64; 3]),
    Vertex(u32),
    On { edge: [&'f str; 2], at: f64 },
}

impl<'f> Points<'f> {
    /// Anchors on edges: name, edge, share. Anchors of a cycle are not among them.
    pub(super) fn on_edges(&self) -> impl Iterator<Item = (&'f str, [&'f str; 2], f64)> {
        self.anchors.iter().filter_map(|(name, place)| match place {
            Some(Place::On { edge, at }) => Some((*name, *edge, *at)),
            _ => None,
        })
    }

    /// All points, if all are good.
    pub(super) fn model(&self) -> Option<Vec<Point>> {
        let point = |(name, place): &(&str, Option<Place<'_>>)| {
            let anchor = match place.as_ref()? {
                Place::Above(xy) => Anchor::Above(*xy),
                Place::Near(xyz) => Anchor::Near(*xyz),
                Place::Vertex(index) => Anchor::Vertex(*index),
                Place::On { edge, at } => Anchor::On {
                    edge: edge.map(str::to_owned),
                    at: *at,
                },
            };
            Some(Point {
                name: (*name).to_owned(),
                anchor,
            })
        };
        self.anchors.iter().map(point).collect()
    }
}

pub(super) fn check<'f>(file: &'f ProjectFile, sink: &mut Sink) -> Points<'f> {
    let Some(table) = file.points.good() else {
        return Points {
            names: None,
            anchors: Vec::new(),
        };
    };
    let mut names: Vec<&str> = table
        .entries
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    names.sort_unstable();
    let mut anchors: Vec<(&str, Option<Place<'_>>)> = table
        .entries
        .iter()
        .map(|(name, anchor)| {
            let place = anchor
                .good()
                .and_then(|anchor| place(name, anchor, &names, sink));
            (name.as_str(), place)
        })
        .collect();
    break_cycles(&mut anchors, sink);
    same_places(&anchors, sink);
    Points {
        names: Some(names),
        anchors,
    }
}

/// Reports a name that is no point.
pub(super) fn undefined(at: &KeyPath, name: &str, names: &[&str], sink: &mut Sink) {
    sink.error(|| {
        let shown = shortened(name);
        let diagnostic =
            Diagnostic::error(Code::new("E0201"), format!("there is no point `{shown}`"))
                .at_key(at.as_str(), "not one of `points`");
        match suggest::help(name, "point", names.iter().copied()) {
            Some(help) => diagnostic.help(help),
            None => diagnostic.help(format!("define it: `{shown} = [x, y]` in `[points]`")),
        }
    });
}

fn place<'f>(
    name: &str,
    anchor: &'f AnchorFile,
    names: &[&str],
    sink: &mut Sink,
) -> Option<Place<'f>> {
    let path = KeyPath::of(["points", name]);
    match anchor {
        AnchorFile::At(coordinates) => {
            let values = coordinates.iter().map(|field| field.good().map(|q| q.si));
            match values.collect::<Option<Vec<f64>>>()?[..] {
                [x, y] => Some(Place::Above([x, y])),
                [x, y, z] => Some(Place::Near([x, y, z])),
                _ => None,
            }
        }
        AnchorFile::Vertex(anchor) => Some(Place::Vertex(anchor.vertex.good()?.0)),
        AnchorFile::On(anchor) => {
            let ends: Vec<Option<&str>> = anchor
                .on
                .good()?
                .0
                .iter()
                .enumerate()
                .map(|(index, end)| {
                    let end = end.good()?.0.as_str();
                    if names.binary_search(&end).is_err() {
                        undefined(&path.key("on").index(index), end, names, sink);
                        return None;
                    }
                    Some(end)
                })
                .collect();
            let [Some(first), Some(second)] = ends[..] else {
                return None;
            };
            if first == second {
                sink.error(|| {
                    Diagnostic::error(
                        Code::new("E0210"),
                        format!("`{name}` lies between `{first}` and itself"),
                    )
                    .at_key(path.key("on").as_str(), "the same anchor twice")
                    .help("name the two ends of a side, such as `on = [\"a\", \"b\"]`")
                });
                return None;
            }
            Some(Place::On {
                edge: [first, second],
                at: anchor.at.good()?.si,
            })
        }
    }
}

/// Reports anchors that are defined by way of themselves and takes their places away.
fn break_cycles(anchors: &mut [(&str, Option<Place<'_>>)], sink: &mut Sink) {
    let index: BTreeMap<&str, usize> = anchors
        .iter()
        .enumerate()
        .map(|(index, (name, _))| (*name, index))
        .collect();
    let ends: Vec<Vec<usize>> = anchors
        .iter()
        .map(|(_, place)| match place {
            Some(Place::On { edge, .. }) => edge
                .iter()
                .filter_map(|end| index.get(end).copied())
                .collect(),
            _ => Vec::new(),
        })
        .collect();
    // Depth first without recursion: a trail of (anchor, next end to look at).
    let mut state = vec![State::Unseen; anchors.len()];
    let mut cycles = Vec::new();
    for start in 0..anchors.len() {
        let mut trail = vec![(start, 0)];
        while let Some((at, next)) = trail.pop() {
            if next == 0 && state[at] != State::Unseen {
                continue;
            }
            state[at] = State::Open;
            let Some(&end) = ends[at].get(next) else {
                state[at] = State::Done;
                continue;
            };
            trail.push((at, next + 1));
            match state[end] {
                State::Unseen => trail.push((end, 0)),
                State::Open => {
                    let from = trail.iter().position(|(open, _)| *open == end);
                    let cycle = trail[from.unwrap_or(0)..].iter().map(|(open, _)| *open);
                    cycles.push(cycle.collect::<Vec<_>>());
                }
                State::Done => {}
            }
        }
    }
    for cycle in cycles {
        sink.error(|| {
            let names: Vec<&str> = cycle.iter().map(|&point| anchors[point].0).collect();
            let first = names[0];
            let path = KeyPath::of(["points", first]).key("on");
            let mut chain = names.clone();
            chain.push(first);
            let diagnostic = Diagnostic::error(
                Code::new("E0209"),
                format!("the anchor `{first}` is defined by way of itself"),
            )
            .at_key(path.as_str(), "leads back to this anchor")
            .note(format!("the way around: {}", shortened_chain(&chain)));
            diagnostic.help(if cycle.len() > 2 {
                "give one of them coordinates or a vertex; in a pinwheel, divide the patch whose side \
                 it stood on from there across"
            } else {
                "give one of them coordinates or a vertex"
            })
        });
        for point in cycle {
            anchors[point].1 = None;
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Unseen,
    Open,
    Done,
}

fn shortened_chain(names: &[&str]) -> String {
    const MOST: usize = 8;
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    if quoted.len() <= MOST {
        return quoted.join(" on ");
    }
    let (head, tail) = (&quoted[..MOST - 2], &quoted[quoted.len() - 1]);
    format!("{} on … on {tail}", head.join(" on "))
}

fn same_places(anchors: &[(&str, Option<Place<'_>>)], sink: &mut Sink) {
    let mut seen: BTreeMap<(u8, Vec<&str>, Vec<u64>), &str> = BTreeMap::new();
    for (name, place) in anchors {
        let key = match place {
            None => continue,
            Some(Place::Above(xy)) => (0, vec![], xy.map(f64::to_bits).to_vec()),
            Some(Place::Near(xyz)) => (1, vec![], xyz.map(f64::to_bits).to_vec()),
            Some(Place::Vertex(index)) => (2, vec![], vec![u64::from(*index)]),
            // An anchor halfway from a to b is the one halfway from b to a.
            Some(Place::On { edge, at }) if edge[0] < edge[1] => {
                (3, edge.to_vec(), vec![at.to_bits()])
            }
            Some(Place::On { edge, at }) => (3, vec![edge[1], edge[0]], vec![(1.0 - at).to_bits()]),
        };
        if let Some(first) = seen.get(&key) {
            sink.error(|| {
                let path = |name: &str| KeyPath::of(["points", name]);
                Diagnostic::error(
                    Code::new("E0224"),
                    format!("`{first}` and `{name}` are two names for one place"),
                )
                .at_key(path(name).as_str(), "the same place again")
                .at_key(path(first).as_str(), format!("`{first}` is here"))
                .help("keep one name: patches that should share a side must name the same anchors")
            });
        } else {
            seen.insert(key, name);
        }
    }
}

/// Warns of points that nothing uses.
pub(super) fn unused(
    file: &ProjectFile,
    points: &Points<'_>,
    patches: &Patches<'_>,
    supports: Option<&Supports>,
    sink: &mut Sink,
) {
    if sink.failed() || !matches!(file.points, Field::Good(_)) {
        return;
    }
    let mut used: BTreeSet<&str> = patches.good().flat_map(|(_, corners)| corners).collect();
    used.extend(points.on_edges().flat_map(|(_, edge, _)| edge));
    if let Some(SupportPlaces::Listed(ids)) = supports.map(|supports| &supports.at) {
        used.extend(ids.iter().map(String::as_str));
    }
    for (name, _) in points
        .anchors
        .iter()
        .filter(|(name, _)| !used.contains(name))
    {
        sink.warning(|| {
            Diagnostic::warning(
                Code::new("W0205"),
                format!("the point `{name}` is never used"),
            )
            .at_name(
                KeyPath::of(["points", name]).as_str(),
                "no patch, anchor or support names it",
            )
            .about(*name)
        });
    }
}
