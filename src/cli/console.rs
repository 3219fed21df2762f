//! The terminal: the only place of the program that prints.

use super::args::{ColorWhen, Global, MessageFormat};
use crate::diagnostics::render::{Source, Sources, Style, human, json_lines, printable};
use crate::diagnostics::{Diagnostic, Severity, SpanTable};
use serde::Serialize;
use std::io::{self, IsTerminal, Write};

/// Where and how things are said.
#[derive(Debug, Clone, Copy)]
pub(super) struct Console {
    format: MessageFormat,
    style: Style,
    /// The style of results, on standard output.
    results: Style,
    quiet: bool,
    terminal: bool,
    /// Standard output holds a document, so that records for programs go to standard error.
    document: bool,
    told: Told,
}

/// Which diagnostics are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Told {
    Everything,
    ErrorsOnly,
}

impl Console {
    pub(super) fn new(global: &Global) -> Self {
        let terminal = io::stderr().is_terminal();
        Self {
            format: global.message_format,
            style: style(global.color, terminal),
            results: style(global.color, io::stdout().is_terminal()),
            quiet: global.quiet,
            terminal,
            document: false,
            told: Told::Everything,
        }
    }

    /// The same for a command whose result is a document on standard output.
    pub(super) fn with_document(self) -> Self {
        Self {
            document: true,
            ..self
        }
    }

    /// The same for a command that looks at a project without judging it.
    pub(super) fn with_errors_only(self) -> Self {
        Self {
            told: Told::ErrorsOnly,
            ..self
        }
    }

    /// Whether standard output is a terminal in which colours are wanted.
    pub(super) fn colours_results(self) -> bool {
        self.results == Style::Colour
    }

    /// Tells diagnostics that are about no file.
    pub(super) fn tell_plainly(self, diagnostics: &[Diagnostic]) {
        let spans = SpanTable::default();
        let nowhere = Source { name: "", text: "" };
        let sources = Sources {
            project: nowhere,
            spans: &spans,
            mesh: None,
        };
        self.tell(diagnostics, &sources);
    }

    /// Whether a progress bar can be drawn and is wanted.
    pub(super) fn draws_progress(self) -> bool {
        self.terminal && !self.quiet && self.format == MessageFormat::Human
    }

    /// Whether a table for people goes to standard output beside messages.
    pub(super) fn prints_tables(self) -> bool {
        !self.quiet && !self.is_json()
    }

    pub(super) fn is_json(self) -> bool {
        self.format == MessageFormat::Json
    }

    /// Tells diagnostics; `quiet` leaves errors only.
    pub(super) fn tell(self, diagnostics: &[Diagnostic], sources: &Sources<'_>) {
        let wanted_all = !self.quiet && self.told == Told::Everything;
        let wanted: Vec<Diagnostic> = diagnostics
            .iter()
            .filter(|d| wanted_all || d.severity == Severity::Error)
            .cloned()
            .collect();
        match self.format {
            MessageFormat::Human => err(&human(&wanted, sources, self.style)),
            MessageFormat::Json => self.records(&json_lines(&wanted, sources)),
        }
    }

    /// A line about what was done: a right-aligned verb, then what.
    pub(super) fn status(self, verb: &str, what: &str) {
        if self.quiet || self.is_json() {
            return;
        }
        let what = printable(what);
        if self.style == Style::Colour {
            err(&format!("\u{1b}[1;32m{verb:>12}\u{1b}[0m {what}\n"));
        } else {
            err(&format!("{verb:>12} {what}\n"));
        }
    }

    /// An error of usage, about no place in a file.
    pub(super) fn complain(self, message: &str, help: Option<&str>) {
        if self.is_json() {
            self.record(&Complaint {
                reason: "usage-error",
                message,
                help,
            });
        } else {
            let help = help.map_or(String::new(), |help| format!("  help: {help}\n"));
            err(&format!("error: {}\n{help}", printable(message)));
        }
    }

    /// A record for programs.
    pub(super) fn record(self, record: &impl Serialize) {
        if !self.is_json() {
            return;
        }
        if let Ok(line) = serde_json::to_string(record) {
            self.records(&format!("{line}\n"));
        }
    }

    fn records(self, lines: &str) {
        if self.document {
            err(lines);
        } else {
            out(lines);
        }
    }
}

#[derive(Serialize)]
struct Complaint<'a> {
    reason: &'static str,
    message: &'a str,
    help: Option<&'a str>,
}

/// Writes a result. A reader that has had enough is no error.
pub(super) fn out(text: &str) {
    let _ = io::stdout().lock().write_all(text.as_bytes());
}

/// Writes a message.
fn err(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

fn style(when: ColorWhen, terminal: bool) -> Style {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    let colour = match when {
        ColorWhen::Always => true,
        ColorWhen::Never => false,
        ColorWhen::Auto if set("NO_COLOR") => false,
        ColorWhen::Auto if set("FORCE_COLOR") || set("CLICOLOR_FORCE") => true,
        ColorWhen::Auto if dumb => return Style::Narrated,
        ColorWhen::Auto => terminal,
    };
    if colour { Style::Colour } else { Style::Plain }
}
