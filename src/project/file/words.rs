//! Values that are names, texts, paths and counts.

use super::quantity::out_of_range;
use super::reader::{FromNode, Reader, shortened};
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::model::Family;
use crate::project::notation::{Node, Value};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;

/// Longest name of a point, patch, material or project.
const LONGEST_NAME: usize = 40;

/// What is wrong with a name, if anything. Names become parts of ids (`west.u03-v05`), of file
/// names and of labels that a stroke font engraves; all of them must be able to hold it.
pub(crate) fn name_fault(name: &str) -> Option<String> {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    if name.is_empty() {
        Some("a name has at least one character".to_owned())
    } else if name.len() > LONGEST_NAME {
        Some(format!("a name has at most {LONGEST_NAME} characters"))
    } else if !name.bytes().all(plain) {
        Some("a name is made of the letters a to z and A to Z, digits, `_` and `-`".to_owned())
    } else if !name.as_bytes()[0].is_ascii_alphanumeric() {
        Some("a name starts with a letter or a digit".to_owned())
    } else if is_device(name) {
        Some("Windows keeps this name for a device, so no file can have it".to_owned())
    } else {
        None
    }
}

fn is_device(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let numbered = |prefix: &str| {
        name.strip_prefix(prefix)
            .is_some_and(|rest| matches!(rest.as_bytes(), [b'1'..=b'9']))
    };
    matches!(name.as_str(), "con" | "prn" | "aux" | "nul") || numbered("com") || numbered("lpt")
}

/// The rule of [`name_fault`] as far as a regular expression says it.
pub(crate) const NAME_PATTERN: &str = "^[A-Za-z0-9][A-Za-z0-9_-]{0,39}$";

pub(crate) fn bad_name(diagnostic: Diagnostic, fault: String) -> Diagnostic {
    diagnostic.note(fault).help(
        "names are engraved on parts and become file names; use short ones such as `west` or `a1`",
    )
}

/// Implements [`JsonSchema`] inline.
macro_rules! inline_schema {
    ($type:ty, $generator:pat => $schema:expr) => {
        impl JsonSchema for $type {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($type).into()
            }

            fn json_schema($generator: &mut SchemaGenerator) -> Schema {
                $schema
            }
        }
    };
}
pub(crate) use inline_schema;

fn text<'n>(node: &'n Node, at: &KeyPath, expected: &str, reader: &mut Reader) -> Option<&'n str> {
    match &node.value {
        Value::Text(text) => Some(text),
        _ => reader.wrong_type(node, at, expected),
    }
}

/// The project's own name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Name(pub(crate) String);

inline_schema!(Name, _ => json_schema!({ "type": "string", "pattern": NAME_PATTERN }));

impl FromNode for Name {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let name = text(node, at, "a name", reader)?;
        if let Some(fault) = name_fault(name) {
            reader.sink.error(|| {
                let message = format!("`{}` cannot be a name", shortened(name));
                let diagnostic = Diagnostic::error(Code::new("E0119"), message)
                    .at_key(at.as_str(), "not usable as a name");
                bad_name(diagnostic, fault)
            });
            return None;
        }
        Some(Self(name.to_owned()))
    }
}

/// The name of something defined elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reference(pub(crate) String);

inline_schema!(Reference, _ => json_schema!({ "type": "string" }));

impl FromNode for Reference {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let name = text(node, at, "a name in quotes", reader)?;
        Some(Self(name.to_owned()))
    }
}

/// A short text without control characters.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Label(pub(crate) String);

inline_schema!(Label, _ => json_schema!({ "type": "string", "minLength": 1, "maxLength": 80 }));

impl FromNode for Label {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let label = text(node, at, "a string", reader)?;
        let length = label.chars().count();
        if (1..=80).contains(&length) && !label.chars().any(char::is_control) {
            return Some(Self(label.to_owned()));
        }
        reader.sink.error(|| {
            let found = format!("\"{label}\"");
            out_of_range(at, &found, "1 to 80 printable characters", None)
        });
        None
    }
}

/// A path relative to the project file, with `/` between its parts.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeshPath(pub(crate) String);

