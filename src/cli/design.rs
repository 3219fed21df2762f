//! A project file on disk: found, read, checked, with the texts that diagnostics point into.

use super::console::Console;
use super::exit::Exit;
use crate::diagnostics::render::{Source, Sources};
use crate::diagnostics::{Code, Diagnostic, File, Label, Place};
use crate::project::model::Project;
use crate::project::{Capability, LengthText, Loaded, Notation, decode, load, unbuilt};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const UNREADABLE_MESH: Code = Code::new("E0901");
const OUTSIDE: Code = Code::new("E0902");

/// What the pipeline does beyond cutting lamellae from patches as they stand.
const BUILT: [Capability; 10] = [
    Capability::SeveralPatches,
    Capability::ClosedStrips,
    Capability::Splitting,
    Capability::Supports,
    Capability::Stickers,
    Capability::Shells,
    Capability::BedWindows,
    Capability::KerfCompensation,
    Capability::Splices,
    Capability::Costs,
];

/// A project file that was read.
#[derive(Debug)]
pub(super) struct Opened {
    path: PathBuf,
    text: String,
    /// What it says.
    pub(super) loaded: Loaded,
    /// The text of the mesh, if diagnostics point into it.
    mesh_text: Option<String>,
    /// The contents of the mesh, if they do not lie on the disk.
    mesh: Option<Arc<[u8]>>,
}

impl Opened {
    /// Finds and reads a project file and tells what is wrong with it.
    pub(super) fn open(console: Console, given: Option<&Path>) -> Result<Self, Exit> {
        let path = locate(console, given)?;
        if path.is_dir() {
            console.complain(
                &format!("`{}` is a folder", path.display()),
                Some("name the project file in it, or go there and name none"),
            );
            return Err(Exit::Usage);
        }
        notation(console, &path)?;
        let bytes = std::fs::read(&path).map_err(|error| {
            console.complain(&format!("cannot read `{}`: {error}", path.display()), None);
            Exit::Usage
        })?;
        Self::from_bytes(console, path, &bytes)
    }

    /// A project file whose contents are at hand; its path is for messages, and its name for a
    /// project without one.
    pub(super) fn from_bytes(console: Console, path: PathBuf, bytes: &[u8]) -> Result<Self, Exit> {
        let notation = notation(console, &path)?;
        let stem = path
            .file_stem()
            .map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        let (text, mut loaded) = match decode(bytes) {
            Ok(text) => (text.to_owned(), load(text, notation, &stem)),
            Err(diagnostics) => {
                let lossy = String::from_utf8_lossy(bytes).into_owned();
                let empty = load("", notation, &stem);
                (
                    lossy,
                    Loaded {
                        project: None,
                        diagnostics,
                        ..empty
                    },
                )
            }
        };
        let missing = unbuilt(&loaded, &BUILT);
        loaded.diagnostics.extend(missing);
        Ok(Self {
            path,
            text,
            loaded,
            mesh_text: None,
            mesh: None,
        })
    }

    /// The same with a mesh that is at hand and not on the disk.
    pub(super) fn with_mesh(self, mesh: Arc<[u8]>) -> Self {
        Self {
            mesh: Some(mesh),
            ..self
        }
    }

    /// The text of the project file.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// The model, or the end of the command when there are errors.
    pub(super) fn project(&self) -> Result<&Project, Exit> {
        self.loaded.project.as_ref().ok_or(Exit::Errors)
    }

    /// Where a key stands, for people: `pavilion.toml:31`.
    pub(super) fn place_of(&self, key: &str) -> Option<String> {
        let start = self.loaded.spans.value(key).start;
        let before = self.text.get(..start)?;
        let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
        Some(format!("{}:{line}", self.path.display()))
    }

