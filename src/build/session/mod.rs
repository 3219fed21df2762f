//! One pass over a graph: looks up what is known ([`settle`]), runs what is not ([`execute`]).
//!
//! Planning and building are the same pass; planning stops before anything runs. An instance
//! moves through these states:
//!
//! ```text
//!                 ┌─► Cached ──┐ (its value is needed but lost)
//! Waiting ─► key ─┼─► Failed   ▼
//!    │            └─► Due ─► Running ─► Ran, Failed
//!    └─► Skipped (a dependency failed)
//! ```
//!
//! An instance has a key as soon as all its dependencies have results, by look-up or by running.

mod ended;
mod entry;
mod estimate;
mod execute;
mod explain;
mod outcome;
mod planning;
mod selection;
mod settle;
mod start;
mod why;
mod worker;

use super::declare::{Declared, Graph, Instance};
use super::event::Event;
use super::key::{Digest, PortKind};
use super::request::Request;
use super::store::Store;
use super::store::trace::Head;
use super::store::worktree::{InstanceRecord, Worktree};
use crate::diagnostics::{Code, Diagnostic};
use entry::{Entry, Slot, Status};
use estimate::Progress;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;
use std::time::Duration;

pub(super) use ended::unwritable;
pub(super) use execute::Conditions;
pub use outcome::BuiltStage;
pub(super) use outcome::{Kept, Publisher, retire};
pub(super) use settle::damage_notice;

/// The state of one pass.
pub(super) struct Session<'p, 's> {
    store: Arc<Store>,
    worktree: &'s Worktree,
    build_id: Option<&'s str>,
    request: &'s Request,
    graph: Graph<'p>,
    entries: Vec<Entry<'s>>,
    names: HashMap<Arc<Instance>, usize>,
    /// Instances of the last build, by name and by key.
    records: HashMap<&'s Instance, &'s InstanceRecord>,
    recorded: HashMap<Digest, &'s InstanceRecord>,
    /// Results found or made in this pass, by key.
    results: HashMap<Digest, Arc<Head>>,
    /// Instances whose state may have to change.
    agenda: BTreeSet<usize>,
    /// Keys of instances that ran although their result was known.
    forced: BTreeSet<Digest>,
    /// What the engine itself has to tell.
    notices: Vec<Diagnostic>,
    /// The store refused a write: values live in memory only.
    memory_only: bool,
    /// A result that others were built on came out differently: everything has to be looked up
    /// again.
    unsettled: bool,
    /// Instances that are due and not queued.
    due: BTreeSet<usize>,
    /// Instances that have ended since the last event.
    news: Vec<usize>,
    progress: Progress,
    scratch: Vec<u8>,
}

/// What one pass hands on to another over the same graph.
#[derive(Default)]
pub(super) struct Known {
    results: HashMap<Digest, Arc<Head>>,
    forced: BTreeSet<Digest>,
}

