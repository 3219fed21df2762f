//! `plan.lock`: what a project gives, a line a part.

use crate::edit::{EDITS, Project};
use crate::program::Workshop;
use egg::diff::{Content, Context, Lock, between, lock_text};
use egg::plan::from_ron;

fn locked() -> Workshop {
    let workshop = Workshop::new();
    Project::bays().write(&workshop, ".");
    workshop.egg(&["lock"]).expect(0);
    workshop
}

fn text(workshop: &Workshop) -> String {
    std::fs::read_to_string(workshop.path("plan.lock")).expect("a lock")
}

#[test]
fn a_project_is_held_to_its_lock() {
    let workshop = locked();
    workshop.egg(&["check", "--locked"]).expect(0);
    for (name, edit) in EDITS {
        if name == "mesh-vertex-a-hundredth" {
            // A lock is precise to as much; whether a digit of it changes is chance.
            continue;
        }
        edit(Project::bays()).write(&workshop, ".");
        let ran = workshop.egg(&["check", "--locked"]);
        match name {
            "comment" | "order-of-tables" | "units" => drop(ran.expect(0)),
            "project-renamed" => assert!(ran.expect(1).err.contains("E0833")),
            _ => assert!(ran.expect(1).err.contains("E0832"), "{name}"),
        }
    }
}

#[test]
fn a_lock_is_small_and_sorted_and_the_same_whenever_it_is_written() {
    let workshop = locked();
    let first = text(&workshop);
    for line in first.lines().skip(1) {
        assert!(line.len() <= 130, "{line}");
    }
    workshop.egg(&["lock"]).expect(0);
    assert_eq!(text(&workshop), first);
    workshop.egg(&["build"]).expect(0);
    let plan = std::fs::read_to_string(workshop.path("build/bays/plan.ron")).expect("a plan");
    let plan = from_ron(&plan).expect("a plan");
    assert_eq!(
        lock_text(&plan),
        first,
        "a plan that was written and read gives the same lock"
    );
}

#[test]
fn a_lock_and_its_plan_do_not_differ() {
    let workshop = locked();
    let ran = workshop.egg(&["diff", "plan.lock"]).expect(0);
    assert!(ran.out.contains("no part changes"), "{}", ran.out);
    let lock = Lock::read(&text(&workshop)).expect("a lock");
    let difference = between(
        Content::Lock(&lock),
        Content::Lock(&lock),
        Context::default(),
    );
    assert_eq!(difference.changes, []);
}

#[test]
fn a_stale_lock_says_what_is_stale() {
    let workshop = locked();
    Project::bays()
        .with("width = 20", "width = 22")
        .write(&workshop, ".");
    let ran = workshop.egg(&["check", "--locked"]).expect(1);
    assert!(ran.err.contains("width 20 -> 22 mm"), "{}", ran.err);
    let ran = workshop
        .egg(&["diff", "plan.lock", "--exit-code"])
        .expect(3);
    assert!(
        ran.out.contains("to cut: 18 of 18 lamellae anew"),
        "{}",
        ran.out
    );
    workshop.egg(&["lock"]).expect(0);
    workshop.egg(&["check", "--locked"]).expect(0);
}

#[test]
fn what_is_wrong_with_a_lock_is_told() {
    let workshop = Workshop::new();
    Project::bays().write(&workshop, ".");
    let said = |code: &str| {
        let ran = workshop.egg(&["check", "--locked"]).expect(1);
        assert!(ran.err.contains(code), "{}", ran.err);
    };
    said("E0831");
    workshop.write("plan.lock", "# egg plan lock, format 1.\n<<<<<<< HEAD\n");
    said("E0830");
    workshop.write("plan.lock", "# egg plan lock, format 9.\n");
    said("E0829");
    workshop.write(
        "plan.lock",
        "# egg plan lock, format 1.\nstructure structure name=dome #1\n",
    );
    said("E0833");
    workshop.egg(&["lock"]).expect(1);
}
