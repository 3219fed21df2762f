//! Starting a ready instance, unless somebody else has its result or is at it.

use super::super::clock::Stopwatch;
use super::super::event::Event;
use super::super::key::{Digest, PortKind};
use super::super::needs::Port;
use super::super::reason::Reason;
use super::super::stage::Context;
use super::super::store::Found;
use super::super::store::lease::{Lease, Leased};
use super::execute::{Execution, Parked, Running};
use super::worker::{Intake, Task};
use super::{Observer, Session, Status};
use std::sync::Arc;

/// Stages recurse over trees and may run on top of each other.
const STACK: usize = 16 << 20;

impl Session<'_, '_> {
    /// Starts a ready instance, unless somebody else has its result or is at it.
    pub(super) fn start(
        &mut self,
        execution: &mut Execution<'_>,
        index: usize,
        observe: Observer<'_>,
    ) {
        let Some(key) = self.entries[index].key else {
            return;
        };
        let twin = |running: &&mut Running| running.key == key;
        if let Some(leader) = execution.running.values_mut().find(twin) {
            leader.twins.push(index);
            return;
        }
        let lease = if self.memory_only || execution.impatient.contains(&index) {
            None
        } else {
            match self.store.lease(key) {
                Leased::Held(lease) => Some(lease),
                Leased::Unavailable => None,
                Leased::Busy { process } => {
                    let tally = self.tally(execution.conditions.jobs, &[]);
                    observe(Event::Waiting {
                        instance: &self.declared(index).instance,
                        process,
                        tally,
                    });
                    execution.parked.push(Parked {
                        index,
                        since: Stopwatch::start(),
                    });
                    return;
                }
            }
        };
        if !self.made_elsewhere(index, key) {
            self.spawn(execution, index, key, lease, observe);
        }
    }

    /// Whether another process, or a twin, has made the result since it was looked for; takes it
    /// over then.
    pub(super) fn made_elsewhere(&mut self, index: usize, key: Digest) -> bool {
        // A damaged entry of a read-only cache stays in its place.
        let reasons = &self.entries[index].reasons;
        if reasons.contains(&Reason::Forced) || reasons.contains(&Reason::EntryDamaged) {
            return false;
        }
        if let Some(head) = &self.entries[index].head {
            // The result was known, its value was lost.
            let back = head
                .output
                .as_ref()
                .is_some_and(|output| output.inline.is_none() && self.store.holds(output));
            if back {
                self.finish(index, Status::Cached);
            }
            return back;
        }
        let head = match self.results.get(&key) {
            Some(head) => head.clone(),
            None => match self.store.trace(key) {
                Found::Whole(trace) => Arc::new(trace.head),
                _ => return false,
            },
        };
        self.found(index, head);
        true
    }

    fn spawn(
        &mut self,
        execution: &mut Execution<'_>,
        index: usize,
        key: Digest,
        lease: Option<Lease>,
        observe: Observer<'_>,
    ) {
        let context = Arc::new(Context::new(execution.conditions.cancel.clone()));
        let task = self.task(index, key, context.clone(), lease);
        self.entries[index].status = Status::Running;
        execution.running.insert(
            index,
            Running {
                key,
                context,
                progress: (0, 0),
                twins: Vec::new(),
            },
        );
        observe(Event::Started {
            instance: &self.declared(index).instance,
            tally: self.tally(execution.conditions.jobs, &[index]),
        });
        if execution.pool.is_none() {
            execution.pool = rayon::ThreadPoolBuilder::new()
                .num_threads(execution.conditions.jobs)
                .thread_name(|index| format!("stage-{index}"))
                .stack_size(STACK)
                .build()
                .ok();
        }
        let sender = execution.sender.clone();
        let run = move || {
            // The receiver outlives every task.
            sender.send((index, task.run())).ok();
        };
        match &execution.pool {
            Some(pool) => pool.spawn(run),
            // No threads to be had: the caller's own will do.
            None => run(),
        }
    }

    fn task(&self, index: usize, key: Digest, context: Arc<Context>, lease: Option<Lease>) -> Task {
        let declared = self.declared(index);
        let intake = |port: &Port| {
            let entry = &self.entries[port.node];
            match (&entry.head, port.kind) {
                (Some(head), PortKind::Warnings) => Intake::Warnings(head.clone()),
                (Some(head), _) if head.output.is_some() => Intake::Value {
                    node: port.node,
                    work: self.declared(port.node).work.clone(),
                    slot: entry.slot.clone(),
                    head: head.clone(),
                },
                _ => Intake::Nothing,
            }
        };
        Task {
            work: declared.work.clone(),
            name: declared.instance.to_string(),
            key,
            recipe: self.recipe(index),
            ports: declared.ports.list.iter().map(intake).collect(),
            unfolds: self.graph.unfolds.iter().any(|(root, _)| *root == index),
            store: self.store.clone(),
            context,
            lease,
        }
    }
}
