//! Looking up: keys, from the results of dependencies, and what the store knows of them.
//!
//! Nothing here opens a blob, but for the value of an instance that the graph unfolds from when
//! it was too long to be kept with its record.

use super::super::key::{Digest, KeyParts, PortKind};
use super::super::needs::Value;
use super::super::reason::Reason;
use super::super::request::Force;
use super::super::store::trace::Head;
use super::super::store::{Damage, Found};
use super::{NOT_CANONICAL, Session, Status, Supplies, internal};
use crate::diagnostics::{Code, Diagnostic};
use std::sync::Arc;

impl Session<'_, '_> {
    /// Goes on until nothing more can be known without running something.
    pub(super) fn settle(&mut self) {
        loop {
            while let Some(index) = self.agenda.pop_first() {
                self.examine(index);
            }
            if !self.unfold() {
                return;
            }
        }
    }

    /// Finds the key of a waiting instance and what is known of it.
    fn examine(&mut self, index: usize) {
        let entry = &self.entries[index];
        if !entry.wanted || entry.status != Status::Waiting {
            return;
        }
        let mut needs = Vec::with_capacity(self.declared(index).ports.list.len());
        let mut failed = None;
        for port in &self.declared(index).ports.list {
            match self.through(port.node, port.kind) {
                None => return,
                Some(Supplies::Result(digest)) => needs.push((port.kind, digest)),
                Some(Supplies::Nothing) => needs.push((port.kind, nothing())),
                Some(Supplies::Failed { lasting }) => {
                    failed = Some(failed.unwrap_or(true) && lasting);
                }
            }
        }
        if let Some(lasting) = failed {
            return self.finish(index, Status::Skipped { lasting });
        }
        let key = match self.key(index, &needs) {
            Ok(key) => key,
            Err(error) => {
                self.entries[index].told.push(*error);
                return self.finish(index, Status::Failed);
            }
        };
        self.entries[index].key = Some(key);
        let forced = self.request.force == Force::Selected
            && self
                .graph
                .selects(self.request, &self.declared(index).instance)
            && !self.forced.contains(&key);
        if forced {
            return self.mark_due(index, vec![Reason::Forced]);
        }
        match self.look_up(key) {
            Found::Whole(head) => self.found(index, head),
            Found::Absent => {
                let reasons = self.why(index);
                self.mark_due(index, reasons);
            }
            Found::Damaged(damage) => {
                self.damaged(&damage);
                self.mark_due(index, vec![Reason::EntryDamaged]);
            }
        }
    }

    fn key(
        &mut self,
        index: usize,
        needs: &[(PortKind, Digest)],
    ) -> Result<Digest, Box<Diagnostic>> {
        let declared = &self.graph.nodes[index];
        self.scratch.clear();
        if let Err(error) = declared.work.encode_input(&mut self.scratch) {
            let what = format!("the input of `{}` has no key: {error}", declared.instance);
            return Err(Box::new(internal(NOT_CANONICAL, what)));
        }
        let parts = KeyParts {
            stage: declared.work.stage(),
            version: declared.work.version(),
            numerics: declared.work.numerics(),
            build_id: self.build_id,
            input: &self.scratch,
            shape: &declared.ports.shape,
            needs,
        };
        Ok(parts.digest())
    }

    /// What is known of a key: from this pass, from the last build's record, from the store.
    pub(super) fn look_up(&self, key: Digest) -> Found<Arc<Head>> {
        if let Some(head) = self.results.get(&key) {
            return Found::Whole(head.clone());
        }
        if let Some(record) = self.recorded.get(&key) {
            return Found::Whole(record.head.clone());
        }
        match self.store.trace(key) {
            Found::Whole(trace) => Found::Whole(Arc::new(trace.head)),
            Found::Absent => Found::Absent,
            Found::Damaged(damage) => Found::Damaged(damage),
        }
    }

    /// Takes a result over that is already known.
    pub(super) fn found(&mut self, index: usize, head: Arc<Head>) {
        let status = if head.output.is_some() {
            Status::Cached
        } else {
            Status::Failed
        };
        if let Some(key) = self.entries[index].key {
            self.results.insert(key, head.clone());
        }
        self.entries[index].head = Some(head);
        self.finish(index, status);
    }

