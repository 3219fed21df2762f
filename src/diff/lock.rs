//! The lock: what a project gives, in one sorted line a part, small enough for git.
//!
//! ```text
//! # egg plan lock, format 1. Written by `egg lock`; `egg check --locked` holds the project to it.
//! lamella west.u01 length=1180.25mm width=30mm thickness=3mm material=ash openings=11 #3f2a9c01
//! ```
//!
//! A line has the part's kind, its id, its headline values and a digest of all its values at the
//! precision at which they are shown, so that `git diff` of a lock is readable, merges are by
//! part, and nothing that people could cut or see changes without a line changing.

use super::class::Class;
use super::part::{Field, Item, Kind, Part, Value};
use super::quantity::{Quantity, number};
use super::records;
use crate::plan::Plan;
use std::borrow::Cow;
use std::fmt::Write;

/// Version of the format.
const FORMAT: u32 = 1;
/// How the first line begins.
const HEAD: &str = "# egg plan lock, format ";
/// Digits of a digest.
const DIGITS: usize = 8;

/// A lock that was read, or that a plan gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Lock {
    project: String,
    parts: Vec<Part>,
}

/// Why a text is no lock.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LockError {
    /// What is wrong in which line, from 1.
    Malformed(usize, String),
    /// It has a format that this program does not know.
    UnknownFormat(u32),
}

/// The lock of a plan, as text.
pub fn lock_text(plan: &Plan) -> String {
    let mut text = format!(
        "{HEAD}{FORMAT}. Written by `egg lock`; `egg check --locked` holds the project to it.\n"
    );
    for part in records::parts(plan) {
        let _ = write!(text, "{} {}", part.kind.word(), word(&part.id));
        for field in part.fields.iter().filter(|field| field.headline) {
            let _ = write!(
                text,
                " {}={}",
                field.name.replace(' ', "-"),
                shown(&field.value)
            );
        }
        if !part.items.is_empty() {
            let _ = write!(text, " {}={}", items_of(part.kind), part.items.len());
        }
        let _ = writeln!(text, " #{}", digest(&part));
    }
    text
}

impl Lock {
    /// What the lock of a plan says.
    pub(super) fn of(plan: &Plan) -> Self {
        let read = Self::read(&lock_text(plan));
        read.unwrap_or(Self {
            project: plan.name.clone(),
            parts: Vec::new(),
        })
    }

    /// Reads a lock.
    ///
    /// # Errors
    /// Where a line cannot be understood, or the format is another.
    pub fn read(text: &str) -> Result<Self, LockError> {
        let head = text.lines().next().and_then(|line| line.strip_prefix(HEAD));
        let format = head.and_then(|rest| rest.split('.').next()?.parse::<u32>().ok());
        match format {
            None => {
                let message = "a lock begins with `# egg plan lock, format 1`".to_owned();
                return Err(LockError::Malformed(1, message));
            }
            Some(FORMAT) => {}
            Some(other) => return Err(LockError::UnknownFormat(other)),
        }
        let mut parts = Vec::new();
        for (i, line) in text.lines().enumerate() {
            if line.starts_with('#') || line.trim().is_empty() {
                continue;
            }
            let part = part(line).map_err(|message| LockError::Malformed(i + 1, message))?;
            parts.push(part);
        }
        let project = parts
            .iter()
            .filter(|part| part.kind == Kind::Structure)
            .flat_map(|part| &part.fields)
            .find_map(|field| match &field.value {
                Value::Text(name) if field.name == "name" => Some(name.clone()),
                _ => None,
            });
        Ok(Self {
            project: project.unwrap_or_default(),
            parts,
        })
    }

    /// The project that it is of.
    pub fn project(&self) -> &str {
        &self.project
    }

    pub(super) fn parts(&self) -> &[Part] {
        &self.parts
    }

    pub(super) fn into_parts(self) -> Vec<Part> {
        self.parts
    }
}

/// What the items of a part are counted as.
fn items_of(kind: Kind) -> &'static str {
    match kind {
        Kind::Lamella => "openings",
        Kind::Sheet => "parts",
        Kind::Patch => "crossings",
        Kind::Strip => "families",
        _ => "items",
    }
}

/// A value as text, at the precision that is shown.
pub(super) fn shown(value: &Value) -> String {
    let length = |metres: f64| number(Quantity::Length.shown(metres), Quantity::Length);
    let place = |place: &[f64; 3]| {
        let [x, y, z] = place.map(length);
        format!("({x},{y},{z})")
    };
    match value {
        Value::Number(value, quantity) => {
            format!(
                "{}{}",
                number(quantity.shown(*value), *quantity),
                quantity.unit()
            )
        }
        Value::Text(text) | Value::Id(text) => word(text).into_owned(),
        Value::Place(at) => place(at),
        Value::Curve(places) => places.iter().map(place).collect::<Vec<_>>().join("-"),
    }
}

