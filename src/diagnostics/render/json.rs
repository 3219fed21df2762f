//! The form for programs: one JSON object a line.
//!
//! Fields may be added; readers ignore what they do not know.

use super::source::{Sources, line_column};
use crate::diagnostics::{Diagnostic, File, Label, Place, Severity};
use serde::Serialize;

/// A diagnostic as a line of JSON.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct JsonDiagnostic {
    /// Always `diagnostic`; other lines of a run have other reasons.
    pub reason: &'static str,
    /// `E0201`.
    pub code: String,
    /// Name of the code, by which a lint is allowed: `undefined-point`.
    pub name: Option<&'static str>,
    /// `error`, `warning` or `note`.
    pub severity: Severity,
    /// What is wrong, complete by itself.
    pub message: String,
    /// Places, the primary one first.
    pub labels: Vec<JsonLabel>,
    /// Facts.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Option<String>,
    /// Id of what it is about: `west`, `west.u03-v05`.
    pub subject: Option<String>,
}

/// A marked place.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct JsonLabel {
    /// Path of the file as given; `null` if the file was not read.
    pub file: Option<String>,
    /// Key path in the project, where the place is one: `patches.west.corners[2]`.
    pub key: Option<String>,
    /// First byte and the byte behind the last; `null` if the file was not read.
    pub start: Option<JsonPosition>,
    /// The byte behind the last.
    pub end: Option<JsonPosition>,
    /// What is said there.
    pub text: String,
}

/// A position in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct JsonPosition {
    /// Bytes before it, a byte order mark included.
    pub byte: usize,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
}

/// Renders diagnostics, one a line.
///
/// # Panics
///
/// Never: a record of strings and numbers has a JSON text.
pub fn json_lines(diagnostics: &[Diagnostic], sources: &Sources<'_>) -> String {
    let mut text = String::new();
    for diagnostic in diagnostics {
        let record = record(diagnostic, sources);
        let line = serde_json::to_string(&record).expect("strings and numbers have a JSON text");
        text.push_str(&line);
        text.push('\n');
    }
    text
}

fn record(diagnostic: &Diagnostic, sources: &Sources<'_>) -> JsonDiagnostic {
    JsonDiagnostic {
        reason: "diagnostic",
        code: diagnostic.code.to_string(),
        name: diagnostic.code.info().map(|info| info.name),
        severity: diagnostic.severity,
        message: diagnostic.message.clone(),
        labels: diagnostic
            .labels
            .iter()
            .map(|label| json_label(label, sources))
            .collect(),
        notes: diagnostic.notes.clone(),
        help: diagnostic.help.clone(),
        subject: diagnostic.subject.clone(),
    }
}

fn json_label(label: &Label, sources: &Sources<'_>) -> JsonLabel {
    let found = sources.find(&label.place);
    let source = found.as_ref().and_then(|found| sources.source(found.file));
    let position = |at: usize| {
        let (line, column) = line_column(source?.text, at);
        Some(JsonPosition {
            byte: at,
            line,
            column,
        })
    };
    JsonLabel {
        file: source.map(|source| source.name.to_owned()),
        key: match &label.place {
            Place::Key(path) | Place::Name(path) => Some(path.clone()),
            Place::Bytes {
                file: File::Project | File::Mesh,
                ..
            } => None,
        },
        start: found.as_ref().and_then(|found| position(found.range.start)),
        end: found.as_ref().and_then(|found| position(found.range.end)),
        text: label.text.clone(),
    }
}
