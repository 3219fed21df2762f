//! The files of a plan.

use super::coupon::CouponSection;
use super::drawing::{Drawing, NotFinite};
use super::index::PlanIndex;
use super::layout::FlatPatch;
use super::lints::lints;
use super::names::{distinct_file_names, file_name, part_file_names};
use super::nesting::Blank;
use super::network::NamedQuad;
use super::part::{Part, PartStyle};
use super::sheet::{Goodness, Parts, SheetStyle, trim};
use super::units::MM;
use super::workbook::{self, Tab};
use super::{
    assembly, cladding_plot, coupon, dxf, from_above, hardware, layout, network, part, pdf, pieces,
    sheet, stickers, supports, svg, tables,
};
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Severity, Warned};
use crate::plan::{
    LamellaRecord, NestingRecord, OpeningRecord, Plan, SheetRecord, cladding_to_ron,
};
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
        warnings: omitted,
    } = parts(plan, inputs);
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
    take(layout_files(plan, inputs));
    take(above_files(plan));
    let quads: Vec<NamedQuad> = plan.patches.iter().map(NamedQuad::of).collect();
    take(network_files(&plan.name, &quads, plan));
    let by_id: Parts = parts.iter().map(|part| (part.id.as_str(), part)).collect();
    for sheet in &plan.sheets {
        take(sheet_files(plan, sheet, &by_id, inputs));
    }
    take(overview_files(plan, &by_id, inputs));
    take(part_files(plan, inputs));
    take(coupon_files(&coupon::sections(&plan.lamellae), inputs));
    take(sticker_files(plan, inputs));
    take(support_files(plan, inputs));
    files.extend(table_files(plan, inputs));
    files.push(assembly_file(plan, inputs));
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
    pieces::blanks(lamellae, |material| grain(material, materials))
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

/// Every part to cut: pieces of lamellae and plates. Labels without place are told.
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
        let Some(neighbours) = index.neighbours(lamella) else {
            continue;
        };
        let drawn = pieces::pieces(lamella)
            .into_iter()
            .map(|piece| part::draw(&piece, &neighbours, style));
        let plates = pieces::plates(lamella)
            .into_iter()
            .map(|plate| part::draw_plate(&plate, style));
        for (part, told) in drawn.chain(plates) {
            parts.push(part);
            warnings.extend(told);
        }
    }
    Warned {
        value: parts,
        warnings,
    }
}

/// The cut files and the overview of a sheet: one cut file, or one for each window.
pub fn sheet_files(
    plan: &Plan,
    sheet: &SheetRecord,
    parts: &Parts<'_>,
    inputs: Inputs<'_>,
) -> Checked<Vec<OutputFile>> {
    let style = sheet_style(plan, sheet, inputs);
    let name = format!(
        "fabrication/{}_{}-{}mm_{}-of-{:02}",
        file_name(&plan.name),
        file_name(&sheet.material),
        trim(sheet.thickness * MM),
        sheet.id,
        plan.sheets.len()
    );
    let mut files = Files::default();
    if sheet.windows.is_empty() {
        files.both(&name, &sheet::cut_file(sheet, parts, &style));
    } else {
        let (drawings, pinned) = sheet::window_files(sheet, parts, &style);
        for (i, drawing) in drawings.iter().enumerate() {
            let window = format!("{name}_window-{}-of-{}", i + 1, drawings.len());
            files.both(&window, drawing);
        }
        if !pinned {
            files.warnings.push(no_pins(sheet, inputs.fabrication));
        }
    }
    files.picture(
        &format!("{name}.overview"),
        &sheet::overview(sheet, parts, &style),
    );
    files.finish()
}

fn sheet_style<'a>(plan: &'a Plan, sheet: &SheetRecord, inputs: Inputs<'a>) -> SheetStyle<'a> {
    let of_sheet = |group: &&NestingRecord| {
        group.material == sheet.material && group.thickness == sheet.thickness
    };
    let group = plan.nesting.iter().find(of_sheet);
    SheetStyle {
        project: &plan.name,
        count: plan.sheets.len(),
        kerf: inputs.fabrication.kerf * MM,
        grain: grain(&sheet.material, inputs.materials),
        colours: inputs.fabrication.colours,
        goodness: group.map(|group| Goodness {
            sheets: group.sheets,
            bound: group.sheets_bound,
        }),
    }
}

fn no_pins(sheet: &SheetRecord, fabrication: &Fabrication) -> Diagnostic {
    Diagnostic::warning(
        codes::NO_REGISTRATION,
        format!(
            "the border of `{}` is too narrow for the pins that hold it when it is pushed on",
            sheet.id
        ),
    )
    .at_key(
        "fabrication.margin",
        format!("{} mm, 5 mm are needed", trim(fabrication.margin * MM)),
    )
    .about(&sheet.id)
}

/// The overviews of all sheets as pages to print.
pub fn overview_files(
    plan: &Plan,
    parts: &Parts<'_>,
    inputs: Inputs<'_>,
) -> Checked<Vec<OutputFile>> {
    let pages: Vec<Drawing> = plan
        .sheets
        .iter()
        .map(|sheet| sheet::overview(sheet, parts, &sheet_style(plan, sheet, inputs)))
        .collect();
    let mut files = Files::default();
    if !pages.is_empty() {
        let title = format!("{}: overview of sheets", plan.name);
        let name = format!("fabrication/{}_overview", file_name(&plan.name));
        files.add(&name, "pdf", pdf::write(&title, &pages));
    }
    files.finish()
}

