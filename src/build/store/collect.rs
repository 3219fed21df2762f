//! The collector: keeps the cache within its bounds.
//!
//! An entry's last use is the later of its file's time and the times of the worktree records that
//! list it; both are set when it is used (records at most hourly, and an entry that drops out of a
//! record is stamped as it does). In this order:
//!
//! 1. Records of worktrees that were not built for longer than the age limit go.
//! 2. Entries whose last use is longer ago than the age limit go.
//! 3. If the rest is larger than the size limit, entries that no record lists go, the longest
//!    unused first.
//!
//! Never goes: an entry younger than an hour, or one that the last build of a living worktree
//! used; the cache may exceed its size by these, and the report says so. Nothing goes while any
//! build is running: builds share a lock, and the collector gives up if it cannot have it alone.
//! Times only decide what is collected. A wrong clock makes builds slower, never wrong.

use super::super::clock::age;
use super::super::key::Digest;
use super::{Found, Kind, Store};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// How much the cache may keep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Limits {
    /// Bytes of all entries.
    pub size: u64,
    /// Time since the last use.
    pub age: Duration,
}

impl Default for Limits {
    /// 10 GB, 30 days.
    fn default() -> Self {
        Self {
            size: 10_000_000_000,
            age: Duration::from_secs(30 * 24 * 3600),
        }
    }
}

/// Whether something is done or only told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// It is done.
    Apply,
    /// It is told what would be done.
    DryRun,
}

/// What the collector did, or would do.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Collected {
    /// A build was running: nothing was done.
    pub busy: bool,
    /// Entries removed, and their bytes.
    pub removed: Tally,
    /// Entries kept, and their bytes.
    pub kept: Tally,
    /// Records of worktrees removed.
    pub worktrees: usize,
    /// Bytes above the limit that have to stay, because living worktrees use them or they are too
    /// young.
    pub excess: u64,
}

/// A number of entries and their bytes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// How many.
    pub entries: usize,
    /// How large together.
    pub bytes: u64,
}

impl Tally {
    pub(super) fn add(&mut self, bytes: u64) {
        self.entries += 1;
        self.bytes += bytes;
    }
}

/// An entry as the file system lists it.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) kind: Kind,
    pub(super) digest: Digest,
    pub(super) path: PathBuf,
    pub(super) size: u64,
    pub(super) modified: SystemTime,
}

/// Younger entries are never removed: a build that was killed may want them in its next try.
const YOUTH: Duration = Duration::from_secs(3600);
/// The collector comes by itself at most this often.
const INTERVAL: Duration = Duration::from_secs(24 * 3600);

impl Store {
    /// Collects if that was not done for a day.
    pub(crate) fn collect_if_due(&self, limits: &Limits, now: SystemTime) -> Option<Collected> {
        let stamp = self.root.join("collected");
        let last = fs::metadata(&stamp).and_then(|metadata| metadata.modified());
        if let Ok(last) = last
            && age(now, last) < INTERVAL
        {
            return None;
        }
        // A new cache has nothing to collect yet; its day begins now.
        let file = File::create(&stamp).ok()?;
        file.set_modified(now).ok();
        last.ok()?;
        let collected = self.collect(limits, now, Mode::Apply);
        (!collected.busy).then_some(collected)
    }

    /// Brings the cache within its limits.
    pub fn collect(&self, limits: &Limits, now: SystemTime, mode: Mode) -> Collected {
        let Some(_alone) = self.alone() else {
            return Collected {
                busy: true,
                ..Collected::default()
            };
        };
        let mut report = Collected::default();
        let roots = self.roots(limits, now, mode, &mut report);
        let mut kept = Vec::new();
        for entry in self.entries() {
            let root = roots.get(&entry.digest).copied();
            let used = root.map_or(entry.modified, |used| used.max(entry.modified));
            let unused = age(now, used);
            if unused > limits.age && age(now, entry.modified) > YOUTH {
                Self::discard(&entry, mode, &mut report);
            } else {
                report.kept.add(entry.size);
                kept.push((used, entry, root.is_some()));
            }
        }
        kept.sort_by_key(|(used, entry, _)| (*used, entry.digest));
        for (_, entry, rooted) in &kept {
            if report.kept.bytes <= limits.size {
                break;
            }
            if !rooted && age(now, entry.modified) > YOUTH {
                report.kept.entries -= 1;
                report.kept.bytes -= entry.size;
                Self::discard(entry, mode, &mut report);
            }
        }
        report.excess = report.kept.bytes.saturating_sub(limits.size);
        if mode == Mode::Apply {
            self.sweep(limits, now);
        }
        report
    }

