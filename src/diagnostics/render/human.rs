//! The form for people: miette's snippets, with the code in front, facts and advice behind.

use super::printable;
use super::source::{Found, Source, Sources, line_column, mark_length};
use crate::diagnostics::{Diagnostic, Label, Severity};
use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, NarratableReportHandler,
    SourceCode,
};
use std::borrow::Cow;
use std::fmt;

/// How a report looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Snippets with colour, for terminals.
    Colour,
    /// Snippets without colour, for files and for terminals without it.
    Plain,
    /// Sentences without drawing, for screen readers and for terminals without Unicode.
    Narrated,
}

/// Renders diagnostics in their order, each followed by an empty line. Control characters of the
/// files are shown as others.
pub fn human(diagnostics: &[Diagnostic], sources: &Sources<'_>, style: Style) -> String {
    let project = [sources.project.name, sources.project.text].map(printable);
    let mesh = sources
        .mesh
        .map(|mesh| [mesh.name, mesh.text].map(printable));
    let sources = Sources {
        project: Source {
            name: &project[0],
            text: &project[1],
        },
        spans: sources.spans,
        mesh: mesh.as_ref().map(|[name, text]| Source { name, text }),
    };
    let mut text = String::new();
    for diagnostic in diagnostics {
        text.push_str(&one(&shown(diagnostic), &sources, style));
        text.push('\n');
    }
    text
}

/// A diagnostic in characters that are shown: names in it come from files.
fn shown(diagnostic: &Diagnostic) -> Diagnostic {
    let mut diagnostic = diagnostic.clone();
    let labels = diagnostic.labels.iter_mut().map(|label| &mut label.text);
    let texts = labels
        .chain(&mut diagnostic.notes)
        .chain(&mut diagnostic.help)
        .chain([&mut diagnostic.message]);
    for text in texts {
        if let Cow::Owned(shown) = printable(text) {
            *text = shown;
        }
    }
    diagnostic
}

fn one(diagnostic: &Diagnostic, sources: &Sources<'_>, style: Style) -> String {
    let mut text = head(diagnostic, style);
    let mut labels: Vec<(Found, &Label)> = diagnostic
        .labels
        .iter()
        .filter_map(|label| Some((sources.find(&label.place)?, label)))
        .collect();
    // A snippet shows one file; the primary label's comes first.
    while let Some((first, _)) = labels.first() {
        let file = first.file;
        let (here, rest) = labels
            .into_iter()
            .partition(|(found, _)| found.file == file);
        labels = rest;
        if let Some(source) = sources.source(file) {
            text.push_str(&snippet(&here, source, diagnostic.severity, style));
        }
    }
    for label in &diagnostic.labels {
        if sources.find(&label.place).is_none() {
            remark(&mut text, "note", &label.text, style);
        }
    }
    for note in &diagnostic.notes {
        remark(&mut text, "note", note, style);
    }
    if let Some(help) = &diagnostic.help {
        remark(&mut text, "help", help, style);
    }
    text
}

/// Severity, code and message; of a lint also the name by which it is allowed.
fn head(diagnostic: &Diagnostic, style: Style) -> String {
    let (word, colour) = match diagnostic.severity {
        Severity::Error => ("error", "31"),
        Severity::Warning => ("warning", "33"),
        Severity::Note => ("note", "36"),
    };
    let lint = diagnostic.code.info().filter(|info| info.is_lint());
    let name = lint.map_or(String::new(), |lint| format!(" ({})", lint.name));
    let start = format!("{word}[{}]", diagnostic.code);
    let start = painted(&start, &format!("1;{colour}"), style);
    format!("{start}: {}{name}\n", diagnostic.message)
}

/// A labelled remark; further lines stand under the first.
fn remark(text: &mut String, word: &str, remark: &str, style: Style) {
    let indent = " ".repeat(word.len() + 4);
    let remark = remark.replace('\n', &format!("\n{indent}"));
    let word = painted(word, "36", style);
    text.extend(["  ", &word, ": ", &remark, "\n"]);
}

