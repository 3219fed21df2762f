//! Lists and tables of values, with their allowed sizes.

use super::reader::{Field, FromNode, Reader, shortened};
use super::words::{NAME_PATTERN, bad_name, name_fault};
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::notation::{Node, Value};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::marker::PhantomData;

/// A list of `LEAST` to `MOST` values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct List<T, const LEAST: usize, const MOST: usize>(pub(crate) Vec<Field<T>>);

/// A list of exactly `N` values.
pub(crate) type Exactly<T, const N: usize> = List<T, N, N>;

impl<T: Clone, const LEAST: usize, const MOST: usize> List<T, LEAST, MOST> {
    /// All values if none is wrong.
    pub(crate) fn all(&self) -> Option<Vec<T>> {
        self.0.iter().map(|item| item.good().cloned()).collect()
    }
}

impl<T: FromNode, const LEAST: usize, const MOST: usize> FromNode for List<T, LEAST, MOST> {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let Value::List(items) = &node.value else {
            return reader.wrong_type(node, at, "a list");
        };
        if !(LEAST..=MOST).contains(&items.len()) {
            reader
                .sink
                .error(|| wrong_length(at, items.len(), LEAST, MOST));
            return None;
        }
        Some(Self(read_items(items, at, reader)))
    }
}

pub(crate) fn read_items<T: FromNode>(
    items: &[Node],
    at: &KeyPath,
    reader: &mut Reader,
) -> Vec<Field<T>> {
    let read = |(index, item): (usize, &Node)| T::read(item, &at.index(index), reader).into();
    items.iter().enumerate().map(read).collect()
}

pub(crate) fn wrong_length(at: &KeyPath, found: usize, least: usize, most: usize) -> Diagnostic {
    let expected = match (least, most) {
        _ if least == most => format!("exactly {least}"),
        _ if found < least => format!("at least {least}"),
        _ => format!("at most {most}"),
    };
    let items = if found == 1 { "item" } else { "items" };
    Diagnostic::error(
        Code::new("E0113"),
        format!("`{at}` has {found} {items}, but takes {expected}"),
    )
    .at_key(at.as_str(), format!("expected {expected}"))
}

impl<T: JsonSchema, const LEAST: usize, const MOST: usize> JsonSchema for List<T, LEAST, MOST> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "List".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "array",
            "items": generator.subschema_for::<T>(),
            "minItems": LEAST,
            "maxItems": MOST,
        })
    }
}

/// One value, or a list of 1 to `MOST`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OneOrMany<T, const MOST: usize>(pub(crate) Vec<Field<T>>);

impl<T: Clone, const MOST: usize> OneOrMany<T, MOST> {
    /// All values if none is wrong.
    pub(crate) fn all(&self) -> Option<Vec<T>> {
        self.0.iter().map(|item| item.good().cloned()).collect()
    }
}

impl<T: FromNode, const MOST: usize> FromNode for OneOrMany<T, MOST> {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        match &node.value {
            Value::List(_) => Some(Self(List::<T, 1, MOST>::read(node, at, reader)?.0)),
            _ => Some(Self(vec![Field::Good(T::read(node, at, reader)?)])),
        }
    }
}

impl<T: JsonSchema, const MOST: usize> JsonSchema for OneOrMany<T, MOST> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "OneOrMany".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<T>();
        let many = generator.subschema_for::<List<T, 1, MOST>>();
        json_schema!({ "anyOf": [one, many] })
    }
}

/// What the keys of a table of the user's are.
pub(crate) trait Keys {
    /// With its article: `a point`.
    const WHAT: &'static str;
    /// Most entries.
    const MOST: usize;
    /// Least entries.
    const LEAST: usize;
    /// Keys are names and must be usable as such; otherwise they are checked elsewhere.
    const NAMES: bool;
    /// Names that have another meaning.
    const RESERVED: &'static [&'static str];
}

/// Marks the names of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Points {}
/// Marks the names of patches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Patches {}
/// Marks the names of materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Materials {}
/// Marks the names of sides, `a-b`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Sides {}
/// Marks names of patches where they are used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PatchUses {}

impl Keys for Points {
    const WHAT: &'static str = "a point";
    const MOST: usize = 5000;
    const LEAST: usize = 0;
    const NAMES: bool = true;
    const RESERVED: &'static [&'static str] = &[];
}

