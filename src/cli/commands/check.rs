//! `egg check`: everything that can be wrong with a design, without writing files.

use crate::build::Request;
use crate::build::graph::Extent;
use crate::cli::args::Global;
use crate::cli::console::Console;
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use std::path::Path;

pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
) -> Result<Exit, Exit> {
    let opened = Opened::open(console, file)?;
    let mut job = Job::prepare(console, global, opened)?;
    let built = job.build(&Request::default(), Extent::Plan)?;
    let exit = Job::verdict(&built);
    if exit == Exit::Done {
        let project = job.opened.project()?;
        console.status("Checked", &project.name);
    }
    Ok(exit)
}
