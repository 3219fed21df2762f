//! The stickers as a table: one line a sticker, in the order of assembly.

use super::super::tables::{Table, fixed};
use super::super::units::MM;
use super::foil::area_of;
use crate::plan::{Face, Plan};
use std::collections::BTreeMap;

/// `stickers.csv`.
pub fn table(plan: &Plan) -> Vec<u8> {
    let mut sheets: BTreeMap<&str, &str> = BTreeMap::new();
    for sheet in &plan.foils {
        for part in &sheet.parts {
            sheets.insert(&part.part, &sheet.id);
        }
    }
    let mut table = Table::new(&[
        "number",
        "id",
        "lamella",
        "face",
        "crossing",
        "from_mm",
        "to_mm",
        "area_cm2",
        "slot_from_mm",
        "slot_to_mm",
        "slot_width_mm",
        "sheet",
    ]);
    for sticker in &plan.stickers {
        let along = sticker.outline.map(|corner| corner[0]);
        let [from, to] = along
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
                [a.min(*v), b.max(*v)]
            });
        table.row([
            sticker.number.to_string(),
            sticker.id.clone(),
            sticker.lamella.clone(),
            match sticker.face {
                Face::Top => "top",
                Face::Bottom => "bottom",
            }
            .to_owned(),
            sticker.crossing.clone(),
            fixed(from * MM, 2),
            fixed(to * MM, 2),
            fixed(area_of(sticker) * 1e4, 2),
            fixed(sticker.slot[0] * MM, 2),
            fixed(sticker.slot[1] * MM, 2),
            fixed(sticker.diameter * MM, 2),
            (*sheets.get(sticker.id.as_str()).unwrap_or(&"")).to_owned(),
        ]);
    }
    table.finish()
}
