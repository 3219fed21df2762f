//! Edits with their golden text, Markdown and JSON.

use crate::edit::{EDITS, diff, tried};
use crate::program::Workshop;
use egg::diff::{Action, Class, Difference, Kind, Look, MARKDOWN_LIMIT, markdown, text};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// The differences of all edits, by their names. They share a cache.
fn differences() -> &'static BTreeMap<&'static str, Difference> {
    static DIFFERENCES: OnceLock<BTreeMap<&'static str, Difference>> = OnceLock::new();
    DIFFERENCES.get_or_init(|| {
        let workshop = Workshop::new();
        let each = EDITS.into_iter().map(|(name, edit)| {
            tried(&workshop, edit);
            let ran = diff(&workshop, &["--format", "json"]).expect(0);
            (name, Difference::from_json(&ran.out).expect("a difference"))
        });
        each.collect()
    })
}

fn of(name: &str) -> &'static Difference {
    &differences()[name]
}

fn golden(name: &str, text: &str) {
    insta::with_settings!({
        snapshot_path => "../golden/diff",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, { insta::assert_snapshot!(name, text) });
}

#[test]
fn every_edit_is_told_as_its_golden_text_says() {
    for (name, difference) in differences() {
        golden(&format!("{name}.txt"), &text(difference, Look::Plain));
    }
}

#[test]
fn every_edit_is_told_as_its_golden_markdown_says() {
    for (name, difference) in differences() {
        golden(&format!("{name}.md"), &markdown(difference, MARKDOWN_LIMIT));
    }
}

/// Drawings are judged by the page and by readers of SVG; beyond some changes more of the same
/// prove nothing.
#[test]
fn every_edit_is_told_as_its_golden_json_says() {
    for (name, difference) in differences() {
        let mut shown = difference.clone();
        shown.drawings.clear();
        shown.changes.truncate(6);
        golden(&format!("{name}.json"), &shown.to_json());
    }
}

#[test]
fn every_text_tells_what_to_cut_in_one_screen() {
    for (name, difference) in differences() {
        let text = text(difference, Look::Plain);
        let lines = text.lines().count();
        assert!(lines <= 60, "{name}: {lines} lines");
        let verdict = text.lines().nth(1).expect("a verdict");
        if difference.summary.class.is_some() {
            assert_eq!(
                text.matches(verdict).count(),
                2,
                "{name}: first and last\n{text}"
            );
        }
    }
}

#[test]
fn edits_that_change_no_part_say_so() {
    for name in ["comment", "order-of-tables", "units"] {
        let difference = of(name);
        assert_eq!(difference.changes, [], "{name}");
        assert_eq!(difference.summary.class, None, "{name}");
    }
    assert!(!of("units").edits.is_empty());
    assert!(of("comment").edits.is_empty() && of("order-of-tables").edits.is_empty());
}

#[test]
fn a_hundredth_of_a_millimetre_is_noise_that_is_told() {
    let difference = of("mesh-vertex-a-hundredth");
    assert!(
        !difference.has(Class::Reassemble),
        "{:?}",
        difference.changes
    );
    let hidden = difference.summary.hidden.iter();
    let lengths = hidden.filter(|hidden| hidden.unit == "mm").count();
    assert_eq!(lengths, 1);
    assert!(
        difference
            .edits
            .iter()
            .any(|edit| edit.key == "surface.mesh")
    );
}

#[test]
fn names_are_no_parts() {
    for (name, what) in [("patch-renamed", "patch"), ("point-renamed", "point")] {
        let difference = of(name);
        assert!(
            !difference.has(Class::Reassemble),
            "{name}: {:?}",
            difference.changes
        );
        assert_eq!(difference.renames.len(), 1, "{name}");
        assert_eq!(difference.renames[0].what, what);
        let removed = difference.changes.iter().filter(|change| {
            matches!(change.action, Action::Added | Action::Removed) && change.kind != Kind::Sheet
        });
        assert_eq!(removed.count(), 0, "{name}");
    }
}

#[test]
fn a_renamed_and_changed_patch_is_told_as_both() {
    let difference = of("patch-renamed-and-widened");
    assert_eq!(difference.renames.len(), 1);
    let lamella = difference
        .changes
        .iter()
        .find(|change| change.kind == Kind::Lamella && change.id == "shore.u02")
        .expect("it is wider");
    assert_eq!(lamella.previous_id.as_deref(), Some("west.u02"));
    assert_eq!(lamella.class, Class::Recut);
    assert!(lamella.fields.iter().any(|field| field.name == "width"));
}

#[test]
fn what_has_to_be_cut_is_counted() {
    let lamellae = |name: &str| {
        let counts = &of(name).summary.counts;
        counts
            .iter()
            .find(|count| count.what == "lamellae")
            .expect("lamellae")
            .clone()
    };
    for name in ["lamella-width", "material", "bolt"] {
        let count = lamellae(name);
        assert_eq!(
            (count.recut, count.added, count.removed),
            (18, 0, 0),
            "{name}"
        );
    }
    let count = lamellae("member-count");
    assert_eq!((count.added, count.removed), (1, 0));
    assert_eq!(count.recut + count.same + count.noise + count.redraw, 18);
    let count = lamellae("patch-added");
    // The strip through all three patches is distributed anew.
    assert_eq!((count.added, count.removed), (7, 0));
    let count = lamellae("patch-removed");
    assert_eq!((count.added, count.removed), (0, 9));
    let count = lamellae("thickness-of-a-patch");
    assert_eq!((count.recut, count.same), (9, 9));
}

#[test]
fn money_and_panels_cut_nothing() {
    for name in ["kerf", "price", "sheet-size"] {
        let difference = of(name);
        assert!(
            !difference.has(Class::Reassemble),
            "{name}: {:?}",
            difference.changes
        );
        assert!(!difference.edits.is_empty(), "{name}");
    }
    assert!(of("price").has(Class::Redraw) && of("sheet-size").has(Class::Redraw));
}

/// A difference backwards adds what it removed and the other way round.
#[test]
fn a_difference_backwards_is_its_mirror() {
    let workshop = Workshop::new();
    tried(&workshop, EDITS[6].1);
    let there = diff(&workshop, &["--format", "json"]).expect(0);
    let back = workshop
        .egg(&[
            "diff",
            "after/bays.toml",
            "before/bays.toml",
            "--format",
            "json",
        ])
        .expect(0);
    let [there, back] = [there, back].map(|ran| Difference::from_json(&ran.out).expect("json"));
    for (a, b) in there.summary.counts.iter().zip(&back.summary.counts) {
        assert_eq!(
            (a.added, a.removed, a.recut),
            (b.removed, b.added, b.recut),
            "{}",
            a.what
        );
        assert_eq!((a.before, a.after), (b.after, b.before), "{}", a.what);
    }
}