    /// The lines of the project file on which these keys stand, each once and in their order:
    /// `pavilion.toml:31  alpha = 40`. A key that the file leaves at its default has no line.
    pub(super) fn lines_of<'a>(&self, keys: impl Iterator<Item = &'a str>) -> Vec<String> {
        let lines: BTreeSet<usize> = keys
            .filter_map(|key| self.loaded.spans.stands(key))
            .filter_map(|place| self.text.get(..place.start))
            .map(|before| before.matches('\n').count())
            .collect();
        let texts: Vec<&str> = self.text.lines().collect();
        lines
            .into_iter()
            .filter_map(|line| {
                let text = texts.get(line)?.trim();
                Some(format!("  {}:{}  {text}", self.path.display(), line + 1))
            })
            .collect()
    }

    /// How the file is written: its notation and its unit of length.
    pub(super) fn writing(&self) -> (Notation, LengthText) {
        let notation = match self.path.extension().and_then(|e| e.to_str()) {
            Some("ron") => Notation::Ron,
            _ => Notation::Toml,
        };
        let key = "project.units";
        let range = self.loaded.spans.value(key);
        let said = self
            .text
            .get(range)
            .filter(|_| self.loaded.spans.contains(key));
        let units = said.map(|units| units.trim_matches(|c: char| !c.is_ascii_alphabetic()));
        (notation, LengthText::of(units))
    }

    /// The words of the file for the value at a key.
    pub(super) fn said<'a>(&self, key: impl IntoIterator<Item = &'a str>) -> Option<&str> {
        let key = crate::diagnostics::KeyPath::of(key);
        let spans = &self.loaded.spans;
        let has = spans.contains(key.as_str());
        has.then(|| self.text.get(spans.value(key.as_str())))?
    }

    /// A path below the folder of the project file, as a person writes it.
    pub(super) fn beside(&self, path: impl AsRef<Path>) -> PathBuf {
        self.path.with_file_name("").join(path)
    }

    /// The folder of the project file.
    pub(super) fn folder(&self) -> &Path {
        match self.path.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        }
    }

    /// Where the mesh lies; it may not leave the repository of the project, or its folder where
    /// there is no repository.
    pub(super) fn mesh_path(&self, project: &Project) -> Result<PathBuf, Diagnostic> {
        let path = self.folder().join(&project.surface.mesh);
        let real = path
            .canonicalize()
            .map_err(|error| unreadable_mesh(project, &error))?;
        let folder = self
            .folder()
            .canonicalize()
            .unwrap_or_else(|_| self.folder().to_owned());
        let root = folder
            .ancestors()
            .find(|a| a.join(".git").exists())
            .unwrap_or(&folder);
        if real.starts_with(root) {
            Ok(path)
        } else {
            let mesh = &project.surface.mesh;
            Err(mesh_outside(mesh))
        }
    }

    /// Reads the mesh's text if one of the diagnostics points into it.
    pub(super) fn fetch_mesh_text(&mut self, diagnostics: &[Diagnostic]) {
        let into_mesh = diagnostics.iter().flat_map(|d| &d.labels).any(|label| {
            matches!(
                label.place,
                Place::Bytes {
                    file: File::Mesh,
                    ..
                }
            )
        });
        if let Some(project) = self.loaded.project.as_ref().filter(|_| into_mesh) {
            let path = self.folder().join(&project.surface.mesh);
            let bytes = match &self.mesh {
                Some(bytes) => Some(bytes.to_vec()),
                None => std::fs::read(path).ok(),
            };
            // Byte ranges count bytes of the file; characters that are no UTF-8 keep one place
            // each, so that the places after them stay right.
            self.mesh_text = bytes.map(|bytes| match String::from_utf8(bytes) {
                Ok(text) => text,
                Err(error) => error
                    .into_bytes()
                    .into_iter()
                    .map(|byte| {
                        if byte.is_ascii() {
                            char::from(byte)
                        } else {
                            '?'
                        }
                    })
                    .collect(),
            });
        }
    }

    /// Diagnostics of stages, each once. What they say about a key that the file does not have
    /// is said about its default instead: there is nothing to point at.
    pub(super) fn in_terms_of_the_file(&self, diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let spans = &self.loaded.spans;
        let mut told: Vec<Diagnostic> = Vec::with_capacity(diagnostics.len());
        for mut diagnostic in diagnostics {
            let (said, unsaid): (Vec<Label>, Vec<Label>) = diagnostic
                .labels
                .into_iter()
                .partition(|label| !matches!(&label.place, Place::Key(key) if !spans.reaches(key)));
            diagnostic.labels = said;
            let notes = unsaid.into_iter().filter_map(|label| match label.place {
                Place::Key(key) => Some(format!("`{key}` has its default: {}", label.text)),
                _ => None,
            });
            diagnostic.notes.splice(0..0, notes);
            if !told.contains(&diagnostic) {
                told.push(diagnostic);
            }
        }
        told
    }

    /// Tells diagnostics about this project.
    pub(super) fn tell(&self, console: Console, diagnostics: &[Diagnostic]) {
        let name = self.path.to_string_lossy().replace('\\', "/");
        let mesh_name = self.loaded.project.as_ref().map(|p| p.surface.mesh.clone());
        let sources = Sources {
            project: Source {
                name: &name,
                text: &self.text,
            },
            spans: &self.loaded.spans,
            mesh: self
                .mesh_text
                .as_deref()
                .zip(mesh_name.as_deref())
                .map(|(text, name)| Source { name, text }),
        };
        console.tell(diagnostics, &sources);
    }
}

