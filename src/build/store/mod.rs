//! The store: what stages gave, found by key, kept by content.
//!
//! ```text
//! <cache>/CACHEDIR.TAG          backup programs pass it by
//! <cache>/v1/traces/a/bcdef…    one record a key: digest of the output, diagnostics, recipe
//! <cache>/v1/blobs/a/bcdef…     one encoded output a digest
//! <cache>/v1/worktrees/ab…      one record an output directory: the instances of its last build
//! <cache>/v1/leases/ab          locked while a key that begins like this is computed
//! <cache>/v1/quarantine/        damaged files, set aside
//! <cache>/v1/tmp/               files that are being written
//! <cache>/v1/lock               shared by builds, exclusive for the collector
//! <cache>/v1/collected          when the collector ran last
//! ```
//!
//! Rules: a blob is written before the trace that names it; files appear whole, by rename, and
//! never change afterwards; every read is proven by digest, and what fails is set aside and
//! missing from then on. So a crash leaves garbage, never a lie, and readers and writers need no
//! locks. Nothing in keys or names depends on where the project lies: worktrees, clones and
//! continuous integration can share one cache, and copying one into another is a union.

pub(crate) mod collect;
pub(crate) mod inspect;
pub(crate) mod lease;
pub(crate) mod sealed;
pub(crate) mod trace;
pub(crate) mod worktree;

use super::key::Digest;
use sealed::{Durability, Magic, Read, Sealed};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use trace::{Output, Trace};

const BLOB: Magic = Magic(*b"eggblob1");
const TRACE: Magic = Magic(*b"eggtrce1");
const VERSION_DIRECTORY: &str = "v1";
/// Digits of a digest that make a folder: enough that folders stay quick to list, few enough that
/// a new cache does not spend its time on making them.
const SHARD: usize = 1;

/// A cache directory.
#[derive(Debug)]
pub struct Store {
    /// The directory that the user named.
    cache: PathBuf,
    /// The part of it that has this format.
    root: PathBuf,
}

/// What a look-up gave.
#[derive(Debug)]
pub(crate) enum Found<T> {
    Whole(T),
    Absent,
    /// There was something, and it has been set aside.
    Damaged(Damage),
}

/// A damaged file of the cache.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Damage {
    /// The file, relative to the cache directory.
    pub file: String,
    /// What is wrong with it.
    pub what: String,
}

/// The kinds of entries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Records of runs.
    Trace,
    /// Encoded outputs.
    Blob,
}

impl Kind {
    const ALL: [Self; 2] = [Self::Trace, Self::Blob];

    const fn folder(self) -> &'static str {
        match self {
            Self::Trace => "traces",
            Self::Blob => "blobs",
        }
    }

    const fn magic(self) -> Magic {
        match self {
            Self::Trace => TRACE,
            Self::Blob => BLOB,
        }
    }
}

impl Store {
    /// A store in `cache`. Nothing is touched before the first write.
    pub fn new(cache: impl Into<PathBuf>) -> Self {
        let cache = cache.into();
        Self {
            root: cache.join(VERSION_DIRECTORY),
            cache,
        }
    }

    /// The directory that the user named.
    pub fn directory(&self) -> &Path {
        &self.cache
    }

    pub(crate) fn put_blob(&self, payload: &[u8], durability: Durability) -> io::Result<Digest> {
        let path = self.entry(Kind::Blob, Digest::of(payload));
        self.write(&path, BLOB, payload, durability)
    }

    pub(crate) fn blob(&self, digest: Digest) -> Found<Sealed> {
        let path = self.entry(Kind::Blob, digest);
        match self.read(&path, BLOB) {
            Found::Whole(sealed) if sealed.digest != digest => {
                Found::Damaged(self.set_aside(&path, "under a wrong name"))
            }
            found => found,
        }
    }

    /// Whether the output can be read, as far as can be told without reading it.
    pub(crate) fn holds(&self, output: &Output) -> bool {
        output.inline.is_some() || self.entry(Kind::Blob, output.digest).exists()
    }

    pub(crate) fn put_trace(&self, trace: &Trace, durability: Durability) -> io::Result<()> {
        let payload = postcard::to_stdvec(trace).map_err(io::Error::other)?;
        let path = self.entry(Kind::Trace, trace.key);
        self.write(&path, TRACE, &payload, durability)?;
        Ok(())
    }

