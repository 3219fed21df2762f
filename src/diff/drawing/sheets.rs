//! Sheets: where parts lie on panels. A part that goes to another place gets an arrow, one that
//! goes to another panel is before on the one and after on the other.

use super::shape::{Canvas, Outline, State};
use super::{Drawing, Scene};
use crate::diff::class::Class;
use crate::diff::part::Kind;
use crate::diff::quantity::{Quantity, number};
use crate::fabrication::names::file_name;
use crate::plan::{PlacedPart, Plan, SheetRecord};
use std::collections::BTreeMap;

/// Draws the panels on which something changed.
pub(super) fn draw(scene: &Scene<'_>) -> Vec<Drawing> {
    let sizes = [scene.before, scene.after].map(sizes);
    let (before, after) = (&scene.before.sheets, &scene.after.sheets);
    scene
        .pairs(before, after, |sheet| &sheet.id)
        .into_iter()
        .filter_map(|(id, old, new)| sheet(scene, id, [old, new], &sizes))
        .collect()
}

/// Length and width of whatever can lie on a sheet, metres.
type Sizes<'a> = BTreeMap<&'a str, [f64; 2]>;

fn sizes(plan: &Plan) -> Sizes<'_> {
    let mut sizes = BTreeMap::new();
    for lamella in &plan.lamellae {
        sizes.insert(&*lamella.id, [lamella.length, lamella.width]);
        for piece in &lamella.pieces {
            sizes.insert(&*piece.id, [piece.to - piece.from, lamella.width]);
        }
    }
    sizes
}

fn sheet(
    scene: &Scene<'_>,
    id: &str,
    sides: [Option<&SheetRecord>; 2],
    sizes: &[Sizes<'_>; 2],
) -> Option<Drawing> {
    let [old, new] = sides.map(|sheet| sheet.map_or(&[][..], |sheet| &sheet.parts));
    let change = scene.changes.get(&(Kind::Sheet, id));
    let is_recut = |part: &str| {
        let lamella = part.trim_end_matches(|c: char| c.is_ascii_lowercase());
        [part, lamella].iter().any(|id| {
            let class = scene.class(&[Kind::Lamella], id);
            class.is_some_and(|class| class == Class::Recut)
        })
    };
    let parts = scene.pairs(old, new, |placed| &placed.part);
    if change.is_none() && !parts.iter().any(|(part, ..)| is_recut(part)) {
        return None;
    }
    let mut canvas = Canvas::default();
    for (side, sheet) in sides.into_iter().enumerate() {
        let Some(sheet) = sheet else { continue };
        let size = [1e3 * sheet.length, 1e3 * sheet.width];
        let same = sides[0].zip(sides[1]).is_some_and(|(a, b)| {
            (a.length - b.length).abs() < 1e-6 && (a.width - b.width).abs() < 1e-6
        });
        let state = match (same, side) {
            (true, 0) => continue,
            (true, _) => State::Same,
            (false, 0) => State::Before,
            (false, _) => State::After,
        };
        canvas.draw(id, state, rectangle([0.0; 2], size));
    }
    for (part, old, new) in parts {
        let placed = change.is_some_and(|change| change.items.iter().any(|item| item.id == part));
        let changed = placed || is_recut(part) || old.is_none() || new.is_none();
        let outline = |placed: &PlacedPart, sizes: &Sizes<'_>| {
            let [length, width] = sizes.get(&*placed.part)?.map(|metres| 1e3 * metres);
            Some(rectangle([1e3 * placed.x, 1e3 * placed.y], [length, width]))
        };
        let before = old.and_then(|placed| outline(placed, &sizes[0]));
        let after = new.and_then(|placed| outline(placed, &sizes[1]));
        let state = if changed { State::After } else { State::Same };
        if let Some(before) = before.filter(|_| changed) {
            canvas.draw(part, State::Before, before);
        }
        if let Some(after) = after {
            canvas.draw(part, state, after);
        }
        let middle = |placed: &PlacedPart, sizes: &Sizes<'_>| {
            let [length, width] = sizes.get(&*placed.part)?.map(|metres| 500.0 * metres);
            Some([1e3 * placed.x + length, 1e3 * placed.y + width])
        };
        let from = old.and_then(|placed| middle(placed, &sizes[0]));
        let to = new.and_then(|placed| middle(placed, &sizes[1]));
        if let (Some(from), Some(to), true) = (from, to, placed) {
            let aside = new.and_then(|placed| sizes[1].get(&*placed.part));
            let aside = aside.map_or(0.0, |[length, _]| 1e3 * length);
            let far = libm::hypot(to[0] - from[0], to[1] - from[1]);
            let far = number(Quantity::Length.shown(1e-3 * far), Quantity::Length);
            // Beside the name, which stands in the middle.
            let [from, to] = [from, to].map(|[x, y]| [x - 0.25 * aside, y]);
            canvas.arrow(part, from, to, format!("{far} mm"));
        }
        if let Some(at) = to.or(from).filter(|_| changed) {
            let state = if to.is_some() {
                State::After
            } else {
                State::Before
            };
            canvas.label(part, state, at);
        }
    }
    canvas.fit(file_name(id), format!("Sheet {id}"))
}

/// A rectangle by its lower left corner and size.
fn rectangle([x, y]: [f64; 2], [length, width]: [f64; 2]) -> Outline {
    Outline::Ring(vec![
        [x, y],
        [x + length, y],
        [x + length, y + width],
        [x, y + width],
    ])
}
