//! What a finished pass leaves: publications, values, the record for the next build.

use super::super::declare::{Instance, Work};
use super::super::event::How;
use super::super::key::Digest;
use super::super::needs::Value;
use super::super::publish::{Files, owner_name};
use super::super::reason::Reason;
use super::super::store::trace::Head;
use super::super::store::worktree::{InstanceRecord, Worktree};
use super::super::store::{Kind, Store};
use super::worker::load;
use super::{Known, Session, Slot, Status};
use crate::diagnostics::Diagnostic;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// How one instance ended.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct BuiltStage {
    /// Which.
    pub instance: Instance,
    /// How.
    pub how: How,
    /// Why it ran, if it did.
    pub reasons: Vec<Reason>,
    /// How long it ran.
    pub duration: Duration,
}

/// A result that outlives its pass.
pub(in crate::build) struct Kept {
    pub(in crate::build) instance: Arc<Instance>,
    work: Arc<dyn Work>,
    head: Arc<Head>,
    slot: Arc<Slot>,
}

impl Kept {
    /// Its value, if it can be read.
    pub(in crate::build) fn load(&self, store: &Store) -> Option<Value> {
        load(store, &self.slot, &self.head, &*self.work).ok()
    }
}

/// An instance with files to publish.
pub(in crate::build) struct Publisher {
    pub(in crate::build) owner: Arc<Instance>,
    pub(in crate::build) index: usize,
    pub(in crate::build) output: Digest,
}

impl Session<'_, '_> {
    /// Whether a result came out differently from what others had been looked up by.
    pub(in crate::build) fn is_unsettled(&self) -> bool {
        self.unsettled
    }

    /// What is known by now, for another pass over the same graph.
    pub(in crate::build) fn into_known(self) -> Known {
        Known {
            results: self.results,
            forced: self.forced,
        }
    }

    /// Whether nothing more has to run.
    pub(in crate::build) fn is_complete(&self) -> bool {
        self.entries.iter().all(|entry| {
            !entry.wanted || (entry.status.is_final() && entry.status != Status::Stopped)
        })
    }

    /// Whether every instance of the graph is known and asked for.
    pub(in crate::build) fn is_whole(&self) -> bool {
        self.request.is_whole() && self.graph.unfolds.is_empty()
    }

