//! Cutting files, judged by independent readers.

mod common;

use common::{python, synthetic};
use egg::fabrication::drawing::{Drawing, Layer, Palette, Text};
use egg::fabrication::{self, Inputs, OutputFile, bom, nesting, svg};
use egg::plan::Plan;
use egg::project::model::{Fabrication, Hardware, Material};
use std::fs;
use std::path::{Path, PathBuf};

/// A plan with the values that its files are made with.
struct Job {
    plan: Plan,
    hardware: Hardware,
    fabrication: Fabrication,
    materials: Vec<Material>,
}

impl Job {
    fn new(plan: Plan, hardware: Hardware, fabrication: Fabrication) -> Self {
        let mut job = Self {
            plan,
            hardware,
            fabrication,
            materials: synthetic::materials(),
        };
        let blanks = fabrication::blanks(&job.plan.lamellae, &job.materials);
        let nest = nesting::nest(&blanks, &nesting::Settings::new(&job.fabrication))
            .expect("the parts fit")
            .value;
        job.plan.sheets = nest.sheets;
        let shopping = bom::Shopping {
            hardware: &job.hardware,
            materials: &job.materials,
            stock: &job.fabrication.stock,
            groups: &nest.groups,
        };
        job.plan.bill_of_materials = bom::rows(&job.plan, &shopping)
            .expect("bolts are long enough")
            .value;
        job
    }

    fn desktop() -> Self {
        Self::new(
            synthetic::desktop(),
            synthetic::hardware(3.0, 4.0),
            synthetic::fabrication([0.8, 0.3]),
        )
    }

    fn pavilion() -> Self {
        Self::new(
            synthetic::pavilion(),
            synthetic::hardware(4.0, 5.0),
            synthetic::fabrication([2.5, 1.25]),
        )
    }

    fn inputs(&self) -> Inputs<'_> {
        Inputs {
            hardware: &self.hardware,
            fabrication: &self.fabrication,
            materials: &self.materials,
        }
    }

    fn files(&self) -> Vec<OutputFile> {
        fabrication::outputs(&self.plan, self.inputs())
            .expect("all files can be made")
            .value
    }

    /// Writes all files and the plan as JSON below the build folder.
    fn write(&self, name: &str) -> PathBuf {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join("fabrication")
            .join(name);
        if folder.exists() {
            fs::remove_dir_all(&folder).expect("old files go");
        }
        for file in self.files() {
            let path = folder.join(&file.path);
            fs::create_dir_all(path.parent().expect("inside the folder")).expect("a folder");
            fs::write(path, file.bytes).expect("a file");
        }
        let settings = serde_json::json!({
            "kerf": self.fabrication.kerf,
            "spacing": self.fabrication.spacing,
            "least_web": 1.0,
        });
        fs::write(folder.join("settings.json"), settings.to_string()).expect("a file");
        let plan = serde_json::to_vec_pretty(&self.plan).expect("a plan is JSON");
        fs::write(folder.join("plan.json"), plan).expect("a file");
        folder
    }
}

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
    job.fabrication.colours = egg::project::model::ColourPreset::BlueCut;
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
    println!("{}", script(&Job::desktop().write("desktop-pictures")));
    println!("{}", script(&Job::pavilion().write("pavilion-pictures")));
}

#[test]
fn letters_look_as_designed() {
    let letters = svg::write(&specimen()).expect("finite");
    fs::write(
        Path::new(env!("CARGO_TARGET_TMPDIR")).join("letters.svg"),
        &letters,
    )
    .expect("a file");
}
