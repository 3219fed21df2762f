//! Stickers, supports, workbook and step list, judged by independent readers.

mod common;

use common::job::Job;
use common::python;
use egg::diagnostics::{Diagnostic, Place};
use egg::fabrication::supports::{self, SupportInputs};
use egg::fabrication::{self, stickers};
use egg::project::model::{Shell, SupportKind, SupportPlaces, Supports};
use std::path::PathBuf;

fn pavilion_on_wedges() -> Job {
    let mut job = Job::pavilion();
    job.supports = Supports {
        at: SupportPlaces::Corners,
        kind: SupportKind::WedgeOnBlock,
        height: 0.12,
    };
    job.prepare();
    job
}

fn readers_of_hardware() -> PathBuf {
    python::venv(&[
        "ezdxf==1.4.*",
        "shapely==2.*",
        "trimesh==4.*",
        "lib3mf==2.*",
        "openpyxl==3.1.*",
    ])
}

#[test]
fn stickers_cover_every_contact_and_lie_on_their_cards_as_they_are_glued() {
    let python = readers_of_hardware();
    let script = |folder: &PathBuf| python::read(&python, "stickers.py", &[folder]);
    // Stickers, crossings that slide, sheets of foil.
    assert_eq!(
        script(&Job::desktop().write("desktop-foil")).trim(),
        "70 35 1"
    );
    assert_eq!(
        script(&Job::pavilion().write("pavilion-foil")).trim(),
        "130 65 11"
    );
}

#[test]
fn printed_feet_are_closed_solids_with_the_contact_faces_of_the_plan() {
    let python = readers_of_hardware();
    let folder = Job::desktop().write("desktop-supports");
    // Supports, solids, objects of the 3MF, templates, drawings of blocks.
    let read = python::read(&python, "supports.py", &[&folder]);
    assert_eq!(read.trim(), "4 4 4 0 0");
}

#[test]
fn wedges_and_blocks_have_the_tilt_and_height_of_the_plan() {
    let python = readers_of_hardware();
    let folder = pavilion_on_wedges().write("pavilion-supports");
    let read = python::read(&python, "supports.py", &[&folder]);
    assert_eq!(read.trim(), "6 0 0 6 6");
    let mut job = Job::pavilion();
    job.supports = Supports {
        at: SupportPlaces::EveryBoundaryCrossing,
        kind: SupportKind::ConcreteBlock,
        height: 0.0,
    };
    job.prepare();
    let folder = job.write("pavilion-blocks");
    let read = python::read(&python, "supports.py", &[&folder]);
    assert_eq!(read.trim(), "42 0 0 42 42");
}

#[test]
fn the_workbook_holds_every_table_cell_by_cell() {
    let python = readers_of_hardware();
    let folder = pavilion_on_wedges().write("pavilion-workbook");
    let read = python::read(&python, "workbook.py", &[&folder]);
    let tabs = "Summary, Shopping, Cut list, Crossings, Stickers, Supports";
    assert_eq!(read.trim(), tabs);
}

