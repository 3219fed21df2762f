//! Reports for people and for programs.

use crate::files::{cases, golden};
use egg::diagnostics::render::{Source, Sources, Style, human, json_lines, summary};
use egg::diagnostics::{Code, Diagnostic, File, SpanTable};

/// A diagnostic with everything, in two files.
fn example() -> Diagnostic {
    Diagnostic::warning(Code::new("W0201"), "the peak of `roof` lies outside")
        .at_key("patches.roof.alpha", "this patch")
        .at_bytes(File::Mesh, 8..12, "this vertex")
        .at_name("patches.roof.corners", "these corners")
        .note("the first fact\nin two lines")
        .note("the second")
        .help("move a corner")
        .about("roof")
}

const PROJECT: &str = "\u{feff}# caf\u{e9}\n[patches.roof]\ncorners = [1, 2]\n";
const MESH: &str = "v 0 0 0\nv 1 x 0\n";

fn spans() -> SpanTable {
    let mut spans = SpanTable::new(PROJECT.len());
    spans.insert("patches.roof", Some(20..24), 20..24);
    spans.insert("patches.roof.corners", Some(26..33), 36..42);
    spans
}

fn sources(spans: &SpanTable) -> Sources<'_> {
    Sources {
        project: Source {
            name: "roof.toml",
            text: PROJECT,
        },
        spans,
        mesh: Some(Source {
            name: "roof.obj",
            text: MESH,
        }),
    }
}

#[test]
fn a_report_shows_every_file_every_label_every_note() {
    let spans = spans();
    let report = human(&[example()], &sources(&spans), Style::Plain);
    golden("reports").bind(|| insta::assert_snapshot!("plain", report));
}

#[test]
fn a_narrated_report_is_sentences() {
    let spans = spans();
    let report = human(&[example()], &sources(&spans), Style::Narrated);
    golden("reports").bind(|| insta::assert_snapshot!("narrated", report));
}

#[test]
fn a_coloured_report_is_the_plain_one_with_colours() {
    let spans = spans();
    let coloured = human(&[example()], &sources(&spans), Style::Colour);
    assert!(coloured.contains("\u{1b}["));
    let mut plain = String::new();
    let mut rest = coloured.as_str();
    while let Some((text, escape)) = rest.split_once("\u{1b}[") {
        plain.push_str(text);
        rest = escape.split_once('m').expect("a colour ends").1;
    }
    plain.push_str(rest);
    let lines = |text: &str| -> Vec<String> {
        text.lines()
            .map(|line| line.trim_end().to_owned())
            .collect()
    };
    assert_eq!(
        lines(&plain),
        lines(&human(&[example()], &sources(&spans), Style::Plain))
    );
}

#[test]
fn json_has_one_line_a_diagnostic_with_bytes_of_the_file_and_lines_and_columns() {
    let spans = spans();
    let text = json_lines(&[example(), example()], &sources(&spans));
    assert_eq!(text.lines().count(), 2);
    let value: serde_json::Value =
        serde_json::from_str(text.lines().next().expect("two lines")).expect("JSON");
    let pretty = serde_json::to_string_pretty(&value).expect("JSON");
    golden("reports").bind(|| insta::assert_snapshot!("json", pretty));
    // The byte order mark is part of the file's bytes and of no column.
    let label = &value["labels"][2];
    let start = usize::try_from(label["start"]["byte"].as_u64().expect("a number")).expect("small");
    assert!(PROJECT[start..].starts_with("corners"));
    assert_eq!(
        (&label["start"]["line"], &label["start"]["column"]),
        (&3.into(), &1.into())
    );
}

#[test]
fn a_place_in_a_file_that_was_not_read_is_a_note() {
    let spans = spans();
    let sources = Sources {
        mesh: None,
        ..sources(&spans)
    };
    let text = human(&[example()], &sources, Style::Plain);
    assert!(text.contains("note: this vertex"), "{text}");
    let json: serde_json::Value =
        serde_json::from_str(json_lines(&[example()], &sources).trim()).expect("JSON");
    assert!(json["labels"][1]["file"].is_null());
    assert_eq!(json["labels"][1]["text"], "this vertex");
}

#[test]
fn every_diagnostic_of_the_corpus_marks_something_in_every_style() {
    for case in cases("wrong") {
        for diagnostic in &case.loaded.diagnostics {
            let one = std::slice::from_ref(diagnostic);
            let plain = human(one, &case.sources(), Style::Plain);
            let drawn = if case.text.is_empty() {
                "at empty.toml:1:1"
            } else {
                "╭─["
            };
            assert!(plain.contains(drawn), "{} {plain}", case.name);
            for label in &diagnostic.labels {
                let first = label.text.split(' ').next().unwrap_or_default();
                assert!(plain.contains(first), "{} {plain}", case.name);
                let narrated = human(one, &case.sources(), Style::Narrated);
                assert!(narrated.contains(&label.text), "{narrated}");
            }
            let json = json_lines(one, &case.sources());
            let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
            for label in json["labels"].as_array().expect("a list") {
                let at = |end: &str| label[end]["byte"].as_u64().expect("a number") as usize;
                assert!(
                    at("start") < at("end") || case.text.is_empty(),
                    "{}",
                    case.name
                );
                assert!(
                    case.text.get(at("start")..at("end")).is_some(),
                    "{}",
                    case.name
                );
            }
        }
    }
}

#[test]
fn messages_keep_the_house_style() {
    for case in cases("wrong") {
        for diagnostic in &case.loaded.diagnostics {
            let mut texts = vec![&diagnostic.message];
            texts.extend(diagnostic.labels.iter().map(|label| &label.text));
            texts.extend(&diagnostic.notes);
            texts.extend(&diagnostic.help);
            for text in texts {
                let first = text.chars().next().expect("no text is empty");
                assert!(!text.ends_with('.'), "{text}");
                let name = text.starts_with("TOML")
                    || text.starts_with("RON")
                    || text.starts_with("Windows");
                assert!(!first.is_uppercase() || name, "{text}");
                assert!(
                    text.matches('`').count() % 2 == 0 || text.contains("RON"),
                    "{text}"
                );
            }
        }
    }
}

#[test]
fn a_summary_counts_errors_and_warnings() {
    let error = || Diagnostic::error(Code::new("E0101"), "x");
    assert_eq!(summary(&[]), None);
    assert_eq!(
        summary(&[Diagnostic::note_only(Code::new("W0290"), "x")]),
        None
    );
    assert_eq!(summary(&[error()]).as_deref(), Some("1 error"));
    assert_eq!(
        summary(&[error(), error(), example()]).as_deref(),
        Some("2 errors, 1 warning")
    );
}
