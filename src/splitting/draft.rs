//! A network of patches that is being split: anchors and patches, which `cut` changes.

use super::cut::stem;
use super::split::Stuck;
use crate::layout::Network;
use crate::project::model::{Anchor, Lamella, Patch, Point};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

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

    /// A name that no point has, beginning with a given one.
    pub(super) fn new_name(&self, wanted: &str) -> String {
        let taken: BTreeSet<&str> = self.points.iter().map(|p| p.name.as_str()).collect();
        if !taken.contains(wanted) {
            return wanted.to_owned();
        }
        // Of so many names one more than there are points is free.
        (2..taken.len() + 3)
            .map(|n| format!("{wanted}-{n}"))
            .find(|name| !taken.contains(name.as_str()))
            .unwrap_or_default()
    }

    /// A name that no patch has, beginning with a given one.
    pub(super) fn free_name(&self, wanted: &str) -> String {
        let taken = |name: &str| self.patches.iter().any(|p| p.name == name);
        let mut names = std::iter::once(wanted.to_owned())
            .chain((2..self.patches.len() + 3).map(|n| format!("{wanted}-{n}")));
        // Of so many names one more than there are patches is free.
        names.find(|name| !taken(name)).unwrap_or_default()
    }

    /// Calls the parts of each patch `west-1`, `west-2` in the order of the draft, whatever the parts
    /// of parts were called on the way; `stuck` is told too.
    pub(super) fn number_parts(&mut self, stuck: &mut Stuck) {
        let parts = self.patches.iter().filter(|p| p.name != p.origin);
        let parts: Vec<(String, String)> =
            parts.map(|p| (p.name.clone(), p.origin.clone())).collect();
        let whole = self.patches.iter().filter(|p| p.name == p.origin);
        let mut taken: BTreeSet<String> = whole.map(|p| p.name.clone()).collect();
        let mut names = BTreeMap::new();
        for (part, origin) in parts {
            let numbers = 1..taken.len() + 2;
            let mut wanted = numbers.map(|n| format!("{}-{n}", stem(&origin)));
            // One of so many numbers is free.
            let name = wanted
                .find(|name| !taken.contains(name))
                .unwrap_or_default();
            taken.insert(name.clone());
            names.insert(part, name);
        }
        let numbered = stuck.iter().map(|(name, refusal)| {
            let name = names.get(name).unwrap_or(name);
            (name.clone(), *refusal)
        });
        *stuck = numbered.collect();
        for patch in &mut self.patches {
            if let Some(name) = names.get(&patch.name) {
                patch.name.clone_from(name);
            }
        }
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
