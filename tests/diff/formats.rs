//! Plans and differences as files: what is read, what is refused, what renderers promise.

use crate::edit::{EDITS, Project, diff, tried};
use crate::program::Workshop;
use crate::python;
use egg::diff::{Content, Context, Difference, Pictures, Tolerances, between, html, markdown, svg};
use egg::plan::{Plan, from_ron};

fn edit(name: &str) -> fn(Project) -> Project {
    EDITS
        .iter()
        .find(|(edit, _)| *edit == name)
        .expect("an edit")
        .1
}

/// The plans of a project before and after an edit, as files.
fn plans(workshop: &Workshop, name: &str) -> [Plan; 2] {
    tried(workshop, edit(name));
    ["before", "after"].map(|side| {
        let file = format!("{side}/bays.toml");
        workshop.egg(&["build", &file, "--out", side]).expect(0);
        let text = std::fs::read_to_string(workshop.path(&format!("{side}/plan.ron")));
        from_ron(&text.expect("a plan")).expect("a plan")
    })
}

#[test]
fn plans_as_files_differ_as_their_projects_do() {
    let workshop = Workshop::new();
    plans(&workshop, "member-count");
    let json = |arguments: &[&str]| {
        let ran = workshop.egg(arguments).expect(0);
        Difference::from_json(&ran.out).expect("a difference")
    };
    let of_plans = json(&[
        "diff",
        "before/plan.ron",
        "after/plan.ron",
        "--format",
        "json",
    ]);
    let of_projects = json(&[
        "diff",
        "before/bays.toml",
        "after/bays.toml",
        "--format",
        "json",
    ]);
    assert_eq!(of_plans.changes, of_projects.changes);
    assert_eq!(of_plans.summary.counts, of_projects.summary.counts);
    let of_folders = json(&["diff", "before", "after", "--format", "json"]);
    assert_eq!(of_folders.changes, of_plans.changes);
}

#[test]
fn every_renderer_works_from_the_document_alone() {
    let workshop = Workshop::new();
    tried(&workshop, edit("lamella-width"));
    let json = diff(&workshop, &["--format", "json", "--to", "saved.json"]).expect(0);
    assert!(json.out.is_empty(), "{}", json.out);
    for format in ["text", "markdown", "json", "svg", "html"] {
        let fresh = diff(&workshop, &["--format", format]).expect(0).out;
        let saved = workshop
            .egg(&["diff", "saved.json", "--format", format])
            .expect(0)
            .out;
        if format == "text" || format == "markdown" || format == "html" {
            assert_eq!(saved, fresh, "{format}");
        }
        assert!(!saved.is_empty());
    }
}

#[test]
fn newer_and_broken_files_are_told_apart() {
    let workshop = Workshop::new();
    let [before, _] = plans(&workshop, "comment");
    let said = |name: &str, text: &str, code: &str| {
        workshop.write(name, text);
        let ran = workshop.egg(&["diff", name, "before/plan.ron"]);
        let ran = if name.ends_with("json") {
            workshop.egg(&["diff", name])
        } else {
            ran
        };
        assert!(ran.err.contains(code), "{name}: {}", ran.err);
        assert_eq!(ran.code, Some(2), "{}", ran.err);
        assert!(ran.out.is_empty(), "{}", ran.out);
    };
    let text = egg::plan::to_ron(&before);
    said(
        "newer.ron",
        &text.replace("format: 1,", "format: 7,"),
        "E0829",
    );
    said("cut.ron", &text[..text.len() / 2], "E0828");
    said("newer.json", "{\"format_version\": 8}", "E0829");
    said("other.json", "{\"format\": 1}", "E0828");
    said("newer.lock", "# egg plan lock, format 4.\n", "E0829");
    said("broken.lock", "lamella\n", "E0830");
}

#[test]
fn two_different_projects_are_compared_with_a_warning() {
    let workshop = Workshop::new();
    let [mut before, after] = plans(&workshop, "comment");
    before.name = "dome".to_owned();
    for point in &mut before.points {
        point.id.insert(0, 'x');
        point.position[0] += 10.0;
    }
    for patch in &mut before.patches {
        patch.id.insert(0, 'x');
        for corner in &mut patch.corners {
            corner.insert(0, 'x');
        }
    }
    workshop.write("dome.ron", egg::plan::to_ron(&before));
    workshop.write("bays.ron", egg::plan::to_ron(&after));
    let ran = workshop.egg(&["diff", "dome.ron", "bays.ron"]).expect(0);
    assert!(ran.err.contains("W0820"), "{}", ran.err);
}

#[test]
fn markdown_stays_below_its_limit_and_says_what_it_left_out() {
    let workshop = Workshop::new();
    let [before, after] = plans(&workshop, "point-moved");
    let context = Context {
        tolerances: Tolerances {
            length: 0.0,
            ..Tolerances::default()
        },
        ..Context::default()
    };
    let difference = between(Content::Plan(&before), Content::Plan(&after), context);
    let whole = markdown(&difference, 60_000);
    assert!(!whole.contains("did not fit"));
    for limit in [2_000, 2_300, 2_600] {
        let short = markdown(&difference, limit);
        assert!(short.len() <= limit, "{} > {limit}", short.len());
        assert!(short.contains("more rows did not fit here"), "{short}");
        assert_eq!(
            short.matches("<details>").count(),
            short.matches("</details>").count()
        );
    }
}

#[test]
fn a_plan_does_not_differ_from_itself() {
    let workshop = Workshop::new();
    let [plan, _] = plans(&workshop, "comment");
    let context = Context {
        pictures: Pictures::With,
        ..Context::default()
    };
    let difference = between(Content::Plan(&plan), Content::Plan(&plan), context);
    assert_eq!(difference.changes, []);
    assert_eq!(difference.drawings, []);
    assert_eq!(difference.summary.hidden, []);
    assert!(html(&difference).contains("no part changes"));
    assert!(svg(&difference).contains("no part changes"));
}

#[test]
fn an_independent_reader_confirms_the_document_and_its_sums() {
    let workshop = Workshop::new();
    let schema = workshop.egg(&["schema", "difference"]).expect(0).out;
    let schema = workshop.write("difference.schema.json", schema);
    let python = python::venv(&["jsonschema==4.*"]);
    for name in ["member-count", "patch-added", "patch-renamed-and-widened"] {
        tried(&workshop, edit(name));
        let to = format!("{name}.json");
        diff(&workshop, &["--format", "json", "--to", &to]).expect(0);
        let told = python::read(&python, "difference.py", &[&schema, &workshop.path(&to)]);
        assert!(told.starts_with("ok "), "{told}");
    }
}
