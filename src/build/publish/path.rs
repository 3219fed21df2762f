//! Which paths outputs may have: the same everywhere, and never outside the output directory.

use std::collections::BTreeMap;

/// Names that one system or another keeps for devices.
const RESERVED: [&str; 22] = [
    "con", "prn", "aux", "nul", "com1", "com2", "com3", "com4", "com5", "com6", "com7", "com8",
    "com9", "lpt1", "lpt2", "lpt3", "lpt4", "lpt5", "lpt6", "lpt7", "lpt8", "lpt9",
];

/// What is wrong with the path of an output, if anything.
pub(super) fn fault(path: &str) -> Option<&'static str> {
    if path
        .chars()
        .any(|c| c.is_control() || "\\:*?\"<>|".contains(c))
    {
        return Some("contains a character that file names cannot have everywhere");
    }
    for part in path.split('/') {
        let stem = part.split('.').next().unwrap_or_default();
        if part.is_empty() || part == "." || part == ".." {
            return Some("does not stay in the output directory");
        }
        if part.ends_with(['.', ' ']) {
            return Some("has a part that ends in a dot or a blank");
        }
        if part.starts_with(".egg-") {
            return Some("is a name that egg keeps for itself");
        }
        if RESERVED.contains(&stem.to_lowercase().as_str()) {
            return Some("is a name that Windows keeps for a device");
        }
    }
    None
}

/// Pairs of paths that cannot both be files: equal but for case, or one below the other.
pub(super) fn collisions<'a>(
    paths: impl Iterator<Item = (&'a str, usize)>,
) -> Vec<(&'a str, usize, &'a str, usize)> {
    let mut by_folded: BTreeMap<String, (&str, usize)> = BTreeMap::new();
    let mut collisions = Vec::new();
    for (path, owner) in paths {
        if let Some((other, other_owner)) = by_folded.insert(folded(path), (path, owner)) {
            collisions.push((other, other_owner, path, owner));
        }
    }
    for (folded, &(path, owner)) in &by_folded {
        let folders = folded.match_indices('/').map(|(end, _)| &folded[..end]);
        for folder in folders {
            if let Some(&(other, other_owner)) = by_folded.get(folder) {
                collisions.push((other, other_owner, path, owner));
            }
        }
    }
    collisions
}

/// Paths that some file systems take for the same have the same folded form.
pub(super) fn folded(path: &str) -> String {
    path.to_lowercase()
}
