//! The language: a project file as text becomes a checked model, or everything that is wrong
//! with it.
//!
//! ```text
//! text --notation--> tree of values with bytes --file--> the file's own terms --check--> model
//!                        |                                                        |
//!                        +--> SpanTable (key path -> bytes)     strips, materials +
//! ```
//!
//! - [`load`] is the way in; [`decode`] turns bytes into its text.
//! - [`model`] is what stages see: SI units, no positions.
//! - [`strips`] chains families of members over shared sides; the layout uses it too.
//! - [`layout_text`] writes points and patches back as text of a file.
//! - [`materials`] is the built-in table, [`schema`] the JSON schema for editors, [`template`]
//!   the file that `egg init` writes, [`unbuilt`] what a build says about sections that no stage
//!   of its pipeline reads.
//!
//! Both notations, TOML and RON, are read into one tree, so nothing after it can tell them apart.
//! Reading never stops at the first error; a value that depends on a wrong one is not judged.

mod check;
mod decimal;
mod file;
mod layout_text;
pub mod materials;
pub mod model;
mod notation;
mod schema;
pub mod strips;
mod suggest;
mod template;
mod unbuilt;
mod units;

use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, File, Place, SpanTable};
use file::ProjectFile;
use file::reader::{FromNode, Reader};
use model::Project;
use notation::{Node, Value};

pub use file::words::FORMAT;
pub use layout_text::{LengthText, OwnLamella, Writing, layout_text};
pub use notation::Notation;
pub use schema::schema;
pub use template::{TEMPLATE_EXTENT, template};
pub use unbuilt::{Capability, unbuilt};

/// What a project file says.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The model; `None` if any of the diagnostics is an error.
    pub project: Option<Project>,
    /// Where everything stands in the file. Empty if the file is no TOML or RON at all.
    pub spans: SpanTable,
    /// Errors and warnings in the order of the file; lints that the project allows are left out.
    pub diagnostics: Vec<Diagnostic>,
}

/// Files longer than this are no projects, and reading them would take noticeable time.
const LONGEST_FILE: usize = 8 << 20;

/// Reads and checks a project file. `file_name` is its name without folder and extension: the
/// name of a project that gives itself none.
///
/// A byte order mark at the start is skipped; byte ranges count from the start of the text
/// with it.
pub fn load(text: &str, notation: Notation, file_name: &str) -> Loaded {
    if text.len() > LONGEST_FILE {
        let megabytes = LONGEST_FILE >> 20;
        return Loaded::failed(vec![
            Diagnostic::error(
                Code::new("E0105"),
                format!("the project file is longer than {megabytes} MB"),
            )
            .help("a project is written by hand; surfaces are meshes of their own, named by `surface.mesh`"),
        ]);
    }
    // Blanks in the place of a byte order mark keep every byte where it is.
    let marked;
    let text = match text.strip_prefix('\u{feff}') {
        Some(rest) => {
            marked = format!("   {rest}");
            &marked
        }
        None => text,
    };
    let tree = match notation::parse(text, notation) {
        Ok(tree) => tree,
        Err(diagnostics) => return Loaded::failed(diagnostics),
    };
    let spans = notation::spans(&tree, text);
    let mut reader = Reader::new();
    reader.length_unit = length_unit(&tree);
    let file = ProjectFile::read(&tree, &crate::diagnostics::KeyPath::root(), &mut reader);
    let project = file.and_then(|file| check::check(&file, file_name, &mut reader.sink));
    let failed = reader.sink.failed();
    let mut diagnostics = reader.sink.into_diagnostics();
    if let Some(project) = &project {
        diagnostics = crate::diagnostics::without_allowed(diagnostics, &project.allowed_lints);
    }
    // In another version of the language all the rest may be right.
    let is_other_format = |diagnostic: &Diagnostic| diagnostic.code.as_str() == "E0106";
    if diagnostics.iter().any(is_other_format) {
        diagnostics.retain(is_other_format);
    }
    diagnostics.sort_by_key(|diagnostic| start(diagnostic, &spans));
    Loaded {
        project: project.filter(|_| !failed),
        spans,
        diagnostics,
    }
}

/// The text of a project file's bytes: UTF-8, with or without a byte order mark. Otherwise the
/// one diagnostic that says why not.
pub fn decode(bytes: &[u8]) -> Result<&str, Vec<Diagnostic>> {
    let error = match std::str::from_utf8(bytes) {
        Ok(text) => return Ok(text),
        Err(error) => error,
    };
    let at = error.valid_up_to();
    let diagnostic = Diagnostic::error(Code::new("E0104"), "the project file is not UTF-8 text");
    let is_wide = bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]);
    let diagnostic = if is_wide {
        diagnostic
            .note("it starts like UTF-16, the \"Unicode\" of some Windows programs")
            .help("save it again with the encoding UTF-8")
    } else if bytes.contains(&0) {
        diagnostic
            .note(format!("byte {at} cannot be text"))
            .help("is this the project file? meshes and drawings are named in it")
    } else {
        let line = bytes[..at].split(|byte| *byte == b'\n').count();
        diagnostic
            .note(format!(
                "byte {at}, in line {line}, is the first that is not UTF-8"
            ))
            .help("save it again with the encoding UTF-8")
    };
    Err(vec![diagnostic])
}

impl Loaded {
    fn failed(diagnostics: Vec<Diagnostic>) -> Self {
        Self {
            project: None,
            spans: SpanTable::default(),
            diagnostics,
        }
    }
}

/// The unit of bare lengths, needed before the first length is read. A wrong one is reported
/// when `[project]` is read.
fn length_unit(tree: &Node) -> units::Unit {
    let child = |node: &Node, key: &str| match &node.value {
        Value::Table(entries) => entries
            .iter()
            .find(|entry| entry.key == key)
            .map(|entry| entry.node.clone()),
        _ => None,
    };
    let unit = child(tree, "project").and_then(|project| child(&project, "units"));
    match unit.map(|node| node.value) {
        Some(Value::Text(word)) => units::LENGTH
            .units
            .iter()
            .copied()
            .find(|unit| unit.symbol == word)
            .unwrap_or(units::MILLIMETRE),
        _ => units::MILLIMETRE,
    }
}

/// Sort key: the start of the primary label, then the code.
fn start(diagnostic: &Diagnostic, spans: &SpanTable) -> (usize, Code) {
    let start = match diagnostic.labels.first().map(|label| &label.place) {
        None => 0,
        Some(Place::Key(path)) => spans.value(path).start,
        Some(Place::Name(path)) => spans.name(path).start,
        Some(Place::Bytes {
            file: File::Project,
            range,
        }) => range.start,
        Some(Place::Bytes { .. }) => usize::MAX,
    };
    (start, diagnostic.code.clone())
}