inline_schema!(MeshPath, _ => json_schema!({
    "type": "string",
    "minLength": 1,
    "maxLength": 1000,
    "pattern": "^[^/\\\\:][^\\\\:]*$",
}));

impl FromNode for MeshPath {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let path = text(node, at, "a path in quotes", reader)?;
        let fault = if path.is_empty() {
            "the path is empty"
        } else if path.len() > 1000 || path.chars().any(char::is_control) {
            "this is no path"
        } else if path.contains('\\') {
            "the parts of a path are divided by `/`, on every system"
        } else if path.starts_with('/') || path.contains(':') {
            "a path is relative to the project file, so that the project can move"
        } else if path.ends_with('/') {
            "the path names a folder"
        } else {
            return Some(Self(path.to_owned()));
        };
        reader.sink.error(|| {
            Diagnostic::error(
                Code::new("E0121"),
                format!("`{at}` cannot be used: {fault}"),
            )
            .at_key(at.as_str(), "expected a path such as \"meshes/roof.obj\"")
        });
        None
    }
}

/// A whole number from `LEAST` to `MOST`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Count<const LEAST: u32, const MOST: u32>(pub u32);

impl<const LEAST: u32, const MOST: u32> JsonSchema for Count<LEAST, MOST> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Count".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": LEAST, "maximum": MOST })
    }
}

impl<const LEAST: u32, const MOST: u32> FromNode for Count<LEAST, MOST> {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let number = match &node.value {
            Value::Number(number) if number.whole => number,
            _ => return reader.wrong_type(node, at, "a whole number"),
        };
        match number.text.parse::<u32>() {
            Ok(count) if (LEAST..=MOST).contains(&count) => Some(Self(count)),
            _ => {
                let range = format!("a whole number from {LEAST} to {MOST}");
                reader
                    .sink
                    .error(|| out_of_range(at, &number.text, &range, None));
                None
            }
        }
    }
}

/// The number of the language's version.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Format;

/// The version of the language that this compiler reads.
pub const FORMAT: u32 = 1;

inline_schema!(Format, _ => json_schema!({ "type": "integer", "const": FORMAT }));

impl FromNode for Format {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let number = match &node.value {
            Value::Number(number) if number.whole => number,
            _ => return reader.wrong_type(node, at, "a whole number"),
        };
        if number.text.parse() == Ok(FORMAT) {
            return Some(Self);
        }
        let newer = number
            .text
            .parse::<f64>()
            .is_ok_and(|n| n > f64::from(FORMAT));
        reader.sink.error(|| {
            Diagnostic::error(
                Code::new("E0106"),
                format!(
                    "format {} of the project language is unknown",
                    shortened(&number.text)
                ),
            )
            .at_key(at.as_str(), format!("this `egg` reads format {FORMAT}"))
            .help(if newer {
                "the file was written for a newer `egg`: install that version, or set the \
                 number back and adapt what this version refuses"
            } else {
                "write `format = 1`"
            })
        });
        None
    }
}

impl FromNode for bool {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        match node.value {
            Value::Bool(bool) => Some(bool),
            _ => reader.wrong_type(node, at, "`true` or `false`"),
        }
    }
}

/// A family of a patch as text: `west.u`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FamilyName {
    /// The patch.
    pub(crate) patch: String,
    /// Which of its families.
    pub(crate) family: Family,
}

inline_schema!(FamilyName, _ => json_schema!({
    "type": "string",
    "pattern": "^[A-Za-z0-9][A-Za-z0-9_-]{0,39}\\.[uv]$",
}));

impl FromNode for FamilyName {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let name = text(node, at, "a family such as \"west.u\"", reader)?;
        let family = match name.rsplit_once('.') {
            Some((patch, "u")) => Some((patch, Family::U)),
            Some((patch, "v")) => Some((patch, Family::V)),
            _ => None,
        };
        let Some((patch, family)) = family else {
            reader.sink.error(|| {
                let message = format!("`{}` names no family of members", shortened(name));
                Diagnostic::error(Code::new("E0114"), message).at_key(
                    at.as_str(),
                    "expected a patch and its family, such as \"west.u\"",
                )
            });
            return None;
        };
        Some(Self {
            patch: patch.to_owned(),
            family,
        })
    }
}
