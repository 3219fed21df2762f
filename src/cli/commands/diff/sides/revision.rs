//! Sides that are read from a repository.

use super::{Held, LOCK, Loaded, Source, compile, fall_back, file_name, memory};
use crate::build::SourceFile;
use crate::cli::args::Global;
use crate::cli::console::Console;
use crate::cli::design::{Opened, mesh_outside, says_project};
use crate::cli::exit::Exit;
use crate::cli::git::{Commit, Reader, Repository, resolved};
use crate::cli::run::{Job, output_directory};
use crate::diagnostics::Diagnostic;
use crate::plan::Plan;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A side that is read from a repository.
pub(super) struct Revision<'a> {
    pub(super) repository: &'a Repository,
    /// The project file, relative to the repository's folder.
    pub(super) file: Option<&'a Path>,
    pub(super) label: String,
    pub(super) ancestor: Option<String>,
    pub(super) slot: &'static str,
}

impl Revision<'_> {
    pub(super) fn load(&self, console: Console, global: &Global) -> Result<Loaded, Exit> {
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
