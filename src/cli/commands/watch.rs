//! `egg watch`: build again whenever the project file or its mesh is saved.

use super::build;
use crate::build::Request;
use crate::cli::args::Global;
use crate::cli::console::Console;
use crate::cli::design::{Opened, locate};
use crate::cli::exit::Exit;
use crate::cli::interrupt;
use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// Editors write a file in several steps; a build waits until it was quiet for so long.
const QUIET: Duration = Duration::from_millis(150);
/// How often Ctrl-C is looked for.
const LOOK: Duration = Duration::from_millis(100);

pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    request: &Request,
) -> Result<Exit, Exit> {
    let path = locate(console, file)?;
    let cancel = interrupt::token();
    loop {
        // Listening begins before the build, so that a save during it is not missed.
        let listener = Listener::new(console, &path)?;
        // What is wrong with the project has been told; the next save may mend it.
        let ended = build::compile(console, global, Some(&path), request).map(|_| ());
        if ended == Err(Exit::Interrupted) || cancel.is_cancelled() {
            return Ok(Exit::Interrupted);
        }
        console.status("Watching", &path.display().to_string());
        while !listener.changed() {
            if cancel.is_cancelled() {
                return Ok(Exit::Interrupted);
            }
        }
        listener.settle();
    }
}

/// Hears of changes of the project file and its mesh.
struct Listener {
    files: Vec<PathBuf>,
    events: Receiver<notify::Result<notify::Event>>,
    _watcher: RecommendedWatcher,
}

impl Listener {
    fn new(console: Console, project: &Path) -> Result<Self, Exit> {
        let mut files = vec![absolute(project)];
        files.extend(mesh_of(console, project).map(|mesh| absolute(&mesh)));
        let (sender, events) = channel();
        let watched = notify::recommended_watcher(sender).and_then(|mut watcher| {
            // Folders, not files: editors replace a file by another one of the same name.
            let mut folders: Vec<&Path> = files.iter().filter_map(|f| f.parent()).collect();
            folders.dedup();
            for folder in folders {
                watcher.watch(folder, RecursiveMode::NonRecursive)?;
            }
            Ok(watcher)
        });
        match watched {
            Ok(watcher) => Ok(Self {
                files,
                events,
                _watcher: watcher,
            }),
            Err(error) => {
                console.complain(
                    &format!("cannot watch `{}`: {error}", project.display()),
                    None,
                );
                Err(Exit::Usage)
            }
        }
    }

    /// Waits a moment for a change of one of the files.
    fn changed(&self) -> bool {
        match self.events.recv_timeout(LOOK) {
            Ok(event) => self.is_about_us(&event),
            Err(RecvTimeoutError::Timeout) => false,
            Err(RecvTimeoutError::Disconnected) => {
                std::thread::sleep(LOOK);
                false
            }
        }
    }

    /// Waits until no more changes come.
    fn settle(&self) {
        while self.events.recv_timeout(QUIET).is_ok() {}
    }

    fn is_about_us(&self, event: &notify::Result<notify::Event>) -> bool {
        event.as_ref().is_ok_and(|event| {
            !matches!(event.kind, EventKind::Access(_))
                && event.paths.iter().any(|path| self.files.contains(path))
        })
    }
}

fn absolute(path: &Path) -> PathBuf {
    // The folder may be a link; the name stays, since the file itself may be gone for a moment.
    let folder = path
        .parent()
        .filter(|p| *p != Path::new(""))
        .unwrap_or(Path::new("."));
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    path.file_name()
        .map_or_else(|| folder.clone(), |name| folder.join(name))
}

/// The mesh that the project names, if it can be read at all.
fn mesh_of(console: Console, project: &Path) -> Option<PathBuf> {
    let opened = Opened::open(console, Some(project)).ok()?;
    let model = opened.loaded.project.as_ref()?;
    Some(opened.folder().join(&model.surface.mesh))
}
