//! The engine: one output directory, one cache, any number of plans and builds.

use super::clock::Clock;
use super::declare::{Graph, Instance};
use super::event::{Event, How};
use super::needs::Needs;
use super::plan::Plan;
use super::publish::{Claim, Claimed, Publication, Publishing, compare, inspect, manifest_stands};
use super::request::Request;
use super::session::{BuiltStage, Conditions, Kept, Publisher, Session, damage_notice, retire};
use super::source::SourceFile;
use super::stage::{CancelToken, Stage};
use super::stamp::Stamp;
use super::store::Store;
use super::store::collect::{Collected, Limits};
use super::store::worktree::{Outputs, SourceRecord, Worktree};
use crate::diagnostics::{Code, Diagnostic, Severity};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// How an engine works. Nothing here changes a result.
#[derive(Debug, Clone)]
pub struct Settings {
    /// The cache's directory.
    pub cache: PathBuf,
    /// The output directory; also the name under which the cache remembers the last build.
    pub output: PathBuf,
    /// Number of stages at a time, and of threads that they share.
    pub jobs: usize,
    /// How long another process may compute a result before this one computes it too.
    pub patience: Duration,
    /// Mixed into every key; set by developers' builds, so that no result outlives the code that
    /// made it. Results without it are kept from version to version.
    pub build_id: Option<String>,
    /// How much the cache may keep.
    pub limits: Limits,
    /// Where the time comes from.
    pub clock: Clock,
}

impl Settings {
    /// The usual settings: one stage at a time per processor.
    pub fn new(cache: impl Into<PathBuf>, output: impl Into<PathBuf>) -> Self {
        Self {
            cache: cache.into(),
            output: output.into(),
            jobs: std::thread::available_parallelism().map_or(1, Into::into),
            patience: Duration::from_secs(600),
            build_id: None,
            limits: Limits::default(),
            clock: Clock::default(),
        }
    }
}

