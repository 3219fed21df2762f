//! Strips of the bill by their section: lamellae, and the plates of joints.

use super::sheet::trim;
use super::units::MM;
use crate::plan::{BomRow, LamellaRecord};
use crate::project::model::Material;
use std::collections::BTreeMap;

/// Rows in metres, by id. A strip has material and section of a lamella and a length, metres; ids
/// begin with `prefix`, and `what` names the strips in words. They are not bought as such, but what
/// a panel becomes.
pub(super) fn rows<'a>(
    prefix: &str,
    what: &str,
    strips: impl IntoIterator<Item = (&'a LamellaRecord, f64)>,
    materials: &[Material],
) -> Vec<BomRow> {
    let mut sections: BTreeMap<String, (usize, f64, &LamellaRecord)> = BTreeMap::new();
    for (lamella, length) in strips {
        let id = format!(
            "{prefix}-{}-{}x{}",
            lamella.material,
            trim(lamella.width * MM),
            trim(lamella.thickness * MM)
        );
        let entry = sections.entry(id).or_insert((0, 0.0, lamella));
        entry.0 += 1;
        entry.1 += length;
    }
    sections
        .into_iter()
        .map(|(id, (count, metres, first))| {
            let material = materials.iter().find(|m| m.name == first.material);
            BomRow {
                id,
                category: "lamella".to_owned(),
                description: format!("{count} {what}, cut from the panels"),
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
