//! How every stage talks to the user: diagnostics with a stable code, a place, and what to do.
//!
//! A stage returns [`Diagnostic`] values and never prints. A diagnostic names its place by a
//! [`Place`]: a key path of the project (`patches.west.alpha`), which survives caching and edits
//! elsewhere in the file, or a byte range of an input file when the file could not be understood
//! as a whole. Key paths are resolved to spans only when a report is rendered.

pub mod codes;
mod key_path;
pub mod render;
mod spans;

use serde::{Deserialize, Serialize};
use std::ops::Range;

pub use codes::{Code, CodeInfo};
pub use key_path::KeyPath;
pub use spans::SpanTable;

/// How grave a diagnostic is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// A fact worth knowing; nothing to do.
    Note,
    /// The result stands, but the user should look.
    Warning,
    /// No result for the subject; the command exits with 1.
    Error,
}

/// Which input file a byte range belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum File {
    /// The project file.
    Project,
    /// The mesh that the project names.
    Mesh,
}

/// Where a diagnostic points.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// A key path of the project: `patches.west.corners[2]`; a name that is not a bare key is
    /// quoted as in TOML (`points."a b"`). A missing key resolves to its nearest ancestor.
    Key(String),
    /// The same, but the key itself is meant and not its value: an unknown key, a bad name.
    Name(String),
    /// A byte range of an input file.
    Bytes {
        /// The file.
        file: File,
        /// The bytes, half open.
        range: Range<usize>,
    },
}

/// A marked place with a text beside it. The primary label makes sense alone.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Label {
    /// Where.
    pub place: Place,
    /// What is said there; lower case, no final stop.
    pub text: String,
}

/// One thing to tell the user.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// Stable code, documented by `egg explain`.
    pub code: Code,
    /// How grave it is.
    pub severity: Severity,
    /// What is wrong, with numbers, units and limits; lower case, no final stop, names in
    /// backticks.
    pub message: String,
    /// The first label is the primary one.
    pub labels: Vec<Label>,
    /// Facts.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Option<String>,
    /// Id of the thing it is about (`west`, `west.u03-v05`), for scripts and the plan.
    pub subject: Option<String>,
}

impl Diagnostic {
    /// An error without a place yet.
    pub fn error(code: Code, message: impl Into<String>) -> Self {
        Self::new(code, Severity::Error, message)
    }

    /// A warning without a place yet.
    pub fn warning(code: Code, message: impl Into<String>) -> Self {
        Self::new(code, Severity::Warning, message)
    }

    /// A note without a place yet.
    pub fn note_only(code: Code, message: impl Into<String>) -> Self {
        Self::new(code, Severity::Note, message)
    }

    fn new(code: Code, severity: Severity, message: impl Into<String>) -> Self {
        Self {
            code,
            severity,
            message: message.into(),
            labels: Vec::new(),
            notes: Vec::new(),
            help: None,
            subject: None,
        }
    }

    /// The same with names for `{.field}` in its texts; a field without a name is left out with
    /// its braces.
    #[must_use]
    pub fn with_names<'n>(&self, name: &dyn Fn(&str) -> Option<&'n str>) -> Self {
        let told = |text: &String| named(text, name);
        let mut this = self.clone();
        this.message = told(&this.message);
        this.notes = this.notes.iter().map(told).collect();
        this.help = this.help.as_ref().map(told);
        for label in &mut this.labels {
            label.text = told(&label.text);
        }
        this
    }

    /// Adds a label at a key path of the project.
    #[must_use]
    pub fn at_key(self, key: impl Into<String>, text: impl Into<String>) -> Self {
        self.at(Place::Key(key.into()), text)
    }

    /// Adds a label at a key itself rather than at its value.
    #[must_use]
    pub fn at_name(self, key: impl Into<String>, text: impl Into<String>) -> Self {
        self.at(Place::Name(key.into()), text)
    }

    /// Adds a label at a byte range of a file.
    #[must_use]
    pub fn at_bytes(self, file: File, range: Range<usize>, text: impl Into<String>) -> Self {
        self.at(Place::Bytes { file, range }, text)
    }

    /// Adds a label.
    #[must_use]
    pub fn at(mut self, place: Place, text: impl Into<String>) -> Self {
        self.labels.push(Label {
            place,
            text: text.into(),
        });
        self
    }

    /// Adds a fact.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Says what to do.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Names the thing it is about.
    #[must_use]
    pub fn about(mut self, subject: impl Into<String>) -> Self {
        self.subject = Some(subject.into());
        self
    }
}

/// The diagnostics without the lints that a project allows by name. Errors cannot be allowed.
pub fn without_allowed(diagnostics: Vec<Diagnostic>, allowed: &[String]) -> Vec<Diagnostic> {
    let is_allowed = |diagnostic: &Diagnostic| {
        let lint = diagnostic.code.info().filter(|info| info.is_lint());
        diagnostic.severity != Severity::Error
            && lint.is_some_and(|lint| allowed.iter().any(|name| name == lint.name))
    };
    let mut diagnostics = diagnostics;
    diagnostics.retain(|diagnostic| !is_allowed(diagnostic));
    diagnostics
}

/// A value together with the warnings and notes met on the way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warned<T> {
    /// The result.
    pub value: T,
    /// What to tell beside it; no errors.
    pub warnings: Vec<Diagnostic>,
}

/// What a stage that can fail through its input returns: all its errors, not only the first
/// (warnings may stand among them).
pub type Checked<T> = Result<Warned<T>, Vec<Diagnostic>>;

/// A text with names for `{.field}`.
fn named<'n>(text: &str, name: &dyn Fn(&str) -> Option<&'n str>) -> String {
    let mut told = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("{.") {
        let Some((field, behind)) = after.split_once('}') else {
            break;
        };
        told.push_str(before);
        match name(field) {
            Some(name) => {
                told.push('`');
                told.push_str(name);
                told.push('`');
            }
            // One word, and the blank before it.
            None => told.truncate(told.trim_end().len()),
        }
        rest = behind;
    }
    told.push_str(rest);
    told
}
