//! Revisions: read from git objects, whatever kind of clone it is, and reported when they cannot be.

use crate::edit::Project;
use crate::program::{Workshop, files};
use crate::repository::Repository;

/// Whether the text tells that lamellae became wider, and by which edit.
fn is_wider(text: &str) -> bool {
    text.contains("lamella.width 20 -> 22") && text.contains("width +2 mm")
}

#[test]
fn the_working_tree_is_compared_with_head() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    let text = repository.egg(&["diff"]).expect(0).out;
    assert!(text.contains("no part changes"), "{text}");
    Project::bays()
        .with("width = 20", "width = 22")
        .write(&workshop, "repo");
    let text = repository.egg(&["diff"]).expect(0).out;
    assert!(text.contains("-> working tree"), "{text}");
    assert!(is_wider(&text), "{text}");
    let only_before = repository.egg(&["diff", "HEAD", "bays.toml"]).expect(0).out;
    assert_eq!(only_before, text);
}

#[test]
fn reading_revisions_touches_nothing() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    repository.commit(&Project::bays().with("width = 20", "width = 22"), "Wider");
    Project::bays()
        .with("width = 20", "width = 24")
        .write(&workshop, "repo");
    repository.egg(&["build"]).expect(0);
    let before = files(&workshop.path("repo"));
    repository.egg(&["diff", "HEAD~1", "HEAD"]).expect(0);
    repository.egg(&["diff"]).expect(0);
    repository.egg(&["check"]).expect(0);
    assert!(
        files(&workshop.path("repo")) == before,
        "files of the working tree changed"
    );
}

#[test]
fn exit_codes_tell_what_was_asked_for() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    repository.commit(&Project::bays().with("\"bays\"", "\"bay\""), "Rename");
    repository.egg(&["diff", "HEAD~1", "HEAD"]).expect(0);
    repository
        .egg(&["diff", "HEAD~1", "HEAD", "--exit-code"])
        .expect(0);
    repository
        .egg(&["diff", "HEAD~1", "HEAD", "--fail-on", "redraw"])
        .expect(3);
    Project::bays()
        .with("width = 20", "width = 22")
        .write(&workshop, "repo");
    repository.egg(&["diff", "--exit-code"]).expect(3);
    repository
        // The feet of two supports grow by a centimetre with it.
        .egg(&["diff", "--exit-code", "--tolerance", "15mm"])
        .expect(0);
    repository
        .egg(&["diff", "--tolerance", "3 parsecs"])
        .expect(2);
}

#[test]
fn a_bare_clone_is_enough() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    repository.commit(&Project::bays().with("width = 20", "width = 22"), "Wider");
    repository.git(&["clone", "--quiet", "--bare", ".", "../bare"]);
    let expected = repository.egg(&["diff", "HEAD~1", "HEAD"]).expect(0).out;
    let ran = repository
        .egg_in("bare", &["diff", "HEAD~1", "HEAD"])
        .expect(0);
    assert_eq!(ran.out, expected);
    let named = repository
        .egg_in("bare", &["diff", "HEAD~1..HEAD", "bays.toml"])
        .expect(0);
    assert!(is_wider(&named.out), "{}", named.out);
    let ran = repository
        .egg_in("bare", &["diff", "main~1...main"])
        .expect(0);
    assert!(is_wider(&ran.out), "{}", ran.out);
}

#[test]
fn a_project_in_a_folder_is_found_from_anywhere() {
    let workshop = Workshop::new();
    let repository = Repository::new(&workshop);
    Project::bays().write(&workshop, "repo/designs");
    repository.git(&["add", "--all"]);
    repository.git(&["commit", "--quiet", "--message", "Start"]);
    Project::bays()
        .with("width = 20", "width = 22")
        .write(&workshop, "repo/designs");
    for (folder, file) in [
        ("repo", "designs/bays.toml"),
        ("repo/designs", "bays.toml"),
        ("", "repo/designs/bays.toml"),
    ] {
        let ran = repository.egg_in(folder, &["diff", "HEAD", file]).expect(0);
        assert!(is_wider(&ran.out), "{folder}: {}", ran.out);
    }
    let ran = repository.egg_in("repo/designs", &["diff"]).expect(0);
    assert!(is_wider(&ran.out), "{}", ran.out);
}

