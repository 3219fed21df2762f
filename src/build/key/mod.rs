//! Keys: what a stage's result depends on, as one digest.
//!
//! ```text
//! key = BLAKE3( "egg/key/1" | stage | version | numerics class | build id
//!               | canonical(input) | grouping, port and digest of every dependency, in order )
//! ```
//!
//! Every part is preceded by its length, so no two lists of parts share their bytes.

pub mod canon;
pub(crate) mod digest;
pub mod recipe;

pub use digest::Digest;

/// What a key is made of.
#[derive(Debug)]
pub(crate) struct KeyParts<'a> {
    pub(crate) stage: &'a str,
    pub(crate) version: u32,
    pub(crate) numerics: &'a str,
    /// Set by developers' builds only, so that they never meet results of other code.
    pub(crate) build_id: Option<&'a str>,
    /// Canonical encoding of the input.
    pub(crate) input: &'a [u8],
    /// How the dependencies are grouped.
    pub(crate) shape: &'a [u32],
    /// Kind of port and digest of what came through it.
    pub(crate) needs: &'a [(PortKind, Digest)],
}

/// What a dependency hands over.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum PortKind {
    /// The value.
    Value,
    /// The warnings and notes.
    Warnings,
    /// The value, or that there is none.
    Attempt,
}

impl KeyParts<'_> {
    pub(crate) fn digest(&self) -> Digest {
        let mut hasher = blake3::Hasher::new();
        let mut part = |bytes: &[u8]| {
            hasher.update(&(bytes.len() as u64).to_le_bytes());
            hasher.update(bytes);
        };
        part(b"egg/key/1");
        part(self.stage.as_bytes());
        part(&self.version.to_le_bytes());
        part(self.numerics.as_bytes());
        part(self.build_id.unwrap_or_default().as_bytes());
        part(self.input);
        part(&(self.shape.len() as u64).to_le_bytes());
        for count in self.shape {
            part(&count.to_le_bytes());
        }
        part(&(self.needs.len() as u64).to_le_bytes());
        for (kind, digest) in self.needs {
            part(&[match kind {
                PortKind::Value => 0,
                PortKind::Warnings => 1,
                PortKind::Attempt => 2,
            }]);
            part(digest.as_bytes());
        }
        Digest::from_bytes(*hasher.finalize().as_bytes())
    }
}

#[cfg(test)]
mod tests;
