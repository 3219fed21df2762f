//! Builds of the projects: they succeed, and always write the same.

use crate::program::{Workshop, files};
use crate::{PROJECTS, STRUCTURES, root};
use crate::{conditions, evenness};
use egg::plan::{DiagnosticRecord, Plan, from_ron, to_json, to_ron};
use egg::project::model::{Family, Project, Workflow};
use egg::project::{Notation, load};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Files of a build by name.
type Built = BTreeMap<String, Vec<u8>>;

/// Builds a project and looks at what is said; gives what is there afterwards.
fn build(shop: &Workshop, project: &Path, [cache, out, jobs]: [&str; 3], finished: &str) -> Built {
    let project = project.to_string_lossy();
    let ran = shop
        .egg(&[
            "build",
            &project,
            "--cache-dir",
            cache,
            "--out",
            out,
            "--jobs",
            jobs,
        ])
        .expect(0);
    assert_eq!(ran.out, "");
    // Notes may stand before it: they tell how patches were split.
    assert!(!ran.err.contains("warning[") && !ran.err.contains("error["));
    let summary = ran.err.rsplit("\n\n").next().unwrap_or_default();
    let lines: Vec<&str> = summary.lines().map(str::trim_start).collect();
    let (last, nested) = lines.split_last().expect("a summary");
    let is_nested = |line: &&str| line.starts_with("Nested ");
    assert!(last.starts_with("Finished "), "{}", ran.err);
    let count = |word: &str| {
        let (before, _) = last.split_once(word).expect("a count");
        let digits = before.rsplit(|c: char| !c.is_ascii_digit()).next();
        digits.unwrap_or_default().to_owned()
    };
    let idle = count(" stages") == count(" cached");
    assert_eq!(nested.is_empty(), idle, "{}", ran.err);
    assert!(nested.iter().all(is_nested), "{}", ran.err);
    assert!(ran.err.contains(finished), "{}", ran.err);
    let mut found = files(&shop.path(out));
    assert!(found.remove(".egg-manifest").is_some());
    found
}

/// Names of files of which two builds have other contents, or which only one has.
fn differing<'a>(a: &'a Built, b: &'a Built) -> Vec<&'a str> {
    let names = a.keys().chain(b.keys());
    names
        .filter(|name| a.get(*name) != b.get(*name))
        .map(String::as_str)
        .collect()
}

fn model(project: &Path) -> Project {
    let text = fs::read_to_string(project).expect("a project file");
    let loaded = load(&text, Notation::Toml, "x");
    assert_eq!(loaded.diagnostics, []);
    loaded.project.expect("no errors")
}

fn plan_of(built: &Built) -> Plan {
    let text = String::from_utf8(built["plan.ron"].clone()).expect("UTF-8");
    let plan = from_ron(&text).expect("a plan");
    assert_eq!(to_ron(&plan), text, "what is read is what was written");
    plan
}

/// Everything that the program promises about a project, with one thread and with two, and with
/// what is already in the cache.
fn prove(name: &str) {
    let project = root(name);
    let shop = Workshop::new();
    let first = build(&shop, &project, ["one", "out-one", "1"], " 0 cached");
    let stamp = |name: &str| fs::metadata(shop.path(name)).and_then(|m| m.modified());
    let written = stamp("out-one/plan.ron").expect("a time");

    let two_threads = build(&shop, &project, ["two", "out-two", "2"], " 0 cached");
    assert_eq!(differing(&first, &two_threads), [""; 0]);
    let stages = format!("({0} stages, {0} cached)", stages(&shop, &project));
    let again = build(&shop, &project, ["one", "out-one", "2"], &stages);
    assert_eq!(differing(&first, &again), [""; 0]);
    assert_eq!(stamp("out-one/plan.ron").expect("a time"), written);
    let elsewhere = build(&shop, &project, ["two", "out-three", "1"], "files written");
    assert_eq!(differing(&first, &elsewhere), [""; 0]);

    let plan = plan_of(&first);
    let with = |command: &[&str]| {
        let project = project.to_string_lossy();
        let more = ["--cache-dir", "one", &project];
        shop.egg(&[command, &more].concat()).expect(0)
    };
    let exported = with(&["export", "--format", "json"]);
    assert_eq!(
        (exported.out, exported.err),
        (to_json(&plan), String::new())
    );
    let exported = with(&["export", "--format", "ron"]);
    assert!(exported.out.as_bytes() == first["plan.ron"].as_slice());
    let checked = with(&["check"]);
    // A head, a row a patch, the limits.
    assert_eq!(checked.out.lines().count(), plan.patches.len() + 2);
    for patch in &plan.patches {
        let row = checked
            .out
            .lines()
            .find(|row| row.split_whitespace().next() == Some(&patch.id));
        assert!(
            row.is_some_and(|row| row.ends_with("feasible")),
            "{}",
            checked.out
        );
    }
    assert_eq!(checked.err, format!("     Checked {}\n", plan.name));

    holds(&plan, &model(&project));
}

