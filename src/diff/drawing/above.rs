//! The structure from above: members on the surface, anchors, supports.

use super::shape::{Canvas, Outline, State};
use super::{Drawing, Scene};
use crate::diff::class::Class;
use crate::diff::part::Kind;
use crate::diff::quantity::{Quantity, number};
use crate::diff::renames::distance;

/// Draws it, if one of its parts changed.
pub(super) fn draw(scene: &Scene<'_>) -> Option<Drawing> {
    let kinds = [
        Kind::Lamella,
        Kind::Member,
        Kind::Point,
        Kind::Support,
        Kind::Patch,
    ];
    let visible = |(kind, _): &(Kind, &str)| kinds.contains(kind);
    if !scene.changes.keys().any(visible) {
        return None;
    }
    let mut canvas = Canvas::default();
    let (before, after) = (&scene.before.members, &scene.after.members);
    for (id, old, new) in scene.pairs(before, after, |member| &member.id) {
        let class = scene.class(&[Kind::Lamella, Kind::Member], id);
        let line = |polyline: &[[f64; 3]]| {
            Outline::Line(polyline.iter().map(|place| flat(*place)).collect())
        };
        match (old, new) {
            (_, Some(new)) if class.is_none_or(|class| class <= Class::Redraw) => {
                canvas.draw(id, State::Same, line(&new.polyline));
            }
            _ => {
                if let Some(old) = old {
                    canvas.draw(id, State::Before, line(&old.polyline));
                }
                if let Some(new) = new {
                    canvas.draw(id, State::After, line(&new.polyline));
                }
            }
        }
    }
    let (before, after) = (&scene.before.points, &scene.after.points);
    let places = scene
        .pairs(before, after, |point| &point.id)
        .into_iter()
        .map(|(id, old, new)| {
            (
                Kind::Point,
                id,
                old.map(|p| p.position),
                new.map(|p| p.position),
            )
        });
    let (before, after) = (&scene.before.supports, &scene.after.supports);
    let supports = scene
        .pairs(before, after, |support| &support.id)
        .into_iter()
        .map(|(id, old, new)| {
            (
                Kind::Support,
                id,
                old.map(|s| s.position),
                new.map(|s| s.position),
            )
        });
    for (kind, id, old, new) in places.chain(supports) {
        let changed = scene
            .class(&[kind], id)
            .is_some_and(|class| class > Class::Redraw);
        let dot = |place: [f64; 3]| Outline::Slot(flat(place), flat(place), 0.0);
        let state = if changed { State::After } else { State::Same };
        if let Some(old) = old.filter(|_| changed) {
            canvas.draw(id, State::Before, dot(old));
        }
        if let Some(new) = new {
            canvas.draw(id, state, dot(new));
        }
        if let Some(place) = new.or(old)
            && kind == Kind::Point
        {
            let state = if new.is_some() { state } else { State::Before };
            canvas.label(id, state, flat(place));
        }
        if let (Some(old), Some(new), true) = (old, new, changed) {
            let far = Quantity::Length.shown(distance(old, new));
            let far = number(far, Quantity::Length);
            canvas.arrow(id, flat(old), flat(new), format!("{far} mm"));
        }
    }
    canvas.fit("above".to_owned(), "From above".to_owned())
}

/// Seen from above, millimetres.
fn flat([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x * 1e3, y * 1e3]
}
