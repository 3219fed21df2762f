//! Input files: known by their contents, read when they are needed.

use crate::workshop::{Workshop, ran};
use egg::build::{
    Built, CancelToken, Clock, Engine, Force, Graph, Numerics, Request, SourceFile, Stage,
};
use egg::diagnostics::Warned;
use std::fs;
use std::path::Path;
use std::time::{Duration, SystemTime};

const COUNT: Stage<SourceFile, (), usize> = Stage {
    name: "count",
    version: 1,
    numerics: Numerics::Portable,
    run: |file, (), _| {
        Ok(Warned {
            value: file.bytes()?.len(),
            warnings: vec![],
        })
    },
};

fn build(engine: &mut Engine, file: &SourceFile, force: Force) -> Built {
    let request = Request {
        force,
        ..Request::default()
    };
    let declare = |g: &mut Graph<'_>| {
        let node = g.add(&COUNT, "", file.clone(), ());
        g.origin(node, "", "surface.mesh");
    };
    engine.build(&request, &declare, &CancelToken::default(), &mut |_| {})
}

fn count(workshop: &Workshop, path: &Path) -> Built {
    let mut engine = workshop.engine();
    let file = engine.source(path).expect("a file");
    build(&mut engine, &file, Force::Nothing)
}

#[test]
fn contents_decide_and_nothing_else() {
    let workshop = Workshop::new();
    let path = workshop.path().join("mesh.obj");
    fs::write(&path, "v 1 2 3").expect("written");
    assert_eq!(ran(&count(&workshop, &path)), ["count"]);
    assert!(ran(&count(&workshop, &path)).is_empty());
    // Touched.
    let file = fs::File::options()
        .append(true)
        .open(&path)
        .expect("opened");
    file.set_modified(SystemTime::UNIX_EPOCH).expect("set");
    assert!(ran(&count(&workshop, &path)).is_empty());
    // Moved.
    let moved = workshop.path().join("other.obj");
    fs::rename(&path, &moved).expect("renamed");
    assert!(ran(&count(&workshop, &moved)).is_empty());
    // Edited, with the same length.
    fs::write(&moved, "v 1 2 4").expect("written");
    let built = count(&workshop, &moved);
    assert_eq!(ran(&built), ["count"]);
    let reason = built.stages[0].reasons[0].to_string();
    assert!(reason.starts_with("surface.mesh #"), "{reason}");
}

#[test]
fn an_edit_is_found_even_if_length_and_time_are_kept() {
    let mut workshop = Workshop::new();
    // As if everything had rested for long, so that stamps are trusted.
    workshop.settings.clock = Clock::Stopped(SystemTime::now() + Duration::from_secs(60));
    let path = workshop.path().join("mesh.obj");
    fs::write(&path, "one").expect("written");
    let time = fs::metadata(&path)
        .expect("there")
        .modified()
        .expect("a time");
    count(&workshop, &path);
    fs::write(&path, "two").expect("written");
    let file = fs::File::options()
        .append(true)
        .open(&path)
        .expect("opened");
    file.set_modified(time).expect("set");
    let mut engine = workshop.engine();
    let found = engine.source(&path).expect("a file");
    assert_eq!(&*found.bytes().expect("read"), b"two");
}

#[test]
#[cfg(unix)]
fn a_file_that_rests_is_not_even_read() {
    let mut workshop = Workshop::new();
    let path = workshop.path().join("mesh.obj");
    fs::write(&path, "v 1 2 3").expect("written");
    for rested in [false, true] {
        let later = if rested { 60 } else { 0 };
        let now = SystemTime::now() + Duration::from_secs(later);
        workshop.settings.clock = Clock::Stopped(now);
        count(&workshop, &path);
        let mut engine = workshop.engine();
        let file = engine.source(&path).expect("a file");
        let aside = workshop.path().join("aside");
        fs::rename(&path, &aside).expect("renamed");
        let built = build(&mut engine, &file, Force::Selected);
        let codes: Vec<_> = built
            .diagnostics
            .iter()
            .map(|told| told.code.as_str())
            .collect();
        // Only a file that was not read beforehand can be missed now.
        assert_eq!(codes, if rested { vec!["E0807"] } else { vec![] });
        fs::rename(&aside, &path).expect("renamed");
    }
}

#[test]
#[cfg(unix)]
fn a_file_that_is_saved_while_it_is_compiled_fails_for_now() {
    let mut workshop = Workshop::new();
    workshop.settings.clock = Clock::Stopped(SystemTime::now() + Duration::from_secs(60));
    let path = workshop.path().join("mesh.obj");
    fs::write(&path, "v 1 2 3").expect("written");
    count(&workshop, &path);
    let mut engine = workshop.engine();
    let file = engine.source(&path).expect("a file");
    fs::write(&path, "v 1 2 3 4").expect("written");
    let built = build(&mut engine, &file, Force::Selected);
    assert_eq!(built.diagnostics[0].code.as_str(), "E0808");
    let built = count(&workshop, &path);
    assert!(built.succeeded());
    assert_eq!(built.output(&COUNT, "").as_deref(), Some(&9));
}

#[test]
fn a_file_that_is_not_there_is_an_error_at_once() {
    let workshop = Workshop::new();
    assert!(
        workshop
            .engine()
            .source(&workshop.path().join("no.obj"))
            .is_err()
    );
    let bytes: &[u8] = b"abc";
    let given = SourceFile::from_bytes("given.obj", bytes);
    assert_eq!(given.path(), Path::new("given.obj"));
    assert_eq!(given.digest(), egg::build::Digest::of(b"abc"));
}

#[test]
fn one_engine_builds_again_and_again() {
    let workshop = Workshop::new();
    let path = workshop.path().join("mesh.obj");
    let mut engine = workshop.engine();
    for length in 1..5 {
        fs::write(&path, "x".repeat(length)).expect("written");
        for runs in [1, 0] {
            let file = engine.source(&path).expect("a file");
            let built = build(&mut engine, &file, Force::Nothing);
            assert_eq!(ran(&built).len(), runs);
            assert_eq!(built.output(&COUNT, "").as_deref(), Some(&length));
        }
    }
}
