//! Damage: whatever happens to the cache, the result is that of a clean build.

use crate::project::Design;
use crate::workshop::{Workshop, clean};
use egg::build::{Clock, How, Mode, Reason};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// One file of every kind that a cache has, with its kind's name.
fn one_of_each(workshop: &Workshop) -> Vec<(String, PathBuf)> {
    let root = workshop.settings.cache.join("v1");
    let mut found: Vec<(String, PathBuf)> = Vec::new();
    let mut paths = workshop.cache();
    paths.sort();
    for path in paths {
        let beside = path.strip_prefix(&workshop.settings.cache);
        let relative = path.strip_prefix(&root).or(beside).expect("of the cache");
        let kind = relative.iter().next().unwrap_or_default();
        let kind = kind.to_string_lossy().into_owned();
        // The largest blob is a map, which the edit below needs.
        match found.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, known)) if size(&path) > size(known) => *known = path,
            Some(_) => {}
            None => found.push((kind, path)),
        }
    }
    found
}

fn size(path: &Path) -> u64 {
    fs::metadata(path).map_or(0, |metadata| metadata.len())
}

/// Damages one file of the cache, edits the design so that much is read, and builds.
fn survives(kind: &str, damage: impl Fn(&Path)) -> Vec<String> {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let files = one_of_each(&workshop);
    let Some((_, path)) = files.iter().find(|(one, _)| one == kind) else {
        panic!("no {kind} in {files:?}");
    };
    damage(path);
    if kind == "traces" {
        // Otherwise the record of the last build knows everything.
        fs::remove_dir_all(workshop.settings.cache.join("v1/worktrees")).expect("removed");
    }
    for patch in &mut design.patches {
        patch.members += 1;
    }
    let built = workshop.build(&design);
    assert!(built.succeeded(), "{kind}: {:?}", built.diagnostics);
    assert_eq!(workshop.outputs(), clean(&design), "{kind}");
    let again = workshop.build(&design);
    assert_eq!(again.count(How::Cached), again.stages.len());
    assert!(again.diagnostics.is_empty(), "{:?}", again.diagnostics);
    let codes = built.diagnostics.iter().map(|told| told.code.to_string());
    codes.collect()
}

#[test]
fn one_flipped_byte_in_any_kind_of_file_is_found_and_repaired() {
    for kind in ["blobs", "traces", "worktrees"] {
        for part in 0..12 {
            let codes = survives(kind, |path| {
                let mut bytes = fs::read(path).expect("read");
                let at = (bytes.len() - 1) * part / 11;
                bytes[at] ^= 1 << (part % 8);
                fs::write(path, bytes).expect("written");
            });
            assert_eq!(codes, ["W0801"], "{kind}, part {part}");
        }
    }
    for kind in ["CACHEDIR.TAG", "lock", "collected"] {
        let workshop = Workshop::new();
        let design = Design::default();
        workshop.build(&design);
        let path = one_of_each(&workshop)
            .into_iter()
            .find(|(one, _)| one.contains(kind))
            .map(|(_, path)| path);
        fs::write(path.expect("there"), b"\xff").expect("written");
        assert_eq!(workshop.build(&design).count(How::Cached), 21, "{kind}");
    }
}

#[test]
fn truncated_empty_lost_and_foreign_files_are_repaired() {
    for kind in ["blobs", "traces", "worktrees"] {
        for length in [0, 7, 48, 49, 100] {
            let codes = survives(kind, |path| {
                let bytes = fs::read(path).expect("read");
                fs::write(path, &bytes[..length.min(bytes.len() - 1)]).expect("written");
            });
            assert_eq!(codes, ["W0801"], "{kind} of {length} bytes");
        }
        let codes = survives(kind, |path| fs::remove_file(path).expect("removed"));
        assert!(codes.is_empty(), "what is missing is no damage");
        let codes = survives(kind, |path| {
            fs::remove_file(path).expect("removed");
            fs::create_dir(path).expect("made");
        });
        assert_eq!(codes, ["W0801"], "{kind} is a folder");
    }
}