fn painted(text: &str, colour: &str, style: Style) -> String {
    match style {
        Style::Colour => format!("\u{1b}[{colour}m{text}\u{1b}[0m"),
        Style::Plain | Style::Narrated => text.to_owned(),
    }
}

fn snippet(
    labels: &[(Found, &Label)],
    source: Source<'_>,
    severity: Severity,
    style: Style,
) -> String {
    if labels
        .iter()
        .any(|(found, _)| !is_drawable(found, source.text))
    {
        return positions(labels, source);
    }
    let mark = mark_length(source.text);
    let spans = labels.iter().enumerate().map(|(index, (found, label))| {
        let start = found.range.start.saturating_sub(mark);
        let span = (start, found.range.len());
        match index {
            0 => LabeledSpan::new_primary_with_span(Some(label.text.clone()), span),
            _ => LabeledSpan::new_with_span(Some(label.text.clone()), span),
        }
    });
    let report = Snippet {
        labels: spans.collect(),
        source: NamedSource::new(source.name, source.text[mark..].to_owned()),
        severity,
    };
    let mut text = String::new();
    let rendered = match style {
        Style::Narrated => NarratableReportHandler::new().render_report(&mut text, &report),
        Style::Colour | Style::Plain => {
            let theme = match style {
                Style::Colour => GraphicalTheme::unicode(),
                _ => GraphicalTheme::unicode_nocolor(),
            };
            GraphicalReportHandler::new_themed(theme)
                .with_width(WIDTH)
                .with_links(false)
                .render_report(&mut text, &report)
        }
    };
    match rendered {
        Ok(()) => without_head(&text),
        // The library refuses spans outside of the text, which cannot come in; a report without
        // its snippet is still a report.
        Err(fmt::Error) => String::new(),
    }
}

/// Lines beyond this make no readable snippet, and beyond 65535 columns the library panics.
const LONGEST_LINE: usize = 1000;

/// Whether there is something to mark and the lines around it are short enough to draw.
fn is_drawable(found: &Found, text: &str) -> bool {
    let is_break = |byte: &u8| *byte == b'\n';
    let bytes = text.as_bytes();
    let mut start = found.range.start;
    let mut end = found.range.end;
    // The line of the place itself and the one before and behind, which are context.
    for _ in 0..2 {
        let from = start.saturating_sub(LONGEST_LINE);
        match bytes[from..start].iter().rposition(is_break) {
            Some(at) => start = from + at,
            None if from > 0 => return false,
            None => start = 0,
        }
        let to = (end + LONGEST_LINE).min(bytes.len());
        match bytes[end..to].iter().position(is_break) {
            Some(at) => end += at + 1,
            None if to < bytes.len() => return false,
            None => end = bytes.len(),
        }
    }
    (1..=LONGEST_LINE).contains(&found.range.len())
}

/// Labels by their positions, where no snippet can be drawn.
fn positions(labels: &[(Found, &Label)], source: Source<'_>) -> String {
    let line = |(found, label): &(Found, &Label)| {
        let (line, column) = line_column(source.text, found.range.start);
        format!("  at {}:{line}:{column}: {}\n", source.name, label.text)
    };
    labels.iter().map(line).collect()
}

/// Wider than any label; lines are not to be broken.
const WIDTH: usize = 400;

/// The library prints the message above its snippet; the message is already there.
fn without_head(text: &str) -> String {
    let mut kept = String::new();
    for line in text.lines().skip_while(|line| !starts_snippet(line)) {
        if !line.trim().is_empty() {
            kept.push_str(line.trim_end());
            kept.push('\n');
        }
    }
    kept
}

fn starts_snippet(line: &str) -> bool {
    line.contains("╭─[") || line.contains("╭────") || line.starts_with("Begin snippet")
}

/// What the library wants to see of a diagnostic.
struct Snippet {
    labels: Vec<LabeledSpan>,
    source: NamedSource<String>,
    severity: Severity,
}

impl fmt::Debug for Snippet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Snippet")
    }
}

impl fmt::Display for Snippet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("-")
    }
}

impl std::error::Error for Snippet {}

impl miette::Diagnostic for Snippet {
    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
            Severity::Note => miette::Severity::Advice,
        })
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }
}
