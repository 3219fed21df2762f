//! What happens in the output directory.

use crate::project::{Design, Patch};
use crate::workshop::{Workshop, clean, ran};
use egg::build::{
    Built, CancelToken, Files, Foreign, Graph, MANIFEST, Numerics, OutputCheck, Reason, Request,
    Stage,
};
use egg::diagnostics::Warned;
use std::fs;
use std::time::{Duration, SystemTime};

/// Publishes files as they are given: path and contents.
const WRITE: Stage<Vec<(String, String)>, (), Files> = Stage {
    name: "write",
    version: 1,
    numerics: Numerics::Portable,
    run: |files, (), _| {
        let mut value = Files::new();
        for (path, text) in files {
            value.push(path, text.as_str());
        }
        Ok(Warned {
            value,
            warnings: vec![],
        })
    },
};

/// Builds one publishing instance for each list of files.
fn publish(workshop: &Workshop, request: &Request, lists: &[&[(&str, &str)]]) -> Built {
    let declare = |g: &mut Graph| {
        for (index, files) in lists.iter().enumerate() {
            let own = |(path, text): &(&str, &str)| ((*path).to_owned(), (*text).to_owned());
            let files = files.iter().map(own).collect();
            let node = g.add(&WRITE, index.to_string(), files, ());
            g.publish(node);
        }
    };
    workshop
        .engine()
        .build(request, &declare, &CancelToken::default(), &mut |_| {})
}

fn codes(built: &Built) -> Vec<&str> {
    built
        .diagnostics
        .iter()
        .map(|told| told.code.as_str())
        .collect()
}

#[test]
fn files_that_are_no_longer_made_are_removed_with_their_empty_folders() {
    let workshop = Workshop::new();
    let whole = Request::default();
    publish(&workshop, &whole, &[&[("a/b/x.txt", "x"), ("y.txt", "y")]]);
    let built = publish(&workshop, &whole, &[&[("y.txt", "y")]]);
    assert_eq!(built.publication.removed, ["a/b/x.txt"]);
    assert!(!workshop.settings.output.join("a").exists());
    let built = publish(&workshop, &whole, &[]);
    assert_eq!(built.publication.removed, ["y.txt"]);
}

#[test]
fn a_file_becomes_a_folder_and_a_folder_a_file() {
    let workshop = Workshop::new();
    let whole = Request::default();
    for files in [[("a", "x")], [("a/b", "x")], [("a", "y")]] {
        let built = publish(&workshop, &whole, &[&files]);
        assert!(built.succeeded(), "{:?}", built.diagnostics);
        let outputs = workshop.outputs();
        assert_eq!(
            outputs.get(files[0].0).map(Vec::as_slice),
            Some(files[0].1.as_bytes())
        );
        assert_eq!(outputs.len(), 2, "the manifest beside it");
    }
}

#[test]
fn untouched_files_keep_their_times() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let path = workshop.settings.output.join("drawings/p0.svg");
    let before = fs::metadata(&path)
        .expect("published")
        .modified()
        .expect("a time");
    std::thread::sleep(Duration::from_millis(20));
    design.patches[1].members = 9;
    let built = workshop.build(&design);
    assert!(
        built
            .publication
            .written
            .contains(&"drawings/p1.svg".to_owned())
    );
    let after = fs::metadata(&path)
        .expect("published")
        .modified()
        .expect("a time");
    assert_eq!(before, after);
}

#[test]
fn a_lost_file_is_written_again_without_running_anything() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    let path = workshop.settings.output.join("bom.csv");
    fs::remove_file(&path).expect("removed");
    let plan = workshop.plan(&design);
    let planned = plan
        .stages
        .iter()
        .find(|stage| stage.instance.stage == "bom");
    let lost = Reason::OutputMissing {
        path: "bom.csv".into(),
    };
    assert_eq!(planned.expect("planned").reasons, [lost]);
    assert!(!plan.is_idle());
    let built = workshop.build(&design);
    assert!(ran(&built).is_empty());
    assert_eq!(built.publication.written, ["bom.csv"]);
    assert_eq!(workshop.outputs(), clean(&design));
}

