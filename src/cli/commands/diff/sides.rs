//! The two sides of a comparison: what the arguments mean, and how each side is had.

use crate::build::graph::{Extent, plan_of};
use crate::build::{Request, SourceFile};
use crate::cli::args::Global;
use crate::cli::console::Console;
use crate::cli::design::{Opened, locate, mesh_outside, says_project};
use crate::cli::exit::Exit;
use crate::cli::git::{Commit, Reader, Repository, RepositoryKind, resolved};
use crate::cli::run::{Job, output_directory};
use crate::diagnostics::codes::diff as codes;
use crate::diagnostics::{Diagnostic, SpanTable};
use crate::diff::{Content, Lock, LockError, Side};
use crate::plan::{Plan, ReadError, from_ron};
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
                    work_tree(console, global, &path, "working tree".to_owned(), slot)
                }
                End::Project(path) => {
                    let label = path.display().to_string();
                    work_tree(console, global, &path, label, slot)
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

/// Whether a file is a plan and not a project in the same notation: a plan begins with its format.
fn is_plan(path: &Path) -> bool {
    use std::io::Read;
    let mut head = String::new();
    let file = std::fs::File::open(path);
    let read = file.and_then(|file| file.take(200).read_to_string(&mut head));
    let begin = head.trim_start().trim_start_matches('(').trim_start();
    read.is_ok() && begin.starts_with("format")
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

/// The project as it lies on the disk.
fn work_tree(
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

/// What the cache calls a side that is compiled to be compared: it keeps one of each per output
/// directory, so that the next comparison finds them at once.
fn memory(output: &Path, slot: &str) -> PathBuf {
    let name = file_name(output);
    output.with_file_name(format!("{name}.diff-{slot}"))
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

/// A plan that was written.
fn plan_file(console: Console, path: &Path) -> Result<Loaded, Exit> {
    let shown = path.display().to_string();
    let text = read(console, path)?;
    match from_ron(&text) {
        Ok(plan) => Ok(Loaded::new(shown, Held::Plan(Arc::new(plan)))),
        Err(error) => {
            console.tell_plainly(&[bad_plan(&shown, &error)]);
            Err(Exit::Usage)
        }
    }
}

/// Why a plan cannot be read.
pub(in crate::cli) fn bad_plan(shown: &str, error: &ReadError) -> Diagnostic {
    match error {
        ReadError::UnknownFormat(format) => other_format(shown, u64::from(*format)),
        ReadError::Malformed {
            message,
            at: (line, column),
        } => Diagnostic::error(
            codes::BAD_PLAN,
            format!("`{shown}` is no plan: {message} (line {line}, column {column})"),
        )
        .help("build it again; plans are results and are not edited"),
    }
}

/// A file of a newer program.
pub(super) fn other_format(shown: &str, format: u64) -> Diagnostic {
    let message = format!("`{shown}` has format {format}, which this egg does not know");
    Diagnostic::error(codes::OTHER_FORMAT, message)
        .help("use the egg that wrote it, or write it again with this one")
}

/// A lock that was written.
fn lock_file(console: Console, path: &Path) -> Result<Loaded, Exit> {
    let shown = path.display().to_string();
    let text = read(console, path)?;
    match Lock::read(&text) {
        Ok(lock) => Ok(Loaded::new(shown, Held::Lock(lock))),
        Err(error) => {
            console.tell_plainly(&[bad_lock(&shown, &error)]);
            Err(Exit::Usage)
        }
    }
}

/// Why a lock cannot be read.
pub(in crate::cli) fn bad_lock(shown: &str, error: &LockError) -> Diagnostic {
    match error {
        LockError::UnknownFormat(format) => other_format(shown, u64::from(*format)),
        LockError::Malformed(line, message) => {
            let message = format!("`{shown}` cannot be read in line {line}: {message}");
            Diagnostic::error(codes::BAD_LOCK, message).help("write it anew: `egg lock`")
        }
    }
}

fn read(console: Console, path: &Path) -> Result<String, Exit> {
    std::fs::read_to_string(path).map_err(|error| {
        console.complain(&format!("cannot read `{}`: {error}", path.display()), None);
        Exit::Usage
    })
}

/// A side that is read from a repository.
struct Revision<'a> {
    repository: &'a Repository,
    /// The project file, relative to the repository's folder.
    file: Option<&'a Path>,
    label: String,
    ancestor: Option<String>,
    slot: &'static str,
}

impl Revision<'_> {
    fn load(&self, console: Console, global: &Global) -> Result<Loaded, Exit> {
        let tell = |told: Diagnostic| {
            console.tell_plainly(&[told]);
            Exit::Usage
        };
        let name = match &self.ancestor {
            Some(other) => self
                .repository
                .merge_base(&self.label, other)
                .map_err(tell)?,
            None => self.label.clone(),
        };
        let commit = self.repository.commit(&name).map_err(tell)?;
        let mut reader = self.repository.reader().map_err(tell)?;
        let commit = reader.subject(commit).map_err(tell)?;
        let path = self.project_path(console, &commit, &mut reader)?;
        let label = &self.label;
        let bytes = reader.file(&commit, label, &path).map_err(tell)?;
        let mut loaded = Loaded::new(label, Held::Nothing);
        loaded.side.commit = Some(commit.id.clone());
        loaded.side.subject = Some(commit.subject.clone());
        if let Some(plan) = self.compile(
            console,
            global,
            &commit,
            &mut reader,
            &path,
            &bytes,
            &mut loaded,
        )? {
            loaded.held = Held::Plan(plan);
            return Ok(loaded);
        }
        let folder = path
            .rsplit_once('/')
            .map_or(String::new(), |(folder, _)| format!("{folder}/"));
        let stem = Path::new(&path)
            .file_stem()
            .map(|stem| stem.to_string_lossy().into_owned());
        let stem = stem.unwrap_or_default();
        let mut committed =
            |name: String| reader.file_if_there(&commit, &format!("{folder}{name}"));
        let names = [
            (
                "its committed plan",
                committed(format!("build/{stem}/plan.ron")),
            ),
            ("its committed plan", committed("plan.ron".to_owned())),
            ("its committed `plan.lock`", committed(LOCK.to_owned())),
        ];
        fall_back(&mut loaded, names);
        Ok(loaded)
    }

    /// Compiles the project of a commit; nothing if it has errors, which are told.
    #[expect(clippy::too_many_arguments, reason = "the two halves of one function")]
    fn compile(
        &self,
        console: Console,
        global: &Global,
        commit: &Commit,
        reader: &mut Reader<'_>,
        path: &str,
        bytes: &[u8],
        loaded: &mut Loaded,
    ) -> Result<Option<Arc<Plan>>, Exit> {
        let quiet = console.with_errors_only();
        let shown = PathBuf::from(format!("{}:{path}", self.label));
        let opened = Opened::from_bytes(quiet, shown, bytes)?;
        let name = file_name(Path::new(path));
        loaded.source = Some(Source::of(&opened, &name, None));
        let Some(project) = opened.loaded.project.as_ref() else {
            opened.tell(quiet, &opened.loaded.diagnostics);
            return Ok(None);
        };
        let below = match path.rsplit_once('/') {
            Some((folder, _)) => format!("{folder}/{}", project.surface.mesh),
            None => project.surface.mesh.clone(),
        };
        // Paths in the tree begin at its top, and the prefix is in `path` already.
        let Some(mesh_path) = resolved(&below) else {
            opened.tell(quiet, &[mesh_outside(&project.surface.mesh)]);
            return Ok(None);
        };
        let mesh = match reader.file(commit, &self.label, &mesh_path) {
            Ok(bytes) => Arc::<[u8]>::from(bytes),
            Err(told) => {
                let told = told.at_key("surface.mesh", "named here");
                opened.tell(quiet, &[told]);
                return Ok(None);
            }
        };
        loaded.source = Some(Source::of(&opened, &name, Some(mesh.clone())));
        let output = output_directory(global, &opened, project);
        let memory = memory(&output, self.slot);
        let source = SourceFile::from_bytes(format!("{}:{mesh_path}", self.label), mesh.clone());
        let opened = opened.with_mesh(mesh);
        compile(Job::detached(quiet, global, opened, source, memory)?)
    }

    /// The project file in the tree.
    fn project_path(
        &self,
        console: Console,
        commit: &Commit,
        reader: &mut Reader<'_>,
    ) -> Result<String, Exit> {
        if let Some(file) = self.file {
            let below = file.to_string_lossy();
            return self.repository.path(&below).ok_or_else(|| {
                console.complain(&format!("`{below}` lies outside the repository"), None);
                Exit::Usage
            });
        }
        let folder = self.repository.prefix();
        let names = self.repository.files(commit, folder).map_err(|told| {
            console.tell_plainly(&[told]);
            Exit::Usage
        })?;
        let mut found = Vec::new();
        for name in names.iter().filter(|name| {
            let ending = Path::new(name)
                .extension()
                .and_then(|ending| ending.to_str());
            matches!(ending, Some("toml" | "ron"))
        }) {
            let path = if folder.is_empty() {
                name.clone()
            } else {
                format!("{folder}/{name}")
            };
            let bytes = reader.file_if_there(commit, &path).unwrap_or_default();
            if says_project(&String::from_utf8_lossy(&bytes)) {
                found.push(path);
            }
        }
        match found.as_slice() {
            [one] => Ok(one.clone()),
            [] => {
                let what = format!("there is no project file at `{}`", self.label);
                console.complain(&what, Some("name one: `egg diff A B designs/dome.toml`"));
                Err(Exit::Usage)
            }
            several => {
                let names: Vec<String> = several.iter().map(|name| format!("`{name}`")).collect();
                let names = names.join(", ");
                let what = format!(
                    "there are several project files at `{}`: {names}",
                    self.label
                );
                console.complain(&what, Some("name the one to compare"));
                Err(Exit::Usage)
            }
        }
    }
}
