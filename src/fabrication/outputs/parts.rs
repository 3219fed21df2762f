//! Parts and sheets: what a machine cuts.

use super::{Files, Grains, OutputFile, sheet_name};
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::fabrication::drawing::Drawing;
use crate::fabrication::index::PlanIndex;
use crate::fabrication::names::{file_name, part_file_names};
use crate::fabrication::part::{self, Part, PartStyle};
use crate::fabrication::sheet::{self, Goodness, Parts, SheetStyle, trim};
use crate::fabrication::units::MM;
use crate::fabrication::{dxf, pdf, pieces};
use crate::plan::{NestingRecord, Plan, SheetRecord};
use crate::project::model::ColourPreset;
use serde::Serialize;

/// What drawings of sheets depend on besides the plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SheetSettings {
    /// How parts are drawn.
    pub parts: PartStyle,
    /// Which colours and layer names.
    pub colours: ColourPreset,
    /// Border of the sheet that stays free, metres.
    pub margin: f64,
    /// Which way the grain runs.
    pub grains: Grains,
}

/// Every part to cut: pieces of lamellae and plates. Labels without place are told.
pub fn parts(plan: &Plan, style: PartStyle) -> Warned<Vec<Part>> {
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
    settings: &SheetSettings,
) -> Checked<Vec<OutputFile>> {
    let style = sheet_style(plan, sheet, settings);
    let material = (sheet.material.as_str(), sheet.thickness);
    let name = sheet_name("fabrication", plan, material, &sheet.id, plan.sheets.len());
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
            files.warnings.push(no_pins(sheet, settings.margin));
        }
    }
    files.picture(
        &format!("{name}.overview"),
        &sheet::overview(sheet, parts, &style),
    );
    files.finish()
}

fn sheet_style<'a>(
    plan: &'a Plan,
    sheet: &SheetRecord,
    settings: &SheetSettings,
) -> SheetStyle<'a> {
    let of_sheet = |group: &&NestingRecord| {
        group.material == sheet.material && group.thickness == sheet.thickness
    };
    let group = plan.nesting.iter().find(of_sheet);
    SheetStyle {
        project: &plan.name,
        count: plan.sheets.len(),
        kerf: settings.parts.kerf,
        grain: settings.grains.grain(&sheet.material),
        colours: settings.colours,
        goodness: group.map(|group| Goodness {
            sheets: group.sheets,
            bound: group.sheets_bound,
        }),
    }
}

fn no_pins(sheet: &SheetRecord, margin: f64) -> Diagnostic {
    Diagnostic::warning(
        codes::NO_REGISTRATION,
        format!(
            "the border of `{}` is too narrow for the pins that hold it when it is pushed on",
            sheet.id
        ),
    )
    .at_key(
        "fabrication.margin",
        format!("{} mm, 5 mm are needed", trim(margin * MM)),
    )
    .about(&sheet.id)
}

/// The overviews of all sheets as pages to print.
pub fn overview_files(
    plan: &Plan,
    parts: &Parts<'_>,
    settings: &SheetSettings,
) -> Checked<Vec<OutputFile>> {
    let pages: Vec<Drawing> = plan
        .sheets
        .iter()
        .map(|sheet| sheet::overview(sheet, parts, &sheet_style(plan, sheet, settings)))
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
pub fn part_files(
    plan: &Plan,
    style: PartStyle,
    colours: ColourPreset,
) -> Checked<Vec<OutputFile>> {
    let Warned { value: parts, .. } = parts(plan, style);
    let names = part_file_names(parts.iter().map(|part| part.id.as_str()));
    let mut files = Files::default();
    for (part, name) in parts.iter().zip(names) {
        let drawing = sheet::part_file(part, style.kerf, colours);
        files.add(&format!("parts/{name}"), "dxf", dxf::write(&drawing));
    }
    files.finish()
}
