//! Looking after the cache: bounded, never at the cost of what is in use.

use crate::project::Design;
use crate::workshop::{Workshop, files, ran};
use egg::build::{Built, CancelToken, Clock, Event, How, Limits, Mode, Request};
use std::fs;
use std::time::{Duration, SystemTime};

const DAY: Duration = Duration::from_secs(24 * 3600);

fn limits(size: u64, days: u32) -> Limits {
    Limits {
        size,
        age: DAY * days,
    }
}

/// Makes every entry of the cache look as if it had been written so long ago.
fn grow_old(workshop: &Workshop, age: Duration) {
    for path in workshop.cache() {
        if path
            .components()
            .any(|part| part.as_os_str() == "worktrees")
        {
            continue;
        }
        let file = fs::File::options().append(true).open(path).expect("opened");
        file.set_modified(SystemTime::now() - age).expect("set");
    }
}

/// A workshop with three states of a design behind it, of which the last is in use.
fn three_states() -> (Workshop, [Design; 3]) {
    let workshop = Workshop::new();
    let designs = [1.0, 2.0, 3.0].map(|first| {
        let mut design = Design::default();
        design.mesh[0] = first;
        design
    });
    for design in &designs {
        assert!(workshop.build(design).succeeded());
    }
    (workshop, designs)
}

#[test]
fn entries_go_by_age_but_not_those_in_use() {
    let (workshop, designs) = three_states();
    grow_old(&workshop, DAY * 40);
    let engine = workshop.engine();
    let store = engine.store();
    let now = SystemTime::now();
    let all = store.status();
    let dry = store.collect(&limits(u64::MAX, 30), now, Mode::DryRun);
    assert_eq!(store.status(), all, "a dry run touches nothing");
    let done = store.collect(&limits(u64::MAX, 30), now, Mode::Apply);
    assert_eq!(done, dry);
    assert!(!done.busy);
    assert!(done.removed.entries > 20, "{done:?}");
    assert!(ran(&workshop.build(&designs[2])).is_empty(), "in use");
    assert!(workshop.build(&designs[0]).count(How::Ran) > 10);
}

#[test]
fn what_was_in_use_until_now_is_young() {
    let (workshop, designs) = three_states();
    grow_old(&workshop, DAY * 40);
    // The third state leaves the record, and is stamped as it does.
    workshop.build(&designs[0]);
    let engine = workshop.engine();
    let collected = engine
        .store()
        .collect(&limits(u64::MAX, 30), SystemTime::now(), Mode::Apply);
    assert!(collected.removed.entries > 0);
    assert!(ran(&workshop.build(&designs[2])).is_empty());
}

#[test]
fn entries_go_by_size_the_longest_unused_first() {
    let (workshop, designs) = three_states();
    grow_old(&workshop, DAY * 2);
    let engine = workshop.engine();
    let store = engine.store();
    let before = store.status();
    let total = before.blobs.bytes + before.traces.bytes;
    let goal = limits(total * 7 / 10, 30);
    let collected = store.collect(&goal, SystemTime::now(), Mode::Apply);
    assert!(collected.removed.bytes >= total * 3 / 10);
    assert!(collected.kept.bytes <= goal.size);
    assert_eq!(collected.excess, 0);
    let after = store.status();
    assert_eq!(after.blobs.bytes + after.traces.bytes, collected.kept.bytes);
    assert!(ran(&workshop.build(&designs[2])).is_empty(), "in use");
    let nothing = store.collect(&limits(0, 30), SystemTime::now(), Mode::Apply);
    assert_eq!(
        nothing.excess, nothing.kept.bytes,
        "the rest is in use, and that is said"
    );
    assert!(ran(&workshop.build(&designs[2])).is_empty());
}

