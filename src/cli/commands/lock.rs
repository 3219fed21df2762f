//! `egg lock` writes what a project gives into `plan.lock`; `egg check --locked` holds the project
//! to it.

use crate::build::Request;
use crate::build::graph::{Extent, plan_of};
use crate::cli::args::Global;
use crate::cli::commands::diff::{LOCK, bad_lock};
use crate::cli::console::Console;
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::diff as codes;
use crate::diff::{Content, Context, Lock, between, lock_text, phrases_of};
use crate::plan::Plan;
use std::io::ErrorKind;
use std::path::Path;

/// Writes the lock beside the project file.
pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
) -> Result<Exit, Exit> {
    let opened = Opened::open(console, file)?;
    let mut job = Job::prepare(console, global, opened)?;
    let built = job.build(&Request::default(), Extent::Plan)?;
    let exit = Job::verdict(&built);
    let Some(plan) = plan_of(&built).filter(|_| exit == Exit::Done) else {
        return Ok(exit);
    };
    let path = job.opened.beside(LOCK);
    let text = lock_text(&plan);
    let old = std::fs::read_to_string(&path).ok();
    if let Some(Ok(lock)) = old.as_deref().map(Lock::read)
        && lock.project() != plan.name
    {
        console.tell_plainly(&[foreign(&path, &lock, &plan)]);
        return Ok(Exit::Errors);
    }
    let verb = if old.as_deref() == Some(&text) {
        "Kept"
    } else {
        std::fs::write(&path, &text).map_err(|error| {
            console.complain(&format!("cannot write `{}`: {error}", path.display()), None);
            Exit::Usage
        })?;
        "Locked"
    };
    let lines = text.lines().count() - 1;
    let what = format!("{}: {lines} parts in {}", plan.name, path.display());
    console.status(verb, &what);
    Ok(Exit::Done)
}

/// Whether the lock of a project is what a plan gives; if not, tells what differs.
pub(in crate::cli) fn holds(console: Console, opened: &Opened, plan: &Plan) -> Exit {
    let path = opened.beside(LOCK);
    let shown = path.display().to_string();
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let told = Diagnostic::error(codes::NO_LOCK, format!("there is no `{shown}`"));
            console.tell_plainly(&[told.help("write it with `egg lock` and commit it")]);
            return Exit::Errors;
        }
        Err(error) => {
            console.complain(&format!("cannot read `{shown}`: {error}"), None);
            return Exit::Usage;
        }
    };
    // A checkout may end its lines the way of another system.
    if text.replace("\r\n", "\n") == lock_text(plan) {
        return Exit::Done;
    }
    let told = match Lock::read(&text) {
        Err(error) => bad_lock(&shown, &error),
        Ok(lock) if lock.project() != plan.name => foreign(&path, &lock, plan),
        Ok(lock) => stale(&shown, &lock, plan),
    };
    console.tell_plainly(&[told]);
    Exit::Errors
}

fn foreign(path: &Path, lock: &Lock, plan: &Plan) -> Diagnostic {
    let (path, theirs, ours) = (path.display(), lock.project(), &plan.name);
    let message = format!("`{path}` is the lock of `{theirs}`, not of `{ours}`");
    Diagnostic::error(codes::FOREIGN_LOCK, message)
        .help("give each project a folder of its own; if it was renamed, remove the lock")
}

/// Most changes that are told of a stale lock.
const TOLD: usize = 6;

fn stale(shown: &str, lock: &Lock, plan: &Plan) -> Diagnostic {
    let difference = between(Content::Lock(lock), Content::Plan(plan), Context::default());
    let count = difference.changes.len();
    let message = format!("`{shown}` is not what the project gives");
    let mut told = Diagnostic::error(codes::STALE_LOCK, message);
    for change in difference.changes.iter().take(TOLD) {
        let what = phrases_of(change).join("; ");
        told = told.note(format!("{} {}: {what}", change.kind.word(), change.id));
    }
    if count > TOLD {
        told = told.note(format!("and {} more parts", count - TOLD));
    }
    if count == 0 {
        told = told.note("its parts are those of the project; its text was edited");
    }
    told.help("look with `egg diff plan.lock`; if this is meant, `egg lock` and commit")
}
