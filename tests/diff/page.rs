//! The page in a browser.

use crate::edit::{EDITS, diff, tried};
use crate::program::Workshop;
use crate::python;
use std::path::Path;

#[test]
fn a_browser_shows_rows_and_shapes_of_the_same_part() {
    let workshop = Workshop::new();
    for name in ["member-count", "point-moved", "sheet-size"] {
        let (_, edit) = EDITS
            .into_iter()
            .find(|(edit, _)| *edit == name)
            .expect("an edit");
        tried(&workshop, edit);
        std::fs::create_dir_all(workshop.path("pages")).expect("a folder");
        let to = format!("pages/{name}.html");
        diff(&workshop, &["--format", "html", "--to", &to]).expect(0);
        let page = workshop.path(&to);
        let shots = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join("diff-pages")
            .join(name);
        std::fs::create_dir_all(&shots).expect("a folder");
        let python = python::venv(&["selenium==4.*"]);
        let told = python::read(&python, "diff_page.py", &[&page, &shots]);
        assert!(told.starts_with("ok "), "{told}");
    }
}
