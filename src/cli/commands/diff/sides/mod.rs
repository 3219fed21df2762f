//! The two sides of a comparison: what the arguments mean, and how each side is had.

mod files;
mod revision;
mod work_tree;

pub(super) use files::other_format;
pub(in crate::cli) use files::{bad_lock, bad_plan};

use crate::build::Request;
use crate::build::graph::{Extent, plan_of};
use crate::cli::args::Global;
use crate::cli::console::Console;
use crate::cli::design::{Opened, locate};
use crate::cli::exit::Exit;
use crate::cli::git::{Repository, RepositoryKind};
use crate::cli::run::Job;
use crate::diagnostics::SpanTable;
use crate::diff::{Content, Lock, Side};
use crate::plan::{Plan, from_ron};
use files::{is_plan, lock_file, plan_file};
use revision::Revision;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Name of the lock beside a project file.
pub(in crate::cli) const LOCK: &str = "plan.lock";

/// What is compared.
#[derive(Debug)]
pub(super) struct Sides {
    ends: [End; 2],
    /// The project file of revisions and of the working tree, where it was named.
    file: Option<PathBuf>,
}

/// One side, as it was asked for.
#[derive(Debug, Clone)]
enum End {
    /// The files as they lie on the disk.
    WorkTree,
    /// A revision; the common ancestor of it and another where that is given.
    Revision(String, Option<String>),
    /// A plan that was written.
    Plan(PathBuf),
    /// A lock that was written.
    Lock(PathBuf),
    /// A project file on the disk.
    Project(PathBuf),
}

impl Sides {
    /// Tells revisions, plans, locks and project files apart.
    pub(super) fn parse(console: Console, arguments: &[String]) -> Result<Self, Exit> {
        let mut ends = Vec::new();
        let mut files = Vec::new();
        for argument in arguments {
            let path = PathBuf::from(argument);
            let ending = path.extension().and_then(|ending| ending.to_str());
            match ending {
                _ if path.join("plan.ron").is_file() => ends.push(End::Plan(path.join("plan.ron"))),
                Some("ron") if is_plan(&path) => ends.push(End::Plan(path)),
                Some("lock") if path.is_file() => ends.push(End::Lock(path)),
                Some("toml" | "ron") => files.push(path),
                _ => match argument
                    .split_once("...")
                    .or_else(|| argument.split_once(".."))
                {
                    Some((from, to)) => {
                        let end = |name: &str| match name {
                            "" => "HEAD".to_owned(),
                            name => name.to_owned(),
                        };
                        let ancestor = argument.contains("...").then(|| end(to));
                        ends.push(End::Revision(end(from), ancestor));
                        ends.push(End::Revision(end(to), None));
                    }
                    None => ends.push(End::Revision(argument.clone(), None)),
                },
            }
        }
        if let ([], [_, _]) = (ends.as_slice(), files.as_slice()) {
            ends = files.drain(..).map(End::Project).collect();
        }
        let wrong = |message: &str| {
            console.complain(
                message,
                Some("compare two revisions, two plans, or one of them with the working tree"),
            );
            Exit::Usage
        };
        let mut files = files.into_iter();
        let file = files.next();
        if files.next().is_some() {
            return Err(wrong("revisions are compared by one project file"));
        }
        let mut ends = ends.into_iter();
        let ends = match (ends.next(), ends.next(), ends.next()) {
            (None, _, _) => [End::Revision("HEAD".to_owned(), None), End::WorkTree],
            (Some(one), None, _) => [one, End::WorkTree],
            (Some(one), Some(two), None) => [one, two],
            _ => return Err(wrong("there are more than two sides")),
        };
        Ok(Self { ends, file })
    }

    /// Compiles or reads both sides. What is wrong with one is told; the other is had anyway.
    pub(super) fn load(self, console: Console, global: &Global) -> Result<[Loaded; 2], Exit> {
        let is_revision = |end: &End| matches!(end, End::Revision(..));
        let mut file = self.file;
        let mut repository = None;
        if self.ends.iter().any(is_revision) {
            let parent = file.as_deref().and_then(Path::parent).map(Path::to_owned);
            let (folder, below) = match (parent, &file) {
                (Some(parent), Some(file)) if parent.is_dir() => {
                    (parent, file.file_name().map(PathBuf::from))
                }
                _ => (PathBuf::from("."), file.clone()),
            };
            let found = Repository::around(&folder).map_err(|told| {
                console.tell_plainly(&[told]);
                Exit::Usage
            })?;
            let works = self.ends.iter().any(|end| matches!(end, End::WorkTree));
            let below = match below {
                None if works && found.kind == RepositoryKind::WorkTree => {
                    file = Some(locate(console, None)?);
                    file.clone()
                }
                below => below,
            };
            repository = Some((found, below));
        }
        let [before, after] = self.ends;
        let load = |end: End, slot: &'static str| -> Result<Loaded, Exit> {
            match end {
                End::WorkTree => {
                    let path = locate(console, file.as_deref())?;
                    work_tree::load(console, global, &path, "working tree".to_owned(), slot)
                }
                End::Project(path) => {
                    let label = path.display().to_string();
                    work_tree::load(console, global, &path, label, slot)
                }
                End::Plan(path) => plan_file(console, &path),
                End::Lock(path) => lock_file(console, &path),
                End::Revision(name, ancestor) => {
                    let Some((repository, file)) = &repository else {
                        return Err(Exit::Usage);
                    };
                    let revision = Revision {
                        repository,
                        file: file.as_deref(),
                        label: name,
                        ancestor,
                        slot,
                    };
                    revision.load(console, global)
                }
            }
        };
        Ok([load(before, "before")?, load(after, "after")?])
    }
}