/// What every finished plan keeps.
fn holds(plan: &Plan, model: &Project) {
    let split = |told: &&DiagnosticRecord| told.code == "W0352";
    assert!(plan.diagnostics.iter().all(|told| split(&told)));
    match model.split.workflow {
        Workflow::Off => assert_eq!(plan.patches.len(), model.patches.len()),
        _ => assert!(plan.patches.len() > model.patches.len()),
    }
    assert!(plan.patches.iter().all(|patch| patch.feasible));
    let bolt = model.hardware.bolt.diameter;
    let shell = model.hardware.shell.as_ref();
    let slider = shell.map_or(bolt, |shell| shell.diameter);
    let play = model.fabrication.clearance;
    conditions::hold(plan, model.split.slope, bolt + play, slider + play);
    let eta_max = model.split.eta_max;
    let etas = plan.patches.iter().map(|patch| patch.eta);
    assert!(etas.clone().all(|eta| eta.u.max(eta.v) <= eta_max));
}

/// The conditions alone: structures are large, and what a build promises beside is shown by the
/// small ones.
fn plan_holds(name: &str) -> Plan {
    let project = root(name);
    let shop = Workshop::new();
    let built = build(&shop, &project, ["cache", "out", "2"], " 0 cached");
    let plan = plan_of(&built);
    holds(&plan, &model(&project));
    let gained = plan.strips.iter().map(|strip| strip.evenness_gained);
    assert!(gained.clone().all(|gained| gained >= 1.0 - 1e-9));
    plan
}

#[test]
fn the_pavilion_keeps_the_conditions_of_a_plan() {
    let plan = plan_holds(STRUCTURES[0]);
    let common = plan.strips.iter().find(|strip| strip.id == "east.v");
    assert_eq!(common.expect("a strip").families, ["east.v", "west.v"]);
    evenness::is_stationary(&plan, ["west", "east"], Family::V);
}

#[test]
fn the_prototype_keeps_the_conditions_of_a_plan() {
    plan_holds(STRUCTURES[1]);
}

#[test]
fn the_great_court_keeps_the_conditions_of_a_plan() {
    let plan = plan_holds(STRUCTURES[2]);
    let around = plan.strips.iter().find(|strip| strip.families.len() > 1);
    let families = ["east.u", "north.u", "south.u", "west.u"];
    assert_eq!(around.expect("a strip").families, families);
}

#[test]
fn the_lilium_tower_keeps_the_conditions_of_a_plan() {
    let plan = plan_holds(STRUCTURES[3]);
    assert_eq!((plan.patches.len(), plan.strips.len()), (16, 8));
}

#[test]
fn the_yas_hotel_keeps_the_conditions_of_a_plan() {
    let plan = plan_holds(STRUCTURES[4]);
    assert_eq!((plan.patches.len(), plan.strips.len()), (16, 8));
}

#[test]
fn the_peak_is_covered_once_it_is_split() {
    for name in &STRUCTURES[6..9] {
        let plan = plan_holds(name);
        assert!((2..=4).contains(&plan.patches.len()), "{name}");
    }
}

/// The ring of a structure closes: members end where they began.
fn ring_closes(name: &str) -> Plan {
    let plan = plan_holds(name);
    let rings: Vec<_> = plan
        .strips
        .iter()
        .filter_map(|strip| strip.ring.as_ref())
        .collect();
    let [ring] = rings[..] else {
        panic!("{rings:?}")
    };
    assert!(ring.closed && ring.drift < 1e-8, "{ring:?}");
    plan
}

#[test]
fn a_ring_of_mirror_images_closes() {
    ring_closes(STRUCTURES[5]);
}

#[test]
fn a_ring_of_turned_images_closes_by_collapsing_alternately() {
    let plan = ring_closes(STRUCTURES[9]);
    let side = |patch: &str| {
        let patch = plan
            .patches
            .iter()
            .find(|p| p.id == patch)
            .expect("a patch");
        patch.alpha_planar < patch.alpha_surface
    };
    let collapsed = ["south", "east", "north", "west"].map(side);
    let up = collapsed.iter().filter(|&&acute| acute).count();
    assert_eq!(up, 2, "{collapsed:?}");
}

