//! Leases: of several processes that need the same result, one computes it.
//!
//! A lease is a file that is locked while its key is being computed. The system releases the lock
//! when the process dies, whatever way it dies. Leases only save work: without them (read-only
//! cache, a file system without locks, a holder that takes too long) two processes compute the
//! same bytes and rename the same file into place.
//!
//! The file goes away with its lease. A process that had it open while it went away gets the lock
//! of a file without a name, and a third process may make a new one: both look for the trace
//! first, and if there is none, the worst is that both compute.

use super::super::key::Digest;
use super::Store;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::PathBuf;

/// What asking for a lease gave.
#[derive(Debug)]
pub(crate) enum Leased {
    /// Nobody else computes this key while the guard lives.
    Held(Lease),
    /// Another process, or another build of this one, is at it.
    Busy {
        /// Its process id, where it can be read.
        process: Option<u32>,
    },
    /// There are no leases here; compute without.
    Unavailable,
}

/// The right to compute a key.
#[derive(Debug)]
pub(crate) struct Lease {
    path: PathBuf,
    _file: File,
}

impl Drop for Lease {
    fn drop(&mut self) {
        // Removed while still locked: nobody can take it in between. What cannot be removed is
        // left to the collector.
        fs::remove_file(&self.path).ok();
    }
}

impl Store {
    /// Asks for the lease of `key` without waiting.
    pub(crate) fn lease(&self, key: Digest) -> Leased {
        let path = self.root.join("leases").join(key.to_hex());
        let open = || {
            File::options()
                .write(true)
                .create(true)
                .truncate(false)
                .open(&path)
        };
        let file = open().or_else(|error| {
            if error.kind() == io::ErrorKind::NotFound {
                fs::create_dir_all(self.root.join("leases"))?;
                return open();
            }
            Err(error)
        });
        let Ok(mut file) = file else {
            return Leased::Unavailable;
        };
        match file.try_lock() {
            Ok(()) => {
                // Only for the message of a process that waits.
                let written = file
                    .set_len(0)
                    .and_then(|()| file.write_all(std::process::id().to_string().as_bytes()));
                written.ok();
                Leased::Held(Lease { path, _file: file })
            }
            Err(TryLockError::WouldBlock) => Leased::Busy {
                process: fs::read_to_string(&path)
                    .ok()
                    .and_then(|text| text.parse().ok()),
            },
            Err(TryLockError::Error(_)) => Leased::Unavailable,
        }
    }
}
