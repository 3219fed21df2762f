//! The manifest: which files of the output directory are egg's, and what they contain.
//!
//! `.egg-manifest` lies in the output directory and moves with it. It is text, one line a file,
//! sorted by path, and says nothing about times or the machine:
//!
//! ```text
//! egg-manifest 1
//! <BLAKE3 of the file> TAB <instance that made it> TAB <path>
//! ```
//!
//! While files are being replaced, a path has a line for its old and one for its new contents, so
//! that after a crash both are known to be egg's. A line that cannot be read is passed over: its
//! file then counts as somebody else's, and is left alone.

use super::super::declare::Instance;
use super::super::key::Digest;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Its name.
pub const MANIFEST: &str = ".egg-manifest";
const HEADER: &str = "egg-manifest 1";

/// Which files are egg's.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Manifest {
    /// By path.
    pub(super) files: BTreeMap<String, Written>,
}

/// A file that egg wrote.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Written {
    /// The instance that made it, as [`owner_name`] writes it.
    pub(super) owner: String,
    /// Contents that it can have.
    pub(super) contents: BTreeSet<Digest>,
}

impl Manifest {
    pub(super) fn read(text: &str) -> Self {
        let mut manifest = Self::default();
        let mut lines = text.lines();
        if lines.next() != Some(HEADER) {
            return manifest;
        }
        for line in lines {
            let mut parts = line.splitn(3, '\t');
            if let (Some(content), Some(owner), Some(path)) =
                (parts.next(), parts.next(), parts.next())
                && let Some(content) = Digest::from_hex(content)
            {
                manifest.add(path, owner, content);
            }
        }
        manifest
    }

    pub(super) fn write(&self) -> String {
        let mut text = format!("{HEADER}\n");
        for (path, written) in &self.files {
            for content in &written.contents {
                writeln!(text, "{content}\t{}\t{path}", written.owner)
                    .expect("a string takes all text");
            }
        }
        text
    }

    /// Adds contents that the file can have.
    pub(super) fn add(&mut self, path: &str, owner: &str, content: Digest) {
        let written = self.files.entry(path.to_owned()).or_default();
        owner.clone_into(&mut written.owner);
        written.contents.insert(content);
    }

    /// Whether egg wrote these contents under this path.
    pub(super) fn knows(&self, path: &str, content: Digest) -> bool {
        self.files
            .get(path)
            .is_some_and(|written| written.contents.contains(&content))
    }
}

/// An instance as the manifest names it: on one line, without tabs.
pub(in crate::build) fn owner_name(instance: &Instance) -> String {
    instance.to_string().escape_debug().to_string()
}