/// A side that was had, as far as it could be.
#[derive(Debug)]
pub(super) struct Loaded {
    pub(super) side: Side,
    pub(super) held: Held,
    /// The texts that it was compiled from, if it was.
    pub(super) source: Option<Source>,
    /// Whether it does not compile.
    pub(super) failed: bool,
    pub(super) notes: Vec<String>,
}

/// What stands for a side.
#[derive(Debug)]
pub(super) enum Held {
    /// A plan.
    Plan(Arc<Plan>),
    /// A lock.
    Lock(Lock),
    /// Nothing could be had.
    Nothing,
}

/// Project file and mesh as texts.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) name: String,
    pub(super) text: String,
    pub(super) spans: SpanTable,
    pub(super) mesh: Option<Arc<[u8]>>,
    pub(super) mesh_name: String,
    pub(super) metres_per_unit: f64,
}

impl Loaded {
    fn new(label: impl Into<String>, held: Held) -> Self {
        Self {
            side: Side {
                label: label.into(),
                ..Side::default()
            },
            held,
            source: None,
            failed: false,
            notes: Vec::new(),
        }
    }

    /// What it is compared by.
    pub(super) fn content(&self) -> Option<Content<'_>> {
        match &self.held {
            Held::Plan(plan) => Some(Content::Plan(plan)),
            Held::Lock(lock) => Some(Content::Lock(lock)),
            Held::Nothing => None,
        }
    }
}

impl Source {
    fn of(opened: &Opened, name: &str, mesh: Option<Arc<[u8]>>) -> Self {
        let surface = opened
            .loaded
            .project
            .as_ref()
            .map(|project| &project.surface);
        Self {
            name: name.to_owned(),
            text: opened.text().to_owned(),
            spans: opened.loaded.spans.clone(),
            mesh,
            mesh_name: surface.map_or(String::new(), |surface| surface.mesh.clone()),
            metres_per_unit: surface.map_or(1.0, |surface| surface.metres_per_unit),
        }
    }
}

/// A file name for people.
fn file_name(path: &Path) -> String {
    path.file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// Compiles a prepared project.
fn compile(mut job: Job) -> Result<Option<Arc<Plan>>, Exit> {
    let built = job.build(&Request::default(), Extent::Plan)?;
    let plan = plan_of(&built);
    Ok(plan.filter(|_| Job::verdict(&built) == Exit::Done))
}

/// In the names of [`memory`].
const MEMORY: &str = ".diff-";

/// Whether a directory that the cache knows is a side that was compiled to be compared.
pub(in crate::cli) fn is_memory(directory: &Path) -> bool {
    let slot = file_name(directory);
    let slot = slot.rsplit_once(MEMORY).map(|(_, slot)| slot);
    matches!(slot, Some("before" | "after"))
}

/// What the cache calls a side that is compiled to be compared: it keeps one of each per output
/// directory, so that the next comparison finds them at once.
fn memory(output: &Path, slot: &str) -> PathBuf {
    let name = file_name(output);
    output.with_file_name(format!("{name}{MEMORY}{slot}"))
}

/// Compares with what is left of a side that does not compile.
fn fall_back<const N: usize>(loaded: &mut Loaded, names: [(&str, Option<Vec<u8>>); N]) {
    loaded.failed = true;
    let label = &loaded.side.label;
    for (what, bytes) in names {
        let Some(text) = bytes.and_then(|bytes| String::from_utf8(bytes).ok()) else {
            continue;
        };
        let held = match Lock::read(&text) {
            Ok(lock) => Held::Lock(lock),
            Err(_) => match from_ron(&text) {
                Ok(plan) => Held::Plan(Arc::new(plan)),
                Err(_) => continue,
            },
        };
        let note = format!("{label} does not compile; {what} is compared instead");
        loaded.notes.push(note);
        loaded.held = held;
        return;
    }
}