    /// Marks the instance as one that has to run, and all those whose lost values it needs.
    pub(super) fn mark_due(&mut self, index: usize, reasons: Vec<Reason>) {
        let mut due = vec![(index, reasons)];
        while let Some((index, reasons)) = due.pop() {
            let was_final = self.entries[index].status.is_final();
            self.entries[index].status = Status::Due;
            self.entries[index].reasons = reasons;
            self.due.insert(index);
            if was_final {
                self.reopen(index);
            }
            for position in 0..self.entries[index].needs.len() {
                let need = self.entries[index].needs[position];
                if self.lost(index, need) {
                    due.push((need, vec![Reason::EntryMissing]));
                }
            }
        }
    }

    /// Whether `index` needs the value of `need`, and it is neither in memory nor in the store.
    fn lost(&self, index: usize, need: usize) -> bool {
        let by_value =
            |port: &super::super::needs::Port| port.node == need && port.kind != PortKind::Warnings;
        let entry = &self.entries[need];
        let output = entry.head.as_ref().and_then(|head| head.output.as_ref());
        entry.status.has_result()
            && self.declared(index).ports.list.iter().any(by_value)
            && entry.slot.lock().is_none()
            && output.is_some_and(|output| !self.store.holds(output))
    }

    /// A finished instance has to run again: what it needs is in demand again.
    fn reopen(&mut self, index: usize) {
        self.count_unfinished(index);
        for position in 0..self.entries[index].needs.len() {
            let need = self.entries[index].needs[position];
            self.entries[need].open_dependents += 1;
        }
    }

    /// Ends the instance and lets those that wait for it go on.
    pub(super) fn finish(&mut self, index: usize, status: Status) {
        let entry = &mut self.entries[index];
        entry.status = status;
        let waiting = entry.dependents.iter().copied();
        self.agenda.extend(waiting);
        self.news.push(index);
        self.count_finished(index);
        for position in 0..self.entries[index].needs.len() {
            let need = self.entries[index].needs[position];
            let entry = &mut self.entries[need];
            entry.open_dependents = entry.open_dependents.saturating_sub(1);
            self.release(need);
        }
        self.release(index);
    }

    /// Forgets a value that nobody will ask for, or that can be read again.
    fn release(&mut self, index: usize) {
        let entry = &self.entries[index];
        let wanted_later = self.graph.nodes[index].publishes || !self.graph.unfolds.is_empty();
        if entry.open_dependents == 0 && !wanted_later && !self.memory_only {
            *entry.slot.lock() = None;
        }
    }

    /// Continues the declaration where a value has become known; whether there was any.
    ///
    /// What was declared first is continued first, even if another value is known earlier: so the
    /// order of the graph, in which stages and diagnostics are told, does not hang on the time
    /// that stages take.
    fn unfold(&mut self) -> bool {
        let next = self
            .graph
            .unfolds
            .iter()
            .position(|(root, _)| !self.entries[*root].status.is_barren());
        let Some(position) = next else {
            return false;
        };
        let root = self.graph.unfolds[position].0;
        if !self.entries[root].status.has_result() {
            return false;
        }
        match self.load(root) {
            Ok(value) => {
                let (_, grow) = self.graph.unfolds.remove(position);
                grow(&mut self.graph, &*value);
                self.grow();
            }
            Err(reason) => self.mark_due(root, vec![reason]),
        }
        true
    }

    /// The value of an instance that has a result.
    pub(super) fn load(&mut self, index: usize) -> Result<Value, Reason> {
        let entry = &self.entries[index];
        let Some(head) = &entry.head else {
            return Err(Reason::EntryMissing);
        };
        let work = &*self.graph.nodes[index].work;
        match super::worker::load(&self.store, &entry.slot, head, work) {
            Ok(value) => Ok(value),
            Err(super::worker::Lost::Missing) => Err(Reason::EntryMissing),
            Err(super::worker::Lost::Damaged(damage)) => {
                self.damaged(&damage);
                Err(Reason::EntryDamaged)
            }
        }
    }

    /// Tells that a part of the cache was damaged.
    pub(super) fn damaged(&mut self, damage: &Damage) {
        self.notice(damage_notice(damage));
    }
}

/// Says that a part of the cache was damaged and is made again.
pub(in crate::build) fn damage_notice(damage: &Damage) -> Diagnostic {
    let what = format!("cache entry `{}` is damaged, rebuilding", damage.file);
    Diagnostic::warning(Code::new("W0801"), what).note(damage.what.clone())
}

/// What stands in a key for an attempt that failed.
fn nothing() -> Digest {
    Digest::of(b"egg/nothing/1")
}
