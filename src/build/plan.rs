//! What a build would do: every instance with its state and the reasons.

use super::declare::Instance;
use super::key::Digest;
use super::reason::Reason;
use crate::diagnostics::Diagnostic;
use serde::Serialize;
use std::time::Duration;

/// What a build would do. It comes from the same look-ups that the build itself makes.
///
/// A plan cannot know what a run will give. An instance whose key depends on such a result is
/// `run` when its own input or version has changed too, or it was never built here (it may still
/// turn out to be known to the cache from elsewhere), and `maybe` when only that result decides.
/// Damaged results are found when they are read: a build may then run what the plan calls cached,
/// with reason `entry-damaged`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// All instances, in an order in which they could run.
    pub stages: Vec<PlannedStage>,
    /// Instances that the graph unfolds from and that have to run first: what follows them is not
    /// known, only what followed them in the last build.
    pub open: Vec<Instance>,
    /// About how long the build would take, going by earlier runs; none without such runs.
    pub remaining: Option<Duration>,
    /// Warnings and errors that are known without running anything.
    pub diagnostics: Vec<Diagnostic>,
}

/// One instance of a plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannedStage {
    /// Which.
    pub instance: Instance,
    /// What would happen.
    pub state: State,
    /// Why. A cached instance can have reasons too: its key or its published files have changed.
    pub reasons: Vec<Reason>,
    /// Its dependencies.
    pub needs: Vec<Instance>,
    /// Whether its files are published.
    pub publishes: bool,
    /// Its key, if all dependencies are known.
    pub key: Option<Digest>,
    /// Digest of its result, if that is known.
    pub result: Option<Digest>,
    /// How long it took before.
    pub estimate: Option<Duration>,
}

/// What would happen to an instance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// Its result is known.
    Cached,
    /// It runs.
    Run,
    /// It runs if one of these gives another result.
    Maybe {
        /// Dependencies that are to run.
        after: Vec<Instance>,
    },
    /// It is known to fail.
    Failed,
    /// Something that it needs is known to fail.
    Skipped,
}

impl State {
    /// One word for tables: `cached`, `run`, `maybe`, `failed`, `skipped`.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Cached => "cached",
            Self::Run => "run",
            Self::Maybe { .. } => "maybe",
            Self::Failed => "failed",
            Self::Skipped => "skipped",
        }
    }
}

impl Plan {
    /// Number of instances in this state.
    pub fn count(&self, state: fn(&State) -> bool) -> usize {
        let stages = self.stages.iter();
        stages.filter(|stage| state(&stage.state)).count()
    }

    /// Whether a build would run nothing and write nothing.
    pub fn is_idle(&self) -> bool {
        self.stages.iter().all(|stage| {
            matches!(stage.state, State::Cached | State::Failed | State::Skipped)
                && (stage.reasons.is_empty() || !stage.publishes)
        })
    }

    /// Adds what is known about the published files of an instance.
    pub(super) fn annotate(&mut self, owner: &Instance, reasons: Vec<Reason>) {
        if let Some(stage) = self.stages.iter_mut().find(|one| one.instance == *owner) {
            stage.reasons.extend(reasons);
        }
    }

    /// The causes from outside that make instances run, each with the instances that it reaches:
    /// everything but changes of dependencies, which follow from these.
    pub fn root_causes(&self) -> Vec<RootCause> {
        let mut causes: Vec<RootCause> = Vec::new();
        let running = |stage: &&PlannedStage| {
            matches!(stage.state, State::Run) || stage.reasons.iter().any(Reason::is_about_outputs)
        };
        for stage in self.stages.iter().filter(running) {
            let own = stage
                .reasons
                .iter()
                .filter(|reason| !matches!(reason, Reason::DependencyChanged { .. }));
            for reason in own {
                match causes.iter_mut().find(|cause| cause.reason == *reason) {
                    Some(cause) => cause.instances.push(stage.instance.clone()),
                    None => causes.push(RootCause {
                        reason: reason.clone(),
                        instances: vec![stage.instance.clone()],
                    }),
                }
            }
        }
        causes
    }
}

/// A cause from outside, and the instances that name it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct RootCause {
    /// What it is.
    pub reason: Reason,
    /// The instances for which it is a reason.
    pub instances: Vec<Instance>,
}
