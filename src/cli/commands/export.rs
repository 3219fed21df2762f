//! `egg export`: the plan on standard output.

use crate::build::Request;
use crate::build::graph::{Extent, plan_of};
use crate::cli::args::{Global, PlanFormat};
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::plan::{to_json, to_ron};
use std::path::Path;

pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    format: PlanFormat,
) -> Result<Exit, Exit> {
    let console = console.with_document();
    let opened = Opened::open(console, file)?;
    let mut job = Job::prepare(console, global, opened)?;
    let built = job.build(&Request::default(), Extent::Plan)?;
    let Some(plan) = plan_of(&built) else {
        let exit = Job::verdict(&built);
        if exit == Exit::Done {
            console.complain("the plan cannot be read back from the cache", None);
            return Ok(Exit::Usage);
        }
        return Ok(exit);
    };
    out(&match format {
        PlanFormat::Json => to_json(&plan),
        PlanFormat::Ron => to_ron(&plan),
    });
    Ok(Job::verdict(&built))
}
