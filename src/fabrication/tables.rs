//! Tables for spreadsheets: UTF-8, comma, line feed, decimal points, units in the headers, rows
//! in the plan's order.

use super::hardware::Fastener;
use super::index::PlanIndex;
use super::nodes::nodes;
use super::part::short_id;
use super::sheet::trim;
use super::summary::Summary;
use super::units::MM;
use crate::plan::{BomRow, CrossingRecord, OpeningRecord, Plan};
use crate::project::model::Hardware;
use std::collections::BTreeMap;

/// The structure in a few numbers.
pub fn summary(plan: &Plan) -> Vec<u8> {
    let mut table = Table::new(&["what", "value", "unit"]);
    for (name, value, unit) in Summary::new(plan).lines() {
        table.row([name, &value, unit]);
    }
    table.finish()
}

/// The shopping list.
pub fn bom(rows: &[BomRow]) -> Vec<u8> {
    let mut table = Table::new(&[
        "item",
        "category",
        "part_number",
        "description",
        "material",
        "spec",
        "qty",
        "unit",
        "qty_spare",
        "unit_mass_g",
        "total_mass_g",
        "unit_cost",
        "total_cost",
        "supplier",
        "url",
        "notes",
    ]);
    for (item, row) in rows.iter().enumerate() {
        let digits = usize::from(row.unit != "pcs") * 3;
        let bought = row.quantity + row.spare;
        table.row([
            (item + 1).to_string(),
            row.category.clone(),
            row.id.clone(),
            row.description.clone(),
            row.material.clone(),
            row.specification.clone(),
            fixed(row.quantity, digits),
            row.unit.clone(),
            fixed(row.spare, digits),
            optional(row.unit_mass.map(|mass| mass * 1e3), 3),
            optional(row.unit_mass.map(|mass| mass * 1e3 * row.quantity), 1),
            optional(row.unit_cost, 2),
            optional(row.unit_cost.map(|cost| cost * bought), 2),
            String::new(),
            String::new(),
            String::new(),
        ]);
    }
    table.finish()
}

/// One line a crossing: where it is, how it slides, what holds it.
pub fn crossings(plan: &Plan, hardware: &Hardware) -> Vec<u8> {
    let index = PlanIndex::new(plan);
    let bolts = bolts(plan, &index, hardware);
    let mut table = Table::new(&[
        "id",
        "u",
        "v",
        "x_m",
        "y_m",
        "z_m",
        "normal_x",
        "normal_y",
        "normal_z",
        "planar_x_mm",
        "planar_y_mm",
        "u_flat_mm",
        "u_deployed_mm",
        "v_flat_mm",
        "v_deployed_mm",
        "u_opening",
        "u_cut_length_mm",
        "v_opening",
        "v_cut_length_mm",
        "angle_flat_deg",
        "angle_deployed_deg",
        "bolt",
        "washers",
        "nuts",
        "stickers",
    ]);
    for crossing in &plan.crossings {
        let CrossingRecord {
            position,
            normal,
            planar,
            on_u,
            on_v,
            ..
        } = crossing;
        let [u, v] = [&crossing.u, &crossing.v].map(|m| index.opening(m, &crossing.id));
        let bolt = bolts.get(crossing.id.as_str());
        let own = usize::from(bolt.is_some_and(|bolt| bolt.holder == crossing.id));
        let stickers =
            usize::from(hardware.sticker.is_some() && super::nodes::slides(crossing, &index));
        table.row([
            crossing.id.clone(),
            crossing.u.clone(),
            crossing.v.clone(),
            fixed(position[0], 5),
            fixed(position[1], 5),
            fixed(position[2], 5),
            fixed(normal[0], 5),
            fixed(normal[1], 5),
            fixed(normal[2], 5),
            fixed(planar[0] * MM, 2),
            fixed(planar[1] * MM, 2),
            fixed(on_u.planar * MM, 2),
            fixed(on_u.surface * MM, 2),
            fixed(on_v.planar * MM, 2),
            fixed(on_v.surface * MM, 2),
            kind(u),
            optional(u.map(cut_length), 2),
            kind(v),
            optional(v.map(cut_length), 2),
            fixed(crossing.angle_planar, 2),
            fixed(crossing.angle_surface, 2),
            bolt.map_or_else(String::new, |bolt| {
                if own == 1 {
                    bolt.name.clone()
                } else {
                    format!("with {}", short_id(bolt.holder, ""))
                }
            }),
            bolt.map_or(0, |bolt| own * bolt.washers).to_string(),
            bolt.map_or(0, |bolt| own * bolt.nuts).to_string(),
            (2 * stickers).to_string(),
        ]);
    }
    table.finish()
}

struct Bolt<'a> {
    /// `M4x16`.
    name: String,
    /// Crossing under which it is listed.
    holder: &'a str,
    washers: usize,
    nuts: usize,
}

fn bolts<'a>(
    plan: &'a Plan,
    index: &PlanIndex<'_>,
    hardware: &Hardware,
) -> BTreeMap<&'a str, Bolt<'a>> {
    let mut bolts = BTreeMap::new();
    for node in nodes(&plan.crossings, index, 0.25 * hardware.bolt.diameter) {
        let fixing = node.fixing(&plan.supports, hardware);
        let (Some(fastener), Some(first)) = (fixing.fastener, node.crossings.first()) else {
            continue;
        };
        let (Fastener::Bolt(length) | Fastener::Rod(length)) = fastener;
        for crossing in &node.crossings {
            bolts.insert(
                crossing.id.as_str(),
                Bolt {
                    name: format!("{}x{}", hardware.bolt.name, trim(length * MM)),
                    holder: first.id.as_str(),
                    washers: fixing.washers,
                    nuts: fixing.nuts,
                },
            );
        }
    }
    bolts
}

fn kind(opening: Option<&OpeningRecord>) -> String {
    match opening {
        Some(OpeningRecord::Hole { .. }) => "hole",
        Some(OpeningRecord::Notch { .. }) => "notch",
        None => "",
    }
    .to_owned()
}

/// Length of an opening over all, millimetres.
fn cut_length(opening: &OpeningRecord) -> f64 {
    MM * match opening {
        OpeningRecord::Hole { diameter, .. } => *diameter,
        OpeningRecord::Notch {
            from, to, diameter, ..
        } => (to - from).abs() + diameter,
    }
}

/// A number with a fixed count of decimals; a negative zero loses its sign.
pub(super) fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        _ => text,
    }
}

pub(super) fn optional(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(String::new, |value| fixed(value, digits))
}

/// A table in the making.
pub(super) struct Table(csv::Writer<Vec<u8>>);

impl Table {
    pub(super) fn new(header: &[&str]) -> Self {
        let mut table = Self(csv::Writer::from_writer(Vec::new()));
        table.row(header);
        table
    }

    pub(super) fn row<T: AsRef<[u8]>>(&mut self, fields: impl IntoIterator<Item = T>) {
        self.0
            .write_record(fields)
            .expect("memory takes every byte and all rows have the header's length");
    }

    pub(super) fn finish(self) -> Vec<u8> {
        self.0.into_inner().expect("memory takes every byte")
    }
}
