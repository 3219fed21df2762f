//! Input files of a project (meshes): known by their contents, read when a stage needs them.

use super::key::Digest;
use crate::build::stage::Failure;
use crate::diagnostics::{Code, Diagnostic};
use serde::{Serialize, Serializer};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file as a part of a stage's input. Only the digest of its contents enters the key: neither
/// its name nor its times.
#[derive(Debug, Clone)]
pub struct SourceFile {
    path: PathBuf,
    content: Digest,
    /// The contents, if they had to be read for the digest.
    bytes: Option<Arc<[u8]>>,
}

impl SourceFile {
    /// A file whose contents are at hand.
    pub fn from_bytes(path: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) -> Self {
        let bytes = bytes.into();
        Self {
            path: path.into(),
            content: Digest::of(&bytes),
            bytes: Some(bytes),
        }
    }

    pub(super) fn known(path: &Path, content: Digest) -> Self {
        Self {
            path: path.to_owned(),
            content,
            bytes: None,
        }
    }

    /// Where it lies, for messages.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Digest of its contents.
    pub fn digest(&self) -> Digest {
        self.content
    }

    /// Its contents, which are exactly those that the key names: a file that is saved while the
    /// build runs is a passing failure.
    pub fn bytes(&self) -> Result<Arc<[u8]>, Failure> {
        if let Some(bytes) = &self.bytes {
            return Ok(bytes.clone());
        }
        let told = |code, what: String| Failure::Passing(vec![Diagnostic::error(code, what)]);
        let shown = self.path.display();
        let bytes: Arc<[u8]> = std::fs::read(&self.path)
            .map_err(|error| told(UNREADABLE, format!("cannot read `{shown}`: {error}")))?
            .into();
        if Digest::of(&bytes) != self.content {
            let what = format!("`{shown}` changed while it was being compiled");
            return Err(told(CHANGED, what));
        }
        Ok(bytes)
    }
}

impl Serialize for SourceFile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.content.serialize(serializer)
    }
}

const UNREADABLE: Code = Code::new("E0807");
const CHANGED: Code = Code::new("E0808");
