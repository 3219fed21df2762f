//! Values that are one of a closed set of words.

use super::reader::{FromNode, Reader, shortened};
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::model::{Axis, ColourPreset, Grain, SupportKind, Workflow};
use crate::project::notation::{Node, Value};
use crate::project::suggest;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use std::borrow::Cow;

/// A closed set of words.
pub(crate) trait Choice: Sized + Copy + 'static {
    /// Every word with its meaning.
    const ALL: &'static [(&'static str, Self)];
}

/// One of a closed set of words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pick<T>(pub(crate) T);

impl<T: JsonSchema> JsonSchema for Pick<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl<T: Choice> FromNode for Pick<T> {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let words = || T::ALL.iter().map(|(word, _)| *word);
        let Value::Text(word) = &node.value else {
            let words: Vec<_> = words().collect();
            return reader.wrong_type(node, at, &suggest::one_of(&words));
        };
        let found = T::ALL.iter().find(|(known, _)| known == word);
        if found.is_none() {
            reader
                .sink
                .error(|| unknown_choice(at, word, &words().collect::<Vec<_>>()));
        }
        found.map(|(_, meaning)| Self(*meaning))
    }
}

pub(crate) fn unknown_choice(at: &KeyPath, word: &str, known: &[&str]) -> Diagnostic {
    let message = format!("`{}` is not a value of `{at}`", shortened(word));
    let diagnostic = Diagnostic::error(Code::new("E0114"), message)
        .at_key(at.as_str(), format!("expected {}", suggest::one_of(known)));
    match suggest::did_you_mean(word, known) {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}

/// Unit of bare lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, JsonSchema)]
#[schemars(rename_all = "lowercase")]
pub(crate) enum LengthUnit {
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
    /// Inches of 25.4 mm.
    In,
    /// Feet of 304.8 mm.
    Ft,
}

/// How lamellae longer than the stock are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, JsonSchema)]
#[schemars(rename_all = "kebab-case")]
pub(crate) enum Splicing {
    /// Not at all: a lamella longer than the stock is an error.
    None,
    /// In-plane fingers, cut and glued.
    Finger,
    /// A scarf across the thickness; it cannot be lasered, so it is marked.
    Scarf,
    /// A butt joint with a lapped plate and screws.
    Plate,
}

impl Choice for LengthUnit {
    const ALL: &'static [(&'static str, Self)] = &[
        ("mm", Self::Mm),
        ("cm", Self::Cm),
        ("m", Self::M),
        ("in", Self::In),
        ("ft", Self::Ft),
    ];
}

impl Choice for Splicing {
    const ALL: &'static [(&'static str, Self)] = &[
        ("none", Self::None),
        ("finger", Self::Finger),
        ("scarf", Self::Scarf),
        ("plate", Self::Plate),
    ];
}

impl Choice for Axis {
    const ALL: &'static [(&'static str, Self)] = &[("x", Self::X), ("y", Self::Y), ("z", Self::Z)];
}

impl Choice for Grain {
    const ALL: &'static [(&'static str, Self)] = &[
        ("along", Self::Along),
        ("across", Self::Across),
        ("none", Self::None),
    ];
}

impl Choice for Workflow {
    const ALL: &'static [(&'static str, Self)] = &[
        ("off", Self::Off),
        ("automatic", Self::Automatic),
        ("informed", Self::Informed),
    ];
}

impl Choice for SupportKind {
    const ALL: &'static [(&'static str, Self)] = &[
        ("printed", Self::Printed),
        ("concrete-block", Self::ConcreteBlock),
        ("wedge-on-block", Self::WedgeOnBlock),
    ];
}

impl Choice for ColourPreset {
    const ALL: &'static [(&'static str, Self)] = &[
        ("red-cut", Self::RedCut),
        ("blue-cut", Self::BlueCut),
        ("by-layer", Self::ByLayer),
    ];
}