/// The notation of a project file, by its name.
fn notation(console: Console, path: &Path) -> Result<Notation, Exit> {
    match path.extension().and_then(|e| e.to_str()) {
        Some("ron") => Ok(Notation::Ron),
        Some("toml") => Ok(Notation::Toml),
        _ => {
            console.complain(
                &format!("`{}` is no project file", path.display()),
                Some("project files end in .toml or .ron"),
            );
            Err(Exit::Usage)
        }
    }
}

/// The mesh is there or not, but it cannot be read.
pub(super) fn unreadable_mesh(project: &Project, error: &io::Error) -> Diagnostic {
    let mesh = &project.surface.mesh;
    Diagnostic::error(
        UNREADABLE_MESH,
        format!("cannot read the mesh `{mesh}`: {error}"),
    )
    .at_key("surface.mesh", "this file")
    .help("paths are relative to the project file")
}

/// The mesh is not part of the project.
pub(super) fn mesh_outside(mesh: &str) -> Diagnostic {
    let message = format!("the mesh `{mesh}` lies outside the project");
    let error = Diagnostic::error(OUTSIDE, message).at_key("surface.mesh", "this file");
    error.help("copy it into the project's folder, so that whoever has the project has the mesh")
}

/// The project file that was named, or the one of the current folder.
pub(super) fn locate(console: Console, given: Option<&Path>) -> Result<PathBuf, Exit> {
    match given {
        Some(path) => Ok(path.to_owned()),
        None => find(console),
    }
}

/// The one project file of the current folder.
fn find(console: Console) -> Result<PathBuf, Exit> {
    let entries = std::fs::read_dir(".").map_err(|error| {
        console.complain(&format!("cannot read the current folder: {error}"), None);
        Exit::Usage
    })?;
    let mut files: Vec<PathBuf> = entries
        .flatten()
        .map(|entry| PathBuf::from(entry.file_name()))
        .filter(|path| {
            let ending = path.extension().and_then(|e| e.to_str());
            matches!(ending, Some("ron" | "toml")) && path.is_file()
        })
        .collect();
    files.sort();
    let mut candidates: Vec<PathBuf> = files.iter().filter(|p| is_project(p)).cloned().collect();
    if candidates.is_empty() && files.len() == 1 {
        // What else could be meant; what is wrong with it will be told.
        candidates = files;
    }
    match candidates.as_slice() {
        [one] => Ok(one.clone()),
        [] => {
            console.complain(
                "there is no project file in this folder",
                Some("name one, or start a project with `egg init NAME`"),
            );
            Err(Exit::Usage)
        }
        several => {
            let names: Vec<_> = several
                .iter()
                .map(|p| format!("`{}`", p.display()))
                .collect();
            console.complain(
                &format!(
                    "there are several project files in this folder: {}",
                    names.join(", ")
                ),
                Some("name the one to use"),
            );
            Err(Exit::Usage)
        }
    }
}

/// Other programs keep TOML files too (Cargo.toml), and egg writes plans as RON: a project has a
/// `surface` with a `mesh`.
fn is_project(path: &Path) -> bool {
    std::fs::read_to_string(path).is_ok_and(|text| says_project(&text))
}

/// Whether a text names a mesh as the surface of a project.
pub(super) fn says_project(text: &str) -> bool {
    let says = |line: &str, word: &str| {
        let mut words = line.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '-'));
        words.any(|one| one == word)
    };
    let mut lines = text
        .lines()
        .map(|line| line.split('#').next().unwrap_or(""));
    lines.clone().any(|line| says(line, "surface")) && lines.any(|line| says(line, "mesh"))
}