/// Compiles graphs into one output directory.
#[derive(Debug)]
pub struct Engine {
    settings: Settings,
    store: Arc<Store>,
    worktree: Worktree,
    /// Input files that were asked for since the last build.
    sources: Vec<SourceRecord>,
    notices: Vec<Diagnostic>,
}

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
    /// An engine with the memory of the last build, if there was one.
    pub fn open(mut settings: Settings) -> Self {
        settings.jobs = settings.jobs.max(1);
        // The working directory may change while the engine lives.
        let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        settings.cache = absolute(&settings.cache);
        settings.output = absolute(&settings.output);
        let store = Arc::new(Store::new(&settings.cache));
        let (worktree, damage) = store.worktree(&settings.output);
        Self {
            settings,
            store,
            worktree,
            sources: Vec::new(),
            notices: damage.iter().map(damage_notice).collect(),
        }
    }

    /// The cache.
    pub fn store(&self) -> &Store {
        &self.store
    }

    /// An input file, known by its contents. It is read only if the file system says that it may
    /// have changed since the last build.
    pub fn source(&mut self, path: &Path) -> io::Result<SourceFile> {
        let path = std::path::absolute(path)?;
        // Before reading: a change in between makes the stamp stale, not the digest wrong.
        let stamp = Stamp::of(&std::fs::metadata(&path)?);
        let recorded = self.worktree.sources.iter().chain(&self.sources);
        let known = recorded
            .filter(|source| source.path == path && source.stamp == stamp)
            .map(|source| source.content)
            .next();
        let file = match known {
            Some(content) => SourceFile::known(&path, content),
            None => SourceFile::from_bytes(&path, std::fs::read(&path)?),
        };
        if stamp.proves(self.settings.clock.now()) {
            self.sources.retain(|source| source.path != path);
            self.sources.push(SourceRecord {
                path,
                stamp,
                content: file.digest(),
            });
        }
        Ok(file)
    }

    /// What building would do.
    pub fn plan<'p>(&self, request: &Request, declare: &dyn Fn(&mut Graph<'p>)) -> Plan {
        let _shared = self.store.share();
        let mut session = self.session(request, BTreeMap::new(), declare);
        let mut reasons = Vec::new();
        for publisher in session.publishers() {
            let found = match self.worktree.publication(&publisher.owner) {
                Some(record) if record.output == publisher.output => {
                    inspect(&self.settings.output, record, request.outputs)
                }
                // The stage itself has moved.
                Some(_) => continue,
                None => match session.files(publisher.index) {
                    Some(files) => compare(&self.settings.output, &files),
                    None => continue,
                },
            };
            if !found.is_empty() {
                session.demand_if_lost(publisher.index);
                reasons.push((publisher.owner, found));
            }
        }
        let mut plan = session.plan(self.settings.jobs);
        for (owner, reasons) in reasons {
            plan.annotate(&owner, reasons);
        }
        plan.diagnostics.splice(0..0, self.notices.iter().cloned());
        plan
    }

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
        let mut session = self.session(request, BTreeMap::new(), declare);
        observe(Event::Planned {
            tally: session.tally(conditions.jobs, &[]),
        });
        session.execute(&conditions, observe);
        let mut passes = 1;
        while session.is_unsettled() && passes < PASSES && !cancel.is_cancelled() {
            diagnostics.extend(session.take_notices());
            session = self.session(request, session.into_results(), declare);
            session.execute(&conditions, observe);
            passes += 1;
        }
        let cancelled = cancel.is_cancelled() && !session.is_complete();
        let (outputs, publication) = if cancelled || session.is_unsettled() {
            (None, Publication::default())
        } else {
            self.publish(request, &mut session, &conditions, observe)
        };
        for notice in session.diagnostics() {
            if !diagnostics.contains(&notice) {
                diagnostics.push(notice);
            }
        }
        if session.is_unsettled() && !cancelled {
            diagnostics.push(not_repeatable());
        }
        diagnostics.extend(publication.diagnostics.iter().cloned());
        let stages = session.stages();
        let instances = session.records();
        let kept = session.into_kept();
        diagnostics.extend(self.remember(instances, outputs));
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

    fn session<'p, 's>(
        &'s self,
        request: &'s Request,
        results: BTreeMap<super::key::Digest, Arc<super::store::trace::Head>>,
        declare: &dyn Fn(&mut Graph<'p>),
    ) -> Session<'p, 's> {
        Session::open(
            self.store.clone(),
            &self.worktree,
            self.settings.build_id.as_deref(),
            request,
            results,
            declare,
        )
    }

    /// Publishes what has a result. `None` if the directory is as recorded.
    fn publish(
        &self,
        request: &Request,
        session: &mut Session<'_, '_>,
        conditions: &Conditions,
        observe: &mut dyn FnMut(Event<'_>),
    ) -> (Option<Outputs>, Publication) {
        let directory = &self.settings.output;
        let old = &self.worktree.outputs;
        loop {
            let publishers = session.publishers();
            let standing: Vec<bool> = publishers
                .iter()
                .map(|one| {
                    self.worktree.publication(&one.owner).is_some_and(|record| {
                        record.output == one.output
                            && inspect(directory, record, request.outputs).is_empty()
                    })
                })
                .collect();
            let gone: BTreeSet<&Instance> = old
                .publications
                .iter()
                .map(|record| &record.owner)
                .filter(|owner| session.is_whole() && !session.publishes(owner))
                .collect();
            let stands = standing.iter().all(|&stands| stands) && manifest_stands(directory, old);
            if stands && gone.is_empty() {
                let files = old.publications.iter().map(|one| one.files.len());
                let publication = Publication {
                    unchanged: files.sum(),
                    ..Publication::default()
                };
                return (None, publication);
            }
            // A result that cannot be read any more has to be made again first.
            let Some(claims) = self.claims(session, &publishers, &standing) else {
                session.execute(conditions, observe);
                if session.is_complete() && !session.is_unsettled() {
                    continue;
                }
                return (None, Publication::default());
            };
            let claimed: BTreeSet<&Instance> = publishers.iter().map(|one| &*one.owner).collect();
            let others = old
                .publications
                .iter()
                .filter(|record| !claimed.contains(&record.owner) && !gone.contains(&record.owner));
            let names = session.publisher_names();
            let (outputs, publication) = Publishing {
                directory,
                claims,
                others: others.cloned().collect(),
                is_gone: &|owner| session.is_whole() && !names.contains(owner),
                foreign: request.foreign,
            }
            .run();
            return (Some(outputs), publication);
        }
    }

    /// What the publishers have and want. `None` if some of them have to run again for that.
    fn claims(
        &self,
        session: &mut Session<'_, '_>,
        publishers: &[Publisher],
        standing: &[bool],
    ) -> Option<Vec<Claim>> {
        let mut claims = Vec::new();
        for (publisher, stands) in publishers.iter().zip(standing) {
            let record = self.worktree.publication(&publisher.owner);
            let files = match record.filter(|_| *stands) {
                Some(record) => Some(Claimed::Standing(record.clone())),
                None => session.demand(publisher.index).map(Claimed::Wanted),
            };
            claims.push(files.map(|files| Claim {
                owner: publisher.owner.clone(),
                output: publisher.output,
                files,
            }));
        }
        claims.into_iter().collect()
    }

    /// Keeps what the next build wants to know.
    fn remember(
        &mut self,
        instances: Option<Vec<super::store::worktree::InstanceRecord>>,
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
            .put_worktree(&self.settings.output, &self.worktree)
            .err()
            .map(|error| super::session::unwritable(&error.to_string()))
    }
}

fn not_repeatable() -> Diagnostic {
    Diagnostic::error(
        Code::new("E0805"),
        "a stage gives another result every time it runs",
    )
    .note("this is a defect of egg, not of the project")
}