fn golden(name: &str, text: &str) {
    insta::with_settings!({
        snapshot_path => "golden/fabrication",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, { insta::assert_snapshot!(name, text) });
}

#[test]
fn tables_and_step_list_are_as_reviewed() {
    let files = pavilion_on_wedges().files();
    for name in ["supports.csv", "summary.csv", "assembly.md"] {
        let file = files.iter().find(|file| file.path == name).expect("made");
        let text = String::from_utf8(file.bytes.clone()).expect("UTF-8");
        golden(&format!("pavilion.{name}"), &text);
    }
}

/// Diagnostics as text: code, message, place, advice.
fn told_of(diagnostics: &[Diagnostic]) -> String {
    diagnostics
        .iter()
        .map(|d| {
            let mut lines = vec![format!("{}: {}", d.code, d.message)];
            lines.extend(d.labels.iter().map(|label| match &label.place {
                Place::Key(key) | Place::Name(key) => format!("  at {key}: {}", label.text),
                Place::Bytes { .. } => String::new(),
            }));
            lines.extend(d.notes.iter().map(|note| format!("  note: {note}")));
            lines.extend(d.help.iter().map(|help| format!("  help: {help}")));
            lines.join("\n") + "\n"
        })
        .collect()
}

#[test]
fn wrong_hardware_and_supports_are_explained() {
    let mut text = String::new();
    let mut tell = |name: &str, told: &[Diagnostic]| {
        assert!(!told.is_empty(), "{name}");
        text.extend(["-- ", name, "\n", &told_of(told)]);
    };
    let job = Job::pavilion();
    let supported = |at: SupportPlaces, kind, height| {
        let supports = Supports { at, kind, height };
        let inputs = SupportInputs {
            supports: &supports,
            bolt: &job.hardware.bolt,
        };
        match supports::records(&job.plan, inputs) {
            Ok(made) => made.warnings,
            Err(told) => told,
        }
    };
    let listed =
        |ids: &[&str]| SupportPlaces::Listed(ids.iter().map(|&id| id.to_owned()).collect());
    let corners = || SupportPlaces::Corners;
    let blocks = SupportKind::ConcreteBlock;
    tell(
        "low supports",
        &supported(corners(), SupportKind::Printed, 0.002),
    );
    tell(
        "tall prints",
        &supported(corners(), SupportKind::Printed, 0.6),
    );
    tell("tall blocks", &supported(corners(), blocks, 0.6));
    tell(
        "one place twice",
        &supported(listed(&["a", "west.u01-v01", "d"]), blocks, 0.0),
    );
    tell(
        "high supports only",
        &supported(listed(&["west.u05-v04"]), blocks, 0.1),
    );

    let mut steep = Job::pavilion();
    for point in &mut steep.plan.points {
        if point.id == "d" || point.id == "f" {
            point.normal = [-0.98, 0.0, 0.2];
        }
    }
    let supports = Supports {
        at: SupportPlaces::Corners,
        kind: blocks,
        height: 0.0,
    };
    let inputs = SupportInputs {
        supports: &supports,
        bolt: &steep.hardware.bolt,
    };
    let made = supports::records(&steep.plan, inputs).expect("others stand");
    tell("steep faces", &made.warnings);

    let mut sticker = job.hardware.sticker.clone().expect("a sticker");
    sticker.sheet = [0.1, 0.06];
    let refused = stickers::nest(&job.plan.stickers, &sticker);
    tell("small foil", &refused.expect_err("cards are larger"));
    let mut narrow = job.plan.clone();
    for lamella in &mut narrow.lamellae {
        lamella.width = 0.0062;
    }
    let crowded = stickers::records(&narrow, &sticker);
    tell("narrow lamellae", &crowded.warnings[..1]);

    let mut wrong = Job::pavilion();
    wrong
        .hardware
        .sticker
        .as_mut()
        .expect("a sticker")
        .thickness = 0.6e-3;
    wrong.hardware.shell = Some(Shell {
        name: "brass 6x0.5".to_owned(),
        diameter: 0.006,
        wall: 0.5e-3,
    });
    let told = match fabrication::check(&wrong.plan, &wrong.inputs().workshop()) {
        Ok(checked) => checked.warnings,
        Err(told) => told,
    };
    let mine = |d: &&Diagnostic| d.code.as_str().starts_with("W076");
    let told: Vec<Diagnostic> = told.iter().filter(mine).cloned().collect();
    tell("thick foil, loose shell", &told);
    golden("hardware.txt", &text);
}

#[test]
fn a_bolt_at_a_support_has_one_washer_and_no_nut() {
    let job = Job::desktop();
    let row = |id: &str| {
        let mut rows = job.plan.bill_of_materials.iter();
        rows.find(|row| row.id == id).expect("a row").quantity
    };
    let crossings = job.plan.crossings.len() as f64;
    assert_eq!(job.plan.supports.len(), 4);
    assert_eq!(row("nut-m3"), crossings - 4.0);
    assert_eq!(row("washer-m3"), 2.0 * crossings - 4.0);
    let bolts = job.plan.bill_of_materials.iter();
    let bolts: f64 = bolts
        .filter(|row| row.id.starts_with("bolt-"))
        .map(|row| row.quantity)
        .sum();
    assert_eq!(bolts, crossings);
}