#[test]
fn nothing_younger_than_an_hour_goes() {
    let (workshop, _) = three_states();
    let engine = workshop.engine();
    let store = engine.store();
    store.forget(&workshop.settings.output, Mode::Apply);
    grow_old(&workshop, Duration::from_secs(3000));
    let none = store.collect(&limits(0, 0), SystemTime::now(), Mode::Apply);
    assert_eq!(none.removed.entries, 0);
    grow_old(&workshop, Duration::from_secs(3700));
    let all = store.collect(&limits(0, 0), SystemTime::now(), Mode::Apply);
    assert_eq!(all.kept.entries, 0);
}

#[test]
fn worktrees_that_nobody_builds_are_forgotten() {
    let (workshop, designs) = three_states();
    let engine = workshop.engine();
    let store = engine.store();
    assert_eq!(store.status().worktrees.len(), 1);
    assert_eq!(store.status().worktrees[0].instances, 21);
    let later = SystemTime::now() + DAY * 31;
    let collected = store.collect(&limits(u64::MAX, 30), later, Mode::Apply);
    assert_eq!(collected.worktrees, 1);
    assert_eq!(collected.kept.entries, 0);
    assert_eq!(workshop.build(&designs[2]).count(How::Ran), 21);
}

#[test]
fn a_build_that_only_looks_keeps_its_entries_in_use() {
    let (mut workshop, designs) = three_states();
    let later = SystemTime::now() + DAY * 20;
    workshop.settings.clock = Clock::Stopped(later);
    assert!(ran(&workshop.build(&designs[2])).is_empty());
    let engine = workshop.engine();
    engine
        .store()
        .collect(&limits(u64::MAX, 30), later + DAY * 20, Mode::Apply);
    assert!(ran(&workshop.build(&designs[2])).is_empty());
}

#[test]
fn nothing_is_collected_while_a_build_runs() {
    let (workshop, mut designs) = three_states();
    grow_old(&workshop, DAY * 40);
    designs[0].mesh[0] = 9.0;
    let store = workshop.engine();
    let mut busy = 0;
    workshop.engine().build(
        &Request::default(),
        &|g| designs[0].declare(g),
        &CancelToken::default(),
        &mut |event| {
            if matches!(event, Event::Started { .. }) {
                let all = limits(0, 0);
                let collected = store.store().collect(&all, SystemTime::now(), Mode::Apply);
                assert!(collected.busy);
                assert!(store.store().clean(Mode::Apply).busy);
                busy += 1;
            }
        },
    );
    assert!(busy > 10);
}

#[test]
fn the_collector_comes_by_itself_once_a_day() {
    let mut workshop = Workshop::new();
    workshop.settings.limits = limits(0, 30);
    let mut design = Design::default();
    let now = SystemTime::now();
    let mut build = |time: SystemTime| -> Built {
        workshop.settings.clock = Clock::Stopped(time);
        design.price += 1.0;
        workshop.build(&design)
    };
    assert_eq!(build(now).collected, None, "a new cache");
    assert_eq!(build(now + DAY / 2).collected, None);
    let collected = build(now + DAY * 2).collected.expect("due");
    assert!(collected.removed.entries > 0, "old prices: {collected:?}");
    assert_eq!(build(now + DAY * 2).collected, None);
}

#[test]
fn what_killed_processes_left_is_swept() {
    let (workshop, _) = three_states();
    let root = workshop.settings.cache.join("v1");
    fs::write(root.join("tmp/.egg-tmp-abc"), "half").expect("written");
    let store = workshop.engine();
    let later = SystemTime::now() + DAY;
    store
        .store()
        .collect(&Limits::default(), later, Mode::Apply);
    assert!(files(&root.join("tmp")).is_empty());
}

#[test]
fn a_finished_build_leaves_no_temporary_files() {
    let (workshop, _) = three_states();
    assert!(files(&workshop.settings.cache.join("v1/tmp")).is_empty());
}

