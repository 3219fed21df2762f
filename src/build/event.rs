//! What a build says while it runs, as values; whoever started it draws them.

use super::declare::Instance;
use serde::Serialize;
use std::time::Duration;

/// Something happened.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
pub enum Event<'a> {
    /// All look-ups are done; what has to run is known as far as it can be.
    Planned {
        /// How things stand.
        tally: Tally,
    },
    /// A stage begins.
    Started {
        /// Which.
        instance: &'a Instance,
        /// How things stand.
        tally: Tally,
    },
    /// A running stage says how far it is.
    Progress {
        /// Which.
        instance: &'a Instance,
        /// Steps done.
        done: u64,
        /// Of so many.
        total: u64,
        /// How things stand.
        tally: Tally,
    },
    /// Another process computes this result; the build goes on with others meanwhile.
    Waiting {
        /// Which.
        instance: &'a Instance,
        /// Id of that process.
        process: Option<u32>,
        /// How things stand.
        tally: Tally,
    },
    /// A stage is finished, one way or another.
    Finished {
        /// Which.
        instance: &'a Instance,
        /// Which way.
        how: How,
        /// How long it ran, if it did.
        duration: Duration,
        /// How things stand.
        tally: Tally,
    },
}

/// How things stand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tally {
    /// Instances that are finished.
    pub finished: usize,
    /// Instances known so far; more may unfold.
    pub known: usize,
    /// What is left to run will take about this long, going by earlier runs; none where there
    /// were none.
    pub remaining: Option<Duration>,
}

/// How an instance ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum How {
    /// Its result was known.
    Cached,
    /// It ran.
    Ran,
    /// It ran, and failed.
    Failed,
    /// It is known to fail; it did not run again.
    FailedCached,
    /// It was left out because something that it needs failed.
    Skipped,
    /// The user stopped the build before it was finished.
    Stopped,
}

impl How {
    /// Whether there is a result.
    pub fn succeeded(self) -> bool {
        matches!(self, Self::Cached | Self::Ran)
    }
}
