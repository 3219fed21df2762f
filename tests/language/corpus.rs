//! Wrong project files, each with its golden report.

use crate::files::{cases, golden};
use egg::diagnostics::render::{Style, human};
use egg::diagnostics::{Severity, codes};
use egg::project::{Capability, Notation, decode, load, unbuilt};
use std::collections::BTreeSet;

#[test]
fn every_wrong_project_is_reported_as_its_golden_text_says() {
    let cases = cases("wrong");
    assert!(cases.len() >= 40);
    for case in cases {
        let report = human(&case.loaded.diagnostics, &case.sources(), Style::Plain);
        golden("projects").bind(|| insta::assert_snapshot!(case.name.as_str(), report));
    }
}

#[test]
fn a_wrong_project_has_no_model_and_a_project_with_lints_has_one() {
    for case in cases("wrong") {
        let diagnostics = &case.loaded.diagnostics;
        let errors = diagnostics.iter().filter(|d| d.severity == Severity::Error);
        assert!(!diagnostics.is_empty(), "{}", case.name);
        assert_eq!(
            errors.count() == 0,
            case.loaded.project.is_some(),
            "{}",
            case.name
        );
        assert_eq!(
            case.stem.starts_with("lint-"),
            case.loaded.project.is_some(),
            "{}",
            case.name
        );
    }
}

#[test]
fn good_projects_load_without_a_word() {
    for case in cases("good") {
        assert_eq!(case.codes(), Vec::<&str>::new(), "{}", case.name);
        assert!(case.loaded.project.is_some(), "{}", case.name);
    }
}

#[test]
fn every_code_of_the_language_is_shown_by_the_corpus_and_no_other_is_used() {
    let mut shown: BTreeSet<String> = cases("wrong")
        .iter()
        .flat_map(|case| {
            case.codes()
                .into_iter()
                .map(str::to_owned)
                .collect::<Vec<_>>()
        })
        .collect();
    // Those that no readable file can show, and the hook's, are shown below.
    shown.extend(["E0104", "E0105", "W0290"].map(str::to_owned));
    let ours = |code: &&str| matches!(&code[1..3], "01" | "02");
    let registered: Vec<&str> = codes::all().map(|info| info.code).filter(ours).collect();
    assert_eq!(shown.into_iter().collect::<Vec<_>>(), {
        let mut sorted = registered;
        sorted.sort_unstable();
        sorted
    });
}

#[test]
fn bytes_that_are_no_text_are_told_apart() {
    let report = |bytes: &[u8]| {
        let diagnostics = decode(bytes).expect_err("not UTF-8");
        let diagnostic = &diagnostics[0];
        assert_eq!(diagnostic.code.as_str(), "E0104");
        diagnostic.notes.join(" ")
    };
    let wide: Vec<u8> = "[surface]"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert!(report(&[&[0xFF, 0xFE], wide.as_slice()].concat()).contains("UTF-16"));
    assert!(report(b"solid\0\0\xC8\x01").contains("byte 7 cannot be text"));
    assert!(report(b"a = 1\nname = \"s\xFCd\"").contains("byte 15, in line 2"));
    assert_eq!(decode("süd".as_bytes()), Ok("süd"));
}

#[test]
fn a_file_of_many_megabytes_is_refused_unread() {
    let text = "# comment\n".repeat(1_000_000);
    let loaded = load(&text, Notation::Toml, "x");
    assert_eq!(loaded.diagnostics[0].code.as_str(), "E0105");
}

#[test]
fn what_a_pipeline_does_not_build_is_said_once_each_and_nothing_else_is() {
    let full = cases("good")
        .into_iter()
        .find(|case| case.name == "full.toml");
    let full = full.expect("in the corpus").loaded;
    let said = |capabilities: &[Capability]| -> Vec<String> {
        let diagnostics = unbuilt(&full, capabilities);
        diagnostics
            .iter()
            .map(|d| format!("{} {:?} {:?}", d.code, d.severity, d.labels[0].place))
            .collect()
    };
    insta::assert_snapshot!(said(&[]).join("\n"), @r#"
    W0290 Warning Key("patches")
    W0290 Warning Key("split.workflow")
    W0290 Warning Key("supports")
    W0290 Warning Key("hardware.sticker")
    W0290 Warning Key("hardware.shell")
    W0290 Warning Key("fabrication.bed")
    W0290 Warning Key("fabrication.kerf")
    W0290 Warning Key("fabrication.splice")
    W0290 Note Key("fabrication.stock.price")
    W0290 Note Key("simulation")
    W0290 Note Key("studies")
    "#);
    assert_eq!(said(&Capability::ALL), Vec::<String>::new());
    assert_eq!(said(&[Capability::Supports]).len(), said(&[]).len() - 1);

    let ring = cases("good")
        .into_iter()
        .find(|case| case.name == "ring.toml");
    let ring = unbuilt(
        &ring.expect("in the corpus").loaded,
        &[Capability::SeveralPatches],
    );
    assert_eq!(ring.len(), 1, "{ring:?}");
    let minimal = cases("good")
        .into_iter()
        .find(|case| case.name == "minimal.ron");
    assert_eq!(unbuilt(&minimal.expect("in the corpus").loaded, &[]), []);
}

#[test]
fn allowed_lints_are_not_reported() {
    let lint = cases("wrong")
        .into_iter()
        .find(|case| case.stem == "lint-fabrication");
    let lint = lint.expect("in the corpus");
    assert_eq!(lint.codes(), ["W0203", "W0210", "W0204", "W0209"]);
    let allow = "\n[lints]\nallow = [\"wide-kerf\", \"tall-labels\"]\n";
    let loaded = load(&format!("{}{allow}", lint.text), Notation::Toml, "x");
    let codes: Vec<&str> = loaded.diagnostics.iter().map(|d| d.code.as_str()).collect();
    assert_eq!(codes, ["W0210", "W0204"]);
}

#[test]
fn the_template_of_a_new_project_is_good() {
    let loaded = load(&egg::project::template("mydome"), Notation::Toml, "other");
    assert_eq!(loaded.diagnostics, []);
    let project = loaded.project.expect("no errors");
    assert_eq!(project.name, "mydome");
    assert_eq!(project.surface.mesh, "mydome.obj");
    assert_eq!(
        unbuilt(
            &load(&egg::project::template("a"), Notation::Toml, "a"),
            &[]
        ),
        []
    );
}
