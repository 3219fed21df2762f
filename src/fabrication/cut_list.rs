//! The cut list: one line a part, with what it is made of, what is cut into it, how far it is bent
//! and where on which sheet it lies.

use super::curve::Curve;
use super::index::PlanIndex;
use super::pieces::{self, End};
use super::sheet::trim;
use super::tables::{Table, fixed, optional};
use super::units::MM;
use crate::plan::{LamellaRecord, OpeningRecord, Plan};
use crate::project::model::{Family, Grain, Material};
use serde::Serialize;
use std::collections::BTreeMap;

/// Curvature is measured over chords of so many widths.
const CHORD_IN_WIDTHS: f64 = 2.0;

/// What the cut list says of materials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Woods(Vec<Wood>);

/// What the cut list says of a material.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Wood {
    name: String,
    grain: Grain,
    /// Along the lamella, Pa.
    elastic_modulus: f64,
}

impl Woods {
    /// Those of materials.
    pub fn new(materials: &[Material]) -> Self {
        let wood = |material: &Material| Wood {
            name: material.name.clone(),
            grain: material.grain,
            elastic_modulus: material.elastic_modulus,
        };
        Self(materials.iter().map(wood).collect())
    }

    fn of(&self, name: &str) -> Option<&Wood> {
        self.0.iter().find(|wood| wood.name == name)
    }
}

/// One line a part.
pub(super) fn cut_list(plan: &Plan, woods: &Woods) -> Vec<u8> {
    let index = PlanIndex::new(plan);
    let places = places(plan);
    let mut table = Table::new(&[
        "id",
        "patch",
        "family",
        "index",
        "piece",
        "qty",
        "material",
        "thickness_mm",
        "width_mm",
        "length_mm",
        "grain",
        "holes",
        "notches",
        "splices",
        "mass_g",
        "max_bending_MPa",
        "sheet",
        "row",
        "x_mm",
        "y_mm",
        "label",
    ]);
    for lamella in &plan.lamellae {
        let Some(member) = index.member(&lamella.member) else {
            continue;
        };
        let wood = woods.of(&lamella.material);
        let curve = Curve::new(member, std::iter::empty());
        for part in part_rows(lamella) {
            let place = places.get(part.id.as_str());
            table.row([
                part.id.clone(),
                member.patch.clone(),
                match member.family {
                    Family::U => "u",
                    Family::V => "v",
                }
                .to_owned(),
                member.index.to_string(),
                part.piece.clone(),
                "1".to_owned(),
                lamella.material.clone(),
                trim(lamella.thickness * MM),
                trim(lamella.width * MM),
                fixed(part.length, 2),
                match wood.map(|wood| wood.grain) {
                    Some(Grain::Along) => "along",
                    Some(Grain::Across) => "across",
                    Some(Grain::None) => "none",
                    None => "",
                }
                .to_owned(),
                part.holes.to_string(),
                part.notches.to_string(),
                part.joints.to_string(),
                fixed(part.mass * 1e3, 2),
                optional(
                    wood.map(|wood| bending(&part, lamella, &curve, wood) * 1e-6),
                    1,
                ),
                place.map_or_else(String::new, |place| place.sheet.to_owned()),
                place.map_or_else(String::new, |place| place.row.to_string()),
                optional(place.map(|place| place.x * MM), 2),
                optional(place.map(|place| place.y * MM), 2),
                part.id.clone(),
            ]);
        }
    }
    table.finish()
}

/// Largest stress of a part that is bent into the surface, Pa: E κ t / 2 of its full section. Geodesic
/// lamellae do not bend in their plane, so κ is the curvature of their curve; it is measured over
/// chords of two widths, which the edges of the mesh do not roughen.
fn bending(part: &PartRow, lamella: &LamellaRecord, curve: &Curve, wood: &Wood) -> f64 {
    let on_member = part.reach.map(|x| x / MM - lamella.end_margin);
    let bend = curve.sharpest(on_member, CHORD_IN_WIDTHS * lamella.width);
    0.5 * wood.elastic_modulus * bend * lamella.thickness
}

/// What the cut list says of a part besides what it has from its lamella.
struct PartRow {
    id: String,
    /// Its number along the lamella; `plate` for plates.
    piece: String,
    /// Millimetres.
    length: f64,
    /// First and last millimetre of the lamella that it is.
    reach: [f64; 2],
    holes: usize,
    notches: usize,
    /// Joints at its ends.
    joints: usize,
    /// Kilograms; what a joint adds or takes is left out.
    mass: f64,
}

/// Pieces and plates of a lamella. Masses of pieces add up to the lamella's.
fn part_rows(lamella: &LamellaRecord) -> Vec<PartRow> {
    let pieces = pieces::pieces(lamella);
    let whole: f64 = lamella.length * MM;
    let mut rows: Vec<PartRow> = pieces
        .iter()
        .enumerate()
        .map(|(i, piece)| {
            let is_notch = |o: &&OpeningRecord| matches!(o, OpeningRecord::Notch { .. });
            let notches = piece.openings().filter(is_notch).count();
            let [from, to] = lamella
                .pieces
                .get(i)
                .map_or([0.0, whole], |record| [record.from * MM, record.to * MM]);
            PartRow {
                id: piece.id.to_owned(),
                piece: (i + 1).to_string(),
                reach: [piece.from, piece.to],
                length: match lamella.pieces.as_slice() {
                    [] => whole,
                    _ => piece.length(),
                },
                holes: piece.openings().count() - notches + piece.screws().len(),
                notches,
                joints: [piece.start, piece.end]
                    .iter()
                    .filter(|end| **end != End::Round)
                    .count(),
                mass: lamella.mass * (to - from) / whole,
            }
        })
        .collect();
    rows.extend(pieces::plates(lamella).into_iter().map(|plate| PartRow {
        piece: "plate".to_owned(),
        length: plate.to - plate.from,
        reach: [plate.from, plate.to],
        holes: plate.joint.screws.len(),
        notches: 0,
        joints: 1,
        mass: plate.mass(),
        id: plate.id,
    }));
    rows
}

struct PlaceOnSheet<'a> {
    sheet: &'a str,
    row: usize,
    x: f64,
    y: f64,
}

fn places(plan: &Plan) -> BTreeMap<&str, PlaceOnSheet<'_>> {
    let mut places = BTreeMap::new();
    for sheet in &plan.sheets {
        let mut rows: Vec<f64> = sheet.parts.iter().map(|part| part.y).collect();
        rows.sort_by(f64::total_cmp);
        rows.dedup();
        for part in &sheet.parts {
            let row = rows.iter().position(|y| *y == part.y).unwrap_or_default() + 1;
            places.insert(
                part.part.as_str(),
                PlaceOnSheet {
                    sheet: &sheet.id,
                    row,
                    x: part.x,
                    y: part.y,
                },
            );
        }
    }
    places
}
