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
    let slope = bumps(&[[-7.0, 0.0]], 3.2, 3.0, &grid([16.0, 7.0], [64, 28]));
    shop.write("slope.obj", write_obj(&slope, "a hill off the middle"));
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
    let text = text.replace("workflow", "# workflow");
    let layout = format!("# the layout\n{layout}# what else there is\n");
    let mut kept = String::new();
    for table in text.split_inclusive("\n\n") {
        let replaced = ["[points]", "[patches.", "[distribution]", "[lamella."];
        let mut lines = table.lines().filter(|line| !line.starts_with('#'));
        let named = lines.next().unwrap_or_default();
        if !replaced.iter().any(|start| named.starts_with(start)) {
            kept.push_str(table);
        }
        if named == "[surface]" {
            kept.push_str(&layout);
        }
    }
    kept
}

/// The layout in what `pasted` makes.
fn layout_of(text: &str) -> &str {
    let (_, layout) = text.split_once("# the layout\n").expect("a layout");
    layout.split_once("# what else there is").expect("more").0
}

/// Files of the corpus that splitting changes.
const SPLIT: [&str; 4] = [
    "automatic.toml",
    "informed.toml",
    "junction.toml",
    "growing.toml",
];

#[test]
fn what_split_prints_is_printed_again_as_it_is() {
    let shop = workshop();
    for name in SPLIT {
        let text = pasted(&shop, name);
        shop.write("pasted.toml", &text);
        for workflow in ["automatic", "informed"] {
            let again = shop
                .egg(&["split", "pasted.toml", "--workflow", workflow])
                .expect(0);
            assert_eq!(again.out, layout_of(&text), "{name} {workflow}");
        }
    }
}

#[test]
fn parts_have_the_lamellae_of_their_patch_in_both_notations() {
    let shop = workshop();
    let text = pasted(&shop, "growing.toml");
    let layout = layout_of(&text);
    for part in ["p-1", "p-2"] {
        let own = format!("[lamella.{part}]\nwidth = 0.12\nmaterial = \"oak\"\n");
        assert!(layout.contains(&own), "{layout}");
    }
    assert!(!layout.contains("[lamella.p]"));
    // A side that carries weight is now two.
    assert!(
        layout.contains("\"a-p-s12\" = 2, \"b-p-s12\" = 2") || layout.contains("\"p-s12-b\" = 2"),
        "{layout}"
    );
}

#[test]
fn a_support_at_a_crossing_of_a_patch_that_is_split_is_told() {
    let shop = workshop();
    let (_, text) = corpus()
        .into_iter()
        .find(|(n, _)| n == "automatic.toml")
        .expect("there");
    let text = format!("{text}\n[supports]\nat = [\"a\", \"p.u02-v02\"]\n");
    shop.write("supported.toml", text);
    let said = shop.egg(&["split", "supported.toml"]);
    assert!(said.err.contains("`p.u02-v02`"), "{}", said.err);
}

#[test]
fn what_split_prints_builds_the_plan_that_the_workflow_builds() {
    let shop = workshop();
    for name in SPLIT {
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

#[test]
fn keys_that_name_a_split_patch_name_its_parts() {
    let shop = workshop();
    let designs = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/designs");
    let read = |name: &str| fs::read_to_string(designs.join(name)).expect("a file");
    shop.write("courtyard.obj", read("wrong/courtyard.obj"));
    let ring = read("ring-closed.toml").replace("wrong/courtyard", "courtyard");
    shop.write("ring.toml", &ring);
    let kept = shop.egg(&["split", "ring.toml"]).expect(0).out;
    assert!(kept.contains("closed = [\"south.v\"]"), "{kept}");
    assert_eq!(kept.matches("alpha = 32").count(), 4);
    shop.write(
        "ring.toml",
        ring.replace("[split]", "[split]\nmax_side = 1"),
    );
    let halved = shop.egg(&["split", "ring.toml"]).expect(0).out;
    assert_eq!(halved.matches("[patches.").count(), 8);
    assert!(
        halved.contains("closed = [\"south-1.v\", \"south-2.v\"]"),
        "{halved}"
    );
    // Angles were the designer's for the whole patches; parts choose theirs.
    assert!(!halved.contains("alpha"), "{halved}");
}

/// One coarse layout of each of the buildings of the paper, which it splits into 4, 16 and 16 patches.
#[test]
fn coarse_layouts_of_buildings_become_feasible_with_few_patches() {
    let shop = Workshop::new();
    let projects = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects");
    for (name, most, patches) in [
        ("great-court", 6, 6),
        ("lilium-tower", 24, 4),
        ("yas-hotel", 24, 4),
    ] {
        let folder = projects.join(name);
        let mesh = format!("{name}.obj");
        for file in ["coarse.toml", &mesh] {
            shop.write(file, fs::read(folder.join(file)).expect("a file"));
        }
        let split = shop.egg(&["split", "coarse.toml"]).expect(0);
        assert!(!split.err.contains("W0351"), "{}", split.err);
        let found = split.out.matches("[patches.").count();
        assert_eq!(found, patches, "{}", split.out);
        assert!(found <= most);
        // The buildings are symmetric, and cuts run through their middle.
        let mut added = split.out.lines().filter(|line| line.contains("-s"));
        let in_the_middle = |line: &str| !line.contains("on = ") || line.contains("at = 0.5 }");
        let given = |line: &str| line.starts_with("south-") || line.starts_with("north-");
        assert!(
            added.all(|line| in_the_middle(line) || given(line)),
            "{}",
            split.out
        );
    }
}
