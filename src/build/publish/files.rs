//! Files as the output of a stage.

use serde::{Deserialize, Serialize};

/// Files that a stage has rendered, to be published in the output directory.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Files(pub(super) Vec<OutputFile>);

/// One rendered file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct OutputFile {
    /// Where it goes, relative to the output directory, with `/` between folders.
    pub path: String,
    /// What it contains.
    #[serde(with = "byte_string")]
    pub bytes: Vec<u8>,
}

impl Files {
    /// No files yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file.
    #[must_use]
    pub fn with(mut self, path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        self.push(path, bytes);
        self
    }

    /// Adds a file.
    pub fn push(&mut self, path: impl Into<String>, bytes: impl Into<Vec<u8>>) {
        self.0.push(OutputFile {
            path: path.into(),
            bytes: bytes.into(),
        });
    }

    /// The files in the order in which they were added.
    pub fn iter(&self) -> std::slice::Iter<'_, OutputFile> {
        self.0.iter()
    }
}

impl<'a> IntoIterator for &'a Files {
    type Item = &'a OutputFile;
    type IntoIter = std::slice::Iter<'a, OutputFile>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// Bytes as one string instead of a sequence of numbers.
mod byte_string {
    use serde::de::{Deserializer, Error, Visitor};
    use serde::ser::Serializer;
    use std::fmt;

    pub(super) fn serialize<S: Serializer>(bytes: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(bytes)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<u8>, D::Error> {
        deserializer.deserialize_byte_buf(Bytes)
    }

    struct Bytes;

    impl Visitor<'_> for Bytes {
        type Value = Vec<u8>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("bytes")
        }

        fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<Vec<u8>, E> {
            Ok(bytes.to_vec())
        }

        fn visit_byte_buf<E: Error>(self, bytes: Vec<u8>) -> Result<Vec<u8>, E> {
            Ok(bytes)
        }
    }
}
