//! How a tree becomes the file's types: one trait for values, one for fields, and a macro that
//! takes a table apart by the names of a struct's fields.

use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath, Severity};
use crate::project::notation::{Entry, Node, Value};
use crate::project::suggest;
use crate::project::units::{MILLIMETRE, Unit};

/// A value that the file says: readable, or wrong and reported. Whoever depends on a wrong value
/// keeps silent, so that one mistake is told once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Field<T> {
    /// As it should be.
    Good(T),
    /// Reported.
    Bad,
}

impl<T> Field<T> {
    /// The value unless it is wrong.
    pub(crate) fn good(&self) -> Option<&T> {
        match self {
            Self::Good(value) => Some(value),
            Self::Bad => None,
        }
    }
}

impl<T> From<Option<T>> for Field<T> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Bad, Self::Good)
    }
}

/// Optional fields: missing takes the default, wrong stays wrong.
pub(crate) trait Defaulted<T> {
    /// The value or the default, `None` if the file says something wrong.
    fn said_or(&self, default: T) -> Option<T>;

    /// The value if the file says one, `None` if it says something wrong.
    #[expect(
        clippy::option_option,
        reason = "wrong, left out and said are three things"
    )]
    fn said(&self) -> Option<Option<T>>;
}

impl<T: Clone> Defaulted<T> for Option<Field<T>> {
    fn said_or(&self, default: T) -> Option<T> {
        Some(self.said()?.unwrap_or(default))
    }

    fn said(&self) -> Option<Option<T>> {
        match self {
            None => Some(None),
            Some(field) => field.good().cloned().map(Some),
        }
    }
}

/// Collects diagnostics while a project is read and checked.
#[derive(Debug, Default)]
pub(crate) struct Sink {
    diagnostics: Vec<Diagnostic>,
    failed: bool,
    hidden: usize,
}

/// Nobody reads on; a file with more has one systematic fault.
const MOST_DIAGNOSTICS: usize = 100;

impl Sink {
    /// Adds a diagnostic, made only if it will be shown.
    pub(crate) fn push(&mut self, severity: Severity, make: impl FnOnce() -> Diagnostic) {
        self.failed |= severity == Severity::Error;
        if self.diagnostics.len() < MOST_DIAGNOSTICS {
            self.diagnostics.push(make());
        } else {
            self.hidden += 1;
        }
    }

    pub(crate) fn error(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.push(Severity::Error, make);
    }

    pub(crate) fn warning(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.push(Severity::Warning, make);
    }

    /// Whether any error came in.
    pub(crate) fn failed(&self) -> bool {
        self.failed
    }

    pub(crate) fn into_diagnostics(mut self) -> Vec<Diagnostic> {
        if self.hidden > 0
            && let Some(last) = self.diagnostics.pop()
        {
            let note = format!("{} further diagnostics are not shown", self.hidden);
            self.diagnostics.push(last.note(note));
        }
        self.diagnostics
    }
}

/// What reading a value may need beside the node.
pub(crate) struct Reader {
    pub(crate) sink: Sink,
    /// The unit of bare lengths.
    pub(crate) length_unit: Unit,
    /// Every table path and key that was asked for, names of the user's as `*`.
    #[cfg(test)]
    pub(crate) asked: std::collections::BTreeSet<String>,
}

impl Reader {
    pub(crate) fn new() -> Self {
        Self {
            sink: Sink::default(),
            length_unit: MILLIMETRE,
            #[cfg(test)]
            asked: std::collections::BTreeSet::new(),
        }
    }

    /// Reports a value of the wrong kind; for use as a read's result.
    pub(crate) fn wrong_type<T>(&mut self, node: &Node, at: &KeyPath, expected: &str) -> Option<T> {
        self.sink.error(|| {
            let found = node.value.kind();
            Diagnostic::error(
                Code::new("E0112"),
                format!("`{at}` is {found}, not {expected}"),
            )
            .at_key(at.as_str(), format!("expected {expected}"))
        });
        None
    }
}

/// A type of values in the file.
pub(crate) trait FromNode: Sized {
    /// Reads the value; `None` after reporting what is wrong with it.
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self>;
}

/// A type of a struct's field: required or optional.
pub(crate) trait FromField: Sized {
    fn take(table: &mut TableReader<'_>, key: &'static str, reader: &mut Reader) -> Self;
}

impl<T: FromNode> FromField for Field<T> {
    fn take(table: &mut TableReader<'_>, key: &'static str, reader: &mut Reader) -> Self {
        let Some(node) = table.find(key, reader) else {
            table.missing.push(key);
            return Self::Bad;
        };
        T::read(node, &table.path.key(key), reader).into()
    }
}

