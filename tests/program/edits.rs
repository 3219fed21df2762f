//! Which stages of the real graph an edit makes run: no more than it touches.
//!
//! Every edit starts from the same finished build with the cache as it was, so that what one edit
//! left does not hide what another would run.

use crate::program::{Workshop, files};
use crate::{JUNCTION, VAULT, read, with_junction};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

/// An edit of the project file or the mesh.
enum Edit {
    /// Of a text in the project file.
    Project(&'static [(&'static str, &'static str)]),
    /// Of a text in the mesh.
    Mesh(&'static str, &'static str),
}

use Edit::{Mesh, Project};

const EDITS: &[(&str, Edit)] = &[
    ("nothing", Project(&[])),
    ("a comment", Project(&[("# Three patches", "# 3 patches")])),
    (
        "tables in another order",
        Project(&[
            ("[split]\nslope = [0.4, 2.5]\n\n", ""),
            ("[points]", "[split]\nslope = [0.4, 2.5]\n\n[points]"),
        ]),
    ),
    (
        "a length in another unit",
        Project(&[("width = 10", "width = \"1 cm\"")]),
    ),
    (
        "a point moved",
        Project(&[("e = [-300, 350]", "e = [-299, 350]")]),
    ),
    (
        "a corner of all patches moved along its line",
        Project(&[("at = 0.5", "at = 0.51")]),
    ),
    (
        "a member more",
        Project(&[("members = { u = 9, v = 6 }", "members = { u = 9, v = 7 }")]),
    ),
    (
        "an angle chosen",
        Project(&[("members = { u = 5 }", "members = { u = 5 }\nalpha = 40")]),
    ),
    (
        "slopes bounded otherwise",
        Project(&[("slope = [0.4, 2.5]", "slope = [0.39, 2.5]")]),
    ),
    (
        "the limit of eta",
        Project(&[("slope = [0.4, 2.5]", "slope = [0.4, 2.5]\neta_max = 1.002")]),
    ),
    (
        "a side weighs more",
        Project(&[(
            "[lamella]",
            "[distribution]\nweights = { \"a-b\" = 2.0 }\n\n[lamella]",
        )]),
    ),
    ("wider lamellae", Project(&[("width = 10", "width = 10.5")])),
    (
        "thicker lamellae",
        Project(&[("thickness = 1\n", "thickness = 1.1\n")]),
    ),
    (
        "wider lamellae of one patch",
        Project(&[("[split]", "[lamella.south]\nwidth = 10.5\n\n[split]")]),
    ),
    (
        "a stiffer material of the same weight",
        Project(&[
            ("\"limewood\"", "\"wood\""),
            (
                "[split]",
                "[materials.wood]\nelastic_modulus = \"9.9 GPa\"\nshear_modulus = \"0.6 GPa\"\ndensity = \"500 kg/m^3\"\nbending_strength = \"90 MPa\"\n\n[split]",
            ),
        ]),
    ),
    (
        "another bolt",
        Project(&[("bolt = \"M3\"", "bolt = \"M2.5\"")]),
    ),
    (
        "clearance",
        Project(&[("clearance = 0.2", "clearance = 0.3")]),
    ),
    (
        "kerf",
        Project(&[("clearance = 0.2", "clearance = 0.2\nkerf = 0.1")]),
    ),
    (
        "spacing of parts",
        Project(&[("spacing = 3", "spacing = 4")]),
    ),
    (
        "size of the sheets",
        Project(&[("length = 1000", "length = 1100")]),
    ),
    (
        "price of a sheet",
        Project(&[("width = 300 }", "width = 300, price = 12.5 }")]),
    ),
    (
        "height of labels",
        Project(&[("clearance = 0.2", "clearance = 0.2\nlabel_height = 3")]),
    ),
    (
        "supports",
        Project(&[(
            "[hardware]",
            "[supports]\nat = \"corners\"\nkind = \"printed\"\n\n[hardware]",
        )]),
    ),
    (
        "a patch renamed",
        Project(&[("[patches.south]", "[patches.court]")]),
    ),
    (
        "a patch removed",
        Project(&[
            (
                "[patches.north-east]\ncorners = [\"t\", \"c\", \"f\", \"m\"]\nmembers = { u = 5 }\n\n",
                "",
            ),
            ("f = [300, 350]\n", ""),
        ]),
    ),
    (
        "the project renamed",
        Project(&[("name = \"junction\"", "name = \"crossing\"")]),
    ),
    ("a comment in the mesh", Mesh("# A low vault", "# A vault")),
    (
        "a vertex of the mesh moved by 5 mm",
        Mesh(
            "v 0.000000 0.000000 0.090000",
            "v 0.000000 0.000000 0.095000",
        ),
    ),
];

/// The stages that ran, each with its targets.
fn ran(said: &str) -> BTreeMap<String, Vec<String>> {
    let mut ran: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for line in said.lines() {
        let record: serde_json::Value = serde_json::from_str(line).expect("a record a line");
        if record["reason"] == "stage-finished" && record["how"] == "ran" {
            let text = |key: &str| record[key].as_str().unwrap_or_default().to_owned();
            ran.entry(text("stage")).or_default().push(text("target"));
        }
    }
    for targets in ran.values_mut() {
        targets.sort();
    }
    ran
}

/// Puts the workshop back to where it was after the first build, then edits the project. It stays
/// in its folder: what was built here before is a part of what a plan says.
fn edit(shop: &Workshop, before: &BTreeMap<String, Vec<u8>>, edit: &Edit) {
    for folder in ["cache", "out"] {
        fs::remove_dir_all(shop.path(folder)).expect("it was built");
    }
    for (name, bytes) in before {
        shop.write(name, bytes);
    }
    let replaced = |text: String, from: &str, to: &str| {
        assert_eq!(text.matches(from).count(), 1, "`{from}` stands there once");
        text.replacen(from, to, 1)
    };
    match edit {
        Project(changes) => {
            let text = changes
                .iter()
                .fold(read(JUNCTION), |text, (from, to)| replaced(text, from, to));
            shop.write("junction.toml", text);
        }
        Mesh(from, to) => {
            shop.write("vault.obj", replaced(read(VAULT), from, to));
        }
    }
}

#[test]
fn an_edit_makes_exactly_run_what_it_touches() {
    let shop = with_junction();
    // One output folder, also where the project has another name: it tells builds apart.
    let build = [
        "build",
        "junction.toml",
        "--out",
        "out",
        "--message-format",
        "json",
    ];
    let all = ran(&shop.egg(&build).expect(0).out);
    let before = files(&shop.path("."));
    let mut table = String::new();
    for (name, change) in EDITS {
        edit(&shop, &before, change);
        let planned = shop.egg(&[&build[..], &["--dry-run"]].concat()).expect(0);
        let built = ran(&shop.egg(&build).expect(0).out);
        // What the plan calls cached does not run; what it says runs does.
        for line in planned.out.lines() {
            let record: serde_json::Value = serde_json::from_str(line).expect("a record a line");
            let (Some(stage), Some(target)) = (record["stage"].as_str(), record["target"].as_str())
            else {
                continue;
            };
            let runs = built
                .get(stage)
                .is_some_and(|targets| targets.iter().any(|t| t == target));
            match record["state"].as_str() {
                Some("run") => assert!(runs, "{name}: {stage} {target} was to run"),
                Some("cached") => assert!(!runs, "{name}: {stage} {target} was cached"),
                state => assert_eq!(state, Some("maybe"), "{name}: {record}"),
            }
        }
        let _ = writeln!(table, "{name}");
        for (stage, targets) in &built {
            let some = match all.get(stage) {
                Some(every) if every.len() == targets.len() => format!("all {}", every.len()),
                _ => targets.join(", "),
            };
            let _ = writeln!(table, "    {stage}: {some}");
        }
    }
    insta::with_settings!({ prepend_module_to_snapshot => false, snapshot_path => "../golden/program" }, {
        insta::assert_snapshot!("edits", table);
    });
}
