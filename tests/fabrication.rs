//! Cutting files, judged by independent readers.

mod common;

use common::job::Job;
use common::{python, synthetic};
use egg::diagnostics::{Diagnostic, Place};
use egg::fabrication::drawing::{Drawing, Layer, Palette, Text};
use egg::fabrication::{self, Inputs, OutputFile, bom, nesting, svg};
use egg::plan::{LamellaRecord, OpeningRecord};
use std::path::{Path, PathBuf};

/// Every letter that can be engraved.
fn specimen() -> Drawing {
    let lines = [
        "ABCDEFGHIJKLMNOPQRSTUVWXYZ",
        "abcdefghijklmnopqrstuvwxyz",
        "0123456789 -_.,:/+=#()%° →←↑↓",
        "west.u03 → TOP   v05   east.v12",
        "Größe 3x30   Il1 O0 B8 S5 Z2   東",
    ];
    let mut drawing = Drawing::new("letters", [230.0, 90.0], Palette::People);
    for (row, line) in lines.iter().enumerate() {
        let y = 74.0 - 16.0 * row as f64;
        drawing.draw(Layer::Label, "", Text::new(*line, [6.0, y], 8.0));
    }
    drawing
}

fn readers() -> PathBuf {
    python::venv(&[
        "ezdxf==1.4.*",
        "shapely==2.*",
        "svgelements==1.9.*",
        "resvg_py==0.5.*",
        "pillow",
    ])
}

#[test]
fn cut_files_hold_every_opening_of_the_plan_with_true_arcs() {
    let python = readers();
    let script = |folder: &PathBuf| python::read(&python, "cut_files.py", &[folder]);
    // Parts, notches, round holes.
    assert_eq!(script(&Job::desktop().write("desktop")).trim(), "16 70 56");
    assert_eq!(
        script(&Job::pavilion().write("pavilion")).trim(),
        "31 130 108"
    );
}

#[test]
fn kerf_grows_outlines_and_shrinks_openings() {
    let mut job = Job::pavilion();
    job.fabrication.kerf = 0.25e-3;
    job.fabrication.colours = egg::project::model::ColourPreset::ByLayer;
    job.prepare();
    let folder = job.write("pavilion-kerf");
    assert_eq!(
        python::read(&readers(), "cut_files.py", &[&folder]).trim(),
        "31 130 108"
    );
}

#[test]
fn svg_and_dxf_of_a_drawing_are_the_same_to_a_micrometre() {
    let python = readers();
    let script = |folder: &PathBuf| python::read(&python, "same_drawing.py", &[folder]);
    // Drawings that were compared, pictures that were rendered.
    assert_eq!(
        script(&Job::desktop().write("desktop-pictures")).trim(),
        "5 9"
    );
    assert_eq!(
        script(&Job::pavilion().write("pavilion-pictures")).trim(),
        "16 21"
    );
}

#[test]
fn the_same_plan_gives_the_same_bytes() {
    let first = Job::pavilion().files();
    std::thread::sleep(std::time::Duration::from_millis(20));
    assert!(first == Job::pavilion().files());
}

#[test]
fn a_dxf_is_read_back_by_the_library_that_wrote_it() {
    let files = Job::desktop().files();
    let is_dxf = |file: &&OutputFile| Path::new(&file.path).extension() == Some("dxf".as_ref());
    let of_all = |file: &&OutputFile| file.path.contains("sheet") || file.path.contains("layout");
    for file in files.iter().filter(is_dxf).filter(of_all) {
        let drawing = dxf::Drawing::load(&mut file.bytes.as_slice()).expect("a drawing");
        assert_eq!(
            drawing.header.default_drawing_units,
            dxf::enums::Units::Millimeters
        );
        let closed = drawing.entities().filter(|e| match &e.specific {
            dxf::entities::EntityType::LwPolyline(polyline) => polyline.is_closed(),
            _ => false,
        });
        // Outlines and notches, and on the sheet its frame.
        let frame = usize::from(file.path.contains("sheet"));
        assert_eq!(closed.count(), 16 + 70 + frame, "{}", file.path);
    }
}

