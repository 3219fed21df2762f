//! The bill of materials: what to buy for a structure.
//!
//! Panels come from the nesting, bolts from the stack of lamellae, foils, washers and nut at
//! every node, shells and stickers from the crossings that slide. Spares are a twentieth,
//! rounded up, at least two. Rows stand in the order of categories and of their ids.

use super::hardware::{Fastener, SHELL_EXCESS, Series, TUBE_SAW, tube_mass_per_metre};
use super::index::PlanIndex;
use super::nesting::Group;
use super::nodes::{Node, nodes};
use super::part::{contact_reach, net_area};
use super::sheet::trim;
use super::units::MM;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::plan::{BomRow, Plan};
use crate::project::model::{Hardware, Material, Stock};
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

/// The rows. Fails if no bolt of the series is long enough.
pub fn rows(plan: &Plan, shopping: &Shopping<'_>) -> Checked<Vec<BomRow>> {
    let index = PlanIndex::new(plan);
    let bolt = &shopping.hardware.bolt;
    let nodes = nodes(&plan.crossings, &index, 0.25 * bolt.diameter);
    let mut rows = panels(shopping);
    rows.extend(lamellae(plan, shopping));
    rows.extend(fasteners(&nodes, shopping)?);
    rows.extend(shells(&nodes, shopping));
    rows.extend(stickers(plan, &index, &nodes, shopping));
    rows.extend(coating(plan));
    Ok(Warned {
        value: rows,
        warnings: Vec::new(),
    })
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

/// Metres of each section: not bought as such, but what a panel becomes.
fn lamellae(plan: &Plan, shopping: &Shopping<'_>) -> Vec<BomRow> {
    let mut sections: BTreeMap<String, (usize, f64, &crate::plan::LamellaRecord)> = BTreeMap::new();
    for lamella in &plan.lamellae {
        let section = format!(
            "lamella-{}-{}x{}",
            lamella.material,
            trim(lamella.width * MM),
            trim(lamella.thickness * MM)
        );
        let entry = sections.entry(section).or_insert((0, 0.0, lamella));
        entry.0 += 1;
        entry.1 += lamella.length;
    }
    sections
        .into_iter()
        .map(|(id, (count, metres, first))| {
            let material = shopping.materials.iter().find(|m| m.name == first.material);
            BomRow {
                id,
                category: "lamella".to_owned(),
                description: format!("{count} lamellae, cut from the panels"),
                material: first.material.clone(),
                specification: format!(
                    "{} x {} mm",
                    trim(first.width * MM),
                    trim(first.thickness * MM)
                ),
                quantity: metres,
                unit: "m".to_owned(),
                spare: 0.0,
                unit_mass: material.map(|m| m.density * first.width * first.thickness),
                unit_cost: None,
            }
        })
        .collect()
}

fn fasteners(nodes: &[Node<'_>], shopping: &Shopping<'_>) -> Result<Vec<BomRow>, Vec<Diagnostic>> {
    let bolt = &shopping.hardware.bolt;
    let Some(series) = Series::of(bolt.diameter) else {
        return Err(super::hardware::check(shopping.hardware));
    };
    let foil = shopping
        .hardware
        .sticker
        .as_ref()
        .map_or(0.0, |s| s.thickness);
    // Lengths in micrometres, which compare exactly.
    let mut lengths: BTreeMap<u64, usize> = BTreeMap::new();
    let mut rods: BTreeMap<u64, usize> = BTreeMap::new();
    for node in nodes {
        let stack = node.lamellae_thickness + 2.0 * foil * node.sliding as f64;
        match series.fastener(stack) {
            Ok(Fastener::Bolt(length)) => *lengths.entry((length * 1e6) as u64).or_default() += 1,
            Ok(Fastener::Rod(length)) => {
                *rods.entry(libm::round(length * 1e6) as u64).or_default() += 1;
            }
            Err(need) => return Err(vec![too_short(node, series, need, &bolt.name)]),
        }
    }
    let second_nuts: usize = rods.values().sum();
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
        nodes.len() + second_nuts,
        series.nut_mass(),
    ));
    rows.push(piece(
        format!("washer-{key}"),
        "washer, large",
        format!("{} {name}", series.washer_standard),
        2 * nodes.len(),
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
    let foil = shopping
        .hardware
        .sticker
        .as_ref()
        .map_or(0.0, |s| s.thickness);
    let mut cuts: BTreeMap<u64, usize> = BTreeMap::new();
    for node in nodes.iter().filter(|node| node.sliding > 0) {
        let stack = node.lamellae_thickness + 2.0 * foil * node.sliding as f64 + SHELL_EXCESS;
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

/// Two stickers at each crossing that slides, one for each face in contact, and the foil for
/// them with its offcuts.
fn stickers(
    plan: &Plan,
    index: &PlanIndex<'_>,
    nodes: &[Node<'_>],
    shopping: &Shopping<'_>,
) -> Vec<BomRow> {
    let Some(sticker) = &shopping.hardware.sticker else {
        return Vec::new();
    };
    let count: usize = nodes.iter().map(|node| 2 * node.sliding).sum();
    if count == 0 {
        return Vec::new();
    }
    let mut area = 0.0;
    for crossing in &plan.crossings {
        if !super::nodes::slides(crossing, index) {
            continue;
        }
        let [Some(u), Some(v)] = [&crossing.u, &crossing.v].map(|m| index.lamella_of(m)) else {
            continue;
        };
        let slide = |on: crate::plan::Positions| (on.surface - on.planar).abs();
        for (own, other, on) in [(u, v, crossing.on_u), (v, u, crossing.on_v)] {
            let reach = contact_reach(own.width, other.width, crossing) + sticker.margin;
            area += (2.0 * reach + slide(on)) * own.width;
        }
    }
    let specification = format!(
        "{} {} mm, self-adhesive",
        sticker.foil,
        trim(sticker.thickness * MM)
    );
    vec![
        BomRow {
            id: "sticker".to_owned(),
            category: "friction".to_owned(),
            description: "sticker, one for each face in contact".to_owned(),
            material: sticker.foil.clone(),
            specification: specification.clone(),
            quantity: count as f64,
            unit: "pcs".to_owned(),
            spare: spare(count),
            unit_mass: None,
            unit_cost: None,
        },
        BomRow {
            id: "foil".to_owned(),
            category: "friction".to_owned(),
            description: "foil for the stickers, without offcuts".to_owned(),
            material: sticker.foil.clone(),
            specification,
            quantity: area,
            unit: "m2".to_owned(),
            spare: 0.0,
            unit_mass: None,
            unit_cost: None,
        },
    ]
}

/// Both faces and the edges of all lamellae.
fn coating(plan: &Plan) -> Vec<BomRow> {
    let area: f64 = plan
        .lamellae
        .iter()
        .map(|lamella| {
            let edges = 2.0 * (lamella.length + lamella.width) * lamella.thickness;
            2.0 * net_area(lamella) / (MM * MM) + edges
        })
        .sum();
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
