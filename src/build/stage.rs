//! What a stage is: a named, versioned, pure function from an input and the results of other
//! stages to one output.

use super::needs::Needs;
use crate::diagnostics::{Diagnostic, Warned};
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// A kind of work, declared once; [`Graph::add`](super::Graph::add) makes instances of it.
///
/// The function is a plain pointer: it captures nothing, so what is not in its input or among its
/// dependencies cannot reach it.
///
/// ```
/// use egg::build::{Graph, Node, Numerics, Stage};
/// use egg::diagnostics::Warned;
///
/// const LENGTH: Stage<String, (), usize> = Stage {
///     name: "length",
///     version: 1,
///     numerics: Numerics::Portable,
///     run: |text, (), _| Ok(Warned { value: text.len(), warnings: vec![] }),
/// };
/// const SUM: Stage<(), Vec<Node<usize>>, usize> = Stage {
///     name: "sum",
///     version: 1,
///     numerics: Numerics::Portable,
///     run: |(), lengths, _| Ok(Warned { value: lengths.into_iter().sum(), warnings: vec![] }),
/// };
///
/// let mut graph = Graph::default();
/// let lengths = ["a", "bc"].map(|text| graph.add(&LENGTH, text, text.to_owned(), ()));
/// graph.add(&SUM, "", (), lengths.to_vec());
/// ```
pub struct Stage<I, N: Needs, O> {
    /// Its name: `cladding`. It enters keys.
    pub name: &'static str,
    /// Raised whenever the same input may give other bytes. It enters keys.
    pub version: u32,
    /// What its bits depend on beside its inputs.
    pub numerics: Numerics,
    /// The function.
    pub run: for<'a> fn(&'a I, N::Values<'a>, &'a Context) -> Outcome<O>,
}

/// What the bits of a stage's output depend on beside its inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numerics {
    /// Nothing: fixed order of operations, transcendental functions of `libm`.
    Portable,
    /// The processor's vector units, because a library chooses its kernels by them.
    Processor,
}

impl Numerics {
    /// The class that enters keys.
    pub fn class(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            Self::Processor => processor_class(),
        }
    }
}

#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
fn processor_class() -> &'static str {
    if is_x86_feature_detected!("avx512f") {
        "x86-avx512"
    } else if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        "x86-avx2-fma"
    } else {
        "x86"
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "x86")))]
fn processor_class() -> &'static str {
    std::env::consts::ARCH
}

/// What a stage returns: a value with warnings, or why there is none.
pub type Outcome<O> = Result<Warned<O>, Failure>;

/// Why a stage has no value.
#[derive(Debug)]
pub enum Failure {
    /// Its inputs do not allow one. The same inputs will fail the same way, so the diagnostics
    /// are kept and told again without running the stage.
    Errors(Vec<Diagnostic>),
    /// Something outside the inputs went wrong; trying again may help, nothing is kept.
    Passing(Vec<Diagnostic>),
    /// It was asked to stop.
    Cancelled,
}

impl From<Vec<Diagnostic>> for Failure {
    fn from(errors: Vec<Diagnostic>) -> Self {
        Self::Errors(errors)
    }
}

impl From<Diagnostic> for Failure {
    fn from(error: Diagnostic) -> Self {
        Self::Errors(vec![error])
    }
}

impl From<Cancelled> for Failure {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// The user asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cancelled;

impl fmt::Display for Cancelled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("cancelled")
    }
}

impl std::error::Error for Cancelled {}

/// Asks running stages to stop; clones share one state.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Asks every holder to stop. Safe in a signal handler's thread.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What a running stage can say and ask.
#[derive(Debug, Default)]
pub struct Context {
    cancel: CancelToken,
    done: AtomicU64,
    total: AtomicU64,
}

impl Context {
    /// A context that listens to `cancel`. The default one is never cancelled.
    pub fn new(cancel: CancelToken) -> Self {
        Self {
            cancel,
            ..Self::default()
        }
    }

    /// Fails once the user asked to stop; called between the steps of long work.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.cancel.is_cancelled() {
            Err(Cancelled)
        } else {
            Ok(())
        }
    }

    /// Says how far the work is.
    pub fn progress(&self, done: u64, total: u64) {
        self.total.store(total, Ordering::Relaxed);
        self.done.store(done, Ordering::Relaxed);
    }

    /// What [`progress`](Self::progress) said last: (done, total).
    pub(crate) fn read(&self) -> (u64, u64) {
        (
            self.done.load(Ordering::Relaxed),
            self.total.load(Ordering::Relaxed),
        )
    }
}
