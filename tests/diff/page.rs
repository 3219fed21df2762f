//! The page in a browser.

use crate::edit::{EDITS, diff, tried};
use crate::program::Workshop;
use crate::python;
use std::path::Path;

/// Opens a page of a workshop and uses it; screenshots stay in the build folder, to be looked at.
fn used(workshop: &Workshop, page: &str) {
    let shots = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("diff-pages")
        .join(page);
    std::fs::create_dir_all(&shots).expect("a folder");
    let python = python::venv(&["selenium==4.*"]);
    let told = python::read(&python, "diff_page.py", &[&workshop.path(page), &shots]);
    assert!(told.starts_with("ok "), "{told}");
}

#[test]
fn a_browser_shows_rows_and_shapes_of_the_same_part() {
    let workshop = Workshop::new();
    for name in ["point-moved", "sheet-size"] {
        let (_, edit) = EDITS
            .into_iter()
            .find(|(edit, _)| *edit == name)
            .expect("an edit");
        tried(&workshop, edit);
        let page = format!("{name}.html");
        diff(&workshop, &["--format", "html", "--to", &page]).expect(0);
        used(&workshop, &page);
    }
}

#[test]
fn a_browser_shows_what_a_member_less_does_to_the_pavilion() {
    let workshop = Workshop::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/pavilion");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("a file");
    let (text, mesh) = (read("pavilion.toml"), read("pavilion.obj"));
    let edited = text.replace("members = { u = 8, v = 10 }", "members = { u = 8, v = 9 }");
    assert_ne!(text, edited);
    for (side, text) in [("before", text), ("after", edited)] {
        workshop.write(&format!("{side}/pavilion.toml"), text);
        workshop.write(&format!("{side}/pavilion.obj"), &mesh);
    }
    let sides = ["before/pavilion.toml", "after/pavilion.toml"];
    let page = ["--format", "html", "--to", "pavilion.html"];
    workshop
        .egg(&[&["diff"], &sides[..], &page].concat())
        .expect(0);
    used(&workshop, "pavilion.html");
}
