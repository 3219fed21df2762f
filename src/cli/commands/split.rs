//! `egg split`: the points and patches that a workflow splits a project into, as text for its file.

use crate::build::Request;
use crate::build::graph::{Extent, laid_out, split_of};
use crate::cli::args::{Global, SplitWorkflow};
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::project::model::{Lamella, Patch, Project, SupportPlaces, Workflow};
use crate::project::{OwnLamella, layout_text};
use crate::splitting::Draft;
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
    let laid = in_file_order(project, &draft);
    let (notation, lengths) = job.opened.writing();
    let own: Vec<OwnLamella> = laid
        .patches
        .iter()
        .filter_map(|patch| {
            let part = draft.patches.iter().find(|p| p.name == patch.name)?;
            own_lamella(&job.opened, &part.origin, patch)
        })
        .collect();
    out(&layout_text(&laid, &own, notation, lengths));
    for place in lost_supports(project, &draft) {
        console.status(
            "Note",
            &format!("`supports.at` names `{place}`, a crossing of a patch that is split"),
        );
    }
    Ok(exit)
}

/// Points and patches in the order of the project file, what is new after what was there: what is
/// printed, pasted and split again is printed alike.
fn in_file_order(project: &Project, draft: &Draft) -> Project {
    let mut draft = draft.clone();
    let point = |name: &str| project.points.iter().position(|p| p.name == name);
    let patch = |name: &str| project.patches.iter().position(|p| p.name == name);
    draft
        .points
        .sort_by_key(|p| point(&p.name).unwrap_or(usize::MAX));
    draft.patches.sort_by_key(|p| patch(&p.origin));
    laid_out(project, &draft)
}

/// What the file says of the lamellae of a patch, for a part of it.
fn own_lamella(opened: &Opened, origin: &str, part: &Patch) -> Option<OwnLamella> {
    if !opened.says(["lamella", origin]) {
        return None;
    }
    let Lamella {
        width,
        thickness,
        material,
    } = part.lamella.clone();
    let said = |key: &str| opened.says(["lamella", origin, key]);
    Some(OwnLamella {
        patch: part.name.clone(),
        width: said("width").then_some(width),
        thickness: said("thickness").then_some(thickness),
        material: said("material").then_some(material),
    })
}

/// Crossings that the project names and that are no more.
fn lost_supports<'a>(project: &'a Project, draft: &Draft) -> Vec<&'a str> {
    let SupportPlaces::Listed(places) = &project.supports.at else {
        return Vec::new();
    };
    let whole = |patch: &str| draft.patches.iter().any(|p| p.name == patch);
    let crossing = |place: &&String| {
        place
            .split_once('.')
            .is_some_and(|(patch, _)| !whole(patch))
    };
    places.iter().filter(crossing).map(String::as_str).collect()
}
