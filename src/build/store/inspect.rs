//! Looking at a cache as a whole: what is in it, whether it is sound, and emptying it.

use super::collect::{Mode, Tally, files_in};
use super::sealed::{self, Read};
use super::trace::Trace;
use super::{Damage, Found, Kind, Store};
use serde::Serialize;
use std::fs;
use std::path::Path;
use std::time::SystemTime;

/// What is in a cache.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Status {
    /// Where it is.
    pub directory: String,
    /// Records of runs.
    pub traces: Tally,
    /// Encoded outputs.
    pub blobs: Tally,
    /// Damaged files that were set aside.
    pub quarantined: Tally,
    /// The oldest entry's time.
    pub oldest: Option<SystemTime>,
    /// Output directories that the cache knows, with the time of their last build.
    pub worktrees: Vec<WorktreeStatus>,
}

/// An output directory that the cache knows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct WorktreeStatus {
    /// Where it is, or was.
    pub directory: String,
    /// When it was built last, to the hour.
    pub used: SystemTime,
    /// Number of instances.
    pub instances: usize,
    /// Bytes of its results.
    pub bytes: u64,
}

/// What verifying found.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Verified {
    /// Whole files.
    pub sound: Tally,
    /// Damaged files. Unless it was a dry run they are set aside now.
    pub damaged: Vec<Damage>,
    /// Traces whose blob is gone: their instances run again when the value is needed.
    pub dangling: usize,
}

/// What emptying did, or would do.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Cleaned {
    /// A build was running: nothing was done.
    pub busy: bool,
    /// Files removed, and their bytes.
    pub removed: Tally,
}

impl Store {
    /// What is in the cache.
    pub fn status(&self) -> Status {
        let mut status = Status {
            directory: self.directory().display().to_string(),
            traces: Tally::default(),
            blobs: Tally::default(),
            quarantined: Tally::default(),
            oldest: None,
            worktrees: Vec::new(),
        };
        for entry in self.entries() {
            match entry.kind {
                Kind::Trace => status.traces.add(entry.size),
                Kind::Blob => status.blobs.add(entry.size),
            }
            let oldest = status.oldest.get_or_insert(entry.modified);
            *oldest = entry.modified.min(*oldest);
        }
        for (path, _) in files_in(&self.root.join("quarantine")) {
            status.quarantined.add(size(&path));
        }
        for (path, used) in files_in(&self.root.join("worktrees")) {
            if let Found::Whole(worktree) = self.read_worktree(&path) {
                let outputs = worktree.instances.iter();
                let bytes = outputs.filter_map(|record| Some(record.head.output.as_ref()?.size));
                status.worktrees.push(WorktreeStatus {
                    bytes: bytes.sum(),
                    instances: worktree.instances.len(),
                    directory: worktree.directory,
                    used,
                });
            }
        }
        status
    }

    /// Reads everything and proves it.
    pub fn verify(&self, mode: Mode) -> Verified {
        let mut verified = Verified::default();
        let mut damaged = |path: &Path, what: &str| {
            verified.damaged.push(match mode {
                Mode::Apply => self.set_aside(path, what),
                Mode::DryRun => self.damage(path, what),
            });
        };
        let mut sound = Tally::default();
        let mut dangling = 0;
        for entry in self.entries() {
            match sealed::read(&entry.path, entry.kind.magic()) {
                Read::Absent => {}
                Read::Damaged(what) => damaged(&entry.path, &what),
                Read::Whole(sealed) => match entry.kind {
                    Kind::Blob if sealed.digest != entry.digest => {
                        damaged(&entry.path, "under a wrong name");
                    }
                    Kind::Blob => sound.add(entry.size),
                    Kind::Trace => match postcard::from_bytes::<Trace>(sealed.payload()) {
                        Ok(trace) if trace.key == entry.digest => {
                            sound.add(entry.size);
                            let output = trace.head.output.as_ref();
                            dangling += usize::from(output.is_some_and(|one| !self.holds(one)));
                        }
                        Ok(_) => damaged(&entry.path, "under a wrong name"),
                        Err(error) => damaged(&entry.path, &error.to_string()),
                    },
                },
            }
        }
        for (path, _) in files_in(&self.root.join("worktrees")) {
            match Self::prove_worktree(&path) {
                Ok(()) => sound.add(size(&path)),
                Err(what) => damaged(&path, &what),
            }
        }
        verified.sound = sound;
        verified.dangling = dangling;
        verified
    }

    /// Removes everything.
    pub fn clean(&self, mode: Mode) -> Cleaned {
        let mut cleaned = Cleaned::default();
        if !self.root.exists() {
            return cleaned;
        }
        let Some(_alone) = self.alone() else {
            cleaned.busy = true;
            return cleaned;
        };
        let mut folders = vec![self.root.clone()];
        while let Some(folder) = folders.pop() {
            let Ok(listing) = fs::read_dir(&folder) else {
                continue;
            };
            for entry in listing.flatten() {
                let path = entry.path();
                if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                    folders.push(path);
                } else if path != self.root.join("lock") {
                    cleaned.removed.add(size(&path));
                }
            }
        }
        if mode == Mode::Apply {
            for kind in [
                "traces",
                "blobs",
                "worktrees",
                "leases",
                "quarantine",
                "tmp",
            ] {
                fs::remove_dir_all(self.root.join(kind)).ok();
            }
            fs::remove_file(self.root.join("collected")).ok();
        }
        cleaned
    }

    /// Forgets what the cache knows of one output directory, so that its results can be collected
    /// once they are old.
    pub fn forget(&self, directory: &Path, mode: Mode) -> Cleaned {
        let mut cleaned = Cleaned::default();
        let absolute = std::path::absolute(directory).unwrap_or_else(|_| directory.to_owned());
        let path = self.worktree_path(&absolute);
        if path.exists() {
            cleaned.removed.add(size(&path));
            if mode == Mode::Apply {
                fs::remove_file(path).ok();
            }
        }
        cleaned
    }
}

fn size(path: &Path) -> u64 {
    fs::metadata(path).map_or(0, |metadata| metadata.len())
}
