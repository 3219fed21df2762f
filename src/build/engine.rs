//! The engine: one output directory, one cache, any number of plans and builds.

use super::clock::Clock;
use super::declare::Graph;
use super::plan::Plan;
use super::publish::{compare, inspect};
use super::request::Request;
use super::session::{Known, Session, damage_notice};
use super::source::SourceFile;
use super::stamp::Stamp;
use super::store::Store;
use super::store::collect::Limits;
use super::store::worktree::{PublicationRecord, SourceRecord, Worktree};
use crate::diagnostics::Diagnostic;
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
    pub(super) settings: Settings,
    pub(super) store: Arc<Store>,
    pub(super) worktree: Worktree,
    /// Input files that were asked for since the last build.
    pub(super) sources: Vec<SourceRecord>,
    /// What there is to tell about the record of the last build.
    pub(super) notices: Vec<Diagnostic>,
}

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
        self.planned(request, declare).0
    }

    /// The plan, with the look-ups that it was made from.
    pub(super) fn planned<'p, 's>(
        &'s self,
        request: &'s Request,
        declare: &dyn Fn(&mut Graph<'p>),
    ) -> (Plan, Session<'p, 's>) {
        let mut session = self.session(request, Known::default(), declare);
        let directory = &self.settings.output;
        let mut reasons = Vec::new();
        for publisher in session.publishers() {
            let found = match self.worktree.publication(&publisher.owner) {
                Some(record) if record.output == publisher.output => {
                    inspect(directory, record, request.outputs)
                }
                // The stage itself has moved, and says so.
                Some(_) => continue,
                None => match session.files(publisher.index) {
                    Some(files) => compare(directory, &files),
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
        let noticed = self.notices.iter().cloned();
        plan.diagnostics.splice(0..0, noticed);
        plan.diagnostics.extend(session.unmatched());
        (plan, session)
    }

    /// The output directory.
    pub fn output(&self) -> &Path {
        &self.settings.output
    }

    /// What stands in the output directory by the last build.
    pub(super) fn publications(&self) -> impl Iterator<Item = &PublicationRecord> {
        self.worktree.outputs.publications.iter()
    }

    /// A pass over the graph, with all look-ups made.
    pub(super) fn session<'p, 's>(
        &'s self,
        request: &'s Request,
        known: Known,
        declare: &dyn Fn(&mut Graph<'p>),
    ) -> Session<'p, 's> {
        Session::open(
            self.store.clone(),
            &self.worktree,
            self.settings.build_id.as_deref(),
            request,
            known,
            declare,
        )
    }
}
