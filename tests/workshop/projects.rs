//! Projects with small stock and small machines, from the project file to verified files.

use crate::common::python;
use crate::program::Workshop;
use crate::{golden, readers};
use std::fs;
use std::path::Path;

/// The desktop model with other lines in `[fabrication]`.
fn desktop(shop: &Workshop, fabrication: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/desktop");
    let mesh = fs::read(folder.join("desktop.obj")).expect("a mesh");
    shop.write("desktop.obj", mesh);
    let text = fs::read_to_string(folder.join("desktop.toml")).expect("a project");
    let text = text.replace("stock = { length = 1000, width = 300 }", fabrication);
    shop.write("desktop.toml", text);
}

#[test]
fn a_project_with_short_stock_is_spliced_pushed_through_and_verified() {
    let shop = Workshop::new();
    desktop(
        &shop,
        "stock = { length = 450, width = 300 }\nbed = { length = 300, width = 400, pass_through = true }\nsplice = \"finger\"",
    );
    let built = shop
        .egg(&["build", "desktop.toml", "--out", "out"])
        .expect(0);
    assert!(!built.err.contains("W0290"), "{}", built.err);
    assert!(
        built.err.contains("Nested limewood 1 mm on "),
        "{}",
        built.err
    );
    let verified = shop.egg(&["verify", "out"]).expect(0);
    assert!(
        verified.err.contains("Verified desktop: "),
        "{}",
        verified.err
    );
    let plan = shop.egg(&["export", "desktop.toml"]).expect(0).out;
    shop.write("out/plan.json", plan);
    shop.write(
        "out/settings.json",
        r#"{"kerf": 0, "spacing": 0.003, "least_web": 1.0}"#,
    );
    python::read(&readers(), "cut_files.py", &[&shop.path("out")]);
}

#[test]
fn stock_that_is_too_short_names_the_joints_that_would_help() {
    let shop = Workshop::new();
    desktop(&shop, "stock = { length = 450, width = 300 }");
    let ran = shop.egg(&["check", "desktop.toml"]).expect(1);
    golden("stock-too-short.txt", &ran.err);
}

#[test]
fn verify_ends_with_one_when_files_differ_and_with_two_when_there_are_none() {
    let shop = Workshop::new();
    desktop(&shop, "stock = { length = 1000, width = 300 }");
    shop.egg(&["build", "desktop.toml", "--out", "out"])
        .expect(0);
    let list = shop.path("out/cutlist.csv");
    let text = fs::read_to_string(&list).expect("a table");
    fs::write(&list, text.replacen("hills.u01,", "hills.u91,", 1)).expect("a table");
    let ran = shop.egg(&["verify", "out"]).expect(1);
    assert!(
        ran.err.contains("E0736") && ran.err.contains("cutlist.csv"),
        "{}",
        ran.err
    );
    let json = shop
        .egg(&["verify", "out", "--message-format", "json"])
        .expect(1);
    assert!(
        json.out
            .lines()
            .all(|line| line.starts_with("{\"reason\":\"diagnostic\"")),
        "{}",
        json.out
    );
    shop.egg(&["verify", "nowhere"]).expect(2);
}

#[test]
fn the_summary_for_programs_tells_yield_and_bounds() {
    let shop = Workshop::new();
    desktop(&shop, "stock = { length = 1000, width = 300 }");
    let ran = shop
        .egg(&["build", "desktop.toml", "--message-format", "json"])
        .expect(0);
    let line = ran
        .out
        .lines()
        .find(|l| l.contains("\"nested\""))
        .expect("a record");
    let record: serde_json::Value = serde_json::from_str(line).expect("JSON");
    assert_eq!(record["sheets"], record["sheets_bound"]);
    assert!(record["yield_share"].as_f64().expect("a number") > 0.3);
}
