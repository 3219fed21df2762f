//! What follows from the end of a run.

use super::super::key::Digest;
use super::super::reason::Reason;
use super::super::store::Found;
use super::super::store::trace::Head;
use super::execute::Running;
use super::worker::{Ending, Lost};
use super::{PANICKED, Session, Status, internal};
use crate::diagnostics::{Code, Diagnostic};

impl Session<'_, '_> {
    /// Takes over what a run gave, and tells its twins.
    pub(super) fn ended(&mut self, running: Running, index: usize, ending: Ending) {
        match ending {
            Ending::Settled { head, value, kept } => {
                if let Err(error) = kept {
                    self.memory_only = true;
                    self.notice(unwritable(&error.to_string()));
                }
                self.compare(index, running.key, &head);
                self.results.insert(running.key, head.clone());
                self.entries[index].slot.lock().clone_from(&value);
                self.entries[index].ran = Some(head.duration());
                self.entries[index].head = Some(head.clone());
                let status = if value.is_some() {
                    Status::Ran
                } else {
                    Status::Failed
                };
                self.finish(index, status);
                for twin in running.twins {
                    self.entries[twin].slot.lock().clone_from(&value);
                    self.found(twin, head.clone());
                }
                return;
            }
            Ending::Passing(diagnostics) => {
                self.entries[index].told = diagnostics;
                self.entries[index].head = None;
                self.finish(index, Status::Failed);
            }
            Ending::Cancelled if running.context.check().is_err() => {
                self.finish(index, Status::Stopped);
            }
            Ending::Cancelled => {
                let what = format!("`{}` stopped by itself", self.declared(index).instance);
                self.entries[index].told.push(internal(PANICKED, what));
                self.entries[index].head = None;
                self.finish(index, Status::Failed);
            }
            Ending::Lacking(lacking) => {
                self.entries[index].status = Status::Due;
                self.due.insert(index);
                for (need, lost) in lacking {
                    let reason = match lost {
                        Lost::Missing => Reason::EntryMissing,
                        Lost::Damaged(damage) => {
                            self.damaged(&damage);
                            Reason::EntryDamaged
                        }
                    };
                    if self.entries[need].status.has_result() {
                        self.mark_due(need, vec![reason]);
                    }
                }
            }
        }
        self.due.extend(running.twins);
    }

    /// Compares a result that was made again with the one that was known.
    fn compare(&mut self, index: usize, key: Digest, head: &Head) {
        let forced = self.entries[index].reasons.contains(&Reason::Forced);
        let known = match (&self.entries[index].head, forced) {
            (Some(known), _) => known.digest(),
            (None, true) => match self.look_up(key) {
                Found::Whole(known) => known.digest(),
                _ => return,
            },
            (None, false) => return,
        };
        if forced {
            self.forced.insert(key);
        }
        if known != head.digest() {
            let instance = self.declared(index).instance.clone();
            self.notice(not_repeatable(&instance.to_string()));
            // Others were looked up by the old result.
            self.unsettled |= self.entries[index].head.is_some();
        }
    }
}

fn not_repeatable(instance: &str) -> Diagnostic {
    let what = format!("`{instance}` gave another result for the same input");
    Diagnostic::warning(Code::new("W0803"), what)
        .note("this is a defect of egg, not of the project; the new result stands")
}

/// Says that results cannot be kept.
pub(in crate::build) fn unwritable(error: &str) -> Diagnostic {
    Diagnostic::warning(Code::new("W0802"), "the cache cannot be written")
        .note(error)
        .help("this build is complete, but the next one will compute its results again")
}
