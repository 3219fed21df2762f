//! The JSON schema of project files, for completion and checks in editors.
//!
//! Draft-07, which the language servers for TOML understand. It is generated from the types that
//! read the file, so it knows the same keys; what depends on more than one key (names, strips)
//! only `egg check` can tell.

#[cfg(test)]
mod drift;

use super::file::ProjectFile;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};

/// The schema as JSON text with a final newline.
///
/// # Panics
///
/// Never: a schema has a JSON text.
pub fn schema() -> String {
    let generator = SchemaSettings::draft07().for_deserialize().into_generator();
    let mut schema = generator.into_root_schema_for::<ProjectFile>().to_value();
    drop_null(&mut schema);
    unwrap_lines(&mut schema);
    let schema = head_first(schema);
    let mut text = serde_json::to_string_pretty(&schema)
        .expect("a tree of strings, numbers and maps has a JSON text");
    text.push('\n');
    text
}

/// Puts what a reader looks for first to the top.
fn head_first(schema: Value) -> Value {
    let Value::Object(mut object) = schema else {
        return schema;
    };
    let mut ordered = Map::new();
    for key in ["$schema", "title", "description"] {
        ordered.extend(object.shift_remove_entry(key));
    }
    ordered.extend(object);
    Value::Object(ordered)
}

/// Optional fields come out as "or null", but TOML has no null: what is optional is left out.
fn drop_null(value: &mut Value) {
    match value {
        Value::Object(object) => {
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|kind| kind != "null");
                if let [only] = types.as_slice() {
                    let only = only.clone();
                    object.insert("type".to_owned(), only);
                }
            }
            if let Some(Value::Array(options)) = object.get_mut("enum") {
                options.retain(|option| !option.is_null());
            }
            if let Some(Value::Array(options)) = object.get_mut("anyOf") {
                options.retain(|option| option.get("type").is_none_or(|kind| kind != "null"));
                if let [only] = options.as_slice() {
                    let only = only.clone();
                    object.remove("anyOf");
                    match only {
                        // A reference admits no neighbours in draft-07.
                        reference if reference.get("$ref").is_some() => {
                            object.insert("allOf".to_owned(), Value::Array(vec![reference]));
                        }
                        Value::Object(inner) => {
                            for (key, inner) in inner {
                                object.entry(key).or_insert(inner);
                            }
                        }
                        other => {
                            object.insert("allOf".to_owned(), Value::Array(vec![other]));
                        }
                    }
                }
            }
            object.values_mut().for_each(drop_null);
        }
        Value::Array(items) => items.iter_mut().for_each(drop_null),
        _ => {}
    }
}

/// Doc comments are broken into lines for the source; hover texts are paragraphs.
fn unwrap_lines(value: &mut Value) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                match value {
                    Value::String(text) if key == "description" => {
                        let paragraphs = text.split("\n\n").map(|part| part.replace('\n', " "));
                        *text = paragraphs.collect::<Vec<_>>().join("\n\n");
                    }
                    _ => unwrap_lines(value),
                }
            }
        }
        Value::Array(items) => items.iter_mut().for_each(unwrap_lines),
        _ => {}
    }
}
