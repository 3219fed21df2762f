//! What reading a mesh has to tell, bounded: a damaged file of a million lines is not a million
//! diagnostics.

use crate::diagnostics::{Checked, Code, Diagnostic, Severity, Warned};

/// Diagnostics of one code that are shown one by one; the rest is counted.
const SHOWN: usize = 5;

/// Diagnostics in the order in which they were met.
#[derive(Debug, Default)]
pub(super) struct Findings {
    diagnostics: Vec<Diagnostic>,
    tallies: Vec<Tally>,
}

#[derive(Debug)]
struct Tally {
    code: Code,
    count: usize,
    /// Index of the last one that is shown.
    last: usize,
}

impl Findings {
    /// Adds a diagnostic, which is only made if it is shown.
    pub(super) fn add(&mut self, code: &Code, make: impl FnOnce() -> Diagnostic) {
        let at = self.tallies.iter().position(|t| t.code == *code);
        let at = at.unwrap_or_else(|| {
            self.tallies.push(Tally {
                code: code.clone(),
                count: 0,
                last: 0,
            });
            self.tallies.len() - 1
        });
        let tally = &mut self.tallies[at];
        tally.count += 1;
        if tally.count <= SHOWN {
            tally.last = self.diagnostics.len();
            self.diagnostics.push(make());
        }
    }

    /// Whether an error is among them.
    pub(super) fn failed(&self) -> bool {
        self.diagnostics
            .iter()
            .any(|d| d.severity == Severity::Error)
    }

    /// The result of the stage: the value with its warnings, or all diagnostics.
    pub(super) fn finish<T>(mut self, value: Option<T>) -> Checked<T> {
        for tally in &self.tallies {
            if tally.count > SHOWN {
                let rest = tally.count - SHOWN;
                self.diagnostics[tally.last]
                    .notes
                    .push(format!("and {rest} more of this kind"));
            }
        }
        match value {
            Some(value) if !self.failed() => Ok(Warned {
                value,
                warnings: self.diagnostics,
            }),
            _ => Err(self.diagnostics),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_findings_of_a_kind_are_counted_not_listed() {
        let code = Code::new("E0304");
        let mut findings = Findings::default();
        for i in 0..1000 {
            findings.add(&code, || Diagnostic::error(code.clone(), format!("{i}")));
        }
        let diagnostics = findings.finish::<()>(None).unwrap_err();
        assert_eq!(diagnostics.len(), 5);
        assert_eq!(diagnostics[4].notes, ["and 995 more of this kind"]);
    }
}
