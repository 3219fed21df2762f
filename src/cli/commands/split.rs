//! `egg split`: the points and patches that a workflow splits a project into, as text for its file.

use crate::build::Request;
use crate::build::graph::{Extent, laid_out, split_of};
use crate::cli::args::{Global, SplitWorkflow};
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::project::model::{Anchor, Patch, Project, SupportPlaces, Workflow};
use crate::project::{OwnLamella, Writing, layout_text};
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
    let writing = Writing {
        notation,
        lengths,
        said: &|key| unchanged(&job.opened, project, &laid, key),
    };
    out(&layout_text(&laid, &own, writing));
    if draft.patches.iter().all(|part| part.name == part.origin) {
        console.status("Note", "no patch has to be split");
    }
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

/// The words of the file for a value that splitting left as it is: the place of a point, the angle of
/// a patch.
fn unchanged<'a>(
    opened: &'a Opened,
    project: &Project,
    laid: &Project,
    key: &[&str],
) -> Option<&'a str> {
    let is_same = match *key {
        ["points", name] => {
            let find = |of: &Project| of.points.iter().find(|p| p.name == name).cloned();
            let place = find(project)?.anchor;
            let has_lengths = matches!(place, Anchor::Above(_) | Anchor::Near(_));
            has_lengths && Some(place) == find(laid).map(|point| point.anchor)
        }
        ["patches", name, "alpha"] => {
            let find = |of: &Project| of.patches.iter().find(|p| p.name == name)?.alpha;
            find(project) == find(laid)
        }
        _ => false,
    };
    is_same.then(|| opened.said(key.iter().copied()))?
}

/// What the file says of the lamellae of a patch, for a part of it.
fn own_lamella(opened: &Opened, origin: &str, part: &Patch) -> Option<OwnLamella> {
    opened.said(["lamella", origin])?;
    let said = |key: &str| opened.said(["lamella", origin, key]).map(str::to_owned);
    Some(OwnLamella {
        patch: part.name.clone(),
        width: said("width"),
        thickness: said("thickness"),
        material: said("material"),
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
