//! The schema and the reader are made from the same types; these tests hold their behaviour
//! together: the same keys, the same ones required, the same bounds, words and lengths.

use super::schema;
use crate::diagnostics::{Diagnostic, KeyPath, Place};
use crate::project::file::ProjectFile;
use crate::project::file::reader::{FromNode, Reader};
use crate::project::notation::{self, Notation};
use serde_json::Value;
use std::collections::BTreeSet;

const FULL: &str = include_str!("../../../tests/corpus/projects/good/full.toml");

/// A property of the schema: its path, with `*` for names of the user's, and what it says.
struct Property {
    path: String,
    schema: Value,
}

/// All properties, references resolved.
fn properties() -> Vec<Property> {
    let root: Value = serde_json::from_str(&schema()).expect("the schema is JSON");
    let mut found = Vec::new();
    walk("", &root, &root, &mut found);
    found
}

fn walk(path: &str, schema: &Value, root: &Value, found: &mut Vec<Property>) {
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.trim_start_matches("#/definitions/");
        return walk(path, &root["definitions"][name], root, found);
    }
    let below = |key: &str| match path {
        "" => key.to_owned(),
        _ => format!("{path}.{key}"),
    };
    for options in ["allOf", "anyOf"] {
        for option in schema[options].as_array().into_iter().flatten() {
            walk(path, option, root, found);
        }
    }
    for (key, property) in schema["properties"].as_object().into_iter().flatten() {
        found.push(Property {
            path: below(key),
            schema: property.clone(),
        });
        walk(&below(key), property, root, found);
    }
    if schema["additionalProperties"].is_object() {
        walk(&below("*"), &schema["additionalProperties"], root, found);
    }
    if schema["items"].is_object() {
        walk(&format!("{path}[*]"), &schema["items"], root, found);
    }
}

/// Reads a TOML text, without checks across keys.
fn read(text: &str) -> (Vec<Diagnostic>, BTreeSet<String>) {
    let tree = notation::parse(text, Notation::Toml).expect("TOML");
    let mut reader = Reader::new();
    reader.length_unit = super::super::length_unit(&tree);
    ProjectFile::read(&tree, &KeyPath::root(), &mut reader);
    (reader.sink.into_diagnostics(), reader.asked)
}

/// Whether anything is reported at a path.
fn reports(text: &str, path: &str) -> bool {
    let (diagnostics, _) = read(text);
    diagnostics.iter().any(|diagnostic| {
        diagnostic.labels.iter().any(|label| match &label.place {
            Place::Key(key) | Place::Name(key) => {
                key == path || key.starts_with(&format!("{path}["))
            }
            Place::Bytes { .. } => false,
        })
    })
}

/// A path of the schema with names in it, and TOML that sets it.
fn set(pattern: &str, value: &str) -> (String, String) {
    let path = pattern.replace('*', "x").replace("[x]", "[0]");
    let mut text = format!("{} = {value}", path.rsplit('.').next().expect("a key"));
    for key in path.rsplit('.').skip(1) {
        text = match key.strip_suffix("[0]") {
            Some(list) => format!("{list} = [{{ {text} }}]"),
            None => format!("{key} = {{ {text} }}"),
        };
    }
    (path, text)
}

#[test]
fn the_reader_asks_for_the_keys_of_the_schema_and_for_no_others() {
    let (_, asked) = read(FULL);
    let pattern = |path: String| -> String {
        let mut keys: Vec<&str> = path.split('.').collect();
        let named = matches!(keys[0], "points" | "patches" | "materials");
        if keys.len() > 1 && (named || keys[0] == "lamella" && keys.len() == 3) {
            keys[1] = "*";
        }
        keys.join(".").replace(|c: char| c.is_ascii_digit(), "*")
    };
    let asked: BTreeSet<String> = asked.into_iter().map(pattern).collect();
    let known: BTreeSet<String> = properties().into_iter().map(|p| p.path).collect();
    assert_eq!(asked, known);
    assert!(known.len() > 75, "{}", known.len());
}

/// All tables of named keys: their paths and which keys they require.
fn collect(path: &str, schema: &Value, root: &Value, tables: &mut Vec<(String, Value)>) {
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.trim_start_matches("#/definitions/");
        return collect(path, &root["definitions"][name], root, tables);
    }
    for option in schema["allOf"].as_array().into_iter().flatten() {
        collect(path, option, root, tables);
    }
    if let Some(properties) = schema["properties"].as_object() {
        tables.push((path.to_owned(), schema["required"].clone()));
        for (key, property) in properties {
            collect(&format!("{path}.{key}"), property, root, tables);
        }
    }
    if schema["additionalProperties"].is_object() {
        collect(
            &format!("{path}.*"),
            &schema["additionalProperties"],
            root,
            tables,
        );
    }
    if schema["items"].is_object() {
        collect(&format!("{path}[*]"), &schema["items"], root, tables);
    }
}

#[test]
fn required_keys_are_those_whose_absence_is_reported() {
    let root: Value = serde_json::from_str(&schema()).expect("JSON");
    let mut tables = Vec::new();
    collect("", &root, &root, &mut tables);
    assert!(tables.len() > 15, "{}", tables.len());
    for (pattern, required) in tables {
        let pattern = pattern.trim_start_matches('.');
        let (path, text) = match pattern {
            "" => (String::new(), String::new()),
            _ => match pattern.strip_suffix("[*]") {
                Some(list) => (format!("{list}[0]"), set(list, "[{}]").1),
                None => set(pattern, "{}"),
            },
        };
        let required: BTreeSet<String> = required
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|key| Some(key.as_str()?.to_owned()))
            .collect();
        let (diagnostics, _) = read(&text);
        let missing: BTreeSet<String> = diagnostics
            .iter()
            .filter(|d| d.code.as_str() == "E0111")
            .filter_map(|d| match &d.labels[0].place {
                Place::Key(key) if path.is_empty() => Some(key.clone()),
                Place::Key(key) => Some(key.strip_prefix(&format!("{path}."))?.to_owned()),
                _ => None,
            })
            .collect();
        assert_eq!(missing, required, "{pattern}");
    }
}

