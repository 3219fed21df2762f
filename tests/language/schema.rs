//! The JSON schema that editors use.

use crate::files::cases;
use crate::python;
use egg::project::Notation;
use std::path::{Path, PathBuf};

fn committed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("schema/project.schema.json")
}

#[test]
fn the_committed_schema_is_the_one_of_the_types() {
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(committed(), egg::project::schema()).expect("the schema's folder is there");
    }
    let text = std::fs::read_to_string(committed()).unwrap_or_default();
    assert!(
        text.replace("\r\n", "\n") == egg::project::schema(),
        "write it again: egg schema project > schema/project.schema.json"
    );
}

#[test]
fn every_property_explains_itself() {
    fn walk(at: &str, value: &serde_json::Value, found: &mut usize) {
        if let Some(properties) = value["properties"].as_object() {
            for (key, property) in properties {
                *found += 1;
                let text = property["description"].as_str().unwrap_or_default();
                assert!(text.len() > 8, "{at}.{key} has no description");
                assert!(
                    !text.contains('\n') || text.contains("\n\n"),
                    "{at}.{key}: {text}"
                );
            }
        }
        match value {
            serde_json::Value::Object(object) => {
                for (key, value) in object {
                    walk(&format!("{at}.{key}"), value, found);
                }
            }
            serde_json::Value::Array(items) => {
                for item in items {
                    walk(at, item, found);
                }
            }
            _ => {}
        }
    }
    let schema: serde_json::Value = serde_json::from_str(&egg::project::schema()).expect("JSON");
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    let mut found = 0;
    walk("", &schema, &mut found);
    assert!(found > 70, "{found}");
}

/// What a schema can see: keys, types, words, ranges that depend on nothing else.
const VISIBLE: &[&str] = &[
    "E0106", "E0110", "E0111", "E0112", "E0113", "E0114", "E0115", "E0116", "E0117", "E0118",
    "E0119", "E0121", "E0122", "E0123",
];

/// Files with a visible code whose fault depends on another key after all.
const HIDDEN: &[&str] = &[
    // A length that is too large in the units of the file.
    "range-kerf-in-inches",
    "range-angle",
    // An order of two values.
    "slope-bounds",
    // A rule that a regular expression does not say.
    "name-of-a-device",
];

/// Files whose fault JSON has no words for, so that readers differ: it cannot tell 7.0 from 7,
/// and has no NaN.
const BEYOND_JSON: &[&str] = &["type-count-with-point", "number-nan"];

#[test]
fn independent_readers_accept_good_projects_and_flag_wrong_ones() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("schema-corpus");
    let _ = std::fs::remove_dir_all(&folder);
    for kind in ["valid", "invalid"] {
        std::fs::create_dir_all(folder.join(kind)).expect("the build folder takes folders");
    }
    let mut counts = [0, 0];
    let all = cases("good").into_iter().chain(cases("wrong"));
    for case in all.filter(|case| case.notation == Notation::Toml) {
        let codes = case.codes();
        let unreadable = ["E0101", "E0102", "E0103"];
        if codes.iter().any(|code| unreadable.contains(code))
            || BEYOND_JSON.contains(&case.stem.as_str())
        {
            continue;
        }
        let visible = codes.iter().any(|code| VISIBLE.contains(code));
        let flagged = visible && !HIDDEN.contains(&case.stem.as_str());
        let kind = if flagged { "invalid" } else { "valid" };
        counts[usize::from(flagged)] += 1;
        std::fs::write(folder.join(kind).join(&case.name), &case.text).expect("a file");
    }
    let template = folder.join("valid/template.toml");
    std::fs::write(template, egg::project::template("dome")).expect("a file");
    assert!(counts[0] > 30 && counts[1] > 35, "{counts:?}");
    let python = python::venv(&["jsonschema==4.*", "tombi==1.9.*"]);
    let told = python::read(&python, "project_schema.py", &[&committed(), &folder]);
    assert_eq!(
        told.trim(),
        format!("{} valid, {} invalid", counts[0] + 1, counts[1])
    );
}
