//! Strips of the bill by their section: lamellae, and the plates of joints.

use super::sheet::trim;
use super::units::MM;
use crate::plan::{BomRow, LamellaRecord};
use std::collections::BTreeMap;

/// Something of the section and the material of a lamella.
pub(super) struct Strip<'a> {
    pub(super) lamella: &'a LamellaRecord,
    /// Metres.
    pub(super) length: f64,
    /// Kilograms.
    pub(super) mass: f64,
}

/// Rows in metres, by id. Ids begin with the category, `what` names the strips in words. They are
/// not bought as such, but what a panel becomes.
pub(super) fn rows<'a>(
    category: &str,
    what: &str,
    strips: impl IntoIterator<Item = Strip<'a>>,
) -> Vec<BomRow> {
    let mut sections: BTreeMap<String, Vec<Strip<'_>>> = BTreeMap::new();
    for strip in strips {
        let lamella = strip.lamella;
        let id = format!(
            "{category}-{}-{}x{}",
            lamella.material,
            trim(lamella.width * MM),
            trim(lamella.thickness * MM)
        );
        sections.entry(id).or_default().push(strip);
    }
    sections
        .into_iter()
        .filter_map(|(id, strips)| {
            let first = strips.first()?.lamella;
            let metres: f64 = strips.iter().map(|strip| strip.length).sum();
            let mass: f64 = strips.iter().map(|strip| strip.mass).sum();
            Some(BomRow {
                id,
                category: category.to_owned(),
                description: format!("{} {what}, cut from the panels", strips.len()),
                material: first.material.clone(),
                specification: format!(
                    "{} x {} mm",
                    trim(first.width * MM),
                    trim(first.thickness * MM)
                ),
                quantity: metres,
                unit: "m".to_owned(),
                spare: 0.0,
                unit_mass: (metres > 0.0).then(|| mass / metres),
                unit_cost: None,
            })
        })
        .collect()
}