fn golden(name: &str, bytes: &[u8]) {
    let text = String::from_utf8(bytes.to_vec()).expect("UTF-8");
    insta::with_settings!({
        snapshot_path => "golden/fabrication",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, { insta::assert_snapshot!(name, text) });
}

#[test]
fn letters_look_as_designed() {
    golden("letters.svg", &svg::write(&specimen()).expect("finite"));
}

#[test]
fn tables_are_as_reviewed() {
    let files = Job::pavilion().files();
    for name in ["bom.csv", "cutlist.csv"] {
        let file = files.iter().find(|file| file.path == name).expect("made");
        golden(&format!("pavilion.{name}"), &file.bytes);
    }
    let files = Job::desktop().files();
    for name in ["crossings.csv", "cladding/west.svg"] {
        let file = files.iter().find(|file| file.path == name).expect("made");
        golden(&format!("desktop.{}", name.replace('/', ".")), &file.bytes);
    }
}

/// Diagnostics as text: code, message, help.
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
fn what_cannot_be_made_is_explained() {
    let plan = synthetic::pavilion();
    let hardware = synthetic::hardware(4.0, 5.0);
    let fabrication = synthetic::fabrication([2.5, 1.25]);
    let materials = synthetic::materials();
    let blanks = fabrication::blanks(&plan.lamellae, &materials);
    let mut text = String::new();

    let mut stock = fabrication.clone();
    stock.stock.length = 1.5;
    let short = nesting::nest(&blanks, &nesting::Settings::new(&stock));
    text += &told_of(&short.expect_err("lamellae are longer"));
    stock.stock.width = 0.03;
    let narrow = nesting::nest(&blanks, &nesting::Settings::new(&stock));
    text += &told_of(&narrow.expect_err("lamellae are wider"));

    let shopping = |hardware| bom::Shopping {
        hardware,
        materials: &materials,
        stock: &fabrication.stock,
        groups: &[],
    };
    let mut thick = plan.clone();
    for lamella in &mut thick.lamellae {
        lamella.thickness = 0.012;
    }
    text += &told_of(&bom::rows(&thick, &shopping(&hardware)).expect_err("bolts end at 40 mm"));

    let mut wrong = hardware.clone();
    wrong.bolt.name = "M7".to_owned();
    wrong.bolt.diameter = 0.007;
    text += &told_of(&bom::rows(&plan, &shopping(&wrong)).expect_err("no such series"));

    let mut kerf = fabrication.clone();
    kerf.kerf = 0.0045;
    let inputs = Inputs {
        hardware: &hardware,
        fabrication: &kerf,
        materials: &materials,
    };
    text += &told_of(&fabrication::outputs(&plan, inputs).expect_err("holes close"));

    let mut broken = plan.clone();
    broken.members[3].planar[0][1] = f64::NAN;
    let inputs = Inputs {
        fabrication: &fabrication,
        ..inputs
    };
    text += &told_of(&fabrication::outputs(&broken, inputs).expect_err("no number"));
    golden("refusals.txt", text.as_bytes());
}

#[test]
fn labels_without_room_are_told_and_left_out() {
    let mut job = Job::desktop();
    for lamella in &mut job.plan.lamellae {
        lamella.width = 0.004;
    }
    let parts = fabrication::parts(&job.plan, job.inputs().part_style());
    assert_eq!(parts.warnings.len(), job.plan.lamellae.len());
    assert_eq!(parts.warnings[0].code.as_str(), "W0720");
}

#[test]
fn what_a_workshop_objects_to_is_told() {
    let mut job = Job::pavilion();
    let mut text = String::new();
    let mut tell = |name: &str, job: &Job| {
        let told = match fabrication::check(&job.plan, &job.inputs().workshop()) {
            Ok(checked) => checked.warnings,
            Err(told) => told,
        };
        text.extend(["-- ", name, "\n", &told_of(&told)]);
    };
    tell("as it is", &job);

    job.fabrication.spacing = 1e-3;
    job.materials[1].grain = egg::project::model::Grain::Across;
    tell("narrow spacing, grain across", &job);

    let mut job = Job::pavilion();
    // A notch that ends 4 mm before the next one, and one that runs into it.
    for (id, rest) in [("east.u03", 4e-3), ("east.u05", -6e-3)] {
        let is_named = |lamella: &&mut LamellaRecord| lamella.id == id;
        let lamella = job.plan.lamellae.iter_mut().find(is_named);
        let [_, _, first, second, ..] = &mut lamella.expect("a lamella").openings[..] else {
            panic!("inner members cross several");
        };
        let (OpeningRecord::Notch { to, diameter, .. }, OpeningRecord::Notch { from, .. }) =
            (first, second)
        else {
            panic!("inner members have notches");
        };
        *to = *from - *diameter - rest;
    }
    tell("long slides", &job);

    let mut job = Job::pavilion();
    for lamella in &mut job.plan.lamellae {
        lamella.width = 0.009;
        lamella.length -= 0.026 * 2.0;
        lamella.end_margin = 0.004;
    }
    tell("narrow lamellae, short ends", &job);
    golden("objections.txt", text.as_bytes());
}
