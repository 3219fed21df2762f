//! `egg build`: compile a project.

use crate::build::graph::{Extent, plan_of};
use crate::build::{Built, Foreign, How, Plan, Request, State};
use crate::cli::args::{Global, Selection};
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::fabrication::sheet::trim;
use crate::fabrication::units::MM;
use crate::plan::NestingRecord;
use serde::Serialize;
use std::path::Path;
use std::time::Instant;

/// Compiles, and ends: nothing may come after it.
pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    request: &Request,
) -> Result<Exit, Exit> {
    let (exit, made) = compile(console, global, file, request)?;
    // The system takes the memory of a process back at once; piece by piece it takes longer than
    // reading the record of the last build.
    std::mem::forget(made);
    Ok(exit)
}

/// Compiles; what it was made of comes with the verdict.
pub(super) fn compile(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    request: &Request,
) -> Result<(Exit, (Job, Built)), Exit> {
    let begin = Instant::now();
    let opened = Opened::open(console, file)?;
    let mut job = Job::prepare(console, global, opened)?;
    let built = job.build(request, Extent::Files)?;
    let exit = Job::verdict(&built);
    finished(console, &job, &built, begin);
    Ok((exit, (job, built)))
}

/// What `--only`, `--stage` and `--force` ask for.
pub(in crate::cli) fn request(selection: &Selection, force: bool) -> Request {
    Request {
        targets: selection.only.clone(),
        stages: selection.stage.clone(),
        foreign: if force {
            Foreign::Replace
        } else {
            Foreign::Keep
        },
        ..Request::default()
    }
}

fn finished(console: Console, job: &Job, built: &Built, begin: Instant) {
    let (ran, cached) = (built.count(How::Ran), built.count(How::Cached));
    let failed = built.count(How::Failed) + built.count(How::FailedCached);
    let name = job
        .opened
        .loaded
        .project
        .as_ref()
        .map_or("", |p| p.name.as_str());
    let publication = &built.publication;
    // A build that ran nothing says nothing new, and opens no result to say it.
    if built.succeeded() && ran > 0 {
        nested(console, built);
    }
    console.record(&Finished {
        reason: "build-finished",
        success: built.succeeded(),
        stages: built.stages.len(),
        ran,
        cached,
        failed,
        written: &publication.written,
        removed: &publication.removed,
        output: job.output.to_string_lossy().into_owned(),
    });
    let files = match (publication.written.len(), publication.removed.len()) {
        (0, 0) => String::new(),
        (written, 0) => format!(", {} written", counted(written, "file")),
        (written, removed) => format!(", {} written, {removed} removed", counted(written, "file")),
    };
    let seconds = begin.elapsed().as_secs_f64();
    if built.succeeded() {
        console.status(
            "Finished",
            &format!(
                "{name} in {seconds:.2} s ({}, {cached} cached{files}) in {}",
                counted(built.stages.len(), "stage"),
                job.output.display()
            ),
        );
    } else {
        let skipped = match built.count(How::Skipped) {
            0 => String::new(),
            skipped => format!(", {skipped} that need them skipped"),
        };
        let what = match failed {
            0 => format!("{name}: not all files could be written"),
            failed => format!("{name}: {} failed{skipped}", counted(failed, "stage")),
        };
        console.status("Failed", &format!("{what}{files}"));
    }
}

/// How good the nesting is, for each material and thickness.
fn nested(console: Console, built: &Built) {
    let Some(plan) = plan_of(built) else {
        return;
    };
    for group in &plan.nesting {
        console.record(&Nested {
            reason: "nested",
            group,
        });
        console.status(
            "Nested",
            &format!(
                "{} {} mm on {} (at least {}), yield {:.1} % (at most {:.1} %)",
                group.material,
                trim(group.thickness * MM),
                counted(group.sheets as usize, "sheet"),
                group.sheets_bound,
                group.yield_share * 100.0,
                group.yield_bound * 100.0
            ),
        );
    }
}

#[derive(Serialize)]
struct Nested<'a> {
    reason: &'static str,
    #[serde(flatten)]
    group: &'a NestingRecord,
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

#[derive(Serialize)]
struct Finished<'a> {
    reason: &'static str,
    success: bool,
    stages: usize,
    ran: usize,
    cached: usize,
    failed: usize,
    written: &'a [String],
    removed: &'a [String],
    output: String,
}

/// `egg build --dry-run`.
pub(in crate::cli) fn dry_run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    request: &Request,
) -> Result<Exit, Exit> {
    let opened = Opened::open(console, file)?;
    let job = Job::prepare(console, global, opened)?;
    let plan = job.plan(request, Extent::Files)?;
    job.opened.tell(console, &plan.diagnostics);
    if console.is_json() {
        for stage in &plan.stages {
            console.record(&StagePlanned {
                reason: "stage-planned",
                stage: &stage.instance.stage,
                target: &stage.instance.target,
                state: stage.state.word(),
                after: match &stage.state {
                    State::Maybe { after } => after.iter().map(ToString::to_string).collect(),
                    _ => Vec::new(),
                },
                reasons: &stage.reasons,
            });
        }
    } else {
        out(&describe(&plan));
    }
    Ok(Exit::Done)
}

#[derive(Serialize)]
struct StagePlanned<'a> {
    reason: &'static str,
    stage: &'a str,
    target: &'a str,
    state: &'static str,
    /// What decides whether it runs, where that is not known yet.
    after: Vec<String>,
    reasons: &'a [crate::build::Reason],
}

/// Causes first, then what they make run, then the rest as a count.
fn describe(plan: &Plan) -> String {
    use std::fmt::Write;
    let mut text = String::new();
    let running = plan.count(|s| matches!(s, State::Run));
    let maybe = plan.count(|s| matches!(s, State::Maybe { .. }));
    let cached = plan.count(|s| matches!(s, State::Cached));
    if plan.is_idle() {
        return format!("nothing to do: {} stages cached\n", plan.stages.len());
    }
    let causes = plan.root_causes();
    for cause in causes.iter().take(5) {
        let whom: Vec<String> = cause
            .instances
            .iter()
            .take(4)
            .map(ToString::to_string)
            .collect();
        let more = cause.instances.len().saturating_sub(4);
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        let _ = writeln!(text, "{}: {}{more}", cause.reason, whom.join(", "));
    }
    if causes.len() > 5 {
        let _ = writeln!(text, "and {} more causes", causes.len() - 5);
    }
    for stage in &plan.stages {
        match &stage.state {
            State::Run => {
                let _ = writeln!(text, "     run {}", stage.instance);
            }
            State::Maybe { after } => {
                let after: Vec<String> = after.iter().map(ToString::to_string).collect();
                let _ = writeln!(
                    text,
                    "   maybe {} (if {} changes)",
                    stage.instance,
                    after.join(" or ")
                );
            }
            State::Failed => {
                let _ = writeln!(text, "  failed {}", stage.instance);
            }
            State::Skipped | State::Cached => {}
        }
    }
    let running = counted(running, "stage");
    let _ = writeln!(text, "{running} to run, {maybe} perhaps, {cached} cached");
    text
}
