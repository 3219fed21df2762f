//! The incremental engine: a build does what an edit touches, and nothing else.
//!
//! A project is compiled by a graph of *instances*: stages (pure functions, declared once as
//! [`Stage`] values) applied to a patch, a strip or the whole structure. Every result is kept on
//! disk under a *key* that names everything it depends on. A build looks all keys up, runs what
//! is not known, and brings the output directory in line.
//!
//! ```text
//! project ─► one small input an instance ──┐
//!                                          ├─► key ─► trace { digest of the output, what it said }
//! digests of the dependencies' outputs ────┘                        │
//!                                                                   └─► blob { the output }
//! ```
//!
//! Because keys hold *digests of outputs* and not keys of dependencies, a stage that runs again
//! and gives the same bytes leaves everything after it as it is (early cutoff). Because traces are
//! enough to chain keys, a build that has nothing to do reads one file and opens no blob.
//!
//! In the terms of *Build systems à la carte* (Mokhov, Mitchell, Peyton Jones, 2018) the engine is
//! topological with constructive traces of depth one; [`Graph::unfold`] makes it suspending where
//! the patches themselves are a result.
//!
//! # What enters a key, and why
//!
//! | enters | because |
//! |---|---|
//! | name and [`version`](Stage::version) of the stage | other code gives other results |
//! | [class of numerics](Numerics) | some libraries choose kernels, and bits, by the processor |
//! | the [canonical](canon) input: names and values of all its fields | it is what the stage sees |
//! | contents of input files, as a digest ([`SourceFile`]) | the same |
//! | digests of the dependencies' outputs, or of their diagnostics, and how they are grouped | the same |
//! | a build id, in developers' builds | there the version cannot be trusted |
//!
//! | does not enter | because |
//! |---|---|
//! | names of instances and of dependencies | a renamed patch is the same patch |
//! | keys of the project file, lines and columns, comments, order of tables | layout is no value |
//! | paths, of the project, of its files, of the output directory | clones and moved folders share results |
//! | times of files | touching is no edit, and an edit can keep the time |
//! | number of threads, order of events | results do not depend on them |
//! | version of the program | minutes of work survive an upgrade; versions of stages count |
//! | diagnostics of dependencies, unless asked for ([`Node::warnings`]) | a reworded warning moves no geometry |
//!
//! -0.0 equals 0.0; otherwise floats count by their bits. There is no tolerance in keys, since
//! being nearly equal is not transitive.
//!
//! # What is kept
//!
//! A result with its warnings, or the errors of a stage that failed for its inputs: both are told
//! again without running. What failed for a reason outside the inputs (a file that changed
//! meanwhile, a defect, the user's Ctrl-C) is not kept. Results are kept the moment a stage ends,
//! so a crash loses only what was running. The layout of the store and its rules about crashes
//! and damage stand in `store`, those of the collector in `store::collect`, those of the output
//! directory in `publish`.
//!
//! # Plans
//!
//! [`Engine::plan`] and [`Engine::build`] are one pass over the graph; the plan stops before
//! anything runs. A [`PlannedStage`] is cached, runs for [`Reason`]s, or may have to run,
//! depending on a result that is not there yet. Reasons come from comparing *recipes* (the fields
//! and digests that a key was made of, kept with every trace) with those of the last build of the
//! same output directory. [`Engine::explain`] follows them back to their causes, also long after
//! the build.
//!
//! # Running
//!
//! The calling thread makes look-ups and decides, stages run on a pool of
//! [`jobs`](Settings::jobs) threads that their parallel loops share. Of the ready instances the
//! one with the longest way to the end goes first, by the durations of earlier runs. Whatever
//! fails, everything that does not depend on it goes on. Two processes that need the same result
//! compute it once: the other waits, tells for whom, and loses patience after a while.
//!
//! # Known limits
//!
//! - A stage whose code changed without its version keeps its old results. Tests hold stages and
//!   versions together; developers' builds set [`Settings::build_id`].
//! - A *wrong* trace (of a program with a defect) is as sound as a right one; only its bytes are
//!   proven. [`Force`] runs stages again and tells if they differ.
//! - A plan cannot see damage before it reads; the build then runs more than was planned.
//! - Diagnostics can name only what their stage's input names. Keys of the project are translated
//!   ([`Graph::origin`]), so most inputs need no names.
//! - Published files are compared by size and times as long as these are the recorded ones;
//!   [`OutputCheck::Contents`] compares bytes.
//! - One blob an output: results of hundreds of megabytes should be several stages.
//! - Two outputs of one instance cannot be depended on apart; a small stage that projects one out
//!   of a large result does that, and cuts off early.
//! - Durations are those of the wall clock; a stage that waited for others while its parallel
//!   loops ran counts their time too. Only orders and estimates use them.

mod building;
mod clock;
mod declare;
mod engine;
mod event;
mod explain;
mod export;
pub mod graph;
mod key;
mod location;
mod needs;
mod passages;
mod plan;
mod publish;
mod publishing;
mod reason;
mod request;
mod session;
mod source;
mod stage;
mod stages;
mod stamp;
mod store;
mod unfolding;

pub use building::Built;
pub use clock::Clock;
pub use declare::{Graph, Instance};
pub use engine::{Engine, Settings};
pub use event::{Event, How, Tally};
pub use explain::{Cause, Explanation, Influence};
pub use export::{dot, json};
pub use key::{Digest, canon, recipe};
pub use location::{CacheNames, cache_directory, user_config_directory};
pub use needs::{Attempt, Needs, Node, Ports, Supply, Warnings};
pub use plan::{Plan, PlannedStage, RootCause, State};
pub use publish::{Files, MANIFEST, OutputFile, Publication};
pub use reason::Reason;
pub use request::{Force, Foreign, OutputCheck, Request};
pub use session::BuiltStage;
pub use source::SourceFile;
pub use stage::{CancelToken, Cancelled, Context, Failure, Numerics, Outcome, Stage};
pub use store::collect::{Collected, Limits, Mode, Tally as CacheTally};
pub use store::inspect::{Cleaned, Status, Verified, WorktreeStatus};
pub use store::{Damage, Kind, Store};
