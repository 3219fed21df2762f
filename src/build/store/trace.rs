//! Traces: what is known about a key without opening its result.

use super::super::key::Digest;
use super::super::key::recipe::Recipe;
use crate::diagnostics::Diagnostic;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// A record of one run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Trace {
    /// The key it stands under; a file under a wrong name is no trace of that key.
    pub(crate) key: Digest,
    /// What came out.
    pub(crate) head: Head,
    /// What went in.
    pub(crate) recipe: Recipe,
}

/// What came out of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Head {
    /// The output, or none if the stage failed for its inputs.
    pub(crate) output: Option<Output>,
    /// What it had to say: told again whenever the record is used.
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// How long it took, in microseconds.
    pub(crate) micros: u64,
}

/// An output.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Output {
    /// Digest of its encoding, and the name of its blob.
    pub(crate) digest: Digest,
    /// Length of its encoding.
    pub(crate) size: u64,
    /// The encoding itself where it is short; there is no blob then.
    pub(crate) inline: Option<Vec<u8>>,
}

impl Head {
    /// Digest of the output, if there is one.
    pub(crate) fn digest(&self) -> Option<Digest> {
        self.output.as_ref().map(|output| output.digest)
    }

    /// Digest of what it said.
    pub(crate) fn diagnostics_digest(&self) -> Digest {
        let bytes = if self.diagnostics.is_empty() {
            Vec::new()
        } else {
            postcard::to_stdvec(&self.diagnostics)
                .expect("diagnostics are plain data, and memory is no limited buffer")
        };
        Digest::of(&bytes)
    }

    /// How long the run took.
    pub(crate) fn duration(&self) -> Duration {
        Duration::from_micros(self.micros)
    }
}
