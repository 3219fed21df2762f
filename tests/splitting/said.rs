//! What the program says about infeasible patches and their splitting: golden texts of a corpus of
//! projects on made-up surfaces.

use crate::program::{Workshop, files};
use crate::{bumps, grid};
use egg::plan::{Plan, from_ron};
use egg::surface::write_obj;
use std::fmt::Write;
use std::fs;
use std::path::Path;

fn corpus() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/splitting");
    let files = files(&folder).into_iter();
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    files.map(|(name, bytes)| (name, text(bytes))).collect()
}

/// A folder with the corpus and the meshes that it names.
fn workshop() -> Workshop {
    let shop = Workshop::new();
    let hill = bumps(&[[0.0, 0.0]], 3.0, 3.0, &grid([12.0, 9.0], [48, 36]));
    shop.write("hill.obj", write_obj(&hill, "a hill"));
    let spike = bumps(&[[0.0, 0.0]], 4.2, 3.0, &grid([11.0, 11.0], [44, 44]));
    shop.write("spike.obj", write_obj(&spike, "a steep hill"));
    for (name, text) in corpus() {
        shop.write(&name, text);
    }
    shop
}

/// The corpus with what `egg check` says, and `egg split` where the project names a workflow.
#[test]
fn every_project_of_the_corpus_is_told_its_criteria_and_what_to_do() {
    let shop = workshop();
    insta::with_settings!({
        snapshot_path => "../golden/splitting",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, {
        for (name, text) in corpus() {
            let checked = shop.egg(&["check", &name]);
            let mut said = format!("{}{}exit {:?}\n", checked.out, checked.err, checked.code);
            if text.contains("workflow") {
                let split = shop.egg(&["split", &name]);
                let _ = write!(said, "\n$ egg split {name}\n{}", split.out);
            }
            insta::assert_snapshot!(name, said);
        }
    });
}

#[test]
fn quiet_checks_print_errors_only_and_programs_get_json() {
    let shop = workshop();
    let quiet = shop.egg(&["check", "-q", "one-family.toml"]).expect(0);
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
    let json = shop
        .egg(&["check", "--format", "json", "one-family.toml"])
        .expect(0);
    let document: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    assert_eq!(document["format"], "egg-check");
    assert_eq!(document["version"], 1);
    assert_eq!(document["project"], "one-family");
    assert_eq!(document["feasible"], false);
    let patch = &document["patches"][0];
    assert_eq!(patch["patch"], "p");
    assert_eq!(patch["violated"][0], "eta v");
    let eta = patch["eta"]["v"].as_f64().expect("a number");
    assert!(eta > 1.0015 && eta < 1.01, "{eta}");
    assert_eq!(patch["peaks"].as_array().map(Vec::len), Some(1));
    // Messages for programs and the table do not share standard output.
    let records = shop
        .egg(&["check", "--message-format", "json", "one-family.toml"])
        .expect(0);
    for line in records.out.lines() {
        serde_json::from_str::<serde_json::Value>(line).expect("a record a line");
    }
}

fn plan(shop: &Workshop, out: &str) -> Plan {
    let text = fs::read_to_string(shop.path(out).join("plan.ron")).expect("a plan");
    from_ron(&text).expect("a plan")
}

/// A project with the layout that `egg split` prints in the place of its own.
fn pasted(shop: &Workshop, name: &str) -> String {
    let (_, text) = corpus()
        .into_iter()
        .find(|(n, _)| n == name)
        .expect("in the corpus");
    let layout = shop.egg(&["split", name]).expect(0).out;
    let start = text.find("[points]").expect("points");
    let end = text.find("[lamella]").expect("a lamella");
    let rest = text[end..].replace("workflow", "# workflow");
    // A patch with lamellae of its own has parts with lamellae of their own.
    let rest = rest.replace(
        "[lamella.south]\nwidth = 0.12",
        "[lamella.south-1]\nwidth = 0.12\n[lamella.south-2]\nwidth = 0.12",
    );
    format!("{}{layout}\n{rest}", &text[..start])
}

#[test]
fn what_split_prints_builds_the_plan_that_the_workflow_builds() {
    let shop = workshop();
    for name in ["automatic.toml", "informed.toml", "junction.toml"] {
        shop.egg(&["build", name, "--out", "by-workflow"]).expect(0);
        shop.write("pasted.toml", pasted(&shop, name));
        shop.egg(&["build", "pasted.toml", "--out", "by-hand"])
            .expect(0);
        let [mut by_workflow, mut by_hand] = ["by-workflow", "by-hand"].map(|out| plan(&shop, out));
        assert!(by_workflow.patches.len() > 1);
        assert!(by_workflow.patches.iter().all(|patch| patch.feasible));
        // That it was split is told by the workflow only.
        by_workflow.diagnostics.retain(|d| d.code != "W0352");
        assert_eq!(by_workflow.diagnostics.len(), by_hand.diagnostics.len());
        for plan in [&mut by_workflow, &mut by_hand] {
            plan.diagnostics.clear();
        }
        assert_eq!(by_workflow, by_hand, "{name}");
    }
}

#[test]
fn a_dry_run_and_a_second_build_know_that_patches_are_a_result() {
    let shop = workshop();
    let planned = shop
        .egg(&["build", "--dry-run", "automatic.toml"])
        .expect(0);
    assert!(planned.out.contains("split"), "{}", planned.out);
    assert!(!planned.out.contains("p-1"), "{}", planned.out);
    shop.egg(&["build", "automatic.toml"]).expect(0);
    let again = shop.egg(&["build", "automatic.toml"]).expect(0);
    assert!(
        again.err.contains(", 0 written") || again.err.contains("cached)"),
        "{}",
        again.err
    );
    let planned = shop
        .egg(&["build", "--dry-run", "automatic.toml"])
        .expect(0);
    assert!(!planned.out.contains("run "), "{}", planned.out);
    let why = shop
        .egg(&["explain", "automatic.toml", "cladding p-1"])
        .expect(0);
    assert!(why.out.contains("p-1"), "{}", why.out);
    // A material is nothing that splitting sees.
    let text = corpus()
        .into_iter()
        .find(|(n, _)| n == "automatic.toml")
        .expect("there")
        .1;
    shop.write("automatic.toml", text.replace("poplar-plywood", "limewood"));
    let planned = shop
        .egg(&["build", "--dry-run", "automatic.toml"])
        .expect(0);
    let mut runs = planned.out.lines().filter(|line| line.contains("run"));
    assert!(!runs.any(|line| line.contains("split") || line.contains("distances")));
}

#[test]
fn a_patch_that_was_split_is_asked_for_by_its_own_name_and_leaves_its_lamella_to_its_parts() {
    let shop = workshop();
    let (_, text) = corpus()
        .into_iter()
        .find(|(name, _)| name == "automatic.toml")
        .expect("there");
    let own = "\n[lamella.p]\nthickness = 0.007\n";
    shop.write("automatic.toml", format!("{text}{own}"));
    let asked = [
        "build",
        "automatic.toml",
        "--only",
        "p",
        "--stage",
        "lamellae",
    ];
    let told = shop
        .egg(&[&asked[..], &["--message-format", "json"]].concat())
        .expect(0);
    let records = told
        .out
        .lines()
        .map(|line| serde_json::from_str::<serde_json::Value>(line).expect("a record a line"));
    let mut made: Vec<String> = records
        .filter(|record| record["stage"] == "lamellae")
        .filter_map(|record| Some(record["target"].as_str()?.to_owned()))
        .collect();
    made.sort();
    assert_eq!(made, ["p-1", "p-2"]);
    let wrong = ["build", "automatic.toml", "--only", "q"];
    let wrong = shop.egg(&wrong).expect(2).err;
    assert!(wrong.contains("there is no target `q`"), "{wrong}");
    shop.egg(&["build", "automatic.toml", "--out", "out"])
        .expect(0);
    let plan = plan(&shop, "out");
    assert!(
        plan.lamellae
            .iter()
            .all(|lamella| lamella.thickness == 0.007)
    );
}