#[test]
fn a_ring_of_unlike_patches_closes() {
    ring_closes(STRUCTURES[10]);
}

/// How many stages a build has.
fn stages(shop: &Workshop, project: &Path) -> usize {
    let project = project.to_string_lossy();
    let arguments = ["build", &project, "--dry-run", "--cache-dir", "none"];
    let told = shop.egg(&arguments).expect(0).out;
    told.lines().filter(|l| l.starts_with("     run ")).count()
}

#[test]
fn the_desktop_model_keeps_every_promise() {
    prove(PROJECTS[0]);
}

#[test]
fn the_saddle_keeps_every_promise() {
    prove(PROJECTS[1]);
}

#[test]
fn the_sphere_cap_keeps_every_promise() {
    prove(PROJECTS[2]);
}

#[test]
fn patches_that_share_sides_keep_every_promise() {
    prove(PROJECTS[3]);
}

/// Copies a project file and its mesh, with another text in it.
fn edited(shop: &Workshop, name: &str, from: &str, to: &str) -> std::path::PathBuf {
    let project = root(name);
    let mesh = model(&project).surface.mesh;
    let folder = project.parent().expect("a folder");
    let bytes = fs::read(folder.join(&mesh)).expect("a mesh");
    shop.write(&mesh, bytes);
    let text = fs::read_to_string(&project).expect("a project file");
    assert!(text.contains(from));
    shop.write("edited.toml", text.replacen(from, to, 1))
}

/// What is read back from the cache has to be what was computed, to the last bit: here every kind
/// of result is read back by one of the edits.
#[test]
fn a_build_after_an_edit_writes_what_a_clean_build_writes() {
    let shop = Workshop::new();
    let name = PROJECTS[3];
    build(&shop, &root(name), ["warm", "first", "2"], " 0 cached");
    for (i, (from, to)) in [
        ("bolt = \"M3\"", "bolt = \"M3\"\nshell = \"brass 4x0.45\""),
        ("length = 1000", "length = 990"),
        ("width = 10", "width = 11"),
        ("slope = [", "eta_max = 1.01\nslope = ["),
    ]
    .into_iter()
    .enumerate()
    {
        let project = edited(&shop, name, from, to);
        let (clean, out) = (format!("clean-{i}"), format!("out-{i}"));
        let warm = build(&shop, &project, ["warm", "warm-out", "2"], " cached");
        let clean = build(&shop, &project, [&clean, &out, "2"], " 0 cached");
        assert_eq!(differing(&warm, &clean), [""; 0], "{to}");
    }
}

#[test]
fn asking_a_ring_to_close_measures_no_patch_again() {
    let shop = Workshop::new();
    let name = "tests/corpus/designs/wrong/ring-open.toml";
    let [from, to] = [
        "[split]",
        "[distribution]\nclosed = [\"south.v\"]\n\n[split]",
    ];
    let open = edited(&shop, name, from, from);
    let cache = ["--cache-dir", "warm"];
    let open = open.to_string_lossy();
    let check = [&["check", &open][..], &cache].concat();
    shop.egg(&check).expect(0);
    let closed = edited(&shop, name, from, to);
    let closed = closed.to_string_lossy();
    let planned = shop.egg(&[&["build", "--dry-run", &closed][..], &cache].concat());
    let planned = planned.expect(0).out;
    let runs = |stage: &str| {
        let mut lines = planned.lines();
        lines.any(|line| line.trim_start().starts_with(&format!("run {stage} ")))
    };
    assert!(runs("closing"), "{planned}");
    for stage in ["line", "patch", "distances", "angles", "cladding"] {
        assert!(!runs(stage), "{stage}: {planned}");
    }
    shop.egg(&[&["check", &closed][..], &cache].concat())
        .expect(0);
    // A weight on a side of the ring moves its members, and with them the angles; nothing that was
    // measured depends on it.
    let text = fs::read_to_string(&*closed).expect("a project file");
    let weighed = text.replace("closed = [", "weights = { \"sw-sw-in\" = 3 }\nclosed = [");
    shop.write("edited.toml", weighed);
    let planned = shop.egg(&[&["build", "--dry-run", &closed][..], &cache].concat());
    let planned = planned.expect(0).out;
    assert!(planned.contains("run closing "), "{planned}");
    assert!(!planned.contains("run feasibility "), "{planned}");
}
