//! The files of a plan.
//!
//! Every file is made from the plan and a few settings of the workshop. What a kind of file takes
//! of these is a type of its own, so that an edit of another setting makes it not again.

mod check;
mod drawings;
mod parts;
mod tables;

pub use check::check;
pub use drawings::{
    above_files, cladding_files, coupon_files, layout_files, network_files, sticker_files,
    support_files,
};
pub use parts::{SheetSettings, overview_files, part_files, parts, sheet_files};
pub use tables::{assembly_file, table_files};

use super::drawing::{Drawing, NotFinite};
use super::names::file_name;
use super::nesting::Blank;
use super::network::NamedQuad;
use super::part::PartStyle;
use super::sheet::{Parts, trim};
use super::units::MM;
use super::{Woods, coupon, dxf, pieces, svg};
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::plan::{LamellaRecord, Plan};
use crate::project::model::{Fabrication, Grain, Hardware, Material};
use serde::Serialize;

/// The path of a sheet's files without their ending: what it is of, which one, and of how many.
fn sheet_name(
    folder: &str,
    plan: &Plan,
    (material, thickness): (&str, f64),
    id: &str,
    count: usize,
) -> String {
    format!(
        "{folder}/{}_{}-{}mm_{id}-of-{count:02}",
        file_name(&plan.name),
        file_name(material),
        trim(thickness * MM)
    )
}

/// A file to write.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFile {
    /// Relative to the output folder, with forward slashes.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// What files depend on besides the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inputs<'a> {
    /// `[hardware]`.
    pub hardware: &'a Hardware,
    /// `[fabrication]`.
    pub fabrication: &'a Fabrication,
    /// Materials that lamellae name.
    pub materials: &'a [Material],
}

impl Inputs<'_> {
    /// What a workshop looks at.
    pub fn workshop(&self) -> Workshop {
        Workshop {
            hardware: self.hardware.clone(),
            kerf: self.fabrication.kerf,
            spacing: self.fabrication.spacing,
            grains: Grains::of(self.materials),
        }
    }

    /// How parts are drawn.
    pub fn part_style(&self) -> PartStyle {
        PartStyle::of(self.hardware, self.fabrication)
    }

    /// How sheets are drawn.
    pub fn sheets(&self) -> SheetSettings {
        SheetSettings {
            parts: self.part_style(),
            colours: self.fabrication.colours,
            margin: self.fabrication.margin,
            grains: Grains::of(self.materials),
        }
    }
}

/// What a workshop looks at in a plan. Metres.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Workshop {
    /// `[hardware]`.
    pub hardware: Hardware,
    /// Width that the beam removes.
    pub kerf: f64,
    /// Least distance between parts on a sheet.
    pub spacing: f64,
    /// Which way the grain runs.
    pub grains: Grains,
}

/// Which way the grain of materials runs in a lamella, by name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Grains(Vec<(String, Grain)>);

impl Grains {
    /// Those of materials, in their order.
    pub fn of(materials: &[Material]) -> Self {
        Self(
            materials
                .iter()
                .map(|m| (m.name.clone(), m.grain))
                .collect(),
        )
    }

    /// That of a material. Those of a checked project are known; for others the usual case holds.
    pub fn grain(&self, material: &str) -> Grain {
        let known = self.0.iter().find(|(name, _)| name == material);
        known.map_or(Grain::Along, |(_, grain)| *grain)
    }

    /// Materials with their grain.
    pub fn iter(&self) -> impl Iterator<Item = (&str, Grain)> {
        self.0.iter().map(|(name, grain)| (name.as_str(), *grain))
    }
}

/// Every file of a plan whose sheets and bill are made.
pub fn outputs(plan: &Plan, inputs: Inputs<'_>) -> Checked<Vec<OutputFile>> {
    let Warned {
        value: (),
        mut warnings,
    } = check(plan, &inputs.workshop())?;
    let (style, settings) = (inputs.part_style(), inputs.sheets());
    let colours = inputs.fabrication.colours;
    let Warned {
        value: parts,
        warnings: omitted,
    } = parts(plan, style);
    warnings.extend(omitted);
    let mut files = Vec::new();
    let mut errors = Vec::new();
    let mut told = Vec::new();
    let mut take = |result: Checked<Vec<OutputFile>>| match result {
        Ok(made) => {
            files.extend(made.value);
            told.extend(made.warnings);
        }
        Err(told) => errors.extend(told),
    };
    take(cladding_files(plan));
    take(layout_files(plan, inputs.hardware.bolt.diameter));
    take(above_files(plan));
    let quads: Vec<NamedQuad> = plan.patches.iter().map(NamedQuad::of).collect();
    take(network_files(&plan.name, &quads, plan));
    let by_id: Parts = parts.iter().map(|part| (part.id.as_str(), part)).collect();
    for sheet in &plan.sheets {
        take(sheet_files(plan, sheet, &by_id, &settings));
    }
    take(overview_files(plan, &by_id, &settings));
    take(part_files(plan, style, colours));
    let sections = coupon::sections(&plan.lamellae);
    take(coupon_files(&sections, inputs.hardware, colours));
    take(sticker_files(plan, colours));
    take(support_files(plan, colours));
    let woods = Woods::new(inputs.materials);
    files.extend(table_files(plan, inputs.hardware, &woods));
    files.push(assembly_file(plan, inputs.hardware));
    if errors.is_empty() {
        warnings.extend(told);
        Ok(Warned {
            value: files,
            warnings,
        })
    } else {
        errors.extend(warnings);
        Err(errors)
    }
}

/// What nesting needs of the lamellae.
pub fn blanks(lamellae: &[LamellaRecord], materials: &[Material]) -> Vec<Blank> {
    let grains = Grains::of(materials);
    pieces::blanks(lamellae, |material| grains.grain(material))
}

/// Files in the making, and drawings that cannot be written.
#[derive(Default)]
struct Files {
    made: Vec<OutputFile>,
    errors: Vec<Diagnostic>,
    warnings: Vec<Diagnostic>,
}

impl Files {
    /// A drawing as DXF and SVG.
    fn both(&mut self, name: &str, drawing: &Drawing) {
        self.add(name, "dxf", dxf::write(drawing));
        self.picture(name, drawing);
    }

    /// A drawing as SVG.
    fn picture(&mut self, name: &str, drawing: &Drawing) {
        self.add(name, "svg", svg::write(drawing));
    }

    fn add(&mut self, name: &str, format: &str, written: Result<Vec<u8>, NotFinite>) {
        let path = format!("{name}.{format}");
        match written {
            Ok(bytes) => self.made.push(OutputFile { path, bytes }),
            Err(NotFinite { layer, subject }) => self.errors.push(
                Diagnostic::error(
                    codes::NOT_A_NUMBER,
                    format!(
                        "`{path}` has a coordinate that is no number, on layer {}",
                        layer.name()
                    ),
                )
                .about(subject),
            ),
        }
    }

    fn finish(self) -> Checked<Vec<OutputFile>> {
        if self.errors.is_empty() {
            Ok(Warned {
                value: self.made,
                warnings: self.warnings,
            })
        } else {
            Err(self.errors)
        }
    }
}
