//! Wrong layouts, each with its golden report: what is said about designs whose project file is in
//! order, once the surface is known.

#[path = "common/program.rs"]
#[allow(
    dead_code,
    reason = "not every test needs everything that runs the program"
)]
mod program;

use egg::diagnostics::codes;
use program::{Ran, Workshop};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/designs/wrong")
}

/// The wrong designs, by name.
fn designs() -> Vec<String> {
    let entries = fs::read_dir(folder()).expect("the corpus is there");
    let mut names: Vec<String> = entries
        .filter_map(|entry| {
            let name = entry.expect("a readable folder").file_name();
            let name = name.to_str().expect("names are ASCII").to_owned();
            name.strip_suffix(".toml").map(str::to_owned)
        })
        .collect();
    names.sort();
    names
}

/// What `egg check` says about each, from a folder with all of them.
fn checked() -> Vec<(String, Ran)> {
    let shop = Workshop::new();
    for entry in fs::read_dir(folder()).expect("the corpus is there") {
        let path = entry.expect("a readable folder").path();
        let name = path.file_name().and_then(|name| name.to_str());
        let name = name.expect("names are ASCII");
        shop.write(name, fs::read(&path).expect("a readable file"));
    }
    let check = |name: String| {
        let ran = shop.egg(&["check", &format!("{name}.toml"), "--jobs", "1"]);
        (name, ran)
    };
    designs().into_iter().map(check).collect()
}

#[test]
fn every_wrong_layout_is_reported_as_its_golden_text_says() {
    let all = checked();
    assert!(all.len() >= 25, "{}", all.len());
    let mut shown: BTreeSet<String> = BTreeSet::new();
    for (name, ran) in &all {
        // The table of criteria, unless nothing is known of any patch.
        assert!(ran.out.is_empty() || ran.out.starts_with("patch"), "{name}");
        let told = |prefix: &str| ran.err.lines().any(|line| line.starts_with(prefix));
        let (errors, lints) = (told("error["), told("warning["));
        assert!(errors || lints, "{name}: {}", ran.err);
        assert_eq!(ran.code, Some(i32::from(errors)), "{name}: {}", ran.err);
        let code = |line: &str| Some(line.split_once('[')?.1.split_once(']')?.0.to_owned());
        shown.extend(ran.err.lines().filter_map(code));
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path("golden/designs");
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name.as_str(), ran.err));
    }
    // All codes of the layout are shown by some design; a geodesic that cannot be found needs a
    // broken mesh, which is refused before.
    let layout = codes::all()
        .map(|info| info.code)
        .filter(|code| matches!(&code[1..4], "032" | "033" | "040"));
    let unshown: Vec<&str> = layout.filter(|code| !shown.contains(*code)).collect();
    assert_eq!(unshown, ["E0404"]);
}
