//! Flat patches: lamellae as they are bolted together on the floor, with the openings that
//! changed. Both sides are laid along the same diagonal with one middle, so that a small change
//! of the angle does not move everything.

use super::shape::{Canvas, Outline, State};
use super::{Drawing, Scene};
use crate::diff::class::Class;
use crate::diff::document::Action;
use crate::diff::part::Kind;
use crate::fabrication::names::file_name;
use crate::plan::{LamellaRecord, MemberRecord, OpeningRecord, PatchRecord};
use std::collections::BTreeMap;

/// Draws the patches whose lamellae changed.
pub(super) fn draw(scene: &Scene<'_>) -> Vec<Drawing> {
    let patches = scene.pairs(&scene.before.patches, &scene.after.patches, |patch| {
        &patch.id
    });
    let members = [scene.before, scene.after].map(|plan| -> BTreeMap<&str, &MemberRecord> {
        plan.members
            .iter()
            .map(|member| (&*member.id, member))
            .collect()
    });
    let mut by_patch: BTreeMap<&str, Vec<Pair<'_>>> = BTreeMap::new();
    let (before, after) = (&scene.before.lamellae, &scene.after.lamellae);
    for (id, old, new) in scene.pairs(before, after, |lamella| &lamella.id) {
        let with_member = |side: usize, lamella| -> Option<Cut<'_>> {
            let lamella: &LamellaRecord = lamella?;
            Some((lamella, *members[side].get(&*lamella.member)?))
        };
        let pair = (id, with_member(0, old), with_member(1, new));
        let Some((_, member)) = pair.2.or(pair.1) else {
            continue;
        };
        by_patch.entry(&member.patch).or_default().push(pair);
    }
    patches
        .into_iter()
        .filter_map(|(id, old, new)| {
            let old_name = old.map_or(id, |patch| &patch.id);
            let mut pairs = by_patch.remove(id).unwrap_or_default();
            if old_name != id {
                // What is gone is known under the old name of the patch.
                pairs.extend(by_patch.remove(old_name).unwrap_or_default());
            }
            patch(scene, id, [old, new], &pairs)
        })
        .collect()
}

/// A lamella and its member.
type Cut<'a> = (&'a LamellaRecord, &'a MemberRecord);

/// Id, before, after.
type Pair<'a> = (&'a str, Option<Cut<'a>>, Option<Cut<'a>>);

fn patch(
    scene: &Scene<'_>,
    id: &str,
    sides: [Option<&PatchRecord>; 2],
    pairs: &[Pair<'_>],
) -> Option<Drawing> {
    let shown = |id: &str| scene.class(&[Kind::Lamella, Kind::Member], id);
    let is_changed = |id: &str| shown(id).is_some_and(|class| class > Class::Redraw);
    if !pairs.iter().any(|(id, ..)| is_changed(id)) {
        return None;
    }
    let last = sides[1].or(sides[0])?;
    let long = last.diagonals.e_planar >= last.diagonals.f_planar;
    let frames = sides.map(|side| side.map(|patch| Frame::along(patch, long)));
    let mut canvas = Canvas::default();
    for (id, old, new) in pairs {
        let change = scene.changes.get(&(Kind::Lamella, *id));
        let changed = is_changed(id);
        let states = [
            State::Before,
            if changed { State::After } else { State::Same },
        ];
        for ((cut, frame), state) in [old, new].into_iter().zip(&frames).zip(states) {
            let (Some((lamella, member)), Some(frame)) = (cut, frame) else {
                continue;
            };
            if state == State::Before && !changed {
                continue;
            }
            let strip = Strip::new(lamella, member, frame);
            canvas.draw(id, state, strip.outline());
            if changed {
                canvas.labels.retain(|label| label.part != **id);
                canvas.label(id, state, strip.at(-4.0 * strip.width, 0.0));
            }
            for opening in &lamella.openings {
                let crossing = match state {
                    State::Before => scene.renames.id(opening.crossing()),
                    _ => Some(opening.crossing().to_owned()),
                };
                let listed = change.is_some_and(|change| {
                    change.action != Action::Changed
                        || change.items.iter().any(|item| {
                            Some(&item.id) == crossing.as_ref() || item.id == opening.crossing()
                        })
                });
                if changed && listed {
                    canvas.draw(id, state, strip.opening(opening));
                }
            }
        }
    }
    let name = format!("patch-{}", file_name(id));
    canvas.fit(name, format!("Patch {id}, flat"))
}

/// A frame in which the patch lies along one of its diagonals; places in millimetres.
struct Frame {
    middle: [f64; 2],
    along: [f64; 2],
}

impl Frame {
    /// Along the diagonal 1-3, or else 2-4.
    fn along(patch: &PatchRecord, first: bool) -> Self {
        let [a, b, c, d] = patch.planar_corners;
        let [from, to] = if first { [a, c] } else { [d, b] };
        let middle = [0, 1].map(|axis| 0.25 * (a[axis] + b[axis] + c[axis] + d[axis]));
        let length = libm::hypot(to[0] - from[0], to[1] - from[1]).max(f64::MIN_POSITIVE);
        Self {
            middle,
            along: [(to[0] - from[0]) / length, (to[1] - from[1]) / length],
        }
    }

    fn place(&self, place: [f64; 2]) -> [f64; 2] {
        let [x, y] = [place[0] - self.middle[0], place[1] - self.middle[1]];
        let [c, s] = self.along;
        [1e3 * (c * x + s * y), 1e3 * (c * y - s * x)]
    }
}

/// A lamella in the plane, millimetres.
struct Strip {
    start: [f64; 2],
    along: [f64; 2],
    width: f64,
    from: f64,
    to: f64,
}

impl Strip {
    fn new(lamella: &LamellaRecord, member: &MemberRecord, frame: &Frame) -> Self {
        let [start, end] = member.planar.map(|place| frame.place(place));
        let length = libm::hypot(end[0] - start[0], end[1] - start[1]).max(f64::MIN_POSITIVE);
        let from = -1e3 * lamella.end_margin;
        Self {
            start,
            along: [(end[0] - start[0]) / length, (end[1] - start[1]) / length],
            width: 1e3 * lamella.width,
            from,
            to: from + 1e3 * lamella.length,
        }
    }

    /// A place by its arc length from the start of the member, and its offset.
    fn at(&self, along: f64, across: f64) -> [f64; 2] {
        let [c, s] = self.along;
        [
            self.start[0] + c * along - s * across,
            self.start[1] + s * along + c * across,
        ]
    }

    fn outline(&self) -> Outline {
        let half = 0.5 * self.width;
        let corners = [
            (self.from, -half),
            (self.to, -half),
            (self.to, half),
            (self.from, half),
        ];
        Outline::Ring(
            corners
                .map(|(along, across)| self.at(along, across))
                .to_vec(),
        )
    }

    fn opening(&self, opening: &OpeningRecord) -> Outline {
        let (from, to, diameter) = match *opening {
            OpeningRecord::Hole { at, diameter, .. } => (at, at, diameter),
            OpeningRecord::Notch {
                from, to, diameter, ..
            } => (from, to, diameter),
        };
        let place = |along: f64| self.at(1e3 * along, 0.0);
        Outline::Slot(place(from), place(to), 500.0 * diameter)
    }
}
