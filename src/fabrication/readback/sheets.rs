//! Cut files against the sheets of the plan.

use super::curves::{Curve, Drawings, Read};
use super::expected::{self, ExpectedPart};
use super::{Agreement, Findings, Folder};
use crate::fabrication::drawing::{Bounds, Layer};
use crate::fabrication::names::part_file_names;
use crate::fabrication::passage::{PIN, windows};
use crate::fabrication::units::MM;
use crate::plan::{Plan, SheetRecord};
use std::collections::BTreeMap;

/// A contour may be off by this, millimetres: plans are written to a nanometre, SVG to a tenth of
/// a micrometre.
const OFF: f64 = 2e-3;
/// Areas may be off by what a contour of some hundred millimetres makes of that.
const AREA_OFF: f64 = 0.5;

/// Every sheet has its cut files, and there are no others.
pub(super) fn check(
    plan: &Plan,
    folder: &Folder,
    drawings: &Drawings,
    agreement: &mut Agreement,
    findings: &mut Findings,
) {
    let parts = expected::parts(plan);
    let mut known: Vec<String> = Vec::new();
    for sheet in &plan.sheets {
        let mark = format!("_{}-of-{:02}", sheet.id, plan.sheets.len());
        let ends: Vec<String> = match windows(sheet).len() {
            0 => vec![mark],
            n => (1..=n)
                .map(|i| format!("{mark}_window-{i}-of-{n}"))
                .collect(),
        };
        for format in ["dxf", "svg"] {
            let found: Option<Vec<&String>> = ends
                .iter()
                .map(|end| cut_file(folder, end, format))
                .collect();
            let Some(paths) = found else {
                let what = format!("the {} of `{}`", format.to_uppercase(), sheet.id);
                findings.missing(&what, &sheet.id);
                continue;
            };
            known.extend(paths.iter().map(|path| (*path).clone()));
            let reads: Option<Vec<(&str, &Read)>> = paths
                .iter()
                .map(|path| Some((path.as_str(), drawings.get(*path)?)))
                .collect();
            // What could not be read was told.
            let Some(reads) = reads else { continue };
            let openings = check_sheet(sheet, &parts, &reads, findings);
            if format == "dxf" {
                agreement.cut_files += reads.len();
                agreement.parts += sheet.parts.len();
                agreement.openings += openings;
            }
        }
    }
    for path in folder.keys() {
        let is_cut = path.starts_with("fabrication/")
            && path.contains("_sheet-")
            && !path.ends_with(".overview.svg")
            && matches!(ending(path), "dxf" | "svg");
        if is_cut && !known.contains(path) {
            findings.unexpected(path);
        }
    }
}

/// What follows the last dot of a path.
fn ending(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or_default()
}

fn cut_file<'a>(folder: &'a Folder, end: &str, format: &str) -> Option<&'a String> {
    let tail = format!("{end}.{format}");
    folder
        .keys()
        .find(|path| path.starts_with("fabrication/") && path.ends_with(&tail))
}

/// A curve in the frame of the panel.
struct Cut<'a> {
    curve: &'a Curve,
    bounds: Bounds,
    used: bool,
}

fn cuts<'a>(reads: &[(&str, &'a Read)], sheet: &SheetRecord, layer: Layer) -> Vec<Cut<'a>> {
    let windows = windows(sheet);
    let mut cuts = Vec::new();
    for (i, (_, read)) in reads.iter().enumerate() {
        let from = windows.get(i).map_or(0.0, |window| window.from);
        for curve in read.curves.iter().filter(|c| c.layer == layer.name()) {
            let mut bounds = curve.geometry.bounds();
            bounds.min[0] += from;
            bounds.max[0] += from;
            cuts.push(Cut {
                curve,
                bounds,
                used: false,
            });
        }
    }
    cuts
}

/// All parts and openings of a sheet; gives the number of openings.
fn check_sheet(
    sheet: &SheetRecord,
    parts: &BTreeMap<String, ExpectedPart>,
    reads: &[(&str, &Read)],
    findings: &mut Findings,
) -> usize {
    let path = reads.first().map_or("", |read| read.0);
    let kerf = sheet.kerf * MM;
    let mut outer = cuts(reads, sheet, Layer::CutOuter);
    let mut inner = cuts(reads, sheet, Layer::CutInner);
    let mut count = 0;
    for place in &sheet.parts {
        let Some(part) = parts.get(&place.part) else {
            findings.part(
                path,
                &place.part,
                "is on the sheet, but no lamella of the plan",
            );
            continue;
        };
        let at = [place.x * MM, place.y * MM];
        check_outline(path, &place.part, part, at, kerf, &mut outer, findings);
        check_openings(path, &place.part, part, at, kerf, &mut inner, findings);
        count += part.openings.len();
    }
    // Pins stand in the border, where no part is.
    let pin = |cut: &Cut<'_>| {
        let size = cut.bounds.size();
        !sheet.windows.is_empty() && (size[0] - (PIN - kerf)).abs() < OFF
    };
    for (cuts, what) in [(&outer, "outline"), (&inner, "opening")] {
        let spare = cuts
            .iter()
            .filter(|cut| !(cut.used || what == "opening" && pin(cut)));
        for cut in spare {
            let [x, y] = cut.bounds.min;
            let whose = cut.curve.subject.as_deref().unwrap_or("unknown");
            findings.part(
                path,
                whose,
                &format!("has an {what} at ({x:.2}, {y:.2}) mm that the plan does not have"),
            );
        }
    }
    count
}

