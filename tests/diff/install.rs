//! `egg git`: `git diff` in terms of parts.

use crate::edit::Project;
use crate::program::Workshop;
use crate::repository::Repository;

/// A repository that keeps its results, with a change of them that is not committed.
fn with_results(workshop: &Workshop) -> Repository<'_> {
    let repository = Repository::new(workshop);
    Project::bays().write(workshop, "repo");
    repository.egg(&["build"]).expect(0);
    repository.git(&["add", "--all", "--force"]);
    repository.git(&["commit", "--quiet", "--message", "Start"]);
    Project::bays()
        .with("width = 20", "width = 22")
        .write(workshop, "repo");
    repository.egg(&["build"]).expect(0);
    repository
}

#[test]
fn git_shows_parts_once_the_driver_is_installed_and_not_any_more_when_it_is_gone() {
    let workshop = Workshop::new();
    let repository = with_results(&workshop);
    let plan = "build/bays/plan.ron";
    let plain = repository.git(&["diff", "--", plan]);
    repository.egg(&["git", "install"]).expect(0);
    let shown = repository.git(&["diff", "--unified=0", "--", plan]);
    assert!(shown.contains("+lamella west.u01"), "{shown}");
    assert!(shown.contains("width 22mm"), "{shown}");
    assert!(!shown.contains("polyline"), "{shown}");
    let sheet = repository.git(&["diff", "--unified=0", "--", "*.dxf"]);
    assert!(sheet.contains("+part 1: "), "{sheet}");
    assert!(!sheet.contains("AcDbEntity"), "{sheet}");
    repository.egg(&["git", "install"]).expect(0);
    repository.egg(&["git", "uninstall"]).expect(0);
    assert_eq!(repository.git(&["diff", "--", plan]), plain);
    assert!(
        !repository
            .git(&["config", "--local", "--list"])
            .contains("diff.egg")
    );
}

#[test]
fn attributes_of_others_stay() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    workshop.write("repo/.gitattributes", "*.png binary\n");
    repository
        .egg(&["git", "install", "--attributes", "shared"])
        .expect(0);
    let read = || std::fs::read_to_string(workshop.path("repo/.gitattributes")).expect("a file");
    assert!(read().starts_with("*.png binary\n"));
    assert!(read().contains("plan.ron diff=egg linguist-generated\n"));
    repository.egg(&["git", "uninstall"]).expect(0);
    assert_eq!(read(), "*.png binary\n");
}

#[test]
fn outside_of_a_repository_there_is_nothing_to_install() {
    let workshop = Workshop::new();
    let repository = Repository {
        workshop: &workshop,
        folder: "",
    };
    let ran = repository.egg(&["git", "install"]).expect(2);
    assert!(ran.err.contains("E0821"), "{}", ran.err);
}

#[test]
fn a_file_that_is_neither_is_shown_as_it_is() {
    let workshop = Workshop::new();
    workshop.write("x.dxf", "no drawing\n");
    let ran = workshop.egg(&["git", "textconv", "x.dxf"]).expect(0);
    assert_eq!(ran.out, "no drawing\n");
    assert!(ran.err.contains("E0828"), "{}", ran.err);
    workshop.write("plan.ron", "(\n  format: 99,\n)\n");
    let ran = workshop.egg(&["git", "textconv", "plan.ron"]).expect(0);
    assert!(ran.err.contains("E0829"), "{}", ran.err);
}
