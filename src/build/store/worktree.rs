//! What the last build of one output directory knew: the fast path of a build with nothing to do,
//! the memory of `explain`, and a root of the cache.
//!
//! One file holds the keys and heads of all instances, so that such a build opens it and nothing
//! else. It is no source of truth: without it every instance is still found in the store by its
//! key, only the reasons of the next build are lost. Recipes stay in the traces.

use super::super::declare::Instance;
use super::super::key::Digest;
use super::super::reason::Reason;
use super::super::stamp::Stamp;
use super::sealed::{self, Durability, Magic, Read};
use super::trace::Head;
use super::{Damage, Found, Store};
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

const WORKTREE: Magic = Magic(*b"eggtree1");

/// The record of one output directory.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Worktree {
    /// The output directory, for people who look at the cache.
    pub(crate) directory: String,
    /// All instances of the last complete build, sorted by name.
    pub(crate) instances: Vec<InstanceRecord>,
    /// What was published.
    pub(crate) outputs: Outputs,
    /// Files whose digest is known as long as their stamp stays.
    pub(crate) sources: Vec<SourceRecord>,
}

/// One instance, as it was last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct InstanceRecord {
    pub(crate) instance: Instance,
    pub(crate) key: Digest,
    /// Shared with the pass that finds it here.
    pub(crate) head: Arc<Head>,
    /// Why its result last became another one.
    pub(crate) changed_by: Vec<Reason>,
}

/// What stands in the output directory.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Outputs {
    /// The manifest's stamp.
    pub(crate) manifest: Option<Stamp>,
    /// One record an instance that publishes, sorted by its name.
    pub(crate) publications: Vec<PublicationRecord>,
}

/// The files of one instance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct PublicationRecord {
    pub(crate) owner: Instance,
    /// Digest of the instance's output.
    pub(crate) output: Digest,
    pub(crate) files: Vec<FileRecord>,
}

/// One published file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct FileRecord {
    pub(crate) path: String,
    pub(crate) content: Digest,
    pub(crate) stamp: Stamp,
}

/// One input file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SourceRecord {
    pub(crate) path: PathBuf,
    pub(crate) stamp: Stamp,
    pub(crate) content: Digest,
}

impl Worktree {
    /// The record of what `owner` published.
    pub(crate) fn publication(&self, owner: &Instance) -> Option<&PublicationRecord> {
        let publications = &self.outputs.publications;
        let index = publications
            .binary_search_by(|publication| publication.owner.cmp(owner))
            .ok()?;
        publications.get(index)
    }
}

impl Store {
    /// The record of an output directory. A damaged one is set aside.
    pub(crate) fn worktree(&self, directory: &Path) -> (Worktree, Option<Damage>) {
        let path = self.worktree_path(directory);
        match self.read_worktree(&path) {
            Found::Whole(worktree) => (worktree, None),
            Found::Absent => (Worktree::default(), None),
            Found::Damaged(damage) => (Worktree::default(), Some(damage)),
        }
    }

    /// Keeps the record, in use since `now`.
    pub(crate) fn put_worktree(
        &self,
        directory: &Path,
        worktree: &Worktree,
        now: SystemTime,
    ) -> io::Result<()> {
        let payload = postcard::to_stdvec(worktree).map_err(io::Error::other)?;
        let path = self.worktree_path(directory);
        self.write(&path, WORKTREE, &payload, Durability::Process)?;
        File::options().append(true).open(path)?.set_modified(now)
    }

    /// Says that everything the record lists is in use, once an hour.
    pub(crate) fn touch_worktree(&self, directory: &Path, now: SystemTime) {
        let path = self.worktree_path(directory);
        let Ok(file) = File::options().append(true).open(path) else {
            return;
        };
        let modified = file.metadata().and_then(|metadata| metadata.modified());
        let hour = std::time::Duration::from_secs(3600);
        if modified.is_ok_and(|then| super::super::clock::age(now, then) > hour) {
            file.set_modified(now).ok();
        }
    }

    pub(super) fn read_worktree(&self, path: &Path) -> Found<Worktree> {
        match sealed::read(path, WORKTREE) {
            Read::Whole(sealed) => match postcard::from_bytes(sealed.payload()) {
                Ok(worktree) => Found::Whole(worktree),
                Err(error) => Found::Damaged(self.set_aside(path, &error.to_string())),
            },
            Read::Absent => Found::Absent,
            Read::Damaged(what) => Found::Damaged(self.set_aside(path, &what)),
        }
    }

    /// What is wrong with a record, if anything; without setting it aside.
    pub(super) fn prove_worktree(path: &Path) -> Result<(), String> {
        match sealed::read(path, WORKTREE) {
            Read::Whole(sealed) => postcard::from_bytes::<Worktree>(sealed.payload())
                .map(drop)
                .map_err(|error| error.to_string()),
            Read::Absent => Ok(()),
            Read::Damaged(what) => Err(what),
        }
    }

    pub(super) fn worktree_path(&self, directory: &Path) -> PathBuf {
        let name = Digest::of(directory.as_os_str().as_encoded_bytes());
        self.root.join("worktrees").join(name.to_hex())
    }
}