fn check_outline(
    path: &str,
    id: &str,
    part: &ExpectedPart,
    [x, y]: [f64; 2],
    kerf: f64,
    outer: &mut [Cut<'_>],
    findings: &mut Findings,
) {
    let grow = 0.5 * kerf;
    let wanted = Bounds {
        min: [x - grow, y - grow],
        max: [x + part.length + grow, y + part.width + grow],
    };
    let mut found = Bounds::EMPTY;
    let mut length = 0.0;
    for cut in outer.iter_mut().filter(|cut| within(&cut.bounds, &wanted)) {
        cut.used = true;
        found.join(&cut.bounds);
        length += cut.curve.geometry.length();
        if let Some(subject) = &cut.curve.subject
            && subject != id
        {
            findings.part(path, id, &format!("is drawn as `{subject}`"));
        }
    }
    if found.is_empty() {
        findings.part(path, id, "has no outline where the plan places it");
        return;
    }
    let [long, wide] = found.size();
    let [expected_long, expected_wide] = wanted.size();
    if (long - expected_long).abs() > OFF || (wide - expected_wide).abs() > OFF {
        findings.part(
            path,
            id,
            &format!(
                "is drawn {long:.2} x {wide:.2} mm, the plan has {expected_long:.2} x \
                 {expected_wide:.2} mm"
            ),
        );
    } else if length < part.perimeter - 1.0 {
        findings.part(path, id, "has an outline with a gap");
    }
}

fn check_openings(
    path: &str,
    id: &str,
    part: &ExpectedPart,
    [x, y]: [f64; 2],
    kerf: f64,
    inner: &mut [Cut<'_>],
    findings: &mut Findings,
) {
    for opening in &part.openings {
        let radius = 0.5 * (opening.diameter - kerf);
        let middle = y + 0.5 * part.width;
        let wanted = Bounds {
            min: [x + opening.centres[0] - radius, middle - radius],
            max: [x + opening.centres[1] + radius, middle + radius],
        };
        let found = inner
            .iter_mut()
            .find(|cut| !cut.used && within(&cut.bounds, &wanted) && within(&wanted, &cut.bounds));
        let Some(found) = found else {
            let [from, to] = opening.centres;
            let how = format!(
                "lacks its opening of {:.2} mm for `{}` at {:.2} mm",
                opening.diameter,
                opening.name,
                0.5 * (from + to)
            );
            findings.part(path, id, &how);
            continue;
        };
        found.used = true;
        let area = found.curve.geometry.area();
        if !found.curve.geometry.is_closed() || (area - opening.area(kerf)).abs() > AREA_OFF {
            let how = format!("has an opening of another shape for `{}`", opening.name);
            findings.part(path, id, &how);
        }
    }
}

/// Whether a box lies in another, up to what may be off.
fn within(inner: &Bounds, outer: &Bounds) -> bool {
    (0..2).all(|k| inner.min[k] > outer.min[k] - OFF && inner.max[k] < outer.max[k] + OFF)
}

/// Every part has its own file.
pub(super) fn check_parts(
    plan: &Plan,
    folder: &Folder,
    drawings: &Drawings,
    findings: &mut Findings,
) {
    let parts = expected::parts(plan);
    let names = part_file_names(parts.keys().map(String::as_str));
    let mut known = Vec::new();
    for ((id, part), name) in parts.iter().zip(names) {
        let path = format!("parts/{name}.dxf");
        if !folder.contains_key(&path) {
            findings.missing(&format!("`{path}`"), id);
        }
        if let Some(read) = drawings.get(&path) {
            let of_part = |p: &&crate::plan::PlacedPart| p.part == *id;
            let sheet = plan
                .sheets
                .iter()
                .find(|s| s.parts.iter().any(|p| of_part(&p)));
            let alone = SheetRecord {
                parts: vec![crate::plan::PlacedPart {
                    part: id.clone(),
                    x: 0.5 * sheet.map_or(0.0, |s| s.kerf),
                    y: 0.5 * sheet.map_or(0.0, |s| s.kerf),
                }],
                windows: Vec::new(),
                kerf: sheet.map_or(0.0, |s| s.kerf),
                ..sheet.cloned().unwrap_or_else(|| empty_sheet(part))
            };
            check_sheet(&alone, &parts, &[(&path, read)], findings);
        }
        known.push(path);
    }
    for path in folder
        .keys()
        .filter(|p| p.starts_with("parts/") && ending(p) == "dxf")
    {
        if !known.contains(path) {
            findings.unexpected(path);
        }
    }
}

fn empty_sheet(part: &ExpectedPart) -> SheetRecord {
    SheetRecord {
        id: String::new(),
        material: String::new(),
        thickness: 0.0,
        length: part.length / MM,
        width: part.width / MM,
        yield_share: 0.0,
        kerf: 0.0,
        parts: Vec::new(),
        windows: Vec::new(),
    }
}