impl Keys for Patches {
    const WHAT: &'static str = "a patch";
    const MOST: usize = 2000;
    const LEAST: usize = 1;
    const NAMES: bool = true;
    const RESERVED: &'static [&'static str] = &["width", "thickness", "material"];
}

impl Keys for Materials {
    const WHAT: &'static str = "a material";
    const MOST: usize = 200;
    const LEAST: usize = 0;
    const NAMES: bool = true;
    const RESERVED: &'static [&'static str] = &[];
}

impl Keys for Sides {
    const WHAT: &'static str = "a side";
    const MOST: usize = 5000;
    const LEAST: usize = 0;
    const NAMES: bool = false;
    const RESERVED: &'static [&'static str] = &[];
}

impl Keys for PatchUses {
    const WHAT: &'static str = "a patch";
    const MOST: usize = 2000;
    const LEAST: usize = 0;
    const NAMES: bool = false;
    const RESERVED: &'static [&'static str] = &[];
}

/// A table whose keys are the user's, in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Named<K, T> {
    /// Keys and values. An entry whose name is refused stays, so that its uses are no second
    /// error.
    pub(crate) entries: Vec<(String, Field<T>)>,
    kind: PhantomData<K>,
}

impl<K, T> Named<K, T> {
    pub(crate) fn new(entries: Vec<(String, Field<T>)>) -> Self {
        Self {
            entries,
            kind: PhantomData,
        }
    }
}

impl<K: Keys, T: FromNode> FromNode for Named<K, T> {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let Value::Table(table) = &node.value else {
            return reader.wrong_type(node, at, "a table");
        };
        if !(K::LEAST..=K::MOST).contains(&table.len()) {
            reader
                .sink
                .error(|| wrong_length(at, table.len(), K::LEAST, K::MOST));
            return None;
        }
        let mut entries: Vec<(String, Field<T>)> = Vec::with_capacity(table.len());
        let mut folded: BTreeMap<String, &str> = BTreeMap::new();
        for entry in table {
            let path = at.key(&entry.key);
            let value = T::read(&entry.node, &path, reader).into();
            if K::NAMES {
                check_name::<K>(&entry.key, at, &mut folded, reader);
            }
            entries.push((entry.key.clone(), value));
        }
        Some(Self::new(entries))
    }
}

fn check_name<'n, K: Keys>(
    name: &'n str,
    table: &KeyPath,
    folded: &mut BTreeMap<String, &'n str>,
    reader: &mut Reader,
) {
    let path = table.key(name);
    let shown = shortened(name);
    if let Some(fault) = name_fault(name) {
        reader.sink.error(|| {
            let message = format!("`{shown}` cannot be the name of {}", K::WHAT);
            let diagnostic = Diagnostic::error(Code::new("E0119"), message)
                .at_name(path.as_str(), "not usable as a name");
            bad_name(diagnostic, fault)
        });
    } else if K::RESERVED.contains(&name) {
        reader.sink.error(|| {
            Diagnostic::error(
                Code::new("E0119"),
                format!("`{shown}` cannot be the name of {}", K::WHAT),
            )
            .at_name(path.as_str(), "reserved")
            .note(format!(
                "`lamella.{shown}` already means the {shown} of every lamella"
            ))
            .help("choose another name")
        });
    } else if let Some(first) = folded.insert(name.to_ascii_lowercase(), name) {
        reader.sink.error(|| {
            Diagnostic::error(
                Code::new("E0120"),
                format!("`{first}` and `{shown}` differ only in upper and lower case"),
            )
            .at_name(path.as_str(), "too much like the other")
            .at_name(table.key(first).as_str(), "the first")
            .help("rename one: their files could not stand side by side on every system")
        });
    }
}

impl<K: Keys, T: JsonSchema> JsonSchema for Named<K, T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Named".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = json_schema!({
            "type": "object",
            "additionalProperties": generator.subschema_for::<T>(),
            "minProperties": K::LEAST,
            "maxProperties": K::MOST,
        });
        if K::NAMES {
            let mut names = json_schema!({ "pattern": NAME_PATTERN });
            if !K::RESERVED.is_empty() {
                names.insert("not".to_owned(), serde_json::json!({ "enum": K::RESERVED }));
            }
            schema.insert("propertyNames".to_owned(), names.into());
        }
        schema
    }
}
