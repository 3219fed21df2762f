//! From a split draft to a project whose patches are the parts, and from the parts back to what the
//! project file says.

use crate::diagnostics::KeyPath;
use crate::layout::{Network, SidePiece};
use crate::project::model::{Family, Patch, Project};
use crate::splitting::{Draft, DraftPatch};
use std::collections::BTreeMap;

/// Where parts and their points come from, by name. What is not in here stands in the project file
/// under its own name.
#[derive(Debug, Default)]
pub(super) struct Origins {
    /// The patch of the file that a patch is a part of.
    patches: BTreeMap<String, String>,
    /// The patch of the file for which a point was added.
    points: BTreeMap<String, String>,
}

impl Origins {
    /// Of a draft.
    pub(super) fn of(project: &Project, draft: &Draft) -> Self {
        let parts = draft.patches.iter();
        let patches = parts.clone().map(|p| (p.name.clone(), p.origin.clone()));
        let corner_of = |name: &str| {
            let has = |p: &&DraftPatch| p.corners.iter().any(|corner| corner == name);
            draft.patches.iter().find(has)
        };
        let added = draft
            .points
            .iter()
            .filter(|point| project.points.iter().all(|known| known.name != point.name));
        Self {
            patches: patches.collect(),
            points: added
                .filter_map(|p| Some((p.name.clone(), corner_of(&p.name)?.origin.clone())))
                .collect(),
        }
    }

    /// The patch of the file that stands for a patch.
    pub(super) fn patch<'a>(&'a self, name: &'a str) -> &'a str {
        self.patches.get(name).map_or(name, String::as_str)
    }

    /// The key that stands for a patch.
    pub(super) fn patch_key(&self, name: &str) -> String {
        KeyPath::of(["patches", self.patch(name)]).into()
    }

    /// The key that stands for a point.
    pub(super) fn point_key(&self, name: &str) -> String {
        match self.points.get(name) {
            Some(patch) => KeyPath::of(["patches", patch]).into(),
            None => KeyPath::of(["points", name]).into(),
        }
    }
}

/// The draft of a project: its points and patches by name.
pub(super) fn draft_of(project: &Project) -> Draft {
    let mut points = project.points.clone();
    points.sort_by(|a, b| a.name.cmp(&b.name));
    let mut patches: Vec<DraftPatch> = project
        .patches
        .iter()
        .map(|patch| DraftPatch {
            name: patch.name.clone(),
            origin: patch.name.clone(),
            corners: patch.corners.clone(),
            members: [Family::U, Family::V].map(|family| super::passages::count(patch, family)),
            alpha: patch.alpha,
            width: patch.lamella.width,
        })
        .collect();
    patches.sort_by(|a, b| a.name.cmp(&b.name));
    Draft { points, patches }
}

/// The project with the points and patches of a draft. Parts have the lamellae of their origin,
/// parts of a weighted side its weight, parts in a closed strip are closed.
pub fn laid_out(project: &Project, draft: &Draft) -> Project {
    let mut laid = project.clone();
    laid.points.clone_from(&draft.points);
    laid.patches = draft
        .patches
        .iter()
        .filter_map(|part| {
            let origin = project.patches.iter().find(|p| p.name == part.origin)?;
            let [u, v] = part.members;
            Some(Patch {
                name: part.name.clone(),
                corners: part.corners.clone(),
                u: Some(u),
                v: Some(v),
                alpha: part.alpha,
                lamella: origin.lamella.clone(),
            })
        })
        .collect();
    laid.distribution.weights = weights(project, &laid);
    laid.distribution.closed = project
        .distribution
        .closed
        .iter()
        .flat_map(|(patch, family)| {
            let parts = draft.patches.iter().filter(|p| p.origin == *patch);
            parts.map(|part| (part.name.clone(), *family))
        })
        .collect();
    laid
}

/// Weights of sides as those of the sides that they fell into.
fn weights(project: &Project, laid: &Project) -> Vec<([String; 2], f64)> {
    let network = Network::new(&laid.points, &laid.patches);
    let share = |line: usize, name: &str| {
        let stations = network.lines[line].stations.iter();
        let station = stations.clone().find(|s| s.name == name)?;
        Some(station.share)
    };
    let mut weights: Vec<([String; 2], f64)> = Vec::new();
    for ([a, b], weight) in &project.distribution.weights {
        for &SidePiece { line, from, to } in network.sides.iter().flatten() {
            let Some((one, other)) = share(line, a).zip(share(line, b)) else {
                continue;
            };
            let stations = &network.lines[line].stations;
            let inside = |i: usize| {
                let at = stations[i].share;
                at >= one.min(other) && at <= one.max(other)
            };
            let ends = [from.min(to), from.max(to)].map(|i| stations[i].name.clone());
            let known = weights.iter().any(|(known, _)| *known == ends);
            if inside(from) && inside(to) && !known {
                weights.push((ends, *weight));
            }
        }
    }
    weights
}
