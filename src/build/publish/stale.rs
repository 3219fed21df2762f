//! What is left over in the output directory: files that nobody makes any more, temporary files
//! of builds that were killed.

use super::super::key::Digest;
use super::super::store::sealed::TEMPORARY_PREFIX;
use super::super::store::worktree::Outputs;
use super::Publication;
use super::claim::{Claim, Claimed};
use super::manifest::{Manifest, Written, owner_name};
use super::path::{fault, folded};
use super::replace::{Publishing, unwritable};
use crate::diagnostics::{Code, Diagnostic};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// What becomes of a file that nobody claims.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fate {
    Remove,
    /// The manifest drops it; the file is not ours, or not what its name says.
    Forget,
}

impl Publishing<'_> {
    /// Removes what is left over, and returns what is there then.
    pub(super) fn remove_stale(
        &self,
        old: &Manifest,
        refused: &BTreeSet<usize>,
        failed: &BTreeSet<String>,
        publication: &mut Publication,
    ) -> Manifest {
        let mut manifest = Manifest::default();
        for (claim, file, digest) in self.wanted(refused) {
            if failed.contains(&file.path) {
                if let Some(written) = old.files.get(&file.path) {
                    manifest.files.insert(file.path.clone(), written.clone());
                }
            } else {
                manifest.add(&file.path, &owner_name(&claim.owner), digest);
            }
        }
        for claim in &self.claims {
            if let Claimed::Standing(record) = &claim.files {
                for file in &record.files {
                    manifest.add(&file.path, &owner_name(&claim.owner), file.content);
                }
            }
        }
        let left_over = self.left_over(old, refused);
        for (path, written) in &old.files {
            if manifest.files.contains_key(path) {
                continue;
            }
            match left_over.get(path.as_str()) {
                Some(Fate::Remove) => self.remove(path, written, publication),
                Some(Fate::Forget) => {}
                None => {
                    manifest.files.insert(path.clone(), written.clone());
                }
            }
        }
        manifest
    }

    /// Removes left-over files that stand where a folder is wanted, or below where a file is.
    pub(super) fn clear_way(
        &self,
        old: &Manifest,
        refused: &BTreeSet<usize>,
        publication: &mut Publication,
    ) {
        let below = |path: &str, folder: &str| {
            let rest = path.strip_prefix(folder);
            rest.is_some_and(|rest| rest.starts_with('/'))
        };
        for (path, fate) in self.left_over(old, refused) {
            if fate == Fate::Forget {
                continue;
            }
            let mut wanted = self.wanted(refused);
            if wanted.any(|(_, file, _)| below(path, &file.path) || below(&file.path, path)) {
                self.remove(path, &old.files[path], publication);
            }
        }
    }

    /// Files of egg's that nobody claims: their owner has a result without them, or is gone.
    fn left_over<'m>(
        &self,
        old: &'m Manifest,
        refused: &BTreeSet<usize>,
    ) -> BTreeMap<&'m str, Fate> {
        let claims = self.claims.iter().enumerate();
        let settled: BTreeSet<String> = claims
            .filter(|(index, _)| !refused.contains(index))
            .map(|(_, claim)| owner_name(&claim.owner))
            .collect();
        let claimed: BTreeMap<String, &str> = self
            .claims
            .iter()
            .flat_map(Claim::paths)
            .map(|path| (folded(path), path))
            .collect();
        let place = |path: &str| fs::canonicalize(self.directory.join(path)).ok();
        let mut left_over = BTreeMap::new();
        for (path, written) in &old.files {
            if !settled.contains(&written.owner) && !(self.is_gone)(&written.owner) {
                continue;
            }
            let fate = match claimed.get(&folded(path)) {
                Some(&same) if same == path => continue,
                // Where case does not tell files apart, the old name is the new file.
                Some(&other) if place(other) == place(path) => Fate::Forget,
                _ if fault(path).is_some() => Fate::Forget,
                _ => Fate::Remove,
            };
            left_over.insert(path.as_str(), fate);
        }
        left_over
    }

    fn remove(&self, path: &str, written: &Written, told: &mut Publication) {
        let target = self.directory.join(path);
        match fs::read(&target) {
            Ok(bytes) if written.contents.contains(&Digest::of(&bytes)) => {
                match fs::remove_file(&target) {
                    Ok(()) => told.removed.push(path.to_owned()),
                    Err(error) => told.diagnostics.push(unwritable(path, &error)),
                }
            }
            Ok(_) => told.diagnostics.push(
                Diagnostic::warning(
                    Code::new("W0805"),
                    format!("`{path}` is no longer made, but it had been edited; it stays"),
                )
                .help("remove it by hand, or keep it: egg leaves it alone from now on"),
            ),
            Err(_) => {}
        }
        // Folders that are empty now; the first that is not ends it.
        let mut folder = target.parent();
        while let Some(path) = folder
            && path != self.directory
            && fs::remove_dir(path).is_ok()
        {
            folder = path.parent();
        }
    }

    /// Removes temporary files of builds that were killed while they published.
    pub(super) fn sweep(&self, old: &Manifest) {
        let claimed = self.claims.iter().flat_map(Claim::paths);
        let known = claimed.chain(old.files.keys().map(String::as_str));
        for file in temporary_files(self.directory, known) {
            fs::remove_file(file).ok();
        }
    }
}

/// Temporary files beside those that egg writes, of builds that were killed or are at work.
fn temporary_files<'a>(directory: &Path, paths: impl Iterator<Item = &'a str>) -> Vec<PathBuf> {
    let mut folders: BTreeSet<&Path> = BTreeSet::from([Path::new("")]);
    folders.extend(
        paths
            .filter(|path| fault(path).is_none())
            .filter_map(|path| Path::new(path).parent()),
    );
    let entries = folders
        .into_iter()
        .filter_map(|folder| fs::read_dir(directory.join(folder)).ok())
        .flat_map(Iterator::flatten);
    entries
        .filter(|entry| {
            let name = entry.file_name();
            name.to_string_lossy().starts_with(TEMPORARY_PREFIX)
        })
        .map(|entry| entry.path())
        .collect()
}

/// Whether no build has left temporary files beside those that are recorded.
pub(in super::super) fn is_swept(directory: &Path, outputs: &Outputs) -> bool {
    let files = outputs.publications.iter().flat_map(|one| &one.files);
    temporary_files(directory, files.map(|file| file.path.as_str())).is_empty()
}
