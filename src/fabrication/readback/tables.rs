//! Tables against the plan, by the names of their columns.

use super::expected::{self, ExpectedPart};
use super::{Agreement, Findings, Folder};
use crate::fabrication::units::MM;
use crate::plan::{CrossingRecord, Plan};
use std::collections::BTreeMap;

/// Lengths in tables have two decimals, millimetres.
const OFF: f64 = 0.0051;

/// Rows of a table by the value of a column.
type Rows = BTreeMap<String, BTreeMap<String, String>>;

pub(super) fn check(
    plan: &Plan,
    folder: &Folder,
    agreement: &mut Agreement,
    findings: &mut Findings,
) {
    let mut table = |path: &str, key: &str| read(folder, path, key, findings);
    let cut_list = table("cutlist.csv", "id");
    let crossings = table("crossings.csv", "id");
    let bill = table("bom.csv", "part_number");
    if let Some(rows) = cut_list {
        agreement.rows += rows.len();
        check_cut_list(plan, &rows, findings);
    }
    if let Some(rows) = crossings {
        agreement.rows += rows.len();
        let ids = plan.crossings.iter().map(|c| c.id.as_str());
        same_rows("crossings.csv", ids, &rows, findings);
        for crossing in &plan.crossings {
            if let Some(row) = rows.get(&crossing.id) {
                check_crossing(crossing, row, findings);
            }
        }
    }
    check_hardware(plan, folder, agreement, findings);
    if let Some(rows) = bill {
        agreement.rows += rows.len();
        let ids = plan.bill_of_materials.iter().map(|row| row.id.as_str());
        same_rows("bom.csv", ids, &rows, findings);
        for item in &plan.bill_of_materials {
            if let Some(row) = rows.get(&item.id) {
                number("bom.csv", &item.id, row, "qty", item.quantity, findings);
            }
        }
    }
}

/// Stickers and supports, where the plan has some.
fn check_hardware(
    plan: &Plan,
    folder: &Folder,
    agreement: &mut Agreement,
    findings: &mut Findings,
) {
    if !plan.stickers.is_empty()
        && let Some(rows) = read(folder, "stickers.csv", "id", findings)
    {
        agreement.rows += rows.len();
        let ids = plan.stickers.iter().map(|sticker| sticker.id.as_str());
        same_rows("stickers.csv", ids, &rows, findings);
        for sticker in &plan.stickers {
            let Some(row) = rows.get(&sticker.id) else {
                continue;
            };
            for (column, value) in [
                ("number", f64::from(sticker.number)),
                ("slot_from_mm", sticker.slot[0] * MM),
                ("slot_to_mm", sticker.slot[1] * MM),
                ("slot_width_mm", sticker.diameter * MM),
            ] {
                number("stickers.csv", &sticker.id, row, column, value, findings);
            }
        }
    }
    if !plan.supports.is_empty()
        && let Some(rows) = read(folder, "supports.csv", "id", findings)
    {
        agreement.rows += rows.len();
        let ids = plan.supports.iter().map(|support| support.id.as_str());
        same_rows("supports.csv", ids, &rows, findings);
        for support in &plan.supports {
            let Some(row) = rows.get(&support.id) else {
                continue;
            };
            let [x, y, z] = support.position;
            for (column, value) in [
                ("x_m", x),
                ("y_m", y),
                ("z_m", z),
                ("tilt_deg", support.tilt),
                ("azimuth_deg", support.azimuth),
            ] {
                number("supports.csv", &support.id, row, column, value, findings);
            }
        }
    }
}

