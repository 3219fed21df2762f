//! Building: a pass over the graph, then publication, then the record for the next build.

use super::declare::Graph;
use super::engine::Engine;
use super::event::{Event, How};
use super::needs::Needs;
use super::publish::Publication;
use super::request::Request;
use super::session::{BuiltStage, Conditions, Kept, Known, retire, unwritable};
use super::stage::{CancelToken, Stage};
use super::store::Store;
use super::store::collect::Collected;
use super::store::worktree::{InstanceRecord, Outputs};
use crate::diagnostics::{Code, Diagnostic, Severity};
use std::sync::Arc;

/// What a build did.
pub struct Built {
    /// All instances that were asked for, in the graph's order.
    pub stages: Vec<BuiltStage>,
    /// Everything that was said, by stages and by the engine, in the graph's order.
    pub diagnostics: Vec<Diagnostic>,
    /// What happened in the output directory; nothing if the build was stopped.
    pub publication: Publication,
    /// Whether the user stopped it.
    pub cancelled: bool,
    /// What the collector did, if it was its turn.
    pub collected: Option<Collected>,
    store: Arc<Store>,
    kept: Vec<Kept>,
}

impl Built {
    /// Whether everything that was asked for is there.
    pub fn succeeded(&self) -> bool {
        !self.cancelled
            && self.stages.iter().all(|stage| stage.how.succeeded())
            && !self
                .diagnostics
                .iter()
                .any(|one| one.severity == Severity::Error)
    }

    /// Number of instances that ended like this.
    pub fn count(&self, how: How) -> usize {
        self.stages.iter().filter(|stage| stage.how == how).count()
    }

    /// The output of an instance, from memory or from the cache.
    pub fn output<I, N: Needs, O: Send + Sync + 'static>(
        &self,
        stage: &Stage<I, N, O>,
        target: &str,
    ) -> Option<Arc<O>> {
        let kept = self
            .kept
            .iter()
            .find(|kept| kept.instance.stage == stage.name && kept.instance.target == target)?;
        kept.load(&self.store)?.downcast().ok()
    }
}

/// Passes over a graph whose results turn out not to be repeatable; then the build gives up.
const PASSES: usize = 4;

impl Engine {
    /// Runs what has to run and publishes the results.
    ///
    /// `declare` lists the graph; it is called again if the pass has to be repeated. `observe`
    /// receives events on the calling thread.
    pub fn build<'p>(
        &mut self,
        request: &Request,
        declare: &dyn Fn(&mut Graph<'p>),
        cancel: &CancelToken,
        observe: &mut dyn FnMut(Event<'_>),
    ) -> Built {
        let shared = self.store.share();
        let conditions = Conditions {
            jobs: self.settings.jobs,
            patience: self.settings.patience,
            cancel: cancel.clone(),
        };
        let mut diagnostics = std::mem::take(&mut self.notices);
        let mut session = self.session(request, Known::default(), declare);
        observe(Event::Planned {
            tally: session.tally(conditions.jobs, &[]),
        });
        let mut passes = 1;
        let (outputs, publication) = loop {
            session.execute(&conditions, observe);
            let published = if session.is_unsettled() || !session.is_complete() {
                (None, Publication::default())
            } else {
                self.publish(request, &mut session, &conditions, observe)
            };
            if !session.is_unsettled() || passes == PASSES || cancel.is_cancelled() {
                break published;
            }
            diagnostics.extend(session.take_notices());
            session = self.session(request, session.into_known(), declare);
            passes += 1;
        };
        let cancelled = cancel.is_cancelled() && !session.is_complete();
        for notice in session.diagnostics() {
            if !diagnostics.contains(&notice) {
                diagnostics.push(notice);
            }
        }
        if session.is_unsettled() && !cancelled {
            diagnostics.push(not_repeatable());
        }
        diagnostics.extend(session.unmatched());
        diagnostics.extend(publication.diagnostics.iter().cloned());
        let stages = session.stages();
        let instances = session.records();
        let kept = session.into_kept();
        let forgotten = self.remember(instances, outputs);
        diagnostics.extend(forgotten.filter(|one| !has_code(&diagnostics, &one.code)));
        drop(shared);
        let ran = stages.iter().any(|stage| stage.how == How::Ran);
        let collected = (ran && !cancelled)
            .then(|| {
                let now = self.settings.clock.now();
                self.store.collect_if_due(&self.settings.limits, now)
            })
            .flatten();
        Built {
            stages,
            diagnostics,
            publication,
            cancelled,
            collected,
            store: self.store.clone(),
            kept,
        }
    }

    /// Keeps what the next build wants to know.
    fn remember(
        &mut self,
        instances: Option<Vec<InstanceRecord>>,
        outputs: Option<Outputs>,
    ) -> Option<Diagnostic> {
        let now = self.settings.clock.now();
        let sources = self.sources != self.worktree.sources && !self.sources.is_empty();
        let outputs_changed = outputs
            .as_ref()
            .is_some_and(|outputs| *outputs != self.worktree.outputs);
        if instances.is_none() && !outputs_changed && !sources {
            self.store.touch_worktree(&self.settings.output, now);
            return None;
        }
        if let Some(instances) = instances {
            retire(&self.store, &self.worktree, &instances, now);
            self.worktree.instances = instances;
        }
        if let Some(outputs) = outputs {
            self.worktree.outputs = outputs;
        }
        if sources {
            self.worktree.sources.clone_from(&self.sources);
        }
        self.worktree.directory = self.settings.output.display().to_string();
        self.store
            .put_worktree(&self.settings.output, &self.worktree, now)
            .err()
            .map(|error| unwritable(&error.to_string()))
    }
}

fn has_code(diagnostics: &[Diagnostic], code: &Code) -> bool {
    diagnostics.iter().any(|one| one.code == *code)
}

fn not_repeatable() -> Diagnostic {
    Diagnostic::error(
        Code::new("E0805"),
        "a stage gives another result every time it runs",
    )
    .note("this is a defect of egg, not of the project")
}
