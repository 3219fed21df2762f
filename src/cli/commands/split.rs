//! `egg split`: the points and patches that a workflow splits a project into, as text for its file.

use crate::build::Request;
use crate::build::graph::{Extent, laid_out, split_of};
use crate::cli::args::{Global, SplitWorkflow};
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::project::layout_text;
use crate::project::model::Workflow;
use std::path::Path;

pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    workflow: Option<SplitWorkflow>,
) -> Result<Exit, Exit> {
    let console = console.with_document();
    let mut opened = Opened::open(console, file)?;
    if let Some(project) = &mut opened.loaded.project {
        project.split.workflow = match (workflow, project.split.workflow) {
            (Some(SplitWorkflow::Automatic), _) | (None, Workflow::Off) => Workflow::Automatic,
            (Some(SplitWorkflow::Informed), _) => Workflow::Informed,
            (None, said) => said,
        };
    }
    let mut job = Job::prepare(console, global, opened)?;
    // A patch that cannot be measured is told where it is checked, so the patches belong to it.
    let request = Request {
        stages: ["split", "patch"].map(str::to_owned).to_vec(),
        ..Request::default()
    };
    let built = job.build(&request, Extent::Plan)?;
    let exit = Job::verdict(&built);
    let Some(draft) = split_of(&built).filter(|_| exit == Exit::Done) else {
        return Ok(exit);
    };
    let project = job.opened.project()?;
    let laid = laid_out(project, &draft);
    let (notation, lengths) = job.opened.writing();
    out(&layout_text(&laid, notation, lengths));
    for (part, origin) in draft.patches.iter().map(|p| (&p.name, &p.origin)) {
        if part != origin && job.opened.overrides_lamella(origin) {
            console.status(
                "Note",
                &format!("`lamella.{origin}` is to be repeated as `lamella.{part}`"),
            );
        }
    }
    Ok(exit)
}