impl<'p, 's> Session<'p, 's> {
    /// Declares the graph and looks up everything that can be looked up.
    pub(super) fn open(
        store: Arc<Store>,
        worktree: &'s Worktree,
        build_id: Option<&'s str>,
        request: &'s Request,
        known: Known,
        declare: &dyn Fn(&mut Graph<'p>),
    ) -> Self {
        let records = worktree.instances.iter();
        let mut graph = Graph::default();
        declare(&mut graph);
        let mut session = Self {
            store,
            worktree,
            build_id,
            request,
            graph,
            entries: Vec::new(),
            names: HashMap::new(),
            records: records.clone().map(|one| (&one.instance, one)).collect(),
            recorded: records.map(|one| (one.key, one)).collect(),
            results: known.results,
            agenda: BTreeSet::new(),
            forced: known.forced,
            notices: Vec::new(),
            memory_only: false,
            unsettled: false,
            due: BTreeSet::new(),
            news: Vec::new(),
            progress: Progress::default(),
            scratch: Vec::new(),
        };
        session.grow();
        session.settle();
        session.news.clear();
        session
    }

    /// Takes up instances that were declared since.
    fn grow(&mut self) {
        let known = self.entries.len();
        for index in known..self.graph.nodes.len() {
            let declared = &self.graph.nodes[index];
            let mut needs: Vec<usize> = declared.ports.list.iter().map(|port| port.node).collect();
            needs.sort_unstable();
            needs.dedup();
            for &need in &needs {
                self.entries[need].dependents.push(index);
            }
            let record = self.records.get(&*declared.instance).copied();
            self.entries.push(Entry {
                status: Status::Waiting,
                wanted: false,
                key: None,
                head: None,
                slot: Arc::default(),
                reasons: Vec::new(),
                told: Vec::new(),
                needs,
                dependents: Vec::new(),
                open_dependents: 0,
                ran: None,
                record,
                estimate: record.map(|record| record.head.duration()),
                urgency: Duration::ZERO,
            });
            let twin = self.names.insert(declared.instance.clone(), index);
            if twin.is_some() {
                let what = format!("`{}` is declared twice", declared.instance);
                self.entries[index].told.push(internal(DUPLICATE, what));
                self.entries[index].status = Status::Failed;
            }
            self.agenda.insert(index);
        }
        self.select();
        self.weigh();
    }

    /// Marks what the request asks for, with everything that it needs.
    fn select(&mut self) {
        let mut unfolding = vec![false; self.entries.len()];
        for (root, _) in &self.graph.unfolds {
            unfolding[*root] = true;
        }
        for index in (0..self.entries.len()).rev() {
            let entry = &self.entries[index];
            let wanted = entry.wanted
                || unfolding[index]
                || entry.dependents.iter().any(|&d| self.entries[d].wanted)
                || self
                    .graph
                    .selects(self.request, &self.graph.nodes[index].instance);
            if wanted && !entry.wanted {
                self.agenda.insert(index);
            }
            self.entries[index].wanted = wanted;
        }
        for index in 0..self.entries.len() {
            let open = self.entries[index]
                .dependents
                .iter()
                .filter(|&&d| self.entries[d].wanted && !self.entries[d].status.is_final())
                .count();
            self.entries[index].open_dependents = open;
        }
    }

    fn declared(&self, index: usize) -> &Declared {
        &self.graph.nodes[index]
    }

    /// What came through a port, as far as keys go. `None` while it is not known.
    fn through(&self, node: usize, kind: PortKind) -> Option<Supplies> {
        let entry = &self.entries[node];
        let settled = entry.head.as_ref();
        match (entry.status, kind) {
            (Status::Failed, PortKind::Attempt) if settled.is_some() => Some(Supplies::Nothing),
            (Status::Skipped { lasting: true }, PortKind::Attempt) => Some(Supplies::Nothing),
            (Status::Failed, _) => Some(Supplies::Failed {
                lasting: settled.is_some(),
            }),
            (Status::Skipped { lasting }, _) => Some(Supplies::Failed { lasting }),
            (Status::Stopped, _) => Some(Supplies::Failed { lasting: false }),
            // A known result stays known while its lost value is being made again.
            _ => {
                let head = settled?;
                Some(match kind {
                    PortKind::Warnings => Supplies::Result(head.diagnostics_digest()),
                    _ => Supplies::Result(head.digest()?),
                })
            }
        }
    }

    fn notice(&mut self, notice: Diagnostic) {
        if !self.notices.contains(&notice) {
            self.notices.push(notice);
        }
    }
}

/// What a dependency contributes to a key.
enum Supplies {
    Result(Digest),
    /// An attempt that failed for good.
    Nothing,
    Failed {
        lasting: bool,
    },
}

/// Receives events.
pub(super) type Observer<'o> = &'o mut dyn FnMut(Event<'_>);

/// An error that is the program's fault.
fn internal(code: &'static str, what: String) -> Diagnostic {
    Diagnostic::error(Code::new(code), what)
        .note("this is a defect of egg, not of the project")
        .help("please report it with the project file and the version that `egg --version` prints")
}

const PANICKED: &str = "E0801";
const NOT_CANONICAL: &str = "E0802";
const DUPLICATE: &str = "E0803";
const NOT_ENCODABLE: &str = "E0804";
const SILENT: &str = "E0806";
