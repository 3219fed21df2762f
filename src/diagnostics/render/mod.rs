//! Diagnostics as text: for people ([`human`]) and for programs ([`json_lines`]).
//!
//! Pure functions to `String`; who prints, and whether in colour, is the terminal's business.
//! Key paths become places in the file here and nowhere earlier.

mod human;
mod json;
mod printable;
mod source;

pub use human::{Style, human};
pub use json::{JsonDiagnostic, JsonLabel, JsonPosition, json_lines};
pub use printable::printable;
pub use source::{Source, Sources};

use super::{Diagnostic, Severity};

/// Counts for the last line of a run: `2 errors, 1 warning`; `None` if there is neither.
pub fn summary(diagnostics: &[Diagnostic]) -> Option<String> {
    let count = |severity| {
        let of = |diagnostic: &&Diagnostic| diagnostic.severity == severity;
        diagnostics.iter().filter(of).count()
    };
    let plural = |count: usize, word: &str| match count {
        0 => None,
        1 => Some(format!("1 {word}")),
        _ => Some(format!("{count} {word}s")),
    };
    let parts: Vec<String> = [
        plural(count(Severity::Error), "error"),
        plural(count(Severity::Warning), "warning"),
    ]
    .into_iter()
    .flatten()
    .collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}