#[test]
fn verifying_finds_every_damaged_file_and_sets_it_aside() {
    let (workshop, designs) = three_states();
    let engine = workshop.engine();
    let store = engine.store();
    assert!(store.verify(Mode::Apply).damaged.is_empty());
    let root = workshop.settings.cache.join("v1");
    let mut damaged = Vec::new();
    for kind in ["blobs", "traces", "worktrees"] {
        let mut paths = workshop.cache();
        paths.sort();
        let path = paths
            .into_iter()
            .find(|path| path.starts_with(root.join(kind)));
        let path = path.expect("there");
        let mut bytes = fs::read(&path).expect("read");
        let last = bytes.len() - 1;
        bytes[last] ^= 0x40;
        fs::write(&path, bytes).expect("written");
        let name = path.strip_prefix(&root).expect("below it");
        damaged.push(name.to_string_lossy().into_owned());
    }
    let named = |found: &egg::build::Verified| {
        let mut names: Vec<_> = found.damaged.iter().map(|one| one.file.clone()).collect();
        names.sort();
        names
    };
    damaged.sort();
    let dry = store.verify(Mode::DryRun);
    assert_eq!(named(&dry), damaged);
    let done = store.verify(Mode::Apply);
    assert_eq!(named(&done), damaged);
    assert_eq!(store.status().quarantined.entries, 3);
    assert!(store.verify(Mode::Apply).damaged.is_empty());
    assert!(workshop.build(&designs[2]).diagnostics.is_empty());
}

#[test]
fn verifying_counts_records_without_their_result() {
    let (workshop, _) = three_states();
    fs::remove_dir_all(workshop.settings.cache.join("v1/blobs")).expect("removed");
    let verified = workshop.engine().store().verify(Mode::Apply);
    assert!(verified.damaged.is_empty());
    assert!(verified.dangling >= 9, "{verified:?}");
}

#[test]
fn status_adds_up() {
    let (workshop, _) = three_states();
    let status = workshop.engine().store().status();
    let on_disk = |kind: &str| {
        let all = files(&workshop.settings.cache.join("v1").join(kind));
        (
            all.len(),
            all.values().map(|bytes| bytes.len() as u64).sum::<u64>(),
        )
    };
    assert_eq!(
        (status.traces.entries, status.traces.bytes),
        on_disk("traces")
    );
    assert_eq!((status.blobs.entries, status.blobs.bytes), on_disk("blobs"));
    assert_eq!(
        status.worktrees[0].directory,
        workshop.settings.output.to_string_lossy()
    );
    assert!(
        serde_json::to_string(&status)
            .expect("plain data")
            .contains("traces")
    );
}

#[test]
fn cleaning_empties_the_cache_and_leaves_the_outputs() {
    let (workshop, designs) = three_states();
    let outputs = workshop.outputs();
    let engine = workshop.engine();
    let store = engine.store();
    let dry = store.clean(Mode::DryRun);
    assert!(store.status().traces.entries > 0);
    let done = store.clean(Mode::Apply);
    assert_eq!(done, dry);
    assert_eq!(store.status().traces.entries, 0);
    assert_eq!(workshop.outputs(), outputs);
    let built = workshop.build(&designs[2]);
    assert_eq!(built.count(How::Ran), 21);
    assert!(built.publication.written.is_empty());
}

#[test]
fn looking_at_a_cache_that_is_not_there_makes_none() {
    let workshop = Workshop::new();
    let engine = workshop.engine();
    assert_eq!(engine.store().status().traces.entries, 0);
    assert!(engine.store().verify(Mode::Apply).damaged.is_empty());
    assert_eq!(engine.store().clean(Mode::Apply).removed.entries, 0);
    assert!(!workshop.settings.cache.exists());
}

#[test]
fn a_copied_cache_works_and_two_caches_merge_by_copying() {
    let (one, designs) = three_states();
    let mut two = Workshop::new();
    two.settings.cache = two.path().join("copy");
    for (name, bytes) in files(&one.settings.cache) {
        let path = two.settings.cache.join(name);
        fs::create_dir_all(path.parent().expect("below it")).expect("made");
        fs::write(path, bytes).expect("written");
    }
    for design in &designs {
        assert!(ran(&two.build(design)).is_empty());
    }
}
