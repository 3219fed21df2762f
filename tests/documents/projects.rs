//! The example projects: their READMEs show their real figures and a picture of their real plan.

use crate::current;
use crate::figures;
use crate::picture;
use egg::build::graph::{Design, Extent, declare};
use egg::build::{CancelToken, Engine, Request, Settings};
use egg::plan::{Plan, from_ron};
use egg::project::{Notation, load};
use std::fs;
use std::path::{Path, PathBuf};

/// A project that was built from nothing.
struct Built {
    plan: Plan,
    output: PathBuf,
    _folder: tempfile::TempDir,
}

fn build(name: &str) -> Built {
    let path = current::path(&format!("projects/{name}/{name}.toml"));
    let text = fs::read_to_string(&path).expect("the project file");
    let loaded = load(&text, Notation::Toml, name);
    let project = loaded.project.expect("the project is right");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = folder.path().join("out");
    let mut engine = Engine::open(Settings::new(folder.path().join("cache"), &output));
    let mesh = path.parent().map(|home| home.join(&project.surface.mesh));
    let mesh = engine
        .source(&mesh.expect("a folder"))
        .expect("the mesh of the project");
    let design = Design {
        project: &project,
        spans: &loaded.spans,
        mesh: &mesh,
    };
    let built = engine.build(
        &Request::default(),
        &|graph| declare(graph, design, Extent::Files),
        &CancelToken::default(),
        &mut |_| {},
    );
    assert!(built.succeeded(), "{name}: {:?}", built.diagnostics);
    let plan = fs::read_to_string(output.join("plan.ron")).expect("the plan");
    Built {
        plan: from_ron(&plan).expect("egg reads its plans"),
        output,
        _folder: folder,
    }
}

/// Holds README and picture of a project to its plan.
fn shown(name: &str) -> Built {
    let built = build(name);
    let folder = format!("projects/{name}");
    current::block(
        &format!("{folder}/README.md"),
        "figures",
        &figures::table(&built.plan),
    );
    current::drawing(
        &format!("{folder}/{name}.svg"),
        &picture::draw(&built.plan),
        0.25,
    );
    built
}

fn copied(built: &Built, file: &str, to: &str) {
    let made = fs::read_to_string(built.output.join(file))
        .unwrap_or_else(|error| panic!("{file}: {error}"));
    current::drawing(to, &made, 0.01);
}

#[test]
fn the_desktop_model_shows_its_figures() {
    let built = shown("desktop");
    // The pictures of the documents are files of this build.
    copied(&built, "cladding/hills.svg", "docs/pictures/cladding.svg");
    copied(
        &built,
        "fabrication/desktop_limewood-1mm_sheet-01-of-01.overview.svg",
        "docs/pictures/sheet.svg",
    );
}

#[test]
fn the_saddle_shows_its_figures() {
    shown("saddle");
}

#[test]
fn the_sphere_cap_shows_its_figures() {
    let built = shown("sphere-cap");
    let picture = "docs/pictures/setting-out.svg";
    copied(&built, "supports/setting-out.svg", picture);
}

#[test]
fn the_pavilion_shows_its_figures() {
    let built = shown("pavilion");
    copied(
        &built,
        "layout/patches.svg",
        "projects/pavilion/patches.svg",
    );
}

#[test]
fn the_prototype_shows_its_figures() {
    shown("prototype");
}

#[test]
fn the_peak_shows_its_figures() {
    shown("peak");
}

#[test]
fn the_great_court_shows_its_figures() {
    let built = shown("great-court");
    copied(
        &built,
        "layout/patches.svg",
        "projects/great-court/patches.svg",
    );
}

#[test]
fn the_lilium_tower_shows_its_figures() {
    let built = shown("lilium-tower");
    copied(
        &built,
        "layout/patches.svg",
        "projects/lilium-tower/patches.svg",
    );
}

#[test]
fn the_yas_hotel_shows_its_figures() {
    let built = shown("yas-hotel");
    copied(
        &built,
        "layout/patches.svg",
        "projects/yas-hotel/patches.svg",
    );
}

#[test]
fn the_rotunda_shows_its_figures() {
    let built = shown("rotunda");
    copied(&built, "layout/patches.svg", "projects/rotunda/patches.svg");
}

#[test]
fn every_project_has_a_test_here_and_a_line_in_the_readme() {
    let tests = current::read("tests/documents/projects.rs");
    let readme = current::read("README.md");
    let folders = fs::read_dir(current::path("projects")).expect("the projects");
    for folder in folders {
        let folder = folder.expect("a folder").path();
        let name = folder
            .file_name()
            .map(Path::new)
            .and_then(Path::to_str)
            .expect("a plain name")
            .to_owned();
        assert!(tests.contains(&format!("shown(\"{name}\")")), "{name}");
        assert!(readme.contains(&format!("(projects/{name})")), "{name}");
    }
}
