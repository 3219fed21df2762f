//! `egg graph`: the dependency graph of a project.

use crate::build::graph::Extent;
use crate::build::{Request, dot, json};
use crate::cli::args::{Global, GraphFormat};
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use std::path::Path;

pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    format: GraphFormat,
) -> Result<Exit, Exit> {
    let console = console.with_document();
    let opened = Opened::open(console, file)?;
    let job = Job::prepare(console, global, opened)?;
    let plan = job.plan(&Request::default(), Extent::Files)?;
    out(&match format {
        GraphFormat::Dot => dot(&plan),
        GraphFormat::Json => json(&plan),
    });
    Ok(Exit::Done)
}
