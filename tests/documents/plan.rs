//! The reference of the plan, its schema, and those of the difference of two plans and of a check.

use crate::current;
use crate::tables::Schema;
use std::fmt::Write;

#[test]
fn the_schema_of_the_plan_is_current() {
    current::whole("schema/plan.schema.json", &egg::plan::schema());
}

#[test]
fn the_schema_of_a_check_is_current() {
    current::whole("schema/check.schema.json", &egg::splitting::schema());
}

#[test]
fn the_schema_of_the_difference_is_current() {
    current::whole("schema/difference.schema.json", &egg::diff::schema());
}

#[test]
fn the_page_on_the_plan_has_every_record() {
    let schema = Schema::new(&egg::plan::schema());
    current::block("docs/plan.md", "records", &records(&schema));
}

fn records(schema: &Schema) -> String {
    let mut text = format!("### Plan\n\n{}", schema.record(schema.root()));
    for name in schema.definitions() {
        let definition = schema.definition(name);
        let about = definition["description"].as_str().unwrap_or("");
        let _ = write!(text, "\n### {name}\n\n{about}\n\n");
        match definition["oneOf"].as_array() {
            None => text.push_str(&schema.record(definition)),
            Some(forms) => {
                for form in forms {
                    let word = form["const"]
                        .as_str()
                        .or_else(|| form["properties"]["kind"]["const"].as_str())
                        .expect("a form has a word");
                    let about = form["description"].as_str().unwrap_or("");
                    let _ = write!(text, "`{word}`: {about}\n\n");
                    if form["properties"].is_object() {
                        let _ = writeln!(text, "{}", schema.record(form));
                    }
                }
                text.truncate(text.trim_end().len());
                text.push('\n');
            }
        }
    }
    text
}