    pub(crate) fn trace(&self, key: Digest) -> Found<Trace> {
        let path = self.entry(Kind::Trace, key);
        match self.read(&path, TRACE) {
            Found::Whole(sealed) => match postcard::from_bytes::<Trace>(sealed.payload()) {
                Ok(trace) if trace.key == key => Found::Whole(trace),
                Ok(_) => Found::Damaged(self.set_aside(&path, "under a wrong name")),
                Err(error) => Found::Damaged(self.set_aside(&path, &error.to_string())),
            },
            Found::Absent => Found::Absent,
            Found::Damaged(damage) => Found::Damaged(damage),
        }
    }

    /// Sets an output aside that cannot be decoded although its bytes are whole.
    pub(crate) fn reject_blob(&self, digest: Digest, what: &str) -> Damage {
        self.set_aside(&self.entry(Kind::Blob, digest), what)
    }

    /// Says that an entry was in use until now, to the collector. Failing to is harmless.
    pub(crate) fn touch(&self, kind: Kind, digest: Digest, now: std::time::SystemTime) {
        if let Ok(file) = File::options().append(true).open(self.entry(kind, digest)) {
            file.set_modified(now).ok();
        }
    }

    /// Takes part in the cache's life: while the guard lives, nothing is collected. `None` where
    /// the cache cannot be locked (it may be read-only, or the file system has no locks).
    pub(crate) fn share(&self) -> Option<SharedLock> {
        let path = self.root.join("lock");
        let open = || File::options().append(true).create(true).open(&path);
        let file = open()
            .or_else(|error| {
                if error.kind() == io::ErrorKind::NotFound {
                    self.prepare()?;
                    return open();
                }
                Err(error)
            })
            .or_else(|_| File::open(&path))
            .ok()?;
        // The collector holds its side only for moments; a build that cannot wait goes without.
        file.try_lock_shared().ok()?;
        Some(SharedLock { _file: file })
    }

    /// Makes the version directory and tells backup programs to pass the cache by.
    fn prepare(&self) -> io::Result<()> {
        fs::create_dir_all(&self.root)?;
        let tag = self.cache.join("CACHEDIR.TAG");
        if !tag.exists() {
            fs::write(
                tag,
                "Signature: 8a477f597d28d172789f06886806bc55\n\
                 # Results of egg's stages. This directory may be deleted at any time.\n",
            )?;
        }
        Ok(())
    }

    fn entry(&self, kind: Kind, digest: Digest) -> PathBuf {
        let hex = digest.to_hex();
        let (shard, name) = hex.split_at(SHARD);
        let mut path = self.root.join(kind.folder());
        path.push(shard);
        path.push(name);
        path
    }

    fn write(
        &self,
        path: &Path,
        magic: Magic,
        payload: &[u8],
        durability: Durability,
    ) -> io::Result<Digest> {
        sealed::write(path, &self.root.join("tmp"), magic, payload, durability)
    }

    fn read(&self, path: &Path, magic: Magic) -> Found<Sealed> {
        match sealed::read(path, magic) {
            Read::Whole(sealed) => Found::Whole(sealed),
            Read::Absent => Found::Absent,
            Read::Damaged(what) => Found::Damaged(self.set_aside(path, &what)),
        }
    }

    /// Moves a damaged file into quarantine, where it can be looked at and is never read again.
    fn set_aside(&self, path: &Path, what: &str) -> Damage {
        let damage = self.damage(path, what);
        let quarantine = self.root.join("quarantine");
        // On a read-only cache it stays where it is; it will be found damaged again.
        if fs::create_dir_all(&quarantine).is_ok() {
            fs::rename(path, quarantine.join(damage.file.replace('/', "-"))).ok();
        }
        damage
    }

    fn damage(&self, path: &Path, what: &str) -> Damage {
        let relative = path.strip_prefix(&self.root).unwrap_or(path);
        Damage {
            file: relative.to_string_lossy().replace('\\', "/"),
            what: what.to_owned(),
        }
    }
}

/// While it lives, the collector keeps away.
#[derive(Debug)]
pub(crate) struct SharedLock {
    _file: File,
}
