//! `[distribution]`: weights name sides, closed families are rings.

use super::patches::Patches;
use super::points::Points;
use super::section;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::DistributionSection;
use crate::project::file::ProjectFile;
use crate::project::file::reader::{Sink, shortened};
use crate::project::model::{Distribution, Family};
use crate::project::strips::{Network, Passage, Side, Strips, sorted};
use crate::project::suggest;
use std::collections::{BTreeMap, BTreeSet};

pub(super) fn check(
    file: &ProjectFile,
    points: &Points<'_>,
    patches: &Patches<'_>,
    network: &Network<'_>,
    strips: &Strips,
    sink: &mut Sink,
) -> Option<Distribution> {
    let Some(distribution) = section(file.distribution.as_ref())? else {
        return Some(Distribution {
            weights: Vec::new(),
            closed: Vec::new(),
        });
    };
    let weights = weights(distribution, points, patches, network, sink);
    let closed = closed(distribution, patches, strips, sink);
    Some(Distribution {
        weights: weights?,
        closed: closed?,
    })
}

type Weights = Vec<([String; 2], f64)>;

fn weights(
    distribution: &DistributionSection,
    points: &Points<'_>,
    patches: &Patches<'_>,
    network: &Network<'_>,
    sink: &mut Sink,
) -> Option<Weights> {
    let Some(table) = section(distribution.weights.as_ref())? else {
        return Some(Vec::new());
    };
    let mut sides: BTreeSet<[&str; 2]> = BTreeSet::new();
    for patch in 0..network.patches.len() {
        sides.extend((0..4).map(|number| sorted(Side { patch, number }.ends(network))));
    }
    let mut seen: BTreeMap<[&str; 2], &str> = BTreeMap::new();
    let mut weights = Some(Vec::new());
    for (name, weight) in &table.entries {
        let path = KeyPath::of(["distribution", "weights", name]);
        // Without all points and patches nobody can say that a side is wrong.
        let Some(known) = &points.names else {
            return None;
        };
        if !patches.complete() {
            return None;
        }
        let ends = match side(name, known, &sides) {
            Ok(ends) => ends,
            Err(fault) => {
                sink.error(|| fault.diagnostic(name, &path, &sides));
                weights = None;
                continue;
            }
        };
        if let Some(first) = seen.insert(sorted(ends), name) {
            sink.error(|| {
                let first = KeyPath::of(["distribution", "weights", first]);
                Diagnostic::error(
                    Code::new("E0212"),
                    format!("the side `{}` has two weights", shortened(name)),
                )
                .at_name(path.as_str(), "the same side again")
                .at_name(first.as_str(), "first")
                .help("keep one of them")
            });
            weights = None;
        }
        weights = weights.zip(weight.good()).map(|(mut weights, weight)| {
            weights.push((ends.map(str::to_owned), weight.si));
            weights
        });
    }
    weights
}

enum Fault<'a> {
    /// Not two points with a hyphen between them, or points that no side connects.
    NoSide,
    /// Point names with hyphens can be read in several ways.
    Several(Vec<[&'a str; 2]>),
}

/// `a-b` as two points. Names may hold hyphens, so every hyphen may be the dividing one; a side
/// of a patch is meant.
fn side<'a>(
    name: &'a str,
    points: &[&str],
    sides: &BTreeSet<[&str; 2]>,
) -> Result<[&'a str; 2], Fault<'a>> {
    let is_point = |name: &str| points.binary_search(&name).is_ok();
    let readings: Vec<[&str; 2]> = name
        .match_indices('-')
        .map(|(at, _)| [&name[..at], &name[at + 1..]])
        .filter(|ends| ends.iter().all(|end| is_point(end)) && sides.contains(&sorted(*ends)))
        .collect();
    match readings[..] {
        [] => Err(Fault::NoSide),
        [ends] => Ok(ends),
        _ => Err(Fault::Several(readings)),
    }
}

impl Fault<'_> {
    fn diagnostic(self, name: &str, path: &KeyPath, sides: &BTreeSet<[&str; 2]>) -> Diagnostic {
        let shown = shortened(name);
        match self {
            Self::NoSide => {
                let diagnostic = Diagnostic::error(
                    Code::new("E0211"),
                    format!("no patch has the side `{shown}`"),
                )
                .at_name(path.as_str(), "not two neighbouring corners of a patch");
                let both: Vec<String> = sides
                    .iter()
                    .flat_map(|[a, b]| [format!("{a}-{b}"), format!("{b}-{a}")])
                    .collect();
                let both: Vec<&str> = both.iter().map(String::as_str).collect();
                diagnostic.help(suggest::did_you_mean(name, &both).unwrap_or_else(|| {
                    "a side is written as its two anchors, such as `\"a-b\"`".to_owned()
                }))
            }
            Self::Several(readings) => {
                let readings: Vec<String> = readings
                    .iter()
                    .map(|[a, b]| format!("from `{a}` to `{b}`"))
                    .collect();
                Diagnostic::error(
                    Code::new("E0221"),
                    format!("the side `{shown}` can be read in {} ways", readings.len()),
                )
                .at_name(path.as_str(), "which of them?")
                .note(readings.join(", or "))
                .help("rename one of the points: a hyphen also divides the two ends of a side")
            }
        }
    }
}

fn closed(
    distribution: &DistributionSection,
    patches: &Patches<'_>,
    strips: &Strips,
    sink: &mut Sink,
) -> Option<Vec<(String, Family)>> {
    let Some(list) = section(distribution.closed.as_ref())? else {
        return Some(Vec::new());
    };
    let names: Vec<&str> = patches.names().collect();
    let mut closed = Some(Vec::new());
    for (index, item) in list.0.iter().enumerate() {
        let path = KeyPath::of(["distribution", "closed"]).index(index);
        let Some(item) = item.good() else {
            closed = None;
            continue;
        };
        if !patches.readable {
            return None;
        }
        let Some(patch) = names.iter().position(|name| *name == item.patch) else {
            undefined_patch(&path, &item.patch, &names, sink);
            closed = None;
            continue;
        };
        // Positions in the network count good patches only.
        let position = patches.good().position(|(index, _)| index == patch);
        let strip = position
            .map(|patch| Passage {
                patch,
                family: item.family,
            })
            .and_then(|passage| strips.of(passage));
        let is_ring = strip.map(|strip| strips.strips[strip].ring);
        if is_ring == Some(false) && patches.complete() {
            sink.error(|| {
                let letter = match item.family {
                    Family::U => "u",
                    Family::V => "v",
                };
                Diagnostic::error(
                    Code::new("E0214"),
                    format!("the strip of `{}.{letter}` is not a ring", item.patch),
                )
                .at_key(path.as_str(), "its members have two ends")
                .about(format!("{}.{letter}", item.patch))
                .help("name a family whose patches go around and meet again, or leave it out")
            });
            closed = None;
        }
        closed = closed.map(|mut closed| {
            closed.push((item.patch.clone(), item.family));
            closed
        });
    }
    closed
}

/// Reports a name that is no patch.
pub(super) fn undefined_patch(at: &KeyPath, name: &str, names: &[&str], sink: &mut Sink) {
    sink.error(|| {
        let shown = shortened(name);
        let diagnostic =
            Diagnostic::error(Code::new("E0202"), format!("there is no patch `{shown}`"))
                .at_name(at.as_str(), "not one of `patches`");
        match suggest::help(name, "patch", names.iter().copied()) {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        }
    });
}
