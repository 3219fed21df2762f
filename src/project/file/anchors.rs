//! Values with more than one form: anchors, the planar angle, places of supports, and the
//! `[lamella]` table, in which patches stand beside keys.

use super::choices::unknown_choice;
use super::collections::{Exactly, Named, PatchUses, read_items, wrong_length};
use super::intervals::{Coordinate, InnerShare, PlanAngle, Section};
use super::quantity::{Length, OfAngle, Plain, Quantity};
use super::reader::{Field, FromField, FromNode, Reader, TableReader, section, unknown_key};
use super::words::{Count, Reference, inline_schema};
use crate::diagnostics::KeyPath;
use crate::project::notation::{Node, Value};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;

/// An anchor: two or three coordinates, `{ vertex = 1207 }` or `{ on = ["a", "b"], at = 0.5 }`.
#[derive(Debug, Clone)]
pub(crate) enum AnchorFile {
    /// Two or three coordinates.
    At(Vec<Field<Length<Coordinate>>>),
    /// A vertex of the mesh.
    Vertex(VertexAnchor),
    /// A point of an edge.
    On(EdgeAnchor),
}

/// A vertex of the mesh.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields, inline)]
pub(crate) struct VertexAnchor {
    /// Counted from 0 in the order of the mesh file.
    pub(crate) vertex: Field<Count<0, { u32::MAX - 1 }>>,
}

section!(VertexAnchor { vertex });

/// A point of the shortest geodesic between two other anchors; on a side of a patch it makes a
/// T-junction.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields, inline)]
pub(crate) struct EdgeAnchor {
    /// The two anchors.
    pub(crate) on: Field<Exactly<Reference, 2>>,
    /// Share of the length from the first, more than 0 and less than 1.
    pub(crate) at: Field<Plain<InnerShare>>,
}

section!(EdgeAnchor { on, at });

impl FromNode for AnchorFile {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        match &node.value {
            Value::List(items) if matches!(items.len(), 2 | 3) => {
                Some(Self::At(read_items(items, at, reader)))
            }
            Value::List(items) => {
                reader.sink.error(|| {
                    wrong_length(at, items.len(), 2, 3)
                        .help("two numbers mean the topmost surface point over (x, y), three the closest surface point")
                });
                None
            }
            Value::Table(entries) if entries.iter().any(|e| e.key == "on" || e.key == "at") => {
                Some(Self::On(FromNode::read(node, at, reader)?))
            }
            Value::Table(entries) if entries.iter().any(|entry| entry.key == "vertex") => {
                Some(Self::Vertex(FromNode::read(node, at, reader)?))
            }
            Value::Table(entries) if !entries.is_empty() => {
                for entry in entries {
                    unknown_key(at, &entry.key, &["vertex", "on", "at"], reader);
                }
                None
            }
            _ => reader.wrong_type(
                node,
                at,
                "coordinates, `{ vertex = 12 }` or `{ on = [\"a\", \"b\"], at = 0.5 }`",
            ),
        }
    }
}

inline_schema!(AnchorFile, generator => {
    let coordinate = generator.subschema_for::<Length<Coordinate>>();
    let vertex = VertexAnchor::json_schema(generator);
    let edge = EdgeAnchor::json_schema(generator);
    json_schema!({
        "description": "Two coordinates: the topmost surface point over (x, y). Three: the closest point of the surface. A vertex: `{ vertex = 1207 }`. A point of the geodesic between two anchors: `{ on = [\"a\", \"b\"], at = 0.5 }`.",
        "anyOf": [
            { "type": "array", "items": coordinate, "minItems": 2, "maxItems": 3 },
            vertex,
            edge,
        ],
    })
});

/// The planar angle at the first corner.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Alpha {
    /// The compiler chooses.
    Auto,
    /// The user has chosen.
    Angle(Quantity<OfAngle, PlanAngle>),
}

impl FromNode for Alpha {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        match &node.value {
            Value::Text(word) if word == "auto" => Some(Self::Auto),
            Value::Text(word) if word.chars().all(char::is_alphabetic) => {
                reader
                    .sink
                    .error(|| unknown_choice(at, word, &["auto", "60 deg"]));
                None
            }
            _ => Some(Self::Angle(FromNode::read(node, at, reader)?)),
        }
    }
}

inline_schema!(Alpha, generator => {
    let angle = generator.subschema_for::<Quantity<OfAngle, PlanAngle>>();
    json_schema!({ "anyOf": [{ "const": "auto" }, angle] })
});

/// Where supports stand.
#[derive(Debug, Clone)]
pub(crate) enum SupportPlacesFile {
    /// At the corners of the patches.
    Corners,
    /// At every crossing of a boundary member.
    EveryBoundaryCrossing,
    /// At points and crossings.
    Listed(Vec<Field<Reference>>),
}