impl<T: FromNode> FromField for Option<Field<T>> {
    fn take(table: &mut TableReader<'_>, key: &'static str, reader: &mut Reader) -> Self {
        let node = table.find(key, reader)?;
        Some(T::read(node, &table.path.key(key), reader).into())
    }
}

/// A table being taken apart.
pub(crate) struct TableReader<'n> {
    pub(crate) path: KeyPath,
    entries: &'n [Entry],
    known: Vec<&'static str>,
    missing: Vec<&'static str>,
}

impl<'n> TableReader<'n> {
    /// Opens a node that must be a table.
    pub(crate) fn open(node: &'n Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        match &node.value {
            Value::Table(entries) => Some(Self {
                path: at.clone(),
                entries,
                known: Vec::new(),
                missing: Vec::new(),
            }),
            _ => reader.wrong_type(node, at, "a table"),
        }
    }

    fn find(&mut self, key: &'static str, reader: &mut Reader) -> Option<&'n Node> {
        self.known.push(key);
        #[cfg(test)]
        reader.asked.insert(self.path.key(key).into());
        #[cfg(not(test))]
        let _ = reader;
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some(&entry.node)
    }

    /// The entries that no field has asked for.
    pub(crate) fn rest(&self) -> impl Iterator<Item = &'n Entry> {
        let known = self.known.clone();
        self.entries
            .iter()
            .filter(move |entry| !known.contains(&entry.key.as_str()))
    }

    /// Reports keys that no field has asked for, and required ones that are missing.
    pub(crate) fn finish(self, reader: &mut Reader) {
        let unknown: Vec<&str> = self.rest().map(|entry| entry.key.as_str()).collect();
        for key in &unknown {
            unknown_key(&self.path, key, &self.known, reader);
        }
        self.report_missing(&unknown, reader);
    }

    /// Reports missing keys, but not one that an unknown key was meant to be.
    pub(crate) fn report_missing(&self, unknown: &[&str], reader: &mut Reader) {
        for key in &self.missing {
            let is_misspelt = |unknown: &&str| suggest::is_close(unknown, key);
            if !unknown.iter().any(is_misspelt) {
                missing_key(&self.path, key, reader);
            }
        }
    }

    /// The keys asked for so far.
    pub(crate) fn known(&self) -> &[&'static str] {
        &self.known
    }
}

fn missing_key(table: &KeyPath, key: &str, reader: &mut Reader) {
    let path = table.key(key);
    reader.sink.error(|| {
        let label = if table.as_str().is_empty() {
            format!("no `{key}` in the whole file")
        } else {
            format!("`{key}` belongs here")
        };
        let diagnostic = Diagnostic::error(Code::new("E0111"), format!("`{path}` is missing"))
            .at_key(path.as_str(), label);
        match super::example(&path) {
            Some(example) => diagnostic.help(format!("for example:{example}")),
            None => diagnostic,
        }
    });
}

pub(crate) fn unknown_key(table: &KeyPath, key: &str, known: &[&str], reader: &mut Reader) {
    reader.sink.error(|| {
        let path = table.key(key);
        let place = if table.as_str().is_empty() {
            "at the top of a project".to_owned()
        } else {
            format!("in `{table}`")
        };
        let message = format!("there is no key `{}` {place}", shortened(key));
        let diagnostic =
            Diagnostic::error(Code::new("E0110"), message).at_name(path.as_str(), "unknown key");
        match suggest::help(key, "key", known.iter().copied()) {
            Some(help) => diagnostic.help(help),
            None => diagnostic.help(format!("the keys are {}", suggest::all_of(known))),
        }
    });
}

/// A user's text in a message, cut where it would fill the screen.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut short = String::new();
    for char in text.chars().take(LONGEST) {
        if char.is_control() {
            short.extend(char.escape_default());
        } else {
            short.push(char);
        }
    }
    if text.chars().count() > LONGEST {
        short.push('…');
    }
    short
}

/// Reads a table into a struct whose field names are its keys.
macro_rules! section {
    ($type:ty { $($field:ident),* $(,)? }) => {
        impl $crate::project::file::reader::FromNode for $type {
            fn read(
                node: &$crate::project::notation::Node,
                at: &$crate::diagnostics::KeyPath,
                reader: &mut $crate::project::file::reader::Reader,
            ) -> Option<Self> {
                use $crate::project::file::reader::{FromField, TableReader};
                let mut table = TableReader::open(node, at, reader)?;
                let section = Self {
                    $($field: FromField::take(&mut table, stringify!($field), reader),)*
                };
                table.finish(reader);
                Some(section)
            }
        }
    };
}
pub(crate) use section;