#[test]
fn a_whole_file_under_another_name_is_no_hit() {
    for kind in ["blobs", "traces"] {
        let workshop = Workshop::new();
        let mut design = Design::default();
        workshop.build(&design);
        let root = workshop.settings.cache.join("v1");
        let mut paths = workshop.cache();
        paths.retain(|path| path.starts_with(root.join(kind)));
        paths.sort();
        // Every file has the contents of its neighbour.
        let contents: Vec<_> = paths
            .iter()
            .map(|path| fs::read(path).expect("read"))
            .collect();
        for (path, bytes) in paths.iter().zip(contents.iter().cycle().skip(1)) {
            fs::write(path, bytes).expect("written");
        }
        fs::remove_dir_all(root.join("worktrees")).expect("removed");
        design.modulus = 1e9;
        let built = workshop.build(&design);
        assert!(built.succeeded(), "{:?}", built.diagnostics);
        assert_eq!(workshop.outputs(), clean(&design), "{kind}");
    }
}

#[test]
fn damage_is_a_reason_and_the_damaged_file_is_set_aside() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let (_, path) = one_of_each(&workshop)
        .into_iter()
        .find(|(kind, _)| kind == "blobs")
        .expect("there");
    fs::write(&path, b"nonsense").expect("written");
    design.modulus = 1e9;
    let built = workshop.build(&design);
    let again = built
        .stages
        .iter()
        .find(|stage| stage.reasons == [Reason::EntryDamaged])
        .expect("made again");
    assert_eq!(again.how, How::Ran);
    let quarantine = workshop.settings.cache.join("v1/quarantine");
    assert_eq!(fs::read_dir(quarantine).expect("there").count(), 1);
    assert!(
        workshop
            .engine()
            .store()
            .verify(Mode::DryRun)
            .damaged
            .is_empty()
    );
}

#[test]
fn a_plan_sees_which_lost_values_have_to_be_made_again() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    fs::remove_dir_all(workshop.settings.cache.join("v1/blobs")).expect("removed");
    assert!(workshop.plan(&design).is_idle(), "nobody needs the values");
    design.modulus = 1e9;
    let plan = workshop.plan(&design);
    let missing = plan
        .stages
        .iter()
        .filter(|stage| stage.reasons == [Reason::EntryMissing])
        .map(|stage| stage.instance.to_string());
    // Members are short enough to be kept with their records.
    assert_eq!(
        missing.collect::<Vec<_>>(),
        ["maps p0", "maps p1", "maps p2"]
    );
    let built = workshop.build(&design);
    assert!(built.succeeded());
    assert_eq!(workshop.outputs(), clean(&design));
}

#[test]
fn without_a_cache_everything_is_computed_and_published() {
    let mut workshop = Workshop::new();
    workshop.settings.cache = "/proc/egg".into();
    let design = Design::default();
    for _ in 0..2 {
        let built = workshop.build(&design);
        assert!(built.succeeded());
        assert_eq!(built.count(How::Ran), 21);
        let codes: Vec<_> = built
            .diagnostics
            .iter()
            .map(|told| told.code.as_str())
            .collect();
        assert_eq!(codes, ["W0802"]);
        assert_eq!(workshop.outputs(), clean(&design));
    }
    // A file where the directory should be.
    let path = workshop.path().join("file");
    fs::write(&path, "mine").expect("written");
    workshop.settings.cache = path.clone();
    assert!(workshop.build(&design).succeeded());
    assert_eq!(fs::read(path).expect("there"), b"mine");
}

#[test]
fn a_clock_that_jumps_changes_no_result() {
    let mut workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let now = SystemTime::now();
    let years = Duration::from_secs(10 * 365 * 24 * 3600);
    for (step, time) in [now - years, now + years, now].into_iter().enumerate() {
        workshop.settings.clock = Clock::Stopped(time);
        assert_eq!(workshop.build(&design).count(How::Cached), 21);
        design.price += 1.0;
        assert!(workshop.build(&design).succeeded());
        assert_eq!(workshop.outputs(), clean(&design), "step {step}");
    }
}