/// A word as it is, or in quotes where it would be taken for several.
fn word(text: &str) -> Cow<'_, str> {
    let plain = |c: char| !c.is_whitespace() && !c.is_control() && !matches!(c, '"' | '=' | '#');
    if !text.is_empty() && text.chars().all(plain) {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(serde_json::Value::from(text).to_string())
    }
}

/// Digest of everything that is compared.
fn digest(part: &Part) -> String {
    let mut text = String::new();
    let fields = |text: &mut String, fields: &[Field]| {
        for field in fields {
            let _ = write!(text, "{}={};", field.name, shown(&field.value));
        }
    };
    fields(&mut text, &part.fields);
    for Item {
        kind,
        id,
        fields: values,
        ..
    } in &part.items
    {
        let _ = write!(text, "{kind} {id} ");
        fields(&mut text, values);
    }
    let mut digest = blake3::hash(text.as_bytes()).to_hex().to_string();
    digest.truncate(DIGITS);
    digest
}

/// A part from its line.
fn part(line: &str) -> Result<Part, String> {
    let mut words = words(line)?.into_iter();
    let kind = words.next().unwrap_or_default();
    let kind = Kind::named(&kind).ok_or_else(|| format!("`{kind}` is no kind of part"))?;
    let id = words.next().ok_or("a part without an id")?;
    let effect = match kind {
        Kind::Lamella | Kind::Sticker | Kind::Support => Class::Recut,
        Kind::Patch | Kind::Member | Kind::Strip | Kind::Point | Kind::BillRow => Class::Reassemble,
        Kind::Sheet | Kind::Nesting | Kind::Structure => Class::Redraw,
    };
    let mut fields = Vec::new();
    for word in words {
        let field = match word.split_once('=') {
            Some((name, value)) => Field::new(name.replace('-', " "), effect, value_of(value)),
            None => match word.strip_prefix('#') {
                Some(digest) => Field::text("details", effect, digest),
                None => return Err(format!("`{word}` is neither a value nor a digest")),
            },
        };
        fields.push(field.headline());
    }
    Ok(Part {
        kind,
        id,
        fields,
        items: Vec::new(),
        presence: effect,
    })
}

/// A number with its unit, or a word.
fn value_of(text: &str) -> Value {
    let digits = text
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-')))
        .unwrap_or(text.len());
    let (digits, unit) = text.split_at(digits);
    match (digits.parse::<f64>(), Quantity::of_unit(unit)) {
        (Ok(value), Some(quantity)) if value.is_finite() => {
            Value::Number(quantity.of_shown(value), quantity)
        }
        _ => Value::Text(text.to_owned()),
    }
}

/// Words of a line, quotes taken off.
fn words(line: &str) -> Result<Vec<String>, String> {
    let mut words = Vec::new();
    let mut rest = line.trim();
    while !rest.is_empty() {
        let mut word = String::new();
        while let Some(c) = rest.chars().next().filter(|c| !c.is_whitespace()) {
            if c == '"' {
                let mut quoted = serde_json::Deserializer::from_str(rest).into_iter::<String>();
                let text = quoted.next().and_then(Result::ok).ok_or("an open quote")?;
                rest = &rest[quoted.byte_offset()..];
                word.push_str(&text);
            } else {
                word.push(c);
                rest = &rest[c.len_utf8()..];
            }
        }
        words.push(word);
        rest = rest.trim_start();
    }
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_what_is_in_it() {
        let line = "lamella west.u01 length=1180.25mm material=\"my ash\" openings=11 #3f2a9c01";
        let part = part(line).unwrap();
        assert_eq!((part.kind, &*part.id), (Kind::Lamella, "west.u01"));
        let values: Vec<String> = part.fields.iter().map(|f| shown(&f.value)).collect();
        assert_eq!(values, ["1180.25mm", "\"my ash\"", "11", "3f2a9c01"]);
    }

    #[test]
    fn what_is_no_lock_is_refused_with_its_line() {
        let refused = |text: &str| Lock::read(text).unwrap_err();
        assert!(matches!(refused(""), LockError::Malformed(1, _)));
        assert_eq!(
            refused("# egg plan lock, format 7.\n"),
            LockError::UnknownFormat(7)
        );
        let head = "# egg plan lock, format 1.\n";
        for line in ["wheel a #1", "lamella", "lamella a b", "lamella \"a #1"] {
            let error = refused(&format!("{head}{line}\n"));
            assert!(
                matches!(error, LockError::Malformed(2, _)),
                "{line}: {error:?}"
            );
        }
    }
}
