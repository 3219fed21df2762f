//! The two notations, read into one tree of values with byte ranges.
//!
//! Everything after this module works on [`Node`]s and cannot tell TOML from RON: that is what
//! makes the model and the diagnostics of both the same.
//!
//! | in the tree | TOML | RON |
//! |---|---|---|
//! | table | table, inline table | `(key: value)`, `Name(key: value)`, `{ "key": value }`, `()` |
//! | list | array, array of tables | `[..]`, tuple `(..)` |
//! | text | string | string, bare identifier (`automatic`) |
//! | absent | - | `None`; `Some(x)` is `x` |

#[cfg(test)]
mod oracle;
mod ron;
mod ron_scan;
mod toml;

use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, File, KeyPath, SpanTable};
use std::ops::Range;

/// The notation that a project file is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Notation {
    /// `pavilion.toml`, the main one.
    Toml,
    /// `pavilion.ron`.
    Ron,
}

impl Notation {
    /// The notation of a file by its extension (`toml` or `ron`, in any case).
    pub fn of_extension(extension: &str) -> Option<Self> {
        if extension.eq_ignore_ascii_case("toml") {
            Some(Self::Toml)
        } else if extension.eq_ignore_ascii_case("ron") {
            Some(Self::Ron)
        } else {
            None
        }
    }
}

/// A value with its place in the file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    /// The bytes of the value; of a table with a header, the header.
    pub(crate) span: Range<usize>,
    pub(crate) value: Value,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    Bool(bool),
    Number(Number),
    Text(String),
    List(Vec<Node>),
    /// In the order of the file, keys unique.
    Table(Vec<Entry>),
    /// Something the notation has and the language does not use, in words: `a date`.
    Other(&'static str),
}

/// A number as written, for the exact decimal reader.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Number {
    /// Decimal digits with sign, point and exponent, without underscores; or `inf`, `nan` with
    /// an optional sign.
    pub(crate) text: String,
    /// Written without point and exponent.
    pub(crate) whole: bool,
}

/// A key and its value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_span: Range<usize>,
    pub(crate) node: Node,
}

impl Value {
    /// What it is, with its article.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Bool(_) => "a boolean",
            Self::Number(number) if number.whole => "a whole number",
            Self::Number(_) => "a decimal number",
            Self::Text(_) => "a string",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Other(kind) => kind,
        }
    }
}

/// Reads a text. With syntax errors there is no tree.
pub(crate) fn parse(text: &str, notation: Notation) -> Result<Node, Vec<Diagnostic>> {
    let (node, mut errors) = match notation {
        Notation::Toml => toml::parse(text),
        Notation::Ron => ron::parse(text),
    };
    if errors.is_empty() {
        return Ok(node);
    }
    errors.sort_by_key(|error| error.span.start);
    errors.dedup_by_key(|error| error.span.start);
    let more = errors.len().saturating_sub(MOST_SYNTAX_ERRORS);
    errors.truncate(MOST_SYNTAX_ERRORS);
    let mut diagnostics: Vec<_> = errors.into_iter().map(SyntaxError::diagnostic).collect();
    if more > 0
        && let Some(last) = diagnostics.pop()
    {
        diagnostics.push(last.note(format!("{more} further errors are not shown")));
    }
    Err(diagnostics)
}

/// After so many syntax errors the rest is noise.
const MOST_SYNTAX_ERRORS: usize = 20;

/// Tables and lists may stand this deep in each other; a project needs five levels. It keeps
/// the recursion of every reader far from the end of the stack.
const DEEPEST: usize = 32;

#[derive(Debug, Clone, PartialEq, Eq)]
struct SyntaxError {
    span: Range<usize>,
    kind: SyntaxKind,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum SyntaxKind {
    /// What was found and expected, and where, if a short text can say it.
    Syntax {
        message: String,
        label: String,
    },
    DuplicateKey,
    TooDeep,
}

impl SyntaxError {
    fn syntax(span: Range<usize>, message: impl Into<String>, label: impl Into<String>) -> Self {
        Self {
            span,
            kind: SyntaxKind::Syntax {
                message: message.into(),
                label: label.into(),
            },
        }
    }

    fn diagnostic(self) -> Diagnostic {
        match self.kind {
            SyntaxKind::Syntax { message, label } => Diagnostic::error(Code::new("E0101"), message)
                .at_bytes(File::Project, self.span, label),
            SyntaxKind::DuplicateKey => {
                Diagnostic::error(Code::new("E0102"), "this key is already set")
                    .at_bytes(File::Project, self.span, "set a second time")
                    .help("keep one of the two; tables with the same name are written once")
            }
            SyntaxKind::TooDeep => Diagnostic::error(
                Code::new("E0103"),
                format!("tables and lists are nested deeper than {DEEPEST} levels"),
            )
            .at_bytes(File::Project, self.span, "too deep from here on")
            .help("no part of a project needs more than five levels; look for an unclosed bracket"),
        }
    }
}

/// The side table of a tree.
pub(crate) fn spans(root: &Node, text: &str) -> SpanTable {
    let mut table = SpanTable::new(text.len());
    enter(root, &KeyPath::root(), text, &mut table);
    table
}

fn enter(node: &Node, path: &KeyPath, text: &str, table: &mut SpanTable) {
    match &node.value {
        Value::Table(entries) => {
            for entry in entries {
                let path = path.key(&entry.key);
                // A table is shown by its name: its bytes may fill the screen.
                let shown = match entry.node.value {
                    Value::Table(_) => entry.key_span.clone(),
                    _ => first_line(&entry.node.span, text),
                };
                table.insert(path.as_str(), Some(entry.key_span.clone()), shown);
                enter(&entry.node, &path, text, table);
            }
        }
        Value::List(items) => {
            for (index, item) in items.iter().enumerate() {
                let path = path.index(index);
                table.insert(path.as_str(), None, first_line(&item.span, text));
                enter(item, &path, text, table);
            }
        }
        _ => {}
    }
}

fn first_line(span: &Range<usize>, text: &str) -> Range<usize> {
    let shown = text.get(span.clone()).unwrap_or_default();
    let length = shown.find(['\n', '\r']).unwrap_or(shown.len());
    span.start..span.start + length
}
