//! Panels that are longer than the bed.

use crate::common::job::Job;
use crate::common::python;
use crate::{golden, readers};
use egg::fabrication;

#[test]
fn readers_put_the_windows_of_a_sheet_together_again() {
    let python = readers();
    let whole = Job::pavilion().write("pavilion-whole");
    let expected = python::read(&python, "cut_files.py", &[&whole]);
    for (bed, name) in [(1.245, "three"), (0.7, "five")] {
        let job = Job::pushed(bed);
        let windows = job.plan.sheets[0].windows.len();
        assert!(windows >= 3, "{windows}");
        let folder = job.write(&format!("pushed-{name}"));
        assert_eq!(python::read(&python, "cut_files.py", &[&folder]), expected);
        python::read(&python, "same_drawing.py", &[&folder]);
    }
}

#[test]
fn windows_of_a_spliced_and_compensated_job_go_together_too() {
    let mut job = Job::spliced(egg::project::model::SpliceKind::Scarf);
    job.fabrication.kerf = 0.15e-3;
    job.fabrication.bed = Some(egg::project::model::Bed {
        length: 0.9,
        width: 1.0,
        pass_through: true,
    });
    job.prepare();
    let folder = job.write("pushed-spliced");
    python::read(&readers(), "cut_files.py", &[&folder]);
}

#[test]
fn a_title_says_how_far_to_push() {
    let files = Job::pushed(1.245).files();
    let first = files
        .iter()
        .find(|f| f.path.ends_with("window-1-of-3.svg"))
        .expect("a window");
    let text = String::from_utf8(first.bytes.clone()).expect("UTF-8");
    assert!(
        text.contains("window 1 of 3, then push 627.50 mm"),
        "the title"
    );
    assert!(text.contains("nominal, kerf not compensated"));
    let last = files
        .iter()
        .find(|f| f.path.ends_with("window-3-of-3.svg"))
        .expect("a window");
    let text = String::from_utf8(last.bytes.clone()).expect("UTF-8");
    assert!(text.contains("window 3 of 3, the last"));
}

#[test]
fn a_border_without_wood_for_pins_is_told() {
    let mut job = Job::pushed(1.245);
    // A panel that is just wide enough for its rows.
    job.fabrication.margin = 2e-3;
    job.prepare();
    let rows = job.plan.sheets[0].parts.iter().map(|part| part.y);
    let top = rows.fold(0.0, f64::max) + 0.03;
    job.fabrication.stock.width = top + 2.1e-3;
    job.prepare();
    let told = fabrication::outputs(&job.plan, job.inputs()).expect("files");
    let told: Vec<_> = told
        .warnings
        .iter()
        .filter(|d| d.code.as_str() == "W0731")
        .collect();
    assert_eq!(told.len(), job.plan.sheets.len());
    golden("no-registration.txt", &told[0].message);
}

#[test]
fn a_reader_finds_a_page_for_every_sheet() {
    let job = Job::spliced(egg::project::model::SpliceKind::Finger);
    let folder = job.write("pages");
    let python = python::venv(&["pypdf==7.*"]);
    let pages = folder.join("fabrication/pavilion_overview.pdf");
    let told = python::read(&python, "pages.py", &[&pages]);
    assert_eq!(told.trim(), format!("{} A3", job.plan.sheets.len()));
}
