//! The registry of diagnostic codes: one file a room of the pipeline, one entry a code.
//!
//! `E` codes stop the build of their subject, `W` codes are lints that can be allowed by name in
//! the project file (`[lints]`). Codes are never reused.

mod build;
pub mod cladding;
mod cli;
pub mod fabrication;
pub mod grid;
pub mod layout;
mod project;
pub mod surface;

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A stable diagnostic code such as `E0204`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Code(Cow<'static, str>);

impl Code {
    /// A code that stands in the registry; a test holds every use to that.
    pub const fn new(code: &'static str) -> Self {
        Self(Cow::Borrowed(code))
    }

    /// The code as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// What the registry says about it.
    pub fn info(&self) -> Option<&'static CodeInfo> {
        find(&self.0)
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

/// What `egg explain CODE` tells.
#[derive(Debug)]
pub struct CodeInfo {
    /// `E0204`.
    pub code: &'static str,
    /// Kebab-case name, by which a lint is allowed: `notch-overlap`.
    pub name: &'static str,
    /// One line.
    pub title: &'static str,
    /// Paragraphs: what it means, why it matters, what to do, with an example where it helps.
    pub text: &'static str,
}

impl CodeInfo {
    /// Whether it is a lint: a warning that a project can allow by name.
    pub fn is_lint(&self) -> bool {
        self.code.starts_with('W')
    }
}

/// All lints, in order.
pub fn lints() -> impl Iterator<Item = &'static CodeInfo> {
    all().filter(|info| info.is_lint())
}

/// All codes, in order.
pub fn all() -> impl Iterator<Item = &'static CodeInfo> {
    [
        project::CODES,
        surface::CODES,
        layout::CODES,
        cladding::CODES,
        grid::CODES,
        fabrication::CODES,
        build::CODES,
        cli::CODES,
    ]
    .into_iter()
    .flatten()
}

/// Looks a code up, `E0204` or `e0204`, or a lint by its name.
pub fn find(code: &str) -> Option<&'static CodeInfo> {
    all().find(|info| info.code.eq_ignore_ascii_case(code) || info.name == code)
}
