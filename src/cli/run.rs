//! Running the engine for a command.

use super::args::Global;
use super::commands::cache;
use super::config::Config;
use super::console::Console;
use super::design::{Opened, unreadable_mesh};
use super::exit::Exit;
use super::interrupt;
use super::progress::Progress;
use crate::build::graph::{Design, Extent, declare};
use crate::build::{Built, Engine, Explanation, OutputCheck, Request, Settings, SourceFile};
use crate::diagnostics::{Severity, without_allowed};
use crate::project::model::Project;
use std::path::PathBuf;

/// How codes of the engine begin.
const ENGINE: &str = "E08";

/// A checked project with the engine that compiles it.
pub(super) struct Job {
    pub(super) opened: Opened,
    pub(super) engine: Engine,
    pub(super) output: PathBuf,
    mesh: SourceFile,
    console: Console,
}

impl Job {
    /// Prepares an engine; tells what is wrong with the project file.
    pub(super) fn prepare(console: Console, global: &Global, opened: Opened) -> Result<Self, Exit> {
        opened.tell(console, &opened.loaded.diagnostics);
        let project = opened.project()?;
        let mesh_path = opened.mesh_path(project).map_err(|diagnostic| {
            opened.tell(console, &[diagnostic]);
            Exit::Errors
        })?;
        let output = output_directory(global, &opened, project);
        let mut engine = Engine::open(settings(console, global, &output)?);
        let mesh = engine.source(&mesh_path).map_err(|error| {
            opened.tell(console, &[unreadable_mesh(project, &error)]);
            Exit::Errors
        })?;
        Ok(Self {
            opened,
            engine,
            output,
            mesh,
            console,
        })
    }

    /// Prepares an engine for a project whose mesh is at hand and that publishes nothing; `memory`
    /// names what the cache remembers of it.
    pub(super) fn detached(
        console: Console,
        global: &Global,
        opened: Opened,
        mesh: SourceFile,
        memory: PathBuf,
    ) -> Result<Self, Exit> {
        opened.tell(console, &opened.loaded.diagnostics);
        opened.project()?;
        Ok(Self {
            engine: Engine::open(settings(console, global, &memory)?),
            opened,
            output: memory,
            mesh,
            console,
        })
    }

    /// Builds up to an extent; tells diagnostics.
    pub(super) fn build(&mut self, request: &Request, extent: Extent) -> Result<Built, Exit> {
        let cancel = interrupt::token();
        let progress = Progress::new(self.console);
        // A graph that ends before the files has none to publish, and those of an earlier build
        // stay.
        let without_files = Request {
            outputs: OutputCheck::Ignore,
            ..request.clone()
        };
        let request = match extent {
            Extent::Files => request,
            Extent::Plan | Extent::Checks => &without_files,
        };
        let (opened, mesh) = (&self.opened, &self.mesh);
        let project = opened.project()?;
        let design = Design {
            project,
            spans: &opened.loaded.spans,
            mesh,
        };
        let built = self.engine.build(
            request,
            &|graph| declare(graph, design, extent),
            &cancel,
            &mut |event| progress.show(event),
        );
        progress.finish();
        let allowed = &project.allowed_lints;
        let told = without_allowed(built.diagnostics.clone(), allowed);
        let told = opened.in_terms_of_the_file(told);
        self.opened.fetch_mesh_text(&told);
        self.opened.tell(self.console, &told);
        if built.cancelled {
            return Err(Exit::Interrupted);
        }
        Ok(built)
    }

    /// What a build would do.
    pub(super) fn plan(
        &self,
        request: &Request,
        extent: Extent,
    ) -> Result<crate::build::Plan, Exit> {
        let design = self.design()?;
        Ok(self.engine.plan(request, &|graph| {
            declare(graph, design, extent);
        }))
    }

    /// Why an output or a stage is as it is; `None` if there is no such thing.
    pub(super) fn explain(
        &self,
        subject: &str,
        extent: Extent,
    ) -> Result<Option<Explanation>, Exit> {
        let design = self.design()?;
        Ok(self.engine.explain(subject, &|graph| {
            declare(graph, design, extent);
        }))
    }

    fn design(&self) -> Result<Design<'_>, Exit> {
        Ok(Design {
            project: self.opened.project()?,
            spans: &self.opened.loaded.spans,
            mesh: &self.mesh,
        })
    }

    /// How a build ended. A cache or an output directory that fails, a request for what is not
    /// there and a stage that breaks down are not the project's fault.
    pub(super) fn verdict(built: &Built) -> Exit {
        let errors = || {
            let all = built.diagnostics.iter();
            all.filter(|told| told.severity == Severity::Error)
        };
        if errors().any(|error| error.code.as_str().starts_with(ENGINE)) {
            Exit::Usage
        } else if built.succeeded() && errors().next().is_none() {
            Exit::Done
        } else {
            Exit::Errors
        }
    }
}

pub(super) fn output_directory(global: &Global, opened: &Opened, project: &Project) -> PathBuf {
    let folder = crate::fabrication::names::file_name(&project.name);
    global
        .out
        .clone()
        .unwrap_or_else(|| opened.beside("build").join(folder))
}

fn settings(console: Console, global: &Global, output: &std::path::Path) -> Result<Settings, Exit> {
    let config = Config::read(console)?;
    let cache = cache::directory(console, global, &config)?;
    let mut settings = Settings::new(cache, output);
    settings.limits = config.limits();
    if let Some(jobs) = global.jobs {
        settings.jobs = jobs.into();
    }
    if cfg!(debug_assertions) {
        settings.build_id = build_id();
    }
    Ok(settings)
}

/// What tells this binary from the one compiled before it.
fn build_id() -> Option<String> {
    let metadata = std::env::current_exe().ok()?.metadata().ok()?;
    Some(format!(
        "{:?} {}",
        metadata.modified().ok()?,
        metadata.len()
    ))
}