/// The parts of a property's schema that can stand for it: itself, or its options.
fn options(schema: &Value) -> Vec<Value> {
    match schema["anyOf"].as_array().or(schema["oneOf"].as_array()) {
        Some(options) => options.iter().flat_map(self::options).collect(),
        None => vec![schema.clone()],
    }
}

#[test]
fn bounds_are_those_of_the_reader() {
    let mut checked = 0;
    for property in properties() {
        for option in options(&property.schema) {
            for (word, outward) in [
                ("minimum", -1.0),
                ("exclusiveMinimum", -1.0),
                ("maximum", 1.0),
                ("exclusiveMaximum", 1.0),
            ] {
                let Some(bound) = option[word].as_f64() else {
                    continue;
                };
                let whole = option["type"] == "integer";
                let beyond = if whole {
                    bound + outward
                } else {
                    bound + outward * (1e-9 + bound.abs() * 1e-9)
                };
                let write = |value: f64| {
                    if whole {
                        format!("{value}")
                    } else {
                        format!("{value:e}")
                    }
                };
                // Length bounds are those of the unit in which the number is loosest.
                let unit = if outward < 0.0 && bound > 0.0 {
                    "m"
                } else {
                    "mm"
                };
                let project = format!("project = {{ units = \"{unit}\" }}\n");
                let (path, text) = set(&property.path, &write(beyond));
                assert!(reports(&format!("{project}{text}"), &path), "{text}");
                let (path, text) = set(&property.path, &write(bound));
                let refused = reports(&format!("{project}{text}"), &path);
                assert_eq!(refused, word.starts_with("exclusive"), "{text}");
                checked += 1;
            }
        }
    }
    assert!(checked > 50, "{checked}");
}

#[test]
fn words_and_types_are_those_of_the_reader() {
    let mut words = 0;
    for property in properties() {
        let mut open = false;
        for option in options(&property.schema) {
            let listed = option["enum"].as_array().cloned().unwrap_or_default();
            let constant = option.get("const").cloned();
            for word in listed.iter().chain(&constant) {
                let (path, text) = set(&property.path, &word.to_string());
                assert!(!reports(&text, &path), "{text}");
                words += 1;
            }
            open |= option["type"] == "string" && option.get("enum").is_none();
        }
        // A value of no type at all that the language has.
        let (path, text) = set(&property.path, "2026-11-23");
        assert!(reports(&text, &path), "{text}");
        if !open && !property.schema.to_string().contains("$ref") {
            let (path, text) = set(&property.path, "\"no such word\"");
            assert!(reports(&text, &path), "{text}");
        }
    }
    assert!(words > 35, "{words}");
}

#[test]
fn lengths_of_lists_are_those_of_the_reader() {
    let mut checked = 0;
    for property in properties() {
        for option in options(&property.schema) {
            let (Some(least), Some(most)) =
                (option["minItems"].as_u64(), option["maxItems"].as_u64())
            else {
                continue;
            };
            let refused = |count: u64| {
                let items = vec!["{}"; count as usize].join(", ");
                let (path, text) = set(&property.path, &format!("[{items}]"));
                let (diagnostics, _) = read(&text);
                diagnostics.iter().any(|d| {
                    d.code.as_str() == "E0113"
                        && matches!(&d.labels[0].place, Place::Key(key) if *key == path)
                })
            };
            assert!(least == 0 || refused(least - 1), "{}", property.path);
            assert!(refused(most + 1), "{}", property.path);
            assert!(!refused(least) && !refused(most), "{}", property.path);
            checked += 1;
        }
    }
    assert!(checked >= 8, "{checked}");
}

#[test]
fn defaults_of_the_schema_are_those_of_the_model() {
    let minimal = include_str!("../../../tests/corpus/projects/good/minimal.toml");
    let model = |text: &str| {
        let loaded = crate::project::load(text, Notation::Toml, "x");
        loaded
            .project
            .unwrap_or_else(|| panic!("{:?}\n{text}", loaded.diagnostics))
    };
    let implied = model(minimal);
    let mut checked = 0;
    for property in properties() {
        let Some(default) = property.schema.get("default") else {
            continue;
        };
        let top = property.path.split('.').next().expect("a key");
        // Sections that the minimal project has, and tables with other required keys.
        if matches!(top, "patches" | "materials")
            || property.path.contains("sticker")
            || property.path.contains("bed")
            || property.path.contains("[*]")
        {
            continue;
        }
        let default = if default.is_string() || default.is_array() {
            default.to_string()
        } else {
            format!("{default}")
        };
        let text = match property.path.strip_prefix("surface.") {
            Some(key) => minimal.replace("[surface]\n", &format!("[surface]\n{key} = {default}\n")),
            None => format!("{}\n{minimal}", set(&property.path, &default).1),
        };
        assert_eq!(model(&text), implied, "{text}");
        checked += 1;
    }
    assert!(checked >= 18, "{checked}");
}