#[test]
fn what_is_not_there_is_told_with_what_to_do() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    let ran = repository.egg(&["diff", "never", "HEAD"]).expect(2);
    assert!(
        ran.err.contains("E0822") && ran.err.contains("`never`"),
        "{}",
        ran.err
    );
    let ran = repository.egg(&["diff", "HEAD~9", "HEAD"]).expect(2);
    assert!(ran.err.contains("E0822"), "{}", ran.err);
    let ran = repository
        .egg(&["diff", "HEAD", "HEAD", "other.toml"])
        .expect(2);
    assert!(
        ran.err.contains("E0823") && ran.err.contains("other.toml"),
        "{}",
        ran.err
    );
    let ran = repository
        .egg(&["diff", "--", "--output=x", "HEAD"])
        .expect(2);
    assert!(ran.err.contains("E0822"), "{}", ran.err);
    Project::bays().write(&workshop, "elsewhere");
    let ran = repository.egg_in("elsewhere", &["diff"]).expect(2);
    assert!(ran.err.contains("E0821"), "{}", ran.err);
}

#[test]
fn a_shallow_clone_says_that_it_is_shallow() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    repository.commit(&Project::bays().with("width = 20", "width = 22"), "Wider");
    let url = format!("file://{}", workshop.path("repo").display());
    repository.git(&["clone", "--quiet", "--depth", "1", &url, "../shallow"]);
    let ran = repository
        .egg_in("shallow", &["diff", "HEAD~1", "HEAD"])
        .expect(2);
    assert!(
        ran.err.contains("E0822") && ran.err.contains("shallow"),
        "{}",
        ran.err
    );
}

#[test]
fn a_mesh_in_a_submodule_is_reported_as_such() {
    let workshop = Workshop::new();
    let meshes = Repository {
        workshop: &workshop,
        folder: "meshes",
    };
    workshop.write("meshes/bays.obj", Project::bays().mesh);
    meshes.git(&["init", "--quiet", "--initial-branch", "main"]);
    meshes.git(&["add", "--all"]);
    meshes.git(&["commit", "--quiet", "--message", "A mesh"]);
    let repository = Repository::new(&workshop);
    let url = format!("file://{}", workshop.path("meshes").display());
    repository.git(&["submodule", "--quiet", "add", &url, "shapes"]);
    let project = Project::bays().with("\"bays.obj\"", "\"shapes/bays.obj\"");
    workshop.write("repo/bays.toml", &project.text);
    repository.git(&["add", "--all"]);
    repository.git(&["commit", "--quiet", "--message", "A mesh of others"]);
    let ran = repository.egg(&["diff"]).expect(1);
    assert!(
        ran.err.contains("E0824") && ran.err.contains("`shapes`"),
        "{}",
        ran.err
    );
}

#[test]
fn a_pointer_of_lfs_is_read_from_the_clone_or_reported() {
    let workshop = Workshop::new();
    let repository = Repository::new(&workshop);
    let mesh = Project::bays().mesh;
    let digest = "0f".repeat(32);
    let pointer = format!(
        "version https://git-lfs.github.com/spec/v1\noid sha256:{digest}\nsize {}\n",
        mesh.len()
    );
    let project = Project {
        mesh: pointer,
        ..Project::bays()
    };
    repository.commit(&project, "A mesh in LFS");
    Project::bays()
        .with("width = 20", "width = 22")
        .write(&workshop, "repo");
    let ran = repository.egg(&["diff"]).expect(1);
    assert!(
        ran.err.contains("E0825") && ran.err.contains("git lfs fetch"),
        "{}",
        ran.err
    );
    workshop.write(&format!("repo/.git/lfs/objects/0f/0f/{digest}"), mesh);
    let ran = repository.egg(&["diff"]).expect(0);
    assert!(is_wider(&ran.out), "{}", ran.out);
}

#[test]
fn a_side_that_does_not_compile_is_told_and_its_lock_is_compared() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    let broken = Project::bays().with("\"poplar-plywood\"", "\"unobtainium\"");
    broken.write(&workshop, "repo");
    let ran = repository.egg(&["diff"]).expect(1);
    assert!(
        ran.err.contains("E0827") && ran.err.contains("unobtainium"),
        "{}",
        ran.err
    );
    assert!(
        ran.err.contains("`lamella.material` was edited"),
        "{}",
        ran.err
    );

    Project::bays().write(&workshop, "repo");
    repository.egg(&["lock"]).expect(0);
    repository.commit(&broken, "Break it, with the lock of before");
    let fixed = Project::bays().with("width = 20", "width = 22");
    repository.commit(&fixed, "Mend it");
    let ran = repository.egg(&["diff", "HEAD~1", "HEAD"]).expect(1);
    assert!(ran.err.contains("unobtainium"), "{}", ran.err);
    assert!(
        ran.out
            .contains("does not compile; its committed `plan.lock`"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("width 20 -> 22 mm"), "{}", ran.out);
}
