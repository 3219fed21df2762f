//! Running one instance on some thread: fetch what it needs, run it, keep what it gave.

use super::super::clock::Stopwatch;
use super::super::declare::{Made, Work};
use super::super::key::Digest;
use super::super::key::recipe::Recipe;
use super::super::needs::{Supplied, Value};
use super::super::stage::{Context, Failure};
use super::super::store::lease::Lease;
use super::super::store::sealed::Durability;
use super::super::store::trace::{Head, Output, Trace};
use super::super::store::{Damage, Found, Store};
use super::{NOT_ENCODABLE, PANICKED, SILENT, Slot, internal};
use crate::diagnostics::{Diagnostic, Severity};
use std::any::Any;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::Duration;

/// Outputs up to this length live in their trace.
const INLINE: usize = 1 << 10;
/// The same for outputs that the graph unfolds from.
const INLINE_UNFOLDING: usize = 256 << 10;
/// What took longer is written through to the disk.
const PRECIOUS: Duration = Duration::from_secs(1);

/// Everything that a run needs.
pub(super) struct Task {
    pub(super) work: Arc<dyn Work>,
    pub(super) name: String,
    pub(super) key: Digest,
    pub(super) recipe: Recipe,
    pub(super) ports: Vec<Intake>,
    pub(super) unfolds: bool,
    pub(super) store: Arc<Store>,
    pub(super) context: Arc<Context>,
    pub(super) lease: Option<Lease>,
}

/// Where the content of a port comes from.
pub(super) enum Intake {
    Value {
        node: usize,
        work: Arc<dyn Work>,
        slot: Arc<Slot>,
        head: Arc<Head>,
    },
    Warnings(Arc<Head>),
    Nothing,
}

/// How a run ended.
pub(super) enum Ending {
    /// With a value, or with errors that are final.
    Settled {
        head: Arc<Head>,
        value: Option<Value>,
        /// Whether the result was kept.
        kept: io::Result<()>,
    },
    /// Without a result that could be kept.
    Passing(Vec<Diagnostic>),
    Cancelled,
    /// Values that it needs are gone.
    Lacking(Vec<(usize, Lost)>),
}

/// Why a value cannot be read.
pub(in crate::build) enum Lost {
    Missing,
    Damaged(Damage),
}

impl Task {
    /// Runs the instance. The lease is given back when its result is in the store.
    pub(super) fn run(mut self) -> Ending {
        // Nothing that unwinds is used afterwards but the name.
        let ending = catch_unwind(AssertUnwindSafe(|| self.attempt()));
        drop(self.lease.take());
        ending.unwrap_or_else(|payload| {
            let what = format!("`{}` broke down: {}", self.name, panic_text(&*payload));
            Ending::Passing(vec![internal(PANICKED, what)])
        })
    }

    fn attempt(&self) -> Ending {
        let supplied = match self.fetch() {
            Ok(supplied) => supplied,
            Err(lacking) => return Ending::Lacking(lacking),
        };
        let watch = Stopwatch::start();
        let outcome = self.work.run(&supplied, &self.context);
        drop(supplied);
        let elapsed = watch.elapsed();
        match outcome {
            Ok(made) => self.keep(made, elapsed),
            Err(Failure::Errors(mut errors)) => {
                if errors.iter().all(|one| one.severity != Severity::Error) {
                    let what = format!("`{}` failed without saying why", self.name);
                    errors.push(internal(SILENT, what));
                }
                let head = head(None, errors, elapsed);
                let kept = self.record(&head, Durability::Process);
                Ending::Settled {
                    head: Arc::new(head),
                    value: None,
                    kept,
                }
            }
            Err(Failure::Passing(errors)) => Ending::Passing(errors),
            Err(Failure::Cancelled) => Ending::Cancelled,
        }
    }

    fn fetch(&self) -> Result<Vec<Supplied>, Vec<(usize, Lost)>> {
        let mut supplied = Vec::with_capacity(self.ports.len());
        let mut lacking = Vec::new();
        for port in &self.ports {
            match port {
                Intake::Warnings(head) => supplied.push(Supplied::Warnings(head.clone())),
                Intake::Nothing => supplied.push(Supplied::Nothing),
                Intake::Value {
                    node,
                    work,
                    slot,
                    head,
                } => match load(&self.store, slot, head, &**work) {
                    Ok(value) => supplied.push(Supplied::Value(value)),
                    Err(lost) => lacking.push((*node, lost)),
                },
            }
        }
        if lacking.is_empty() {
            Ok(supplied)
        } else {
            Err(lacking)
        }
    }

    fn keep(&self, made: Made, elapsed: Duration) -> Ending {
        let bytes = match made.bytes {
            Ok(bytes) => bytes,
            Err(error) => {
                let what = format!("the result of `{}` cannot be kept: {error}", self.name);
                return Ending::Passing(vec![internal(NOT_ENCODABLE, what)]);
            }
        };
        let limit = if self.unfolds {
            INLINE_UNFOLDING
        } else {
            INLINE
        };
        let durability = if elapsed > PRECIOUS {
            Durability::Disk
        } else {
            Durability::Process
        };
        let inline = bytes.len() <= limit;
        let output = Output {
            digest: Digest::of(&bytes),
            size: bytes.len() as u64,
            inline: inline.then(|| bytes.clone()),
        };
        let head = head(Some(output), made.warnings, elapsed);
        let blob = if inline {
            Ok(())
        } else {
            self.store.put_blob(&bytes, durability).map(drop)
        };
        let kept = blob.and_then(|()| self.record(&head, durability));
        Ending::Settled {
            head: Arc::new(head),
            value: Some(made.value),
            kept,
        }
    }

    fn record(&self, head: &Head, durability: Durability) -> io::Result<()> {
        let trace = Trace {
            key: self.key,
            head: head.clone(),
            recipe: self.recipe.clone(),
        };
        self.store.put_trace(&trace, durability)
    }
}

/// The value behind `head`: from memory, from its record or from the store.
pub(in crate::build) fn load(
    store: &Store,
    slot: &Slot,
    head: &Head,
    work: &dyn Work,
) -> Result<Value, Lost> {
    let mut held = slot.lock();
    if let Some(value) = &*held {
        return Ok(value.clone());
    }
    let Some(output) = &head.output else {
        return Err(Lost::Missing);
    };
    let decoded = if let Some(bytes) = &output.inline {
        work.decode(bytes).map_err(|error| {
            Lost::Damaged(Damage {
                file: format!("record of `{}`", work.stage()),
                what: error.to_string(),
            })
        })
    } else {
        match store.blob(output.digest) {
            Found::Whole(blob) => work.decode(blob.payload()).map_err(|error| {
                Lost::Damaged(store.reject_blob(output.digest, &error.to_string()))
            }),
            Found::Absent => Err(Lost::Missing),
            Found::Damaged(damage) => Err(Lost::Damaged(damage)),
        }
    };
    let value = decoded?;
    *held = Some(value.clone());
    Ok(value)
}

fn head(output: Option<Output>, diagnostics: Vec<Diagnostic>, elapsed: Duration) -> Head {
    Head {
        output,
        diagnostics,
        micros: u64::try_from(elapsed.as_micros()).unwrap_or(u64::MAX),
    }
}

fn panic_text(payload: &(dyn Any + Send)) -> &str {
    payload
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}