#[test]
fn what_a_killed_build_left_behind_goes_even_if_there_is_nothing_to_write() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    for name in [".egg-tmp-a1b2c3", "drawings/.egg-tmp-d4e5f6"] {
        fs::write(workshop.settings.output.join(name), "half").expect("written");
    }
    let built = workshop.build(&design);
    assert!(built.succeeded() && ran(&built).is_empty());
    assert!(built.publication.written.is_empty() && built.publication.removed.is_empty());
    assert_eq!(workshop.outputs(), clean(&design));
}

#[test]
fn an_edited_file_is_replaced_with_a_warning() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    fs::write(workshop.settings.output.join("bom.csv"), "mine").expect("written");
    let built = workshop.build(&design);
    assert_eq!(codes(&built), ["W0804"]);
    assert!(built.succeeded(), "a warning is no failure");
    assert_eq!(workshop.outputs(), clean(&design));
}

#[test]
fn an_edit_that_keeps_size_and_time_is_found_by_contents() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    let path = workshop.settings.output.join("bom.csv");
    let time = fs::metadata(&path)
        .expect("published")
        .modified()
        .expect("a time");
    let mut bytes = fs::read(&path).expect("published");
    bytes[0] ^= 1;
    fs::write(&path, bytes).expect("written");
    let file = fs::File::options()
        .append(true)
        .open(&path)
        .expect("opened");
    file.set_modified(time).expect("set");
    let request = Request {
        outputs: OutputCheck::Contents,
        ..Request::default()
    };
    let built = workshop.request(&design, &request);
    assert_eq!(built.publication.written, ["bom.csv"]);
}

#[test]
fn a_file_that_was_only_touched_is_left_alone() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    let path = workshop.settings.output.join("bom.csv");
    let file = fs::File::options()
        .append(true)
        .open(&path)
        .expect("opened");
    let long_ago = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000);
    file.set_modified(long_ago).expect("set");
    assert!(workshop.plan(&design).is_idle());
    let built = workshop.build(&design);
    assert!(built.publication.written.is_empty());
    let time = fs::metadata(&path)
        .expect("published")
        .modified()
        .expect("a time");
    assert_eq!(time, long_ago);
}

#[test]
fn a_foreign_file_is_never_touched_unless_asked_for() {
    let workshop = Workshop::new();
    let output = &workshop.settings.output;
    fs::create_dir_all(output).expect("made");
    fs::write(output.join("notes.txt"), "mine").expect("written");
    fs::write(output.join("x.txt"), "mine").expect("written");
    let lists: &[&[(&str, &str)]] = &[&[("x.txt", "x"), ("w.txt", "w")], &[("y.txt", "y")]];
    let built = publish(&workshop, &Request::default(), lists);
    assert_eq!(codes(&built), ["E0813"]);
    assert!(!built.succeeded());
    assert_eq!(built.publication.written, ["y.txt"], "others are published");
    assert_eq!(fs::read(output.join("x.txt")).expect("there"), b"mine");

    let request = Request {
        foreign: Foreign::Replace,
        ..Request::default()
    };
    let built = publish(&workshop, &request, lists);
    assert_eq!(built.publication.written, ["w.txt", "x.txt"]);
    publish(&workshop, &Request::default(), &[]);
    let left: Vec<String> = workshop.outputs().into_keys().collect();
    assert_eq!(left, [MANIFEST, "notes.txt"]);
}

#[test]
fn a_foreign_file_with_the_right_contents_is_adopted() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    // As in a clone of a repository that holds the outputs but not the manifest.
    fs::remove_file(workshop.settings.output.join(MANIFEST)).expect("removed");
    fs::remove_dir_all(&workshop.settings.cache).expect("removed");
    let built = workshop.build(&design);
    assert!(built.succeeded(), "{:?}", built.diagnostics);
    assert!(built.publication.written.is_empty());
    assert_eq!(workshop.outputs(), clean(&design));
}

