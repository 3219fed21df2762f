//! Sides that lie on the disk as projects.

use super::{Held, LOCK, Loaded, Source, compile, fall_back, file_name, memory};
use crate::build::SourceFile;
use crate::cli::args::Global;
use crate::cli::console::Console;
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::{Job, output_directory};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The project as it lies on the disk.
pub(super) fn load(
    console: Console,
    global: &Global,
    path: &Path,
    label: String,
    slot: &str,
) -> Result<Loaded, Exit> {
    let quiet = console.with_errors_only();
    let opened = Opened::open(quiet, Some(path))?;
    let folder = opened.folder().to_owned();
    let mut loaded = Loaded::new(label, Held::Nothing);
    let mesh_path = opened
        .loaded
        .project
        .as_ref()
        .map(|project| opened.mesh_path(project));
    let mesh = mesh_path
        .and_then(Result::ok)
        .and_then(|path| std::fs::read(path).ok());
    let mesh: Option<Arc<[u8]>> = mesh.map(Into::into);
    loaded.source = Some(Source::of(&opened, &file_name(path), mesh.clone()));
    let mut output = folder.join("build");
    let held = match (opened.loaded.project.as_ref(), mesh) {
        (Some(project), Some(bytes)) => {
            output = output_directory(global, &opened, project);
            let memory = memory(&output, slot);
            let mesh = SourceFile::from_bytes(folder.join(&project.surface.mesh), bytes.clone());
            let opened = opened.with_mesh(bytes);
            compile(Job::detached(quiet, global, opened, mesh, memory)?)?
        }
        // Tells what is wrong.
        _ => Job::prepare(quiet, global, opened)
            .map(|_| None)
            .or_else(|exit| match exit {
                Exit::Errors => Ok(None),
                exit => Err(exit),
            })?,
    };
    if let Some(plan) = held {
        loaded.held = Held::Plan(plan);
        return Ok(loaded);
    }
    let read = |path: PathBuf| std::fs::read(path).ok();
    let names = [
        (
            "the plan that was built last",
            read(output.join("plan.ron")),
        ),
        ("its `plan.lock`", read(folder.join(LOCK))),
    ];
    fall_back(&mut loaded, names);
    Ok(loaded)
}
