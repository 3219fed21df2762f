//! The bill of materials: what to buy for a structure.
//!
//! Panels come from the nesting, bolts from the stack of lamellae, foils, washers and nut at
//! every node, shells and stickers from the crossings that slide. Spares are a twentieth,
//! rounded up, at least two. Rows stand in the order of categories and of their ids.

use super::hardware::{Fastener, SHELL_EXCESS, Series, TUBE_SAW, tube_mass_per_metre};
use super::index::PlanIndex;
use super::nesting::Group;
use super::nodes::{Node, nodes};
use super::part::net_area;
use super::pieces::plates;
use super::sections::{self, Strip};
use super::sheet::trim;
use super::splicing;
use super::supports::drawing::layers;
use super::supports::{WEDGE_EDGE, thinnest_sheet};
use super::units::MM;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::plan::{BomRow, LamellaRecord, Plan, SupportBody, SupportRecord};
use crate::project::model::{Hardware, Material, Stock, SupportKind};
use std::collections::BTreeMap;

/// What the bill depends on besides the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shopping<'a> {
    /// Bolts, stickers, shells.
    pub hardware: &'a Hardware,
    /// Materials by name, for density and price.
    pub materials: &'a [Material],
    /// The panel.
    pub stock: &'a Stock,
    /// What nesting needs.
    pub groups: &'a [Group],
}

/// The rows of a plan that has its stickers and supports. Fails if no bolt of the series is long
/// enough.
pub fn rows(plan: &Plan, shopping: &Shopping<'_>) -> Checked<Vec<BomRow>> {
    let index = PlanIndex::new(plan);
    let bolt = &shopping.hardware.bolt;
    let nodes = nodes(&plan.crossings, &index, 0.25 * bolt.diameter);
    let mut rows = panels(shopping);
    rows.extend(sections::rows(
        "lamella",
        "lamellae",
        plan.lamellae.iter().map(|lamella| Strip {
            lamella,
            length: lamella.length,
            mass: lamella.mass,
        }),
    ));
    rows.extend(fasteners(plan, &nodes, shopping)?);
    rows.extend(shells(&nodes, shopping));
    rows.extend(stickers(plan, shopping));
    rows.extend(supports(plan, shopping));
    rows.extend(splicing::shopping::rows(plan, shopping.hardware)?);
    rows.extend(coating(plan));
    Ok(Warned {
        value: rows,
        warnings: Vec::new(),
    })
}

/// Whether a row is bought as such, and not cut, cast or printed from what another row has.
pub fn is_bought(row: &BomRow) -> bool {
    match row.category.as_str() {
        "lamella" | "plate" => false,
        "sleeve" => row.id == "tube",
        "friction" => row.id == "foil",
        "support" => !matches!(row.id.as_str(), "block" | "foot"),
        _ => true,
    }
}

/// Spares of pieces that get lost: a twentieth, at least two.
fn spare(count: usize) -> f64 {
    count.div_ceil(20).max(2) as f64
}

fn panels(shopping: &Shopping<'_>) -> Vec<BomRow> {
    let stock = shopping.stock;
    let area = stock.length * stock.width;
    shopping
        .groups
        .iter()
        .map(|group| {
            let material = shopping.materials.iter().find(|m| m.name == group.material);
            let thickness = trim(group.thickness * MM);
            let sawn = if group.format.per_panel > 1 || group.format.width < stock.width {
                format!(
                    ", sawn into {} of {} x {} mm",
                    group.format.per_panel,
                    trim(group.format.length * MM),
                    trim(group.format.width * MM)
                )
            } else {
                String::new()
            };
            BomRow {
                id: format!("panel-{}-{thickness}", group.material),
                category: "stock".to_owned(),
                description: format!("panel {}", group.material),
                material: group.material.clone(),
                specification: format!(
                    "{} x {} x {thickness} mm{sawn}",
                    trim(stock.length * MM),
                    trim(stock.width * MM)
                ),
                quantity: f64::from(group.panels),
                unit: "pcs".to_owned(),
                spare: 0.0,
                unit_mass: material.map(|m| m.density * area * group.thickness),
                unit_cost: stock
                    .price
                    .or_else(|| material.and_then(|m| m.price).map(|price| price * area)),
            }
        })
        .collect()
}

