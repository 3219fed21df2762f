//! The registry of diagnostic codes: one file a room of the pipeline, one entry a code.
//!
//! `E` codes stop the build of their subject, `W` codes are lints that can be allowed by name in
//! the project file (`[lints]`). Codes are never reused.

mod build;
pub mod cladding;
mod cli;
pub mod diff;
pub mod fabrication;
pub mod grid;
pub mod layout;
mod project;
pub mod splitting;
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
        splitting::CODES,
        layout::CODES,
        cladding::CODES,
        grid::CODES,
        fabrication::CODES,
        build::CODES,
        diff::CODES,
        cli::CODES,
    ]
    .into_iter()
    .flatten()
}

/// Looks a code up, `E0204` or `e0204`, or a lint by its name.
pub fn find(code: &str) -> Option<&'static CodeInfo> {
    all().find(|info| info.code.eq_ignore_ascii_case(code) || info.name == code)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn codes_and_names_are_unique_and_well_formed() {
        let mut seen = BTreeSet::new();
        for info in all() {
            let (letter, number) = info.code.split_at(1);
            assert!(matches!(letter, "E" | "W"), "{}", info.code);
            assert!(
                number.len() == 4 && number.bytes().all(|b| b.is_ascii_digit()),
                "{}",
                info.code
            );
            let kebab =
                |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
            assert!(info.name.bytes().all(kebab), "{}", info.name);
            assert!(
                seen.insert(info.code) && seen.insert(info.name),
                "{} {}",
                info.code,
                info.name
            );
            assert!(
                !info.title.is_empty() && !info.title.ends_with('.'),
                "{}",
                info.code
            );
            assert!(info.text.len() > 40, "{} explains nothing", info.code);
        }
    }

    #[test]
    fn a_code_is_found_in_any_case_and_a_lint_by_its_name() {
        assert_eq!(find("e0201").map(|info| info.name), Some("undefined-point"));
        assert_eq!(find("thick-lamella").map(|info| info.code), Some("W0201"));
        assert!(find("E9999").is_none());
        assert!(lints().all(|info| info.code.starts_with('W')));
    }
}
