//! `egg check`: everything that can be wrong with a design, without writing files.

use super::lock;
use crate::build::Request;
use crate::build::graph::{Extent, plan_of};
use crate::cli::args::Global;
use crate::cli::console::Console;
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
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
    held: Held,
) -> Result<Exit, Exit> {
    let opened = Opened::open(console, file)?;
    let mut job = Job::prepare(console, global, opened)?;
    let built = job.build(&Request::default(), Extent::Plan)?;
    let mut exit = Job::verdict(&built);
    if exit == Exit::Done && held == Held::Locked {
        let Some(plan) = plan_of(&built) else {
            console.complain("the plan cannot be read back from the cache", None);
            return Ok(Exit::Usage);
        };
        exit = lock::holds(console, job.opened.folder(), &plan);
    }
    if exit == Exit::Done {
        let project = job.opened.project()?;
        console.status("Checked", &project.name);
    }
    Ok(exit)
}