fn fasteners(
    plan: &Plan,
    nodes: &[Node<'_>],
    shopping: &Shopping<'_>,
) -> Result<Vec<BomRow>, Vec<Diagnostic>> {
    let bolt = &shopping.hardware.bolt;
    let Some(series) = Series::of(bolt.diameter) else {
        return Err(super::hardware::check(shopping.hardware));
    };
    // Lengths in micrometres, which compare exactly.
    let mut lengths: BTreeMap<u64, usize> = BTreeMap::new();
    let mut rods: BTreeMap<u64, usize> = BTreeMap::new();
    let (mut nuts, mut washers) = (0, 0);
    for node in nodes {
        let fixing = node.fixing(&plan.supports, shopping.hardware);
        let (length, kind) = match fixing.fastener {
            Some(Fastener::Bolt(length)) => (length, &mut lengths),
            Some(Fastener::Rod(length)) => (length, &mut rods),
            None => {
                let need = series.bolt_length(fixing.stack).unwrap_or_else(|need| need);
                return Err(vec![too_short(node, series, need, &bolt.name)]);
            }
        };
        *kind.entry(libm::round(length * 1e6) as u64).or_default() += 1;
        nuts += fixing.nuts;
        washers += fixing.washers;
    }
    let piece = |id: String, description: &str, specification: String, count: usize, mass| BomRow {
        id,
        category: "fastener".to_owned(),
        description: description.to_owned(),
        material: "steel".to_owned(),
        specification,
        quantity: count as f64,
        unit: "pcs".to_owned(),
        spare: spare(count),
        unit_mass: Some(mass),
        unit_cost: None,
    };
    let name = &bolt.name;
    let key = name.to_lowercase();
    let mut rows: Vec<BomRow> = lengths
        .into_iter()
        .map(|(micrometres, count)| {
            let length = micrometres as f64 * 1e-6;
            let millimetres = trim(length * MM);
            piece(
                format!("bolt-{key}x{millimetres}"),
                "bolt",
                format!("{} {name}x{millimetres}", series.bolt_standard),
                count,
                series.bolt_mass(length),
            )
        })
        .collect();
    rows.extend(rods.into_iter().map(|(micrometres, count)| {
        let length = micrometres as f64 * 1e-6;
        let millimetres = trim(length * MM);
        piece(
            format!("rod-{key}x{millimetres}"),
            "threaded rod, cut to length",
            format!("DIN 976 {name}x{millimetres}"),
            count,
            series.rod_mass(length),
        )
    }));
    rows.push(piece(
        format!("nut-{key}"),
        "lock nut",
        format!("DIN 985 {name}"),
        nuts,
        series.nut_mass(),
    ));
    rows.push(piece(
        format!("washer-{key}"),
        "washer, large",
        format!("{} {name}", series.washer_standard),
        washers,
        series.washer_mass(),
    ));
    Ok(rows)
}

fn too_short(node: &Node<'_>, series: &Series, need: f64, bolt: &str) -> Diagnostic {
    let crossing = node.crossings.first().map_or("", |c| c.id.as_str());
    Diagnostic::error(
        codes::BOLT_TOO_SHORT,
        format!(
            "at `{crossing}` a bolt of {:.1} mm is needed, {bolt} ends at {:.0} mm",
            need * MM,
            series.lengths[1]
        ),
    )
    .at_key("hardware.bolt", "too short")
    .note(format!(
        "{:.1} mm of lamellae meet there",
        node.lamellae_thickness * MM
    ))
    .about(crossing)
}

/// One shell at each crossing that slides, cut from tube to the height of its two lamellae.
fn shells(nodes: &[Node<'_>], shopping: &Shopping<'_>) -> Vec<BomRow> {
    let Some(shell) = &shopping.hardware.shell else {
        return Vec::new();
    };
    let mut cuts: BTreeMap<u64, usize> = BTreeMap::new();
    for node in nodes.iter().filter(|node| node.sliding > 0) {
        let stack = node.fixing(&[], shopping.hardware).stack + SHELL_EXCESS;
        *cuts.entry(libm::round(stack * 1e6) as u64).or_default() += 1;
    }
    let mass = tube_mass_per_metre(shell);
    let material = shell.name.split_whitespace().next().unwrap_or_default();
    let mut metres = 0.0;
    let mut rows = Vec::new();
    for (micrometres, count) in cuts {
        let length = micrometres as f64 * 1e-6;
        let millimetres = trim(length * MM);
        metres += (count as f64 + spare(count)) * (length + TUBE_SAW);
        rows.push(BomRow {
            id: format!("shell-{millimetres}"),
            category: "sleeve".to_owned(),
            description: format!("shell, cut to {millimetres} mm"),
            material: material.to_owned(),
            specification: shell.name.clone(),
            quantity: count as f64,
            unit: "pcs".to_owned(),
            spare: spare(count),
            unit_mass: mass.map(|mass| mass * length),
            unit_cost: None,
        });
    }
    if !rows.is_empty() {
        rows.push(BomRow {
            id: "tube".to_owned(),
            category: "sleeve".to_owned(),
            description: "tube for the shells, saw cuts and spares included".to_owned(),
            material: material.to_owned(),
            specification: shell.name.clone(),
            quantity: metres,
            unit: "m".to_owned(),
            spare: 0.0,
            unit_mass: mass,
            unit_cost: None,
        });
    }
    rows
}

/// Stickers, and the sheets of foil for them.
fn stickers(plan: &Plan, shopping: &Shopping<'_>) -> Vec<BomRow> {
    let Some(sticker) = &shopping.hardware.sticker else {
        return Vec::new();
    };
    let count = plan.stickers.len();
    if count == 0 {
        return Vec::new();
    }
    let area: f64 = plan.stickers.iter().map(super::stickers::area_of).sum();
    let density = foil_density(&sticker.foil);
    let weight = |area: f64| density.map(|density| density * area * sticker.thickness);
    let foil = format!("{} {} mm", sticker.foil, trim(sticker.thickness * MM));
    let [length, width] = sticker.sheet;
    vec![
        BomRow {
            id: "sticker".to_owned(),
            category: "friction".to_owned(),
            description: "sticker, one for each face in contact, cut from the foil".to_owned(),
            material: sticker.foil.clone(),
            specification: format!("{foil}, {:.0} cm2 in all", area * 1e4),
            quantity: count as f64,
            unit: "pcs".to_owned(),
            spare: spare(count),
            unit_mass: weight(area / count as f64),
            unit_cost: None,
        },
        BomRow {
            id: "foil".to_owned(),
            category: "friction".to_owned(),
            description: "sheet of foil for the stickers".to_owned(),
            material: sticker.foil.clone(),
            specification: format!(
                "{foil}, self-adhesive, {} x {} mm",
                trim(length * MM),
                trim(width * MM)
            ),
            quantity: plan.foils.len() as f64,
            unit: "pcs".to_owned(),
            spare: 1.0,
            unit_mass: weight(length * width),
            unit_cost: None,
        },
    ]
}

/// kg/m^3 of the foils that slide, adhesive not counted.
fn foil_density(foil: &str) -> Option<f64> {
    let upper = foil.to_ascii_uppercase();
    [("PTFE", 2200.0), ("PE", 940.0)]
        .into_iter()
        .find(|(name, _)| upper.contains(name))
        .map(|(_, density)| density)
}

/// Feet, blocks, wedges, and what they are made of.
fn supports(plan: &Plan, shopping: &Shopping<'_>) -> Vec<BomRow> {
    let bodies: Vec<(&SupportRecord, SupportBody)> = plan
        .supports
        .iter()
        .filter_map(|support| Some((support, support.body?)))
        .collect();
    let Some((first, _)) = bodies.first() else {
        return Vec::new();
    };
    let mass: f64 = bodies.iter().map(|(_, body)| body.mass).sum();
    let row = |id: &str, description: &str, material: &str, specification: String| BomRow {
        id: id.to_owned(),
        category: "support".to_owned(),
        description: description.to_owned(),
        material: material.to_owned(),
        specification,
        quantity: bodies.len() as f64,
        unit: "pcs".to_owned(),
        spare: 0.0,
        unit_mass: None,
        unit_cost: None,
    };
    let bulk = |row: BomRow, mass: f64| BomRow {
        quantity: mass,
        unit: "kg".to_owned(),
        unit_mass: Some(1.0),
        ..row
    };
    let litres: f64 = bodies.iter().map(|(_, body)| body.volume * 1e3).sum();
    if first.kind == SupportKind::Printed {
        return vec![
            row(
                "foot",
                "printed foot",
                "",
                "supports/*.stl, supports/supports.3mf".to_owned(),
            ),
            bulk(
                row(
                    "filament",
                    "filament for solid feet",
                    "PLA",
                    format!("{litres:.2} l; a fill of 30 % takes about half"),
                ),
                mass,
            ),
        ];
    }
    let sides = bodies.iter().map(|(_, body)| body.foot * MM);
    let [least, most] = sides.fold([f64::INFINITY, 0.0], |[a, b], v| [a.min(v), b.max(v)]);
    let range = if most - least < 0.5 {
        format!("{} mm square", trim(most))
    } else {
        format!("{} to {} mm square", trim(least), trim(most))
    };
    let mut rows = vec![
        row("block", "block of concrete", "concrete", range),
        bulk(
            row(
                "concrete",
                "concrete for the blocks",
                "concrete",
                format!("{litres:.1} l"),
            ),
            mass,
        ),
    ];
    if first.kind == SupportKind::WedgeOnBlock {
        let thickness = thinnest_sheet(plan).unwrap_or(WEDGE_EDGE);
        let sides: usize = bodies.iter().map(|(_, body)| layers(body, thickness)).sum();
        rows.push(row(
            "wedge",
            "wooden wedge, sides cut from sheet and glued",
            "",
            format!("{sides} sides of {} mm", trim(thickness * MM)),
        ));
    }
    if let Some(series) = Series::of(shopping.hardware.bolt.diameter) {
        rows.push(row(
            "sleeve",
            "threaded sleeve to cast or screw in",
            "steel",
            format!("M{}", trim(series.diameter)),
        ));
    }
    rows
}

/// Both faces and the edges of all lamellae and plates.
fn coating(plan: &Plan) -> Vec<BomRow> {
    // Millimetres.
    let surface = |lamella: &LamellaRecord, length: f64, face: f64| {
        let edges = 2.0 * (length + lamella.width * MM) * lamella.thickness * MM;
        (2.0 * face + edges) / (MM * MM)
    };
    let of_lamellae = plan
        .lamellae
        .iter()
        .map(|lamella| surface(lamella, lamella.length * MM, net_area(lamella)));
    let of_plates = plan
        .lamellae
        .iter()
        .flat_map(plates)
        .map(|plate| surface(plate.lamella, plate.to - plate.from, plate.net_area()));
    let area: f64 = of_lamellae.chain(of_plates).sum();
    vec![BomRow {
        id: "coating".to_owned(),
        category: "consumable".to_owned(),
        description: "coating of faces and edges, one layer".to_owned(),
        material: String::new(),
        specification: String::new(),
        quantity: area,
        unit: "m2".to_owned(),
        spare: 0.0,
        unit_mass: None,
        unit_cost: None,
    }]
}