    /// What the engine itself has to tell.
    pub(in crate::build) fn take_notices(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.notices)
    }

    /// Instances in the graph's order, with how they ended.
    pub(in crate::build) fn stages(&self) -> Vec<BuiltStage> {
        let wanted = self.entries.iter().zip(&self.graph.nodes);
        wanted
            .filter(|(entry, _)| entry.wanted)
            .map(|(entry, declared)| BuiltStage {
                instance: (*declared.instance).clone(),
                how: entry.how().unwrap_or(How::Stopped),
                reasons: entry.reasons.clone(),
                duration: entry.ran.unwrap_or_default(),
            })
            .collect()
    }

    /// Instances that have files to publish, and a result.
    pub(in crate::build) fn publishers(&self) -> Vec<Publisher> {
        let nodes = self.graph.nodes.iter().zip(&self.entries).enumerate();
        nodes
            .filter(|(_, (declared, entry))| {
                declared.publishes && entry.wanted && entry.status.has_result()
            })
            .filter_map(|(index, (declared, entry))| {
                Some(Publisher {
                    owner: declared.instance.clone(),
                    index,
                    output: entry.head.as_ref()?.digest()?,
                })
            })
            .collect()
    }

    /// Whether the graph declares that `instance` publishes files.
    pub(in crate::build) fn publishes(&self, instance: &Instance) -> bool {
        let index = self.names.get(instance);
        index.is_some_and(|&index| self.declared(index).publishes)
    }

    /// Names of all instances that publish files, as the manifest writes them.
    pub(in crate::build) fn publisher_names(&self) -> BTreeSet<String> {
        let publishing = self.graph.nodes.iter().filter(|one| one.publishes);
        publishing.map(|one| owner_name(&one.instance)).collect()
    }

    /// The files of an instance with a result, if they can be read.
    pub(in crate::build) fn files(&mut self, index: usize) -> Option<Arc<Files>> {
        self.load(index).ok()?.downcast().ok()
    }

    /// The same; if they cannot be read, the instance has to run again.
    pub(in crate::build) fn demand(&mut self, index: usize) -> Option<Arc<Files>> {
        match self.load(index) {
            Ok(value) => value.downcast().ok(),
            Err(reason) => {
                self.mark_due(index, vec![reason]);
                None
            }
        }
    }

    /// Marks an instance to run again if its result is no longer in the store.
    pub(in crate::build) fn demand_if_lost(&mut self, index: usize) {
        let entry = &self.entries[index];
        let output = entry.head.as_ref().and_then(|head| head.output.as_ref());
        if output.is_some_and(|output| entry.slot.lock().is_none() && !self.store.holds(output)) {
            self.mark_due(index, vec![Reason::EntryMissing]);
        }
    }

    /// Results, to be handed out after the pass.
    pub(in crate::build) fn into_kept(self) -> Vec<Kept> {
        let nodes = self.graph.nodes.into_iter().zip(self.entries);
        nodes
            .filter(|(_, entry)| entry.status.has_result())
            .filter_map(|(declared, entry)| {
                Some(Kept {
                    instance: declared.instance,
                    work: declared.work,
                    head: entry.head?,
                    slot: entry.slot,
                })
            })
            .collect()
    }

    /// The instances for the next build's record, or none if nothing is new. Instances that were
    /// not reached keep their old records, unless the whole graph is known without them.
    pub(in crate::build) fn records(&self) -> Option<Vec<InstanceRecord>> {
        let mut news = false;
        let mut met = 0;
        let mut records = Vec::with_capacity(self.entries.len());
        for (index, entry) in self.entries.iter().enumerate() {
            let (true, Some(key), Some(head)) = (
                entry.wanted
                    && matches!(entry.status, Status::Cached | Status::Ran | Status::Failed),
                entry.key,
                &entry.head,
            ) else {
                continue;
            };
            let old = entry.record;
            let same = |old: &InstanceRecord| {
                old.key == key && (Arc::ptr_eq(&old.head, head) || old.head == *head)
            };
            news |= !old.is_some_and(same);
            met += usize::from(old.is_some());
            records.push((index, key, head));
        }
        if !news && met == self.worktree.instances.len() {
            return None;
        }
        let whole = self.is_whole();
        let visited: BTreeSet<&Instance> = records
            .iter()
            .map(|(index, ..)| &*self.declared(*index).instance)
            .collect();
        let kept: Vec<&InstanceRecord> = self
            .worktree
            .instances
            .iter()
            .filter(|old| !visited.contains(&old.instance))
            .filter(|old| !whole || self.names.contains_key(&old.instance))
            .collect();
        news |= kept.len() + visited.len() != self.worktree.instances.len();
        if !news {
            return None;
        }
        let mut all: Vec<InstanceRecord> = kept.into_iter().cloned().collect();
        for (index, key, head) in records {
            all.push(InstanceRecord {
                instance: (*self.declared(index).instance).clone(),
                key,
                head: head.clone(),
                changed_by: self.changed_by(index, head),
            });
        }
        all.sort_by(|a, b| a.instance.cmp(&b.instance));
        Some(all)
    }

    /// Why the instance's result is what it is: the reasons of the build in which it changed last.
    fn changed_by(&self, index: usize, head: &Head) -> Vec<Reason> {
        match self.entries[index].record {
            Some(old) if old.head.digest() == head.digest() => old.changed_by.clone(),
            _ if !self.entries[index].reasons.is_empty() => self.entries[index].reasons.clone(),
            _ => self.why(index),
        }
    }
}

/// Tells the collector that entries which a record no longer lists were in use until now.
pub(in crate::build) fn retire(
    store: &Store,
    old: &Worktree,
    new: &[InstanceRecord],
    now: SystemTime,
) {
    let kept: BTreeSet<Digest> = new.iter().map(|record| record.key).collect();
    for record in &old.instances {
        if kept.contains(&record.key) {
            continue;
        }
        store.touch(Kind::Trace, record.key, now);
        if let Some(output) = &record.head.output
            && output.inline.is_none()
        {
            store.touch(Kind::Blob, output.digest, now);
        }
    }
}