#[test]
fn an_edited_file_that_is_no_longer_made_stays() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let path = workshop.settings.output.join("drawings/p2.svg");
    fs::write(&path, "mine").expect("written");
    design.patches.pop();
    let built = workshop.build(&design);
    assert_eq!(codes(&built), ["W0805"]);
    assert_eq!(fs::read(&path).expect("there"), b"mine");
    // From now on it is the user's.
    let again = workshop.build(&design);
    assert!(again.diagnostics.is_empty());
    design.patches.push(Patch {
        name: "p2".into(),
        corner: 2.0,
        members: 7,
    });
    assert_eq!(codes(&workshop.build(&design)), ["E0813"]);
}

#[test]
fn outputs_that_exclude_each_other_are_errors() {
    let cases: [&[&[(&str, &str)]]; 3] = [
        &[&[("a.txt", "x")], &[("A.TXT", "y")]],
        &[&[("a", "x"), ("a/b", "y")]],
        &[&[("a.txt", "x"), ("a.txt", "x")]],
    ];
    for lists in cases {
        let workshop = Workshop::new();
        let built = publish(&workshop, &Request::default(), lists);
        assert_eq!(codes(&built), ["E0812"], "{lists:?}");
        assert!(built.publication.written.is_empty());
    }
}

#[test]
fn paths_that_lead_out_of_the_directory_or_exist_nowhere_are_errors() {
    let paths = [
        "../x",
        "/x",
        "a/../../x",
        "a//b",
        "",
        "a\\b",
        "c:x",
        "con",
        "a/NUL.txt",
        "a.",
        "x\n",
        ".egg-manifest",
        "what?",
    ];
    for path in paths {
        let workshop = Workshop::new();
        let built = publish(&workshop, &Request::default(), &[&[(path, "x")]]);
        assert_eq!(codes(&built), ["E0811"], "{path:?}");
        assert!(workshop.outputs().is_empty());
    }
}

#[test]
fn a_directory_that_cannot_be_written_is_an_error_with_the_path() {
    let mut workshop = Workshop::new();
    workshop.settings.output = "/proc/egg".into();
    let built = publish(&workshop, &Request::default(), &[&[("x.txt", "x")]]);
    assert_eq!(codes(&built), ["E0814"]);
    let workshop = Workshop::new();
    // A file of the user where a folder is wanted.
    fs::create_dir_all(&workshop.settings.output).expect("made");
    fs::write(workshop.settings.output.join("a"), "mine").expect("written");
    let built = publish(&workshop, &Request::default(), &[&[("a/x.txt", "x")]]);
    assert!(!built.succeeded());
    assert_eq!(
        fs::read(workshop.settings.output.join("a")).expect("there"),
        b"mine"
    );
}

#[test]
fn the_manifest_says_nothing_about_times_or_places() {
    let (one, two) = (Workshop::new(), Workshop::new());
    let design = Design::default();
    one.build(&design);
    std::thread::sleep(Duration::from_millis(5));
    two.build(&design);
    let (one, two) = (one.outputs(), two.outputs());
    assert_eq!(one[MANIFEST], two[MANIFEST]);
    let text = String::from_utf8(one[MANIFEST].clone()).expect("text");
    let first = text.lines().nth(1).expect("a line");
    assert!(first.ends_with("\tbom\tbom.csv"), "{first}");
}

#[test]
fn a_manifest_that_cannot_be_read_protects_everything() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    fs::write(
        workshop.settings.output.join(MANIFEST),
        b"\xff\x00 nonsense",
    )
    .expect("written");
    design.patches.pop();
    let built = workshop.build(&design);
    assert!(
        built.publication.removed.is_empty(),
        "nobody knows whose it is"
    );
    assert!(workshop.outputs().contains_key("drawings/p2.svg"));
}

#[test]
fn a_name_that_changes_in_case_only_leaves_one_file() {
    let workshop = Workshop::new();
    publish(&workshop, &Request::default(), &[&[("West.txt", "x")]]);
    let built = publish(&workshop, &Request::default(), &[&[("west.txt", "x")]]);
    assert!(built.succeeded(), "{:?}", built.diagnostics);
    assert_eq!(
        workshop.outputs().len(),
        2,
        "{:?}",
        workshop.outputs().keys()
    );
}
