//! Running what is due: the most urgent ready instance first, on as many threads as asked for.
//!
//! One thread (the caller's) keeps the state, makes look-ups and decides; stages run on a pool.
//! Never more instances are started than there are threads, so that a stage that waits for its
//! own parallel loops can pick up at most a few others on top of its stack, and no instance ever
//! blocks a thread: one whose result another process is computing is put aside and asked for
//! again.

use super::super::clock::Stopwatch;
use super::super::event::Event;
use super::super::key::Digest;
use super::super::stage::{CancelToken, Context};
use super::super::store::lease::Leased;
use super::worker::Ending;
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

/// What is going on while a pass runs.
pub(super) struct Execution<'c> {
    pub(super) conditions: &'c Conditions,
    pub(super) ready: BinaryHeap<(Duration, Reverse<usize>)>,
    pub(super) running: BTreeMap<usize, Running>,
    pub(super) parked: Vec<Parked>,
    /// Instances for which another process was waited for long enough.
    pub(super) impatient: BTreeSet<usize>,
    pub(super) pool: Option<rayon::ThreadPool>,
    pub(super) sender: Sender<(usize, Ending)>,
    pub(super) receiver: Receiver<(usize, Ending)>,
}

/// An instance that runs.
pub(super) struct Running {
    pub(super) key: Digest,
    pub(super) context: Arc<Context>,
    /// What the context said when it was last asked.
    pub(super) progress: (u64, u64),
    /// Instances with the same key: they take its result.
    pub(super) twins: Vec<usize>,
}

/// An instance that another process computes.
pub(super) struct Parked {
    pub(super) index: usize,
    pub(super) since: Stopwatch,
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
