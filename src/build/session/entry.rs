//! The state of one instance.

use super::super::event::How;
use super::super::key::Digest;
use super::super::needs::Value;
use super::super::reason::Reason;
use super::super::store::trace::Head;
use super::super::store::worktree::InstanceRecord;
use crate::diagnostics::Diagnostic;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// One instance.
pub(super) struct Entry<'s> {
    pub(super) status: Status,
    /// The instance as the last build knew it.
    pub(super) record: Option<&'s InstanceRecord>,
    pub(super) wanted: bool,
    pub(super) key: Option<Digest>,
    pub(super) head: Option<Arc<Head>>,
    pub(super) slot: Arc<Slot>,
    pub(super) reasons: Vec<Reason>,
    /// Diagnostics that are not part of a kept result.
    pub(super) told: Vec<Diagnostic>,
    /// Indices of dependencies and dependents, each once.
    pub(super) needs: Vec<usize>,
    pub(super) dependents: Vec<usize>,
    /// Number of dependents that may still want the value.
    pub(super) open_dependents: usize,
    /// How long it took this time.
    pub(super) ran: Option<Duration>,
    /// How long it may take, and how long everything that waits for it may take with it.
    pub(super) estimate: Option<Duration>,
    pub(super) urgency: Duration,
}

/// Where an instance stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    /// A dependency has no result yet.
    Waiting,
    /// The result is known.
    Cached,
    /// It has to run.
    Due,
    /// It is running.
    Running,
    /// It has run.
    Ran,
    /// There is no result; for good if there is a head.
    Failed,
    /// A dependency failed; for good if that one did.
    Skipped { lasting: bool },
    /// The build ended before it was finished.
    Stopped,
}

impl Status {
    pub(super) fn has_result(self) -> bool {
        matches!(self, Self::Cached | Self::Ran)
    }

    pub(super) fn is_final(self) -> bool {
        !matches!(self, Self::Waiting | Self::Due | Self::Running)
    }

    /// Whether it ended without a result.
    pub(super) fn is_barren(self) -> bool {
        self.is_final() && !self.has_result()
    }
}

impl Entry<'_> {
    /// How it ended, if it has.
    pub(super) fn how(&self) -> Option<How> {
        Some(match self.status {
            Status::Cached => How::Cached,
            Status::Ran => How::Ran,
            Status::Failed if self.head.is_some() && self.ran.is_none() => How::FailedCached,
            Status::Failed => How::Failed,
            Status::Skipped { .. } => How::Skipped,
            Status::Stopped => How::Stopped,
            Status::Waiting | Status::Due | Status::Running => return None,
        })
    }
}

/// Holds a value while somebody may need it. Whoever loads it from the store holds the lock, so
/// that it is loaded once.
#[derive(Default)]
pub(in crate::build) struct Slot(Mutex<Option<Value>>);

impl Slot {
    pub(super) fn lock(&self) -> MutexGuard<'_, Option<Value>> {
        // A value is stored whole or not at all: a panic elsewhere leaves nothing half done.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