    /// The exclusive side of the lock that builds share, if nobody builds. Where there are no
    /// locks nobody can say that, and nothing is collected.
    pub(super) fn alone(&self) -> Option<File> {
        let path = self.root.join("lock");
        let file = File::options().append(true).create(true).open(path).ok()?;
        file.try_lock().ok()?;
        Some(file)
    }

    /// When each entry was used last by a living worktree.
    fn roots(
        &self,
        limits: &Limits,
        now: SystemTime,
        mode: Mode,
        report: &mut Collected,
    ) -> BTreeMap<Digest, SystemTime> {
        let mut roots: BTreeMap<Digest, SystemTime> = BTreeMap::new();
        for (path, used) in files_in(&self.root.join("worktrees")) {
            if age(now, used) > limits.age {
                report.worktrees += 1;
                if mode == Mode::Apply {
                    fs::remove_file(path).ok();
                }
                continue;
            }
            let Found::Whole(worktree) = self.read_worktree(&path) else {
                continue;
            };
            for record in worktree.instances {
                let digests = [Some(record.key), record.head.digest()];
                for digest in digests.into_iter().flatten() {
                    let last = roots.entry(digest).or_insert(used);
                    *last = used.max(*last);
                }
            }
        }
        roots
    }

    /// All entries, in order of kind and digest.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        for kind in Kind::ALL {
            for shard in subfolders(&self.root.join(kind.folder())) {
                let prefix = shard.file_name().unwrap_or_default().to_string_lossy();
                let Ok(listing) = fs::read_dir(&shard) else {
                    continue;
                };
                for file in listing.flatten() {
                    let name = file.file_name();
                    let name = format!("{prefix}{}", name.to_string_lossy());
                    // What is not named as an entry is not the cache's business.
                    if let Some(digest) = Digest::from_hex(&name)
                        && let Ok(metadata) = file.metadata()
                        && let Ok(modified) = metadata.modified()
                    {
                        entries.push(Entry {
                            kind,
                            digest,
                            path: file.path(),
                            size: metadata.len(),
                            modified,
                        });
                    }
                }
            }
        }
        entries.sort_by_key(|entry| (entry.kind.folder(), entry.digest));
        entries
    }

    fn discard(entry: &Entry, mode: Mode, report: &mut Collected) {
        if mode == Mode::DryRun || fs::remove_file(&entry.path).is_ok() {
            report.removed.add(entry.size);
        } else {
            report.kept.add(entry.size);
        }
    }

    /// Removes what killed processes left, and old quarantine.
    fn sweep(&self, limits: &Limits, now: SystemTime) {
        let limits = [("tmp", YOUTH), ("quarantine", limits.age)];
        for (folder, limit) in limits {
            for (path, modified) in files_in(&self.root.join(folder)) {
                if age(now, modified) >= limit {
                    fs::remove_file(path).ok();
                }
            }
        }
        let shards: BTreeSet<PathBuf> = Kind::ALL
            .iter()
            .flat_map(|kind| subfolders(&self.root.join(kind.folder())))
            .collect();
        for shard in shards {
            // Fails where something is left in it.
            fs::remove_dir(shard).ok();
        }
    }
}

/// Files of a folder with their times, by name.
pub(super) fn files_in(folder: &Path) -> Vec<(PathBuf, SystemTime)> {
    let Ok(listing) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut files: Vec<_> = listing
        .flatten()
        .filter_map(|file| {
            let metadata = file.metadata().ok()?;
            let modified = metadata.modified().ok()?;
            metadata.is_file().then(|| (file.path(), modified))
        })
        .collect();
    files.sort();
    files
}

fn subfolders(folder: &Path) -> Vec<PathBuf> {
    let Ok(listing) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut folders: Vec<_> = listing.flatten().map(|entry| entry.path()).collect();
    folders.sort();
    folders
}
