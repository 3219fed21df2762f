//! Leases: of several processes that need the same result, one computes it.
//!
//! A lease is a lock on one of 256 files, chosen by the key; the file tells whose lock it is and
//! for which key. The system releases the lock when the process dies, whatever way it dies. Two
//! keys may meet at one file: whoever finds it locked for another key goes on without a lease.
//!
//! Leases only save work: without them (read-only cache, a file system without locks, a holder
//! that takes too long) two processes compute the same bytes and rename the same file into place.
//! Locks belong to open files, not to processes, so builds of one process exclude each other too.

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
    /// There is no lease to be had; compute without.
    Unavailable,
}

/// The right to compute a key.
#[derive(Debug)]
pub(crate) struct Lease {
    _file: File,
}

/// Length of what a lease's file says: key, blank, process id, padding.
const RECORD: usize = 80;

impl Store {
    /// Asks for the lease of `key` without waiting.
    pub(crate) fn lease(&self, key: Digest) -> Leased {
        let path = self.lease_path(key);
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
                let record = format!("{key} {}", std::process::id());
                // Always the same length, so that the next holder overwrites all of it. Others
                // wait for the lock itself where this cannot be written.
                file.write_all(format!("{record:RECORD$}").as_bytes()).ok();
                Leased::Held(Lease { _file: file })
            }
            Err(TryLockError::WouldBlock) => {
                let record = fs::read_to_string(&path).unwrap_or_default();
                match record.split_once(' ') {
                    Some((holder, _)) if Digest::from_hex(holder) != Some(key) => {
                        Leased::Unavailable
                    }
                    Some((_, process)) => Leased::Busy {
                        process: process.trim().parse().ok(),
                    },
                    None => Leased::Busy { process: None },
                }
            }
            Err(TryLockError::Error(_)) => Leased::Unavailable,
        }
    }

    fn lease_path(&self, key: Digest) -> PathBuf {
        self.root.join("leases").join(&key.to_hex()[..2])
    }
}
