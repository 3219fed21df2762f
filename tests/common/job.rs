//! A made-up plan with sheets, bill and files, as a workshop gets it.

use super::synthetic;
use egg::fabrication::splicing::{self, Rules};
use egg::fabrication::supports::{self, SupportInputs};
use egg::fabrication::{self, Inputs, OutputFile, bom, nesting, stickers};
use egg::plan::Plan;
use egg::project::model::{
    Bed, Fabrication, Hardware, Material, SpliceKind, SupportKind, SupportPlaces, Supports,
};
use std::fs;
use std::path::{Path, PathBuf};

/// A plan with the values that its files are made with.
pub(crate) struct Job {
    pub(crate) plan: Plan,
    pub(crate) hardware: Hardware,
    pub(crate) fabrication: Fabrication,
    pub(crate) materials: Vec<Material>,
    pub(crate) supports: Supports,
}

impl Job {
    pub(crate) fn new(plan: Plan, hardware: Hardware, fabrication: Fabrication) -> Self {
        let mut job = Self {
            plan,
            hardware,
            fabrication,
            materials: synthetic::materials(),
            supports: Supports {
                at: SupportPlaces::Corners,
                kind: SupportKind::Printed,
                height: 0.0,
            },
        };
        job.prepare();
        job
    }

    /// Splices, sheets, stickers, supports and bill.
    pub(crate) fn prepare(&mut self) {
        let settings = nesting::Settings::new(&self.fabrication);
        if let Some(kind) = self.fabrication.splice {
            let stock = |m: &Material| splicing::Stock {
                material: m.name.clone(),
                longest: settings.longest(m.grain),
                elastic_modulus: m.elastic_modulus,
                bending_strength: m.bending_strength,
            };
            let rules = Rules {
                kind,
                bolt: self.hardware.bolt.diameter,
                clearance: self.fabrication.clearance,
                stock: self.materials.iter().map(stock).collect(),
            };
            let spliced = splicing::splice(&self.plan, &rules).expect("there are places");
            for splice in spliced.value {
                let mut lamellae = self.plan.lamellae.iter_mut();
                let lamella = lamellae.find(|l| l.id == splice.lamella);
                splice.put_into(lamella.expect("a lamella"));
            }
        }
        let blanks = fabrication::blanks(&self.plan.lamellae, &self.materials);
        let nest = nesting::nest(&blanks, &settings)
            .expect("the parts fit")
            .value;
        self.plan.nesting = nest.records();
        self.plan.sheets.clone_from(&nest.sheets);
        if let Some(sticker) = &self.hardware.sticker {
            self.plan.stickers = stickers::records(&self.plan, sticker).value;
            let foils = stickers::nest(&self.plan.stickers, sticker);
            self.plan.foils = foils.expect("the stickers fit").value;
        }
        let inputs = SupportInputs {
            supports: &self.supports,
            bolt: &self.hardware.bolt,
        };
        let made = supports::records(&self.plan, inputs);
        self.plan.supports = made.expect("supports stand").value;
        let shopping = bom::Shopping {
            hardware: &self.hardware,
            materials: &self.materials,
            stock: &self.fabrication.stock,
            groups: &nest.groups,
        };
        self.plan.bill_of_materials = bom::rows(&self.plan, &shopping)
            .expect("bolts are long enough")
            .value;
    }

    pub(crate) fn desktop() -> Self {
        Self::new(
            synthetic::desktop(),
            synthetic::hardware(3.0, 4.0),
            synthetic::fabrication([0.8, 0.3]),
        )
    }

    pub(crate) fn pavilion() -> Self {
        Self::new(
            synthetic::pavilion(),
            synthetic::hardware(4.0, 5.0),
            synthetic::fabrication([2.5, 1.25]),
        )
    }

    /// The pavilion from shorter panels, with joints.
    pub(crate) fn spliced(kind: SpliceKind) -> Self {
        let mut fabrication = synthetic::fabrication([1.3, 0.9]);
        fabrication.splice = Some(kind);
        Self::new(
            synthetic::pavilion(),
            synthetic::hardware(4.0, 5.0),
            fabrication,
        )
    }

    /// The pavilion on a machine that panels are pushed through.
    pub(crate) fn pushed(bed: f64) -> Self {
        let mut fabrication = synthetic::fabrication([2.5, 1.25]);
        fabrication.bed = Some(Bed {
            length: bed,
            width: 1.3,
            pass_through: true,
        });
        Self::new(
            synthetic::pavilion(),
            synthetic::hardware(4.0, 5.0),
            fabrication,
        )
    }

    pub(crate) fn inputs(&self) -> Inputs<'_> {
        Inputs {
            hardware: &self.hardware,
            fabrication: &self.fabrication,
            materials: &self.materials,
        }
    }

    pub(crate) fn files(&self) -> Vec<OutputFile> {
        fabrication::outputs(&self.plan, self.inputs())
            .expect("all files can be made")
            .value
    }

    /// Writes all files and the plan as JSON below the build folder.
    pub(crate) fn write(&self, name: &str) -> PathBuf {
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
