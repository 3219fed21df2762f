//! `egg check`: everything that can be wrong with a design, and the criteria of its patches,
//! without writing files.

use super::lock;
use crate::build::Request;
use crate::build::graph::{Extent, checks_of, plan_of};
use crate::cli::args::{CheckFormat, Global};
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::cli::table;
use crate::splitting::CheckDocument;
use std::path::Path;

/// Whether the project is held to its lock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Held {
    /// It is not.
    Free,
    /// It has to give what `plan.lock` says.
    Locked,
}

pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    format: CheckFormat,
    held: Held,
) -> Result<Exit, Exit> {
    let console = match format {
        CheckFormat::Table => console,
        CheckFormat::Json => console.with_document(),
    };
    let opened = Opened::open(console, file)?;
    let mut job = Job::prepare(console, global, opened)?;
    let built = job.build(&Request::default(), Extent::Checks)?;
    let mut exit = Job::verdict(&built);
    let project = job.opened.project()?;
    let checks = checks_of(&built);
    let checks = checks.as_deref().map_or(&[][..], Vec::as_slice);
    match format {
        CheckFormat::Table => {
            if !checks.is_empty() && console.prints_tables() {
                out(&table::checks(checks));
            }
        }
        CheckFormat::Json => {
            let sound = exit == Exit::Done;
            let document = CheckDocument::new(&project.name, sound, checks);
            let text = serde_json::to_string_pretty(&document).unwrap_or_default();
            out(&format!("{text}\n"));
        }
    }
    if exit == Exit::Done && held == Held::Locked {
        let Some(plan) = plan_of(&built) else {
            console.complain("the plan cannot be read back from the cache", None);
            return Ok(Exit::Usage);
        };
        exit = lock::holds(console, &job.opened, &plan);
    }
    if exit == Exit::Done {
        console.status("Checked", &project.name);
    }
    Ok(exit)
}
