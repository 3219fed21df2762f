//! The form of every file in the cache: a header that proves the rest.
//!
//! ```text
//! 8 bytes   what it is and in which format ("eggblob1")
//! 8 bytes   length of the payload, little-endian
//! 32 bytes  BLAKE3 of the payload
//! payload
//! ```
//!
//! A file appears under its name only when it is whole (written beside, then renamed). A power
//! cut can still leave one short or empty: the header tells.

use super::super::key::Digest;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

const HEADER: usize = 48;

/// What a file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Magic(pub(super) [u8; 8]);

/// Whether a write waits for the disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Durability {
    /// Survives the end of the process.
    Process,
    /// Survives a power cut; for what took long to compute.
    Disk,
}

/// What reading a file gave.
#[derive(Debug)]
pub(crate) enum Read {
    /// A whole file.
    Whole(Sealed),
    /// There is none.
    Absent,
    /// There is something else.
    Damaged(String),
}

/// A file whose payload was proven.
#[derive(Debug)]
pub(crate) struct Sealed {
    bytes: Vec<u8>,
    pub(crate) digest: Digest,
}

impl Sealed {
    pub(crate) fn payload(&self) -> &[u8] {
        &self.bytes[HEADER..]
    }
}

/// Writes a file by way of a temporary one in `temporary`, which is on the same file system.
pub(super) fn write(
    path: &Path,
    temporary: &Path,
    magic: Magic,
    payload: &[u8],
    durability: Durability,
) -> io::Result<Digest> {
    let digest = Digest::of(payload);
    let mut header = Vec::with_capacity(HEADER);
    header.extend_from_slice(&magic.0);
    header.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    header.extend_from_slice(digest.as_bytes());
    replace(path, temporary, &[&header, payload], durability)?;
    Ok(digest)
}

/// Reads and proves a file.
pub(super) fn read(path: &Path, magic: Magic) -> Read {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        // A folder on the way may be a file: then there is nothing below it either.
        Err(error)
            if matches!(
                error.kind(),
                io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
            ) =>
        {
            return Read::Absent;
        }
        Err(error) => return Read::Damaged(error.to_string()),
    };
    let Some((header, payload)) = bytes.split_at_checked(HEADER) else {
        return Read::Damaged(format!("{} bytes are no header", bytes.len()));
    };
    if header[..8] != magic.0 {
        return Read::Damaged("unknown format".to_owned());
    }
    if header[8..16] != (payload.len() as u64).to_le_bytes() {
        return Read::Damaged(format!("wrong length: {} bytes", payload.len()));
    }
    let digest = Digest::of(payload);
    if header[16..] != *digest.as_bytes() {
        return Read::Damaged("wrong digest".to_owned());
    }
    Read::Whole(Sealed { bytes, digest })
}

/// Replaces a file as a whole: readers see the old or the new one. Folders are made as needed.
pub(crate) fn replace(
    path: &Path,
    temporary: &Path,
    parts: &[&[u8]],
    durability: Durability,
) -> io::Result<()> {
    let create = |target: &Path| File::options().write(true).create_new(true).open(target);
    // Not the private mode that temporary files usually get: the process's own.
    let make = || {
        tempfile::Builder::new()
            .prefix(TEMPORARY_PREFIX)
            .make_in(temporary, create)
    };
    let mut file = make().or_else(|error| {
        if error.kind() != io::ErrorKind::NotFound {
            return Err(error);
        }
        fs::create_dir_all(temporary)?;
        make()
    })?;
    for part in parts {
        file.write_all(part)?;
    }
    if durability == Durability::Disk {
        file.as_file().sync_all()?;
    }
    match file.persist(path) {
        Ok(_) => Ok(()),
        Err(error) if error.error.kind() == io::ErrorKind::NotFound => {
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent)?;
            }
            error.file.persist(path)?;
            Ok(())
        }
        Err(error) => Err(error.error),
    }
}

/// How names of temporary files begin.
pub(crate) const TEMPORARY_PREFIX: &str = ".egg-tmp-";
