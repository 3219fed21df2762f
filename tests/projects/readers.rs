//! The projects' plans and drawings before independent readers.

use crate::program::Workshop;
use crate::python;
use crate::{PROJECTS, STRUCTURES, root};
use std::fs;
use std::path::{Path, PathBuf};

/// Builds a project into a folder, with its plan as JSON and what the readers of drawings need to
/// know beside it.
fn built(shop: &Workshop, name: &str) -> PathBuf {
    let project = root(name);
    let project = project.to_string_lossy();
    shop.egg(&["build", &project, "--out", "out"]).expect(0);
    let plan = shop.egg(&["export", &project]).expect(0).out;
    shop.write("out/plan.json", plan);
    let text = fs::read_to_string(root(name)).expect("a project file");
    let loaded = egg::project::load(&text, egg::project::Notation::Toml, "x");
    let fabrication = loaded.project.expect("no errors").fabrication;
    let settings = serde_json::json!({
        "kerf": fabrication.kerf,
        "spacing": fabrication.spacing,
        "least_web": 1.0,
    });
    shop.write("out/settings.json", settings.to_string());
    shop.path("out")
}

/// Patches, members, crossings, lamellae, and ends of members on shared sides.
fn recomputed(name: &str) -> String {
    let shop = Workshop::new();
    let out = built(&shop, name);
    let materials = shop.egg(&["materials", "--message-format", "json"]);
    let materials = shop.write("materials.jsonl", materials.expect(0).out);
    let schema = shop.egg(&["schema", "plan"]).expect(0).out;
    let schema = shop.write("plan.schema.json", schema);
    let python = python::venv(&["numpy==2.*", "pygeodesic==0.1.*", "jsonschema==4.*"]);
    let (project, plan) = (root(name), out.join("plan.json"));
    let paths: [&Path; 4] = [&project, &plan, &schema, &materials];
    let told = python::read(&python, "plan_check.py", &paths);
    told.lines().next().unwrap_or_default().to_owned()
}

#[test]
fn another_exact_solver_confirms_the_plan_of_the_desktop_model() {
    assert_eq!(recomputed(PROJECTS[0]), "1 20 99 20 0");
}

#[test]
fn another_exact_solver_confirms_the_plan_of_the_saddle() {
    assert_eq!(recomputed(PROJECTS[1]), "1 22 121 22 0");
}

#[test]
fn another_exact_solver_confirms_the_plan_of_the_sphere_cap() {
    assert_eq!(recomputed(PROJECTS[2]), "1 18 81 18 0");
}

#[test]
fn another_exact_solver_confirms_the_plan_of_patches_that_share_sides() {
    assert_eq!(recomputed(PROJECTS[3]), "3 37 114 37 32");
}

#[test]
fn another_exact_solver_confirms_the_plan_of_the_pavilion() {
    assert_eq!(recomputed(STRUCTURES[0]), "2 36 160 36 20");
}

#[test]
fn the_check_of_a_structure_is_what_its_schema_says() {
    let shop = Workshop::new();
    let schema = shop.egg(&["schema", "check"]).expect(0).out;
    let schema = shop.write("check.schema.json", schema);
    let python = python::venv(&["numpy==2.*", "pygeodesic==0.1.*", "jsonschema==4.*"]);
    let project = root(STRUCTURES[0]);
    let check = ["check", "--format", "json", &project.to_string_lossy()];
    let check = shop.write("check.json", shop.egg(&check).expect(0).out);
    let told = python::read(&python, "schema.py", &[&schema, &check]);
    assert_eq!(told.trim(), "ok 2 patches");
}

#[test]
fn readers_of_drawings_find_the_openings_of_the_plan_in_the_files_of_the_projects() {
    let python = python::venv(&[
        "ezdxf==1.4.*",
        "shapely==2.*",
        "svgelements==1.9.*",
        "resvg_py==0.5.*",
        "pillow",
    ]);
    let mut found = Vec::new();
    for name in PROJECTS {
        let shop = Workshop::new();
        let out = built(&shop, name);
        let cut = python::read(&python, "cut_files.py", &[&out]);
        let drawn = python::read(&python, "same_drawing.py", &[&out]);
        found.push(format!("{} / {}", cut.trim(), drawn.trim()));
    }
    // Parts, notches, round holes / drawings that were compared, pictures that were rendered.
    assert_eq!(
        found,
        [
            "20 126 72 / 4 8",
            "22 162 80 / 4 8",
            "18 98 64 / 25 29",
            "37 101 127 / 6 12",
        ]
    );
}

#[test]
fn the_committed_schema_of_the_plan_is_the_one_of_its_types() {
    let text = fs::read_to_string(root("schema/plan.schema.json")).unwrap_or_default();
    assert!(
        text.replace("\r\n", "\n") == egg::plan::schema(),
        "write it again: egg schema plan > schema/plan.schema.json"
    );
}
