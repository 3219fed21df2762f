//! The incremental engine.

mod clock;
mod declare;
mod engine;
mod event;
pub mod graph;
mod key;
mod location;
mod needs;
mod passages;
mod plan;
mod publish;
mod reason;
mod request;
mod session;
mod source;
mod stage;
mod stages;
mod stamp;
mod store;

pub use clock::Clock;
pub use declare::{Graph, Instance};
pub use engine::{Built, Engine, Settings};
pub use event::{Event, How, Tally};
pub use key::{Digest, canon, recipe};
pub use location::{CacheNames, cache_directory};
pub use needs::{Attempt, Needs, Node, Ports, Supply, Warnings};
pub use plan::{Plan, PlannedStage, RootCause, State};
pub use publish::{Files, MANIFEST, OutputFile, Publication};
pub use reason::Reason;
pub use request::{Force, Foreign, OutputCheck, Request};
pub use session::BuiltStage;
pub use source::SourceFile;
pub use stage::{CancelToken, Cancelled, Context, Failure, Numerics, Outcome, Stage};
pub use store::collect::{Collected, Limits, Mode};
pub use store::inspect::{Cleaned, Status, Verified, WorktreeStatus};
pub use store::{Damage, Kind, Store};
