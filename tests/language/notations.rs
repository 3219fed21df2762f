//! TOML and RON say the same and are told the same.

use crate::files::{Case, cases};
use egg::project::{Notation, load};
use toml::de::{DeTable, DeValue};

#[test]
fn a_project_has_one_model_in_both_notations() {
    let cases = cases("good");
    let mut pairs = 0;
    for case in cases.iter().filter(|case| case.notation == Notation::Toml) {
        let other = cases
            .iter()
            .find(|other| other.stem == case.stem && other.notation == Notation::Ron)
            .expect("every good project stands in both notations");
        assert_eq!(case.loaded.project, other.loaded.project, "{}", case.stem);
        pairs += 1;
    }
    assert_eq!(pairs * 2, cases.len());
}

#[test]
fn every_value_of_a_good_project_rewritten_in_ron_has_the_same_model() {
    for case in toml_cases("good") {
        let rewritten = load(&to_ron(&case.text), Notation::Ron, &case.stem);
        assert_eq!(case.loaded.project, rewritten.project, "{}", case.name);
    }
}

#[test]
fn wrong_projects_rewritten_in_ron_get_the_same_diagnostics_at_the_same_key_paths() {
    let mut compared = 0;
    for case in toml_cases("wrong") {
        let is_syntax = |code: &&str| matches!(*code, "E0101" | "E0102" | "E0103");
        if case.codes().iter().any(is_syntax) || case.stem == "type-date" {
            continue;
        }
        let ron = to_ron(&case.text);
        let rewritten = load(&ron, Notation::Ron, &case.stem);
        let sorted = |diagnostics: &[egg::diagnostics::Diagnostic]| {
            let mut all: Vec<String> = diagnostics.iter().map(|d| format!("{d:?}")).collect();
            all.sort();
            all
        };
        assert_eq!(
            sorted(&case.loaded.diagnostics),
            sorted(&rewritten.diagnostics),
            "{}\n{ron}",
            case.name
        );
        compared += 1;
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn spans_mark_the_text_of_their_value_in_both_notations() {
    for case in cases("good") {
        let marked = |path: &str| &case.text[case.loaded.spans.value(path)];
        if case.stem == "full" {
            assert_eq!(marked("lamella.west.width"), "\"1.5 in\"");
            assert_eq!(marked("points.d[1]"), "\"10.5 in\"");
            assert_eq!(marked("points.t.at"), "0.5");
            assert_eq!(marked("materials.my-ash.price"), "42.5");
            assert_eq!(marked("distribution.weights.a-d"), "2.0");
            assert_eq!(marked("patches.north-west.members.v"), "6");
            assert_eq!(marked("studies[1].scale"), "5");
            let name = &case.text[case.loaded.spans.name("fabrication.bed.pass_through")];
            assert_eq!(name, "pass_through");
            let material = case.text[case.loaded.spans.name("materials.my-ash")].to_owned();
            assert!(matches!(material.as_str(), "my-ash" | "r#my-ash"));
            assert_eq!(marked("lamella.width.nothing"), marked("lamella.width"));
        }
    }
}

#[test]
fn line_ends_and_a_byte_order_mark_change_nothing() {
    for case in cases("good") {
        for text in [
            case.text.replace('\n', "\r\n"),
            format!("\u{feff}{}", case.text),
        ] {
            let loaded = load(&text, case.notation, &case.stem);
            assert_eq!(loaded.project, case.loaded.project, "{}", case.name);
        }
        let marked = load(&format!("\u{feff}{}", case.text), case.notation, &case.stem);
        let shift = |range: std::ops::Range<usize>| range.start + 3..range.end + 3;
        for path in ["lamella.width", "patches", "points.a[1]"] {
            assert_eq!(
                marked.spans.value(path),
                shift(case.loaded.spans.value(path))
            );
        }
    }
}

#[test]
fn a_length_has_the_same_bits_however_it_is_written() {
    let minimal = cases("good")
        .into_iter()
        .find(|case| case.name == "minimal.toml");
    let minimal = minimal.expect("in the corpus").text;
    let width = |written: &str, units: &str| {
        let text = minimal.replace("width = 10\n", &format!("width = {written}\n"));
        let text = text.replace("thickness = 1\n", "thickness = \"0.1 mm\"\n");
        let text = format!("project = {{ units = \"{units}\" }}\n{text}");
        let loaded = load(&text, Notation::Toml, "x");
        let project = loaded
            .project
            .unwrap_or_else(|| panic!("{:?}", loaded.diagnostics));
        project.patches[0].lamella.width.to_bits()
    };
    let eight = width("8", "mm");
    for (written, units) in [
        ("8.0", "mm"),
        ("0.8", "cm"),
        ("0.008", "m"),
        ("8e-3", "m"),
        ("\"8mm\"", "ft"),
        ("\"8.0 mm\"", "in"),
        ("\"0.008 m\"", "cm"),
        ("\" .8e0 cm \"", "mm"),
        ("0x8", "mm"),
    ] {
        assert_eq!(width(written, units), eight, "{written} {units}");
    }
    assert_eq!(width("\"0.5 in\"", "mm"), width("12.7", "mm"));
    assert_eq!(width("\"0.25 ft\"", "mm"), width("3", "in"));
}

#[test]
fn an_angle_has_the_same_bits_however_it_is_written() {
    let alpha = |written: &str| {
        let minimal = cases("good")
            .into_iter()
            .find(|case| case.name == "minimal.toml");
        let text = minimal.expect("in the corpus").text;
        let text = text.replace("[lamella]", &format!("alpha = {written}\n[lamella]"));
        let project = load(&text, Notation::Toml, "x")
            .project
            .expect("a good angle");
        project.patches[0].alpha.map(f64::to_bits)
    };
    let sixty = Some((60.0_f64 * std::f64::consts::PI / 180.0).to_bits());
    for written in ["60", "60.0", "6e1", "\"60 deg\"", "\"60.00°\""] {
        assert_eq!(alpha(written), sixty, "{written}");
    }
    assert_eq!(alpha("\"1.25 rad\""), Some(1.25_f64.to_bits()));
    assert_eq!(alpha("\"auto\""), None);
}

fn toml_cases(folder: &str) -> Vec<Case> {
    let mut cases = cases(folder);
    cases.retain(|case| case.notation == Notation::Toml);
    cases
}

/// The same values in RON, in the order of the file.
fn to_ron(text: &str) -> String {
    let text = text.trim_start_matches('\u{feff}');
    let table = DeTable::parse(text).expect("TOML without syntax errors");
    let mut ron = String::new();
    write_table(table.get_ref(), &mut ron);
    ron
}

fn write_table(table: &DeTable<'_>, ron: &mut String) {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    ron.push_str("{ ");
    for (key, value) in entries {
        ron.push_str(&ron::to_string(key.get_ref().as_ref()).expect("a string"));
        ron.push_str(": ");
        write_value(value.get_ref(), ron);
        ron.push_str(", ");
    }
    ron.push('}');
}

fn write_value(value: &DeValue<'_>, ron: &mut String) {
    match value {
        DeValue::String(text) => ron.push_str(&ron::to_string(text.as_ref()).expect("a string")),
        DeValue::Integer(integer) => ron.push_str(&integer.to_string()),
        DeValue::Float(float) => ron.push_str(&float.as_str().replace("nan", "NaN")),
        DeValue::Boolean(boolean) => ron.push_str(&boolean.to_string()),
        DeValue::Array(items) => {
            ron.push('[');
            for item in items {
                write_value(item.get_ref(), ron);
                ron.push_str(", ");
            }
            ron.push(']');
        }
        DeValue::Table(table) => write_table(table, ron),
        DeValue::Datetime(_) => unreachable!("files with dates are left out"),
    }
}
