//! What the file system says about a file, to tell without reading whether it changed.

use serde::{Deserialize, Serialize};
use std::fs::Metadata;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Size and times of a file. Equal stamps mean an untouched file, as far as the system knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Stamp {
    size: u64,
    /// Nanoseconds since 1970 of the last change of the contents.
    modified: i64,
    /// Nanoseconds since 1970 of the last change of anything, which no program can set; 0 where
    /// the system has no such time.
    changed: i64,
    /// Number of the file on its disk; 0 where there is none.
    number: u64,
}

impl Stamp {
    pub(super) fn of(metadata: &Metadata) -> Self {
        let (changed, number) = identity(metadata);
        Self {
            size: metadata.len(),
            modified: metadata.modified().map_or(0, nanoseconds),
            changed,
            number,
        }
    }

    /// Whether an equal stamp proves equal contents: the system keeps a time that cannot be set,
    /// and the file has rested for longer than any file system's clock ticks, so a later change
    /// cannot have the same time.
    pub(super) fn proves(&self, now: SystemTime) -> bool {
        let rested = |time: i64| nanoseconds(now).saturating_sub(time) > TICK.as_nanos() as i64;
        self.changed != 0 && rested(self.changed) && rested(self.modified)
    }
}

/// The coarsest tick among file systems in use is 2 s (FAT).
const TICK: Duration = Duration::from_millis(2500);

fn nanoseconds(time: SystemTime) -> i64 {
    match time.duration_since(UNIX_EPOCH) {
        Ok(after) => i64::try_from(after.as_nanos()).unwrap_or(i64::MAX),
        Err(before) => i64::try_from(before.duration().as_nanos()).map_or(i64::MIN, |n| -n),
    }
}

#[cfg(unix)]
fn identity(metadata: &Metadata) -> (i64, u64) {
    use std::os::unix::fs::MetadataExt;
    let changed = metadata
        .ctime()
        .saturating_mul(1_000_000_000)
        .saturating_add(metadata.ctime_nsec());
    (changed, metadata.ino())
}

#[cfg(not(unix))]
fn identity(_: &Metadata) -> (i64, u64) {
    (0, 0)
}
