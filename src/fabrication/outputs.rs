//! The files of a plan.

use super::drawing::{Drawing, NotFinite};
use super::index::PlanIndex;
use super::layout::FlatPatch;
use super::lints::lints;
use super::names::{distinct_file_names, file_name};
use super::nesting::Blank;
use super::network::NamedQuad;
use super::part::{Part, PartStyle};
use super::sheet::{Parts, SheetStyle, trim};
use super::units::MM;
use super::{cladding_plot, dxf, from_above, hardware, layout, network, part, sheet, svg, tables};
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Severity, Warned};
use crate::plan::{LamellaRecord, OpeningRecord, Plan, SheetRecord, cladding_to_ron};
use crate::project::model::{Fabrication, Grain, Hardware, Material};

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

/// Every file of a plan whose sheets and bill are made.
pub fn outputs(plan: &Plan, inputs: Inputs<'_>) -> Checked<Vec<OutputFile>> {
    let Warned {
        value: (),
        mut warnings,
    } = check(plan, inputs)?;
    let Warned {
        value: parts,
        warnings: told,
    } = parts(plan, inputs);
    warnings.extend(told);
    let mut files = Vec::new();
    let mut errors = Vec::new();
    let mut take = |result: Checked<Vec<OutputFile>>| match result {
        Ok(made) => files.extend(made.value),
        Err(told) => errors.extend(told),
    };
    take(cladding_files(plan));
    take(layout_files(plan, inputs));
    take(above_files(plan));
    let quads: Vec<NamedQuad> = plan.patches.iter().map(NamedQuad::of).collect();
    take(network_files(&plan.name, &quads, plan));
    let by_id: Parts = parts.iter().map(|part| (part.id.as_str(), part)).collect();
    for sheet in &plan.sheets {
        take(sheet_files(plan, sheet, &by_id, inputs));
    }
    files.extend(table_files(plan, inputs));
    if errors.is_empty() {
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
    lamellae
        .iter()
        .map(|lamella| Blank {
            id: lamella.id.clone(),
            material: lamella.material.clone(),
            thickness: lamella.thickness,
            length: lamella.length,
            width: lamella.width,
            grain: grain(&lamella.material, materials),
        })
        .collect()
}

/// Whether the parts of a plan can be made and hold, and what a workshop should know.
pub fn check(plan: &Plan, inputs: Inputs<'_>) -> Checked<()> {
    let mut told = hardware::check(inputs.hardware);
    told.extend(kerf_errors(plan, inputs.fabrication));
    told.extend(lints(
        &plan.lamellae,
        inputs.hardware,
        inputs.fabrication,
        inputs.materials,
    ));
    if told.iter().any(|d| d.severity == Severity::Error) {
        Err(told)
    } else {
        Ok(Warned {
            value: (),
            warnings: told,
        })
    }
}

/// Every lamella as a part to cut; labels without place are told.
pub fn parts(plan: &Plan, inputs: Inputs<'_>) -> Warned<Vec<Part>> {
    let style = PartStyle {
        kerf: inputs.fabrication.kerf * MM,
        label_height: inputs.fabrication.label_height * MM,
        sticker_margin: inputs.hardware.sticker.as_ref().map_or(0.0, |s| s.margin) * MM,
    };
    let index = PlanIndex::new(plan);
    let mut warnings = Vec::new();
    let mut parts = Vec::new();
    for lamella in &plan.lamellae {
        if let Some(neighbours) = index.neighbours(lamella) {
            let (part, told) = part::draw(lamella, &neighbours, style);
            parts.push(part);
            warnings.extend(told);
        }
    }
    Warned {
        value: parts,
        warnings,
    }
}

/// The cut file and the overview of a sheet.
pub fn sheet_files(
    plan: &Plan,
    sheet: &SheetRecord,
    parts: &Parts<'_>,
    inputs: Inputs<'_>,
) -> Checked<Vec<OutputFile>> {
    let style = SheetStyle {
        project: &plan.name,
        count: plan.sheets.len(),
        kerf: inputs.fabrication.kerf * MM,
        grain: grain(&sheet.material, inputs.materials),
        colours: inputs.fabrication.colours,
    };
    let name = format!(
        "fabrication/{}_{}-{}mm_{}-of-{:02}",
        file_name(&plan.name),
        file_name(&sheet.material),
        trim(sheet.thickness * MM),
        sheet.id,
        plan.sheets.len()
    );
    let mut files = Files::default();
    files.both(&name, &sheet::cut_file(sheet, parts, &style));
    files.picture(
        &format!("{name}.overview"),
        &sheet::overview(sheet, parts, &style),
    );
    files.finish()
}

/// Drawings of the whole structure beside those of its patches.
const WHOLE: [&str; 2] = ["from-above", "patches"];

/// The flat layout of every patch.
pub fn layout_files(plan: &Plan, inputs: Inputs<'_>) -> Checked<Vec<OutputFile>> {
    let index = PlanIndex::new(plan);
    let patches = plan.patches.iter().map(|patch| patch.id.as_str());
    let names = distinct_file_names(WHOLE.into_iter().chain(patches));
    let names = names.into_iter().skip(WHOLE.len());
    let mut files = Files::default();
    for (patch, name) in plan.patches.iter().zip(names) {
        let members = plan.members.iter().filter(|m| m.patch == patch.id);
        let is_here = |member: &str| index.member(member).is_some_and(|m| m.patch == patch.id);
        let flat = FlatPatch {
            project: &plan.name,
            patch,
            lamellae: members
                .filter_map(|member| Some((member, index.lamella_of(&member.id)?)))
                .collect(),
            crossings: plan.crossings.iter().filter(|c| is_here(&c.u)).collect(),
            bolt: inputs.hardware.bolt.diameter,
        };
        files.both(&format!("layout/{name}"), &layout::draw(&flat));
    }
    files.finish()
}

/// The members of all patches from above.
pub fn above_files(plan: &Plan) -> Checked<Vec<OutputFile>> {
    let mut files = Files::default();
    let above = from_above::draw(&plan.name, &plan.patches, &plan.members, &plan.points);
    files.picture("layout/from-above", &above);
    files.finish()
}

/// The layout from above: its skeleton with names.
pub fn network_files(
    name: &str,
    patches: &[NamedQuad],
    skeleton: &Plan,
) -> Checked<Vec<OutputFile>> {
    let mut files = Files::default();
    let drawing = network::draw(name, patches, &skeleton.points, &skeleton.edges);
    files.picture("layout/patches", &drawing);
    files.finish()
}

/// The cladding functions of every patch, as a plot and as a document.
pub fn cladding_files(plan: &Plan) -> Checked<Vec<OutputFile>> {
    let names = distinct_file_names(plan.patches.iter().map(|patch| patch.id.as_str()));
    let mut files = Files::default();
    for (patch, name) in plan.patches.iter().zip(names) {
        let members = plan.members.iter().filter(|m| m.patch == patch.id);
        let drawing = cladding_plot::draw(patch, &members.collect::<Vec<_>>());
        files.picture(&format!("cladding/{name}"), &drawing);
        let document = cladding_to_ron(plan, patch).into_bytes();
        files.add(&format!("cladding/{name}"), "ron", Ok(document));
    }
    files.finish()
}

/// The tables.
pub fn table_files(plan: &Plan, inputs: Inputs<'_>) -> Vec<OutputFile> {
    let file = |path: &str, bytes| OutputFile {
        path: path.to_owned(),
        bytes,
    };
    vec![
        file("bom.csv", tables::bom(&plan.bill_of_materials)),
        file("cutlist.csv", tables::cut_list(plan, inputs.materials)),
        file("crossings.csv", tables::crossings(plan, inputs.hardware)),
    ]
}

fn grain(material: &str, materials: &[Material]) -> Grain {
    // Materials of a checked project are known; for others the usual case holds.
    materials
        .iter()
        .find(|m| m.name == material)
        .map_or(Grain::Along, |m| m.grain)
}

fn kerf_errors(plan: &Plan, fabrication: &Fabrication) -> Option<Diagnostic> {
    let (lamella, diameter) = plan
        .lamellae
        .iter()
        .flat_map(|lamella| lamella.openings.iter().map(move |o| (lamella, o)))
        .map(|(lamella, opening)| match opening {
            OpeningRecord::Hole { diameter, .. } | OpeningRecord::Notch { diameter, .. } => {
                (lamella, *diameter)
            }
        })
        .find(|(_, diameter)| *diameter <= fabrication.kerf)?;
    Some(
        Diagnostic::error(
            codes::KERF_CLOSES_OPENING,
            format!(
                "an opening of {:.2} mm in `{}` is cut with a kerf of {:.2} mm",
                diameter * MM,
                lamella.id,
                fabrication.kerf * MM
            ),
        )
        .at_key("fabrication.kerf", "wider than the opening")
        .about(&lamella.id),
    )
}

/// Files in the making, and drawings that cannot be written.
#[derive(Default)]
struct Files {
    files: Vec<OutputFile>,
    errors: Vec<Diagnostic>,
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
            Ok(bytes) => self.files.push(OutputFile { path, bytes }),
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
                value: self.files,
                warnings: Vec::new(),
            })
        } else {
            Err(self.errors)
        }
    }
}
