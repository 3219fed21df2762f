//! Patches: four different defined corners, each quadrilateral once, no side of three patches.

use super::points;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::PatchFile;
use crate::project::file::ProjectFile;
use crate::project::file::anchors::Alpha;
use crate::project::file::reader::{Defaulted, Field, Sink};
use std::collections::BTreeMap;

/// Patches as far as they are good.
pub(super) struct Patches<'f> {
    /// In the order of the file.
    pub(super) all: Vec<PatchNames<'f>>,
    /// Whether the table could be read.
    pub(super) readable: bool,
}

pub(super) struct PatchNames<'f> {
    pub(super) name: &'f str,
    /// `None` if reported.
    pub(super) corners: Option<[&'f str; 4]>,
    /// `None` if reported.
    pub(super) alpha: Option<Alpha>,
}

impl<'f> Patches<'f> {
    /// Patches with good corners, in order: their index in the file and the corners.
    pub(super) fn good(&self) -> impl Iterator<Item = (usize, [&'f str; 4])> {
        let corners = |(index, patch): (usize, &PatchNames<'f>)| Some((index, patch.corners?));
        self.all.iter().enumerate().filter_map(corners)
    }

    /// Whether every patch has good corners.
    pub(super) fn complete(&self) -> bool {
        self.readable && self.all.iter().all(|patch| patch.corners.is_some())
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &'f str> {
        self.all.iter().map(|patch| patch.name)
    }
}

pub(super) fn check<'f>(
    file: &'f ProjectFile,
    points: Option<&[&'f str]>,
    sink: &mut Sink,
) -> Patches<'f> {
    let Some(table) = file.patches.good() else {
        return Patches {
            all: Vec::new(),
            readable: false,
        };
    };
    let mut all: Vec<PatchNames<'_>> = table
        .entries
        .iter()
        .map(|(name, patch)| match patch {
            Field::Bad => PatchNames {
                name,
                corners: None,
                alpha: None,
            },
            Field::Good(patch) => PatchNames {
                name,
                corners: points.and_then(|points| corners(name, patch, points, sink)),
                alpha: patch.alpha.said_or(Alpha::Auto),
            },
        })
        .collect();
    repeated(&mut all, sink);
    Patches {
        all,
        readable: true,
    }
}

fn corners<'f>(
    name: &str,
    patch: &'f PatchFile,
    points: &[&'f str],
    sink: &mut Sink,
) -> Option<[&'f str; 4]> {
    let path = KeyPath::of(["patches", name, "corners"]);
    let named = &patch.corners.good()?.0;
    let mut good = true;
    let mut corners = Vec::with_capacity(4);
    for (index, corner) in named.iter().enumerate() {
        let Some(corner) = corner.good() else {
            good = false;
            continue;
        };
        let corner = corner.0.as_str();
        if points.binary_search(&corner).is_err() {
            points::undefined(&path.index(index), corner, points, sink);
            good = false;
        } else if let Some(first) = corners.iter().position(|other| *other == Some(corner)) {
            sink.error(|| {
                Diagnostic::error(
                    Code::new("E0205"),
                    format!("the patch `{name}` has the corner `{corner}` twice"),
                )
                .at_key(path.index(index).as_str(), "again")
                .at_key(path.index(first).as_str(), "first")
                .about(name)
                .help("a patch has four different corners; split a triangle into three quadrilaterals")
            });
            good = false;
        }
        corners.push(Some(corner));
    }
    if !good {
        return None;
    }
    let corners: Vec<&str> = corners.into_iter().flatten().collect();
    corners.try_into().ok()
}

/// Reports patches with the same four corners and takes the later ones out.
fn repeated(all: &mut [PatchNames<'_>], sink: &mut Sink) {
    let mut seen: BTreeMap<[&str; 4], &str> = BTreeMap::new();
    for patch in all {
        let Some(mut corners) = patch.corners else {
            continue;
        };
        corners.sort_unstable();
        let name = patch.name;
        if let Some(first) = seen.get(&corners) {
            sink.error(|| {
                let path = |name| KeyPath::of(["patches", name, "corners"]);
                Diagnostic::error(
                    Code::new("E0220"),
                    format!("the patches `{first}` and `{name}` have the same corners"),
                )
                .at_key(path(name).as_str(), "the same four anchors")
                .at_key(path(first).as_str(), format!("as `{first}`"))
                .about(name)
                .help("remove one of them, or correct a corner")
            });
            patch.corners = None;
        } else {
            seen.insert(corners, name);
        }
    }
}
