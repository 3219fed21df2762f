//! What joints need: glue, or plates with their screws.

use crate::diagnostics::{Diagnostic, codes::fabrication as codes};
use crate::fabrication::hardware::{self, Series};
use crate::fabrication::pieces::plates;
use crate::fabrication::sections::{self, Strip};
use crate::fabrication::sheet::trim;
use crate::fabrication::units::MM;
use crate::plan::{BomRow, JointRecord, LamellaRecord, Plan};
use crate::project::model::{Hardware, SpliceKind};
use std::collections::BTreeMap;

/// Rows of the bill for all joints of a plan, none for a plan without. Fails if no bolt of the
/// series goes through lamella and plate.
pub fn rows(plan: &Plan, hardware: &Hardware) -> Result<Vec<BomRow>, Vec<Diagnostic>> {
    let joints: Vec<(&LamellaRecord, &JointRecord)> = plan
        .lamellae
        .iter()
        .flat_map(|lamella| lamella.pieces.iter().map(move |piece| (lamella, piece)))
        .filter_map(|(lamella, piece)| Some((lamella, piece.joint.as_ref()?)))
        .collect();
    let of = |kind: SpliceKind| joints.iter().filter(move |(_, joint)| joint.kind == kind);
    let mut rows = Vec::new();
    for (kind, name) in [(SpliceKind::Finger, "finger"), (SpliceKind::Scarf, "scarf")] {
        let count = of(kind).count();
        if count > 0 {
            let area: f64 = of(kind).map(|(lamella, joint)| glued(lamella, joint)).sum();
            rows.push(glue(name, count, area));
        }
    }
    let plated: Vec<_> = of(SpliceKind::Plate).copied().collect();
    rows.extend(sections::rows(
        "plate",
        "plates over joints",
        plan.lamellae.iter().flat_map(plates).map(|plate| Strip {
            lamella: plate.lamella,
            length: (plate.to - plate.from) / MM,
            mass: plate.mass(),
        }),
    ));
    if !plated.is_empty() {
        rows.extend(screws(&plated, hardware)?);
    }
    Ok(rows)
}

/// Glued area of a joint, square metres: flanks of fingers, or the slope of a scarf.
fn glued(lamella: &LamellaRecord, joint: &JointRecord) -> f64 {
    match joint.kind {
        SpliceKind::Finger => {
            let flanks = f64::from((2 * joint.fingers).saturating_sub(1));
            flanks * joint.length * lamella.thickness
        }
        SpliceKind::Scarf => libm::hypot(joint.length, lamella.thickness) * lamella.width,
        SpliceKind::Plate => 0.0,
    }
}

fn glue(kind: &str, count: usize, area: f64) -> BomRow {
    BomRow {
        id: format!("glue-{kind}"),
        category: "consumable".to_owned(),
        description: format!("wood glue, {count} {kind} joints"),
        material: String::new(),
        specification: "D3 or better (EN 204)".to_owned(),
        quantity: area * 1e4,
        unit: "cm2".to_owned(),
        spare: 0.0,
        unit_mass: None,
        unit_cost: None,
    }
}

/// Length of the bolts through a lamella and a plate, metres; what is needed if none is so long.
pub fn screw_length(series: &Series, lamella: &LamellaRecord) -> Result<f64, f64> {
    series.bolt_length(2.0 * lamella.thickness)
}

/// Bolts through lamella and plate, each with a nut and two washers, as at crossings.
fn screws(
    joints: &[(&LamellaRecord, &JointRecord)],
    hardware: &Hardware,
) -> Result<Vec<BomRow>, Vec<Diagnostic>> {
    let bolt = &hardware.bolt;
    let Some(series) = Series::of(bolt.diameter) else {
        return Err(hardware::check(hardware));
    };
    // Lengths in micrometres, which compare exactly.
    let mut lengths: BTreeMap<u64, usize> = BTreeMap::new();
    for (lamella, joint) in joints {
        let length = screw_length(series, lamella);
        let length = length.map_err(|need| vec![too_short(lamella, need, &bolt.name)])?;
        *lengths.entry((length * 1e6) as u64).or_default() += joint.screws.len();
    }
    let count: usize = lengths.values().sum();
    let name = &bolt.name;
    let key = name.to_lowercase();
    let row = |id: String, description: &str, specification: String, count: usize, mass| BomRow {
        id,
        category: "fastener".to_owned(),
        description: format!("{description} of plates"),
        material: "steel".to_owned(),
        specification,
        quantity: count as f64,
        unit: "pcs".to_owned(),
        spare: count.div_ceil(20).max(2) as f64,
        unit_mass: Some(mass),
        unit_cost: None,
    };
    let mut rows: Vec<BomRow> = lengths
        .into_iter()
        .map(|(micrometres, count)| {
            let length = micrometres as f64 * 1e-6;
            let millimetres = trim(length * MM);
            let id = format!("plate-bolt-{key}x{millimetres}");
            let specification = format!("{} {name}x{millimetres}", series.bolt_standard);
            row(id, "bolt", specification, count, series.bolt_mass(length))
        })
        .collect();
    let nut = format!("DIN 985 {name}");
    rows.push(row(
        format!("plate-nut-{key}"),
        "lock nut",
        nut,
        count,
        series.nut_mass(),
    ));
    let washer = format!("{} {name}", series.washer_standard);
    let id = format!("plate-washer-{key}");
    rows.push(row(id, "washer", washer, 2 * count, series.washer_mass()));
    Ok(rows)
}

fn too_short(lamella: &LamellaRecord, need: f64, bolt: &str) -> Diagnostic {
    Diagnostic::error(
        codes::BOLT_TOO_SHORT,
        format!(
            "through `{}` and its plate a bolt of {:.1} mm is needed, longer than {bolt} is made",
            lamella.id,
            need * MM
        ),
    )
    .at_key("hardware.bolt", "too short")
    .about(&lamella.id)
}
