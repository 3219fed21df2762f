//! Running what is due: the most urgent ready instance first, on as many threads as asked for.
//!
//! One thread (the caller's) keeps the state, makes look-ups and decides; stages run on a pool.
//! Never more instances are started than there are threads, so that a stage that waits for its
//! own parallel loops can pick up at most a few others on top of its stack, and no instance ever
//! blocks a thread: one whose result another process is computing is put aside and asked for
//! again.

use super::super::clock::Stopwatch;
use super::super::event::Event;
use super::super::key::{Digest, PortKind};
use super::super::needs::Port;
use super::super::reason::Reason;
use super::super::stage::{CancelToken, Context};
use super::super::store::Found;
use super::super::store::lease::{Lease, Leased};
use super::worker::{Ending, Intake, Task};
use super::{Observer, Session, Status, Supplies};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

/// How a build runs.
#[derive(Debug, Clone)]
pub(in crate::build) struct Conditions {
    /// Number of stages at a time, and of threads that they share.
    pub(in crate::build) jobs: usize,
    /// How long another process may compute a result before this one does it too.
    pub(in crate::build) patience: Duration,
    pub(in crate::build) cancel: CancelToken,
}

/// How often waiting things are looked at.
const TICK: Duration = Duration::from_millis(50);
/// The same while another process is waited for.
const SHORT_TICK: Duration = Duration::from_millis(10);
/// Stages recurse over trees and may run on top of each other.
const STACK: usize = 16 << 20;

struct Execution<'c> {
    conditions: &'c Conditions,
    ready: BinaryHeap<(Duration, Reverse<usize>)>,
    running: BTreeMap<usize, Running>,
    parked: Vec<Parked>,
    /// Instances for which another process was waited for long enough.
    impatient: BTreeSet<usize>,
    pool: Option<rayon::ThreadPool>,
    sender: Sender<(usize, Ending)>,
    receiver: Receiver<(usize, Ending)>,
}

/// An instance that runs.
pub(super) struct Running {
    pub(super) key: Digest,
    pub(super) context: Arc<Context>,
    /// What the context said when it was last asked.
    progress: (u64, u64),
    /// Instances with the same key: they take its result.
    pub(super) twins: Vec<usize>,
}

/// An instance that another process computes.
struct Parked {
    index: usize,
    since: Stopwatch,
}

impl Session<'_, '_> {
    /// Runs until nothing is left, or the user stops it.
    pub(in crate::build) fn execute(&mut self, conditions: &Conditions, observe: Observer<'_>) {
        let (sender, receiver) = channel();
        let mut execution = Execution {
            conditions,
            ready: BinaryHeap::new(),
            running: BTreeMap::new(),
            parked: Vec::new(),
            impatient: BTreeSet::new(),
            pool: None,
            sender,
            receiver,
        };
        loop {
            self.settle();
            self.enqueue(&mut execution);
            self.start_ready(&mut execution, observe);
            self.tell(&mut execution, observe);
            let stopping = self.unsettled || conditions.cancel.is_cancelled();
            if stopping {
                execution.parked.clear();
            } else if !self.agenda.is_empty() {
                continue;
            }
            if execution.running.is_empty() && execution.parked.is_empty() {
                if stopping || execution.ready.is_empty() {
                    break;
                }
                continue;
            }
            self.wait(&mut execution);
            self.ask_again(&mut execution);
        }
        for entry in &mut self.entries {
            if entry.wanted && !entry.status.is_final() {
                entry.status = Status::Stopped;
            }
        }
    }

    /// Queues what is due and has its dependencies' values at hand.
    fn enqueue(&mut self, execution: &mut Execution<'_>) {
        for index in std::mem::take(&mut self.due) {
            let needs = || self.entries[index].needs.iter();
            let status = |need: &usize| self.entries[*need].status;
            if self.entries[index].status != Status::Due {
                continue;
            }
            if needs().any(|need| matches!(status(need), Status::Due | Status::Running)) {
                self.due.insert(index);
            } else if needs().all(|need| self.serves(index, *need)) {
                let urgency = self.entries[index].urgency;
                execution.ready.push((urgency, Reverse(index)));
            } else {
                // A dependency whose value was lost failed when it was made again.
                self.entries[index].status = Status::Waiting;
                self.entries[index].head = None;
                self.agenda.insert(index);
            }
        }
    }

    /// Whether `index` can run as far as `need` is concerned.
    fn serves(&self, index: usize, need: usize) -> bool {
        let ports = &self.declared(index).ports.list;
        let mut ports = ports.iter().filter(|port| port.node == need);
        ports.all(|port| {
            matches!(
                self.through(port.node, port.kind),
                Some(Supplies::Result(_) | Supplies::Nothing)
            )
        })
    }

    fn start_ready(&mut self, execution: &mut Execution<'_>, observe: Observer<'_>) {
        let conditions = execution.conditions;
        while execution.running.len() < conditions.jobs
            && !self.unsettled
            && !conditions.cancel.is_cancelled()
            && let Some((_, Reverse(index))) = execution.ready.pop()
        {
            if self.entries[index].status == Status::Due {
                self.start(execution, index, observe);
            }
        }
    }

    /// Starts a ready instance, unless somebody else has its result or is at it.
    fn start(&mut self, execution: &mut Execution<'_>, index: usize, observe: Observer<'_>) {
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
    fn made_elsewhere(&mut self, index: usize, key: Digest) -> bool {
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

    fn wait(&mut self, execution: &mut Execution<'_>) {
        let tick = if execution.parked.is_empty() {
            TICK
        } else {
            SHORT_TICK
        };
        let first = execution.receiver.recv_timeout(tick).ok();
        let ended: Vec<_> = first
            .into_iter()
            .chain(execution.receiver.try_iter())
            .collect();
        for (index, ending) in ended {
            if let Some(running) = execution.running.remove(&index) {
                self.ended(running, index, ending);
            }
        }
    }

    /// Looks whether what other processes compute is there, or has been waited for long enough.
    fn ask_again(&mut self, execution: &mut Execution<'_>) {
        for parked in std::mem::take(&mut execution.parked) {
            let index = parked.index;
            let Some(key) = self.entries[index].key else {
                continue;
            };
            if self.made_elsewhere(index, key) {
                continue;
            }
            let impatient = parked.since.elapsed() > execution.conditions.patience;
            if impatient {
                execution.impatient.insert(index);
            }
            if impatient || !matches!(self.store.lease(key), Leased::Busy { .. }) {
                self.due.insert(index);
            } else {
                execution.parked.push(parked);
            }
        }
    }

    /// Reports what has ended and how far the rest is.
    fn tell(&mut self, execution: &mut Execution<'_>, observe: Observer<'_>) {
        let jobs = execution.conditions.jobs;
        let running: Vec<usize> = execution.running.keys().copied().collect();
        for index in std::mem::take(&mut self.news) {
            let entry = &self.entries[index];
            let Some(how) = entry.how() else {
                continue;
            };
            observe(Event::Finished {
                instance: &self.declared(index).instance,
                how,
                duration: entry.ran.unwrap_or_default(),
                tally: self.tally(jobs, &running),
            });
        }
        for (&index, stage) in &mut execution.running {
            let progress = stage.context.read();
            if progress != stage.progress {
                stage.progress = progress;
                observe(Event::Progress {
                    instance: &self.declared(index).instance,
                    done: progress.0,
                    total: progress.1,
                    tally: self.tally(jobs, &running),
                });
            }
        }
    }
}
