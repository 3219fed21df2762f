//! The replacement of published files, under the directory's lock.

use super::super::key::Digest;
use super::super::request::Foreign;
use super::super::stamp::Stamp;
use super::super::store::sealed::{Durability, replace};
use super::super::store::worktree::{FileRecord, Outputs, PublicationRecord};
use super::Publication;
use super::claim::{Claim, Claimed, refuse};
use super::manifest::{MANIFEST, Manifest, owner_name};
use crate::diagnostics::{Code, Diagnostic};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::time::Duration;

/// One publication.
pub(in crate::build) struct Publishing<'a> {
    pub(in crate::build) directory: &'a Path,
    pub(in crate::build) claims: Vec<Claim>,
    /// Records of instances that have no claim this time and keep their files.
    pub(in crate::build) others: Vec<PublicationRecord>,
    /// Whether files of an owner that makes no claim are left over.
    pub(in crate::build) is_gone: &'a dyn Fn(&str) -> bool,
    pub(in crate::build) foreign: Foreign,
}

/// What is to be done with a wanted file.
enum Action {
    Keep,
    Write,
    /// Replace what somebody edited.
    Overwrite,
}

impl Publishing<'_> {
    /// Brings the directory in line.
    pub(in crate::build) fn run(self) -> (Outputs, Publication) {
        let mut publication = Publication::default();
        let wants_files = self.claims.iter().any(|claim| !claim.is_empty());
        if !self.directory.exists() && !wants_files {
            return (Outputs::default(), publication);
        }
        if let Err(error) = fs::create_dir_all(self.directory) {
            publication
                .diagnostics
                .push(unwritable(&self.directory.display().to_string(), &error));
            return (Outputs::default(), publication);
        }
        let _lock = lock(self.directory);
        let path = self.directory.join(MANIFEST);
        let before = fs::read_to_string(&path).unwrap_or_default();
        let old = Manifest::read(&before);
        self.sweep(&old);
        let refused = refuse(&self.claims, &mut publication);
        self.clear_way(&old, &refused, &mut publication);
        let (actions, refused) = self.decide(&old, refused, &mut publication);

        // First say what may be there, then write, then say what is there: after a crash at any
        // point, every file with our contents is known to be ours.
        let mut ahead = old.clone();
        for (claim, file, digest) in self.wanted(&refused) {
            ahead.add(&file.path, &owner_name(&claim.owner), digest);
        }
        let ahead = ahead.write();
        let writes = actions
            .values()
            .any(|action| !matches!(action, Action::Keep));
        if writes
            && ahead != before
            && let Err(error) = self.write(MANIFEST, ahead.as_bytes())
        {
            publication.diagnostics.push(unwritable(MANIFEST, &error));
            return (Outputs::default(), publication);
        }
        let failed = self.write_all(&refused, &actions, &mut publication);
        let manifest = self.remove_stale(&old, &refused, &failed, &mut publication);
        let after = manifest.write();
        let current = if writes { ahead } else { before };
        if after != current
            && !(manifest.files.is_empty() && current.is_empty())
            && let Err(error) = self.write(MANIFEST, after.as_bytes())
        {
            publication.diagnostics.push(unwritable(MANIFEST, &error));
        }
        publication.written.sort();
        publication.removed.sort();
        (self.record(&refused, &failed), publication)
    }

    /// Compares every wanted file with what is there.
    fn decide(
        &self,
        old: &Manifest,
        mut refused: BTreeSet<usize>,
        publication: &mut Publication,
    ) -> (BTreeMap<&str, Action>, BTreeSet<usize>) {
        let mut actions = BTreeMap::new();
        for (index, claim) in self.claims.iter().enumerate() {
            let Claimed::Wanted(files) = &claim.files else {
                continue;
            };
            if refused.contains(&index) {
                continue;
            }
            for file in files.iter() {
                let action = match fs::read(self.directory.join(&file.path)) {
                    Ok(bytes) if bytes == file.bytes => Action::Keep,
                    Ok(bytes) if old.knows(&file.path, Digest::of(&bytes)) => Action::Write,
                    Ok(_) if old.files.contains_key(&file.path) => Action::Overwrite,
                    Err(error) if error.kind() == io::ErrorKind::NotFound => Action::Write,
                    Ok(_) if self.foreign == Foreign::Replace => Action::Overwrite,
                    Ok(_) | Err(_) => {
                        refused.insert(index);
                        publication.diagnostics.push(foreign(&file.path));
                        continue;
                    }
                };
                actions.insert(file.path.as_str(), action);
            }
        }
        (actions, refused)
    }

    /// Writes what has to be written; returns the paths that could not be.
    fn write_all(
        &self,
        refused: &BTreeSet<usize>,
        actions: &BTreeMap<&str, Action>,
        publication: &mut Publication,
    ) -> BTreeSet<String> {
        let mut failed = BTreeSet::new();
        for (_, file, _) in self.wanted(refused) {
            let action = actions.get(file.path.as_str());
            if matches!(action, None | Some(Action::Keep)) {
                publication.unchanged += 1;
                continue;
            }
            if let Err(error) = self.write(&file.path, &file.bytes) {
                publication.diagnostics.push(unwritable(&file.path, &error));
                failed.insert(file.path.clone());
                continue;
            }
            if matches!(action, Some(Action::Overwrite)) {
                let what = format!("`{}` had been edited; it is replaced", file.path);
                publication
                    .diagnostics
                    .push(Diagnostic::warning(Code::new("W0804"), what).help(
                    "edit a copy under another name: files in the output directory are made anew",
                ));
            }
            publication.written.push(file.path.clone());
        }
        for claim in &self.claims {
            if let Claimed::Standing(record) = &claim.files {
                publication.unchanged += record.files.len();
            }
        }
        failed
    }

    /// Files to be published, with owner and digest.
    pub(super) fn wanted<'s>(
        &'s self,
        refused: &'s BTreeSet<usize>,
    ) -> impl Iterator<Item = (&'s Claim, &'s super::OutputFile, Digest)> {
        let claims = self.claims.iter().enumerate();
        claims
            .filter(|(index, _)| !refused.contains(index))
            .filter_map(|(_, claim)| match &claim.files {
                Claimed::Wanted(files) => Some((claim, files)),
                Claimed::Standing(_) => None,
            })
            .flat_map(|(claim, files)| {
                files
                    .iter()
                    .map(move |file| (claim, file, Digest::of(&file.bytes)))
            })
    }

    fn write(&self, path: &str, bytes: &[u8]) -> io::Result<()> {
        let target = self.directory.join(path);
        let folder = target.parent().unwrap_or(self.directory);
        replace(&target, folder, &[bytes], Durability::Process)
    }

    fn record(&self, refused: &BTreeSet<usize>, failed: &BTreeSet<String>) -> Outputs {
        let stamp = |path: &str| {
            let metadata = fs::metadata(self.directory.join(path)).ok()?;
            Some(Stamp::of(&metadata))
        };
        let mut publications = self.others.clone();
        for (index, claim) in self.claims.iter().enumerate() {
            let files = match &claim.files {
                Claimed::Standing(record) => record.files.clone(),
                Claimed::Wanted(files) => {
                    let stands = |file: &&super::OutputFile| {
                        !refused.contains(&index) && !failed.contains(&file.path)
                    };
                    let all = files.iter().filter(stands).filter_map(|file| {
                        Some(FileRecord {
                            path: file.path.clone(),
                            content: Digest::of(&file.bytes),
                            stamp: stamp(&file.path)?,
                        })
                    });
                    let recorded: Vec<FileRecord> = all.collect();
                    if recorded.len() != files.iter().len() {
                        // Not as it should be: without a record it is compared again next time.
                        continue;
                    }
                    recorded
                }
            };
            publications.push(PublicationRecord {
                owner: (*claim.owner).clone(),
                output: claim.output,
                files,
            });
        }
        publications.sort_by(|a, b| a.owner.cmp(&b.owner));
        Outputs {
            manifest: stamp(MANIFEST),
            publications,
        }
    }
}

/// Builds that publish to one directory take turns; publishing is short. Where directories cannot
/// be locked, or a process hangs while it publishes, this one goes on: every file is whole anyway.
fn lock(directory: &Path) -> Option<File> {
    let file = File::open(directory).ok()?;
    for _ in 0..1000 {
        match file.try_lock() {
            Ok(()) => return Some(file),
            Err(fs::TryLockError::WouldBlock) => std::thread::sleep(Duration::from_millis(10)),
            Err(fs::TryLockError::Error(_)) => return None,
        }
    }
    None
}

fn foreign(path: &str) -> Diagnostic {
    let what = format!("`{path}` is in the way, and egg did not write it");
    Diagnostic::error(Code::new("E0813"), what).help("move it, or choose another output directory")
}

/// Says that a file of the output directory could not be written.
pub(super) fn unwritable(path: &str, error: &io::Error) -> Diagnostic {
    Diagnostic::error(
        Code::new("E0814"),
        format!("cannot write `{path}`: {error}"),
    )
}