/// The words that [`SupportPlacesFile`] knows.
const SUPPORT_WORDS: [&str; 2] = ["corners", "every-boundary-crossing"];

/// Most supports in a list.
const MOST_SUPPORTS: usize = 5000;

impl FromNode for SupportPlacesFile {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        match &node.value {
            Value::Text(word) if word == SUPPORT_WORDS[0] => Some(Self::Corners),
            Value::Text(word) if word == SUPPORT_WORDS[1] => Some(Self::EveryBoundaryCrossing),
            Value::Text(word) => {
                reader
                    .sink
                    .error(|| unknown_choice(at, word, &SUPPORT_WORDS));
                None
            }
            Value::List(items) if !(1..=MOST_SUPPORTS).contains(&items.len()) => {
                reader
                    .sink
                    .error(|| wrong_length(at, items.len(), 1, MOST_SUPPORTS));
                None
            }
            Value::List(items) => Some(Self::Listed(read_items(items, at, reader))),
            _ => reader.wrong_type(
                node,
                at,
                "`corners`, `every-boundary-crossing` or a list of ids",
            ),
        }
    }
}

inline_schema!(SupportPlacesFile, _ => json_schema!({
    "anyOf": [
        { "enum": SUPPORT_WORDS },
        {
            "type": "array",
            "items": { "type": "string" },
            "minItems": 1,
            "maxItems": MOST_SUPPORTS,
        },
    ],
}));

/// `[lamella]`: three keys for the whole structure, and for each patch that differs a table of
/// the patch's name.
///
/// A key of the three always means the property, whatever patches exist; therefore no patch may
/// be called `width`, `thickness` or `material`. Every other key is a patch if its value is a
/// table, and an unknown key if it is not.
#[derive(Debug, Clone)]
pub(crate) struct LamellaFile {
    /// Of all patches without their own.
    pub(crate) width: Field<Length<Section>>,
    /// Of all patches without their own.
    pub(crate) thickness: Field<Length<Section>>,
    /// Of all patches without their own.
    pub(crate) material: Field<Reference>,
    /// By patch.
    pub(crate) overrides: Named<PatchUses, OverrideFile>,
}

/// What the lamellae of one patch have different.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct OverrideFile {
    /// Width of the lamellae of this patch, a length.
    pub(crate) width: Option<Field<Length<Section>>>,
    /// Thickness of the lamellae of this patch, a length.
    pub(crate) thickness: Option<Field<Length<Section>>>,
    /// Material of the lamellae of this patch.
    pub(crate) material: Option<Field<Reference>>,
}

section!(OverrideFile {
    width,
    thickness,
    material
});

/// The keys of `[lamella]` alone: the part of its schema that can be derived.
#[derive(JsonSchema)]
struct LamellaKeys {
    /// Width of the lamellae, a length; about 2 % of the structure's size.
    #[expect(dead_code, reason = "only the schema is derived from it")]
    width: Field<Length<Section>>,
    /// Thickness of the lamellae, a length; less than a fifth of the width.
    #[expect(dead_code, reason = "only the schema is derived from it")]
    thickness: Field<Length<Section>>,
    /// A built-in material (`egg materials` lists them) or one of `[materials]`.
    #[expect(dead_code, reason = "only the schema is derived from it")]
    material: Field<Reference>,
}

impl FromNode for LamellaFile {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let mut table = TableReader::open(node, at, reader)?;
        let width = FromField::take(&mut table, "width", reader);
        let thickness = FromField::take(&mut table, "thickness", reader);
        let material = FromField::take(&mut table, "material", reader);
        let known = table.known().to_vec();
        let mut overrides = Vec::new();
        let mut unknown = Vec::new();
        for entry in table.rest() {
            if matches!(entry.node.value, Value::Table(_)) {
                let value = FromNode::read(&entry.node, &at.key(&entry.key), reader).into();
                overrides.push((entry.key.clone(), value));
            } else {
                unknown_key(at, &entry.key, &known, reader);
                unknown.push(entry.key.as_str());
            }
        }
        table.report_missing(&unknown, reader);
        Some(Self {
            width,
            thickness,
            material,
            overrides: Named::new(overrides),
        })
    }
}

impl JsonSchema for LamellaFile {
    fn schema_name() -> Cow<'static, str> {
        "Lamella".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = LamellaKeys::json_schema(generator);
        let patch = generator.subschema_for::<OverrideFile>();
        schema.insert("additionalProperties".to_owned(), patch.into());
        schema.insert(
            "description".to_owned(),
            "Cross-section and material of the lamellae; a table of a patch's name says what that patch has different.".into(),
        );
        schema
    }
}

impl<T: JsonSchema> JsonSchema for Field<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}