fn read(folder: &Folder, path: &str, key: &str, findings: &mut Findings) -> Option<Rows> {
    let Some(bytes) = folder.get(path) else {
        findings.missing(&format!("`{path}`"), path);
        return None;
    };
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let header = match reader.headers() {
        Ok(header) => header.clone(),
        Err(error) => {
            findings.unreadable(path, &error.to_string());
            return None;
        }
    };
    if !header.iter().any(|name| name == key) {
        findings.unreadable(path, &format!("it has no column `{key}`"));
        return None;
    }
    let mut rows = Rows::new();
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                findings.unreadable(path, &error.to_string());
                return None;
            }
        };
        let row: BTreeMap<String, String> = header
            .iter()
            .map(str::to_owned)
            .zip(record.iter().map(str::to_owned))
            .collect();
        let id = row.get(key).cloned().unwrap_or_default();
        if rows.insert(id.clone(), row).is_some() {
            findings.table(path, &id, "stands in two rows");
        }
    }
    Some(rows)
}

/// The table has a row for every id, and no other.
fn same_rows<'a>(
    path: &str,
    ids: impl Iterator<Item = &'a str>,
    rows: &Rows,
    findings: &mut Findings,
) {
    let ids: Vec<&str> = ids.collect();
    for id in ids.iter().filter(|id| !rows.contains_key(**id)) {
        findings.table(path, id, "has no row");
    }
    for id in rows.keys().filter(|id| !ids.contains(&id.as_str())) {
        findings.table(path, id, "is not in the plan");
    }
}

fn number(
    path: &str,
    id: &str,
    row: &BTreeMap<String, String>,
    column: &str,
    expected: f64,
    findings: &mut Findings,
) {
    let Some(text) = row.get(column) else {
        findings.table(path, id, &format!("has no `{column}`"));
        return;
    };
    let found: f64 = text.parse().unwrap_or(f64::NAN);
    let agrees = (found - expected).abs() <= OFF;
    if !agrees {
        let how = format!("has `{column}` {text}, the plan has {expected:.2}");
        findings.table(path, id, &how);
    }
}

fn check_cut_list(plan: &Plan, rows: &Rows, findings: &mut Findings) {
    let path = "cutlist.csv";
    let parts = expected::parts(plan);
    same_rows(path, parts.keys().map(String::as_str), rows, findings);
    let places: BTreeMap<&str, (&str, [f64; 2])> = plan
        .sheets
        .iter()
        .flat_map(|sheet| {
            let place = |p: &crate::plan::PlacedPart| [p.x * MM, p.y * MM];
            let of_sheet = move |p| (&*sheet.id, place(p));
            sheet
                .parts
                .iter()
                .map(move |p| (p.part.as_str(), of_sheet(p)))
        })
        .collect();
    for (id, part) in &parts {
        let Some(row) = rows.get(id) else { continue };
        let ExpectedPart {
            length,
            width,
            openings,
            ..
        } = part;
        let notches = openings.iter().filter(|o| o.centres[0] != o.centres[1]);
        let notches = notches.count();
        let holes = openings.len() - notches;
        let mut check = |column: &str, value: f64| number(path, id, row, column, value, findings);
        check("length_mm", *length);
        check("width_mm", *width);
        check("holes", holes as f64);
        check("notches", notches as f64);
        if let Some((sheet, [x, y])) = places.get(id.as_str()) {
            check("x_mm", *x);
            check("y_mm", *y);
            if row.get("sheet").is_none_or(|found| found != sheet) {
                findings.table(path, id, &format!("is not on `{sheet}`"));
            }
        }
    }
}

fn check_crossing(
    crossing: &CrossingRecord,
    row: &BTreeMap<String, String>,
    findings: &mut Findings,
) {
    let path = "crossings.csv";
    for (column, metres) in [
        ("u_flat_mm", crossing.on_u.planar),
        ("u_deployed_mm", crossing.on_u.surface),
        ("v_flat_mm", crossing.on_v.planar),
        ("v_deployed_mm", crossing.on_v.surface),
    ] {
        number(path, &crossing.id, row, column, metres * MM, findings);
    }
    for (column, id) in [("u", &crossing.u), ("v", &crossing.v)] {
        if row.get(column) != Some(id) {
            findings.table(path, &crossing.id, &format!("does not join `{id}`"));
        }
    }
}