/// Every part as a file of its own, cuts only, for shops that nest by themselves.
pub fn part_files(plan: &Plan, inputs: Inputs<'_>) -> Checked<Vec<OutputFile>> {
    let Warned { value: parts, .. } = parts(plan, inputs);
    let names = part_file_names(parts.iter().map(|part| part.id.as_str()));
    let mut files = Files::default();
    for (part, name) in parts.iter().zip(names) {
        let drawing = sheet::part_file(
            part,
            inputs.fabrication.kerf * MM,
            inputs.fabrication.colours,
        );
        files.add(&format!("parts/{name}"), "dxf", dxf::write(&drawing));
    }
    files.finish()
}

/// The coupon that tells kerf and fit of a machine, one for each material and thickness.
pub fn coupon_files(sections: &[CouponSection], inputs: Inputs<'_>) -> Checked<Vec<OutputFile>> {
    let mut files = Files::default();
    for section in sections {
        let name = format!(
            "coupon/{}-{}mm",
            file_name(&section.material),
            trim(section.thickness * MM)
        );
        let drawing = coupon::draw(section, inputs.hardware, inputs.fabrication.colours);
        files.both(&name, &drawing);
    }
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

/// The sheets of foil.
pub fn sticker_files(plan: &Plan, inputs: Inputs<'_>) -> Checked<Vec<OutputFile>> {
    let by_id = plan.stickers.iter().map(|s| (s.id.as_str(), s)).collect();
    let style = stickers::FoilStyle {
        project: &plan.name,
        count: plan.foils.len(),
        colours: inputs.fabrication.colours,
    };
    let mut files = Files::default();
    for sheet in &plan.foils {
        let name = format!(
            "stickers/{}_{}-{}mm_{}-of-{:02}",
            file_name(&plan.name),
            file_name(&sheet.material),
            trim(sheet.thickness * MM),
            sheet.id,
            plan.foils.len()
        );
        files.both(&name, &stickers::draw(sheet, &by_id, &style));
    }
    files.finish()
}

/// The ground plan, and every support as it is made: printed, or cast and cut.
pub fn support_files(plan: &Plan, inputs: Inputs<'_>) -> Checked<Vec<OutputFile>> {
    let names = distinct_file_names(plan.supports.iter().map(|support| support.id.as_str()));
    let grid: f64 = plan.lamellae.iter().map(|lamella| lamella.mass).sum();
    let style = supports::drawing::BlockStyle {
        project: &plan.name,
        share: grid / plan.supports.len().max(1) as f64,
        sheet: supports::thinnest_sheet(plan).unwrap_or(supports::WEDGE_EDGE),
        colours: inputs.fabrication.colours,
    };
    let mut files = Files::default();
    if let Some(drawing) = supports::setting_out::draw(plan) {
        files.both("supports/setting-out", &drawing);
    }
    let mut solids = Vec::new();
    for (support, name) in plan.supports.iter().zip(names) {
        let name = format!("supports/{name}");
        if let Some(drawing) = supports::drawing::block(support, &style) {
            files.both(&format!("{name}.block"), &drawing);
        }
        if let Some(drawing) = supports::drawing::template(support, &style) {
            files.both(&format!("{name}.template"), &drawing);
        }
        if let Some(solid) = supports::solid::of(support) {
            files.made.push(OutputFile {
                path: format!("{name}.stl"),
                bytes: supports::solid::stl(&support.id, &solid),
            });
            solids.push((support.id.as_str(), solid));
        }
    }
    if !solids.is_empty() {
        files.made.push(OutputFile {
            path: "supports/supports.3mf".to_owned(),
            bytes: supports::solid::three_mf(&solids),
        });
    }
    files.finish()
}

/// The step list.
pub fn assembly_file(plan: &Plan, inputs: Inputs<'_>) -> OutputFile {
    OutputFile {
        path: "assembly.md".to_owned(),
        bytes: assembly::steps(plan, inputs.hardware),
    }
}

/// The tables, each as CSV, and all of them as a workbook.
pub fn table_files(plan: &Plan, inputs: Inputs<'_>) -> Vec<OutputFile> {
    let mut made = vec![
        ("Summary", "summary", tables::summary(plan)),
        ("Shopping", "bom", tables::bom(&plan.bill_of_materials)),
        (
            "Cut list",
            "cutlist",
            tables::cut_list(plan, inputs.materials),
        ),
        (
            "Crossings",
            "crossings",
            tables::crossings(plan, inputs.hardware),
        ),
    ];
    if !plan.stickers.is_empty() {
        made.push(("Stickers", "stickers", stickers::table(plan)));
    }
    if !plan.supports.is_empty() {
        made.push(("Supports", "supports", supports::table(plan)));
    }
    let tabs: Vec<Tab<'_>> = made
        .iter()
        .map(|(name, _, csv)| Tab { name, csv })
        .collect();
    let workbook = workbook::write(&plan.name, &tabs);
    let mut files: Vec<OutputFile> = made
        .into_iter()
        .map(|(_, name, bytes)| OutputFile {
            path: format!("{name}.csv"),
            bytes,
        })
        .collect();
    files.push(OutputFile {
        path: "bill.xlsx".to_owned(),
        bytes: workbook,
    });
    files
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
