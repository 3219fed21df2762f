//! What is the same thing under another name.
//!
//! Users rename points and patches, and ids of parts start with these names; a member that is
//! inserted moves the numbers of those after it. A reviewer wants to read that a name changed, not
//! that everything was removed and added again. Renames are found by what does not change with a
//! name:
//!
//! - points by their place,
//! - patches by their corners (names, which may have been renamed too, or places),
//! - members of a patch whose count changed by their ends on the surface,
//! - strips, which are called after their first family, by any of their families.
//!
//! The radius within which a place is the same has nothing to do with the tolerance: a thing that
//! was renamed and moved is told as both.

use super::part::Kind;
use crate::plan::{MemberRecord, PatchRecord, Plan, StripRecord};
use crate::project::model::Family;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// How far a renamed point or corner may have moved, as a share of the structure's size.
const RADIUS: f64 = 0.02;
/// How far apart the ends of a member with another number may be, metres: less than any two
/// members of a buildable grid.
const MEMBER_RADIUS: f64 = 0.5e-3;

/// From ids before to ids after.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Renames {
    points: BTreeMap<String, String>,
    patches: BTreeMap<String, String>,
    /// By the name of the patch before: numbers of members before and after, per family; members
    /// that are gone have none after.
    members: BTreeMap<String, [BTreeMap<u32, Option<u32>>; 2]>,
    /// Strips that are called after another family.
    strips: BTreeMap<String, String>,
    /// Patches before, to know which ids start with one.
    known: BTreeSet<String>,
}

impl Renames {
    /// Compares names and places.
    pub(super) fn detect(before: &Plan, after: &Plan) -> Self {
        let mut renames = Self {
            known: before
                .patches
                .iter()
                .map(|patch| patch.id.clone())
                .collect(),
            ..Self::default()
        };
        let radius = RADIUS * size(after);
        renames.detect_points(before, after, radius);
        renames.detect_patches(before, after, radius);
        for patch in &before.patches {
            let new = renames.patches.get(&patch.id).unwrap_or(&patch.id);
            let families = [Family::U, Family::V].map(|family| {
                let of = |plan: &'_ Plan, name: &str| -> Vec<MemberRecord> {
                    let members = plan.members.iter();
                    members
                        .filter(|member| member.patch == name && member.family == family)
                        .cloned()
                        .collect()
                };
                renumbered(&of(before, &patch.id), &of(after, new))
            });
            if families.iter().any(|numbers| !numbers.is_empty()) {
                renames.members.insert(patch.id.clone(), families);
            }
        }
        renames.detect_strips(before, after);
        renames
    }

    /// Renamed points and patches, before and after.
    pub(super) fn named(&self) -> impl Iterator<Item = (&'static str, &str, &str)> {
        let patches = self.patches.iter();
        let patches = patches.map(|(before, after)| ("patch", &**before, &**after));
        let points = self.points.iter();
        patches.chain(points.map(|(before, after)| ("point", &**before, &**after)))
    }

    /// The id after of a part before; none for a member, or what hangs on it, that is gone.
    pub(super) fn part(&self, kind: Kind, id: &str) -> Option<String> {
        match self.strips.get(id) {
            Some(new) if kind == Kind::Strip => Some(new.clone()),
            _ => self.id(id),
        }
    }

    /// The id after of an id before; none for a member, or what hangs on it, that is gone.
    pub(super) fn id(&self, id: &str) -> Option<String> {
        let (prefix, name) = match id.strip_prefix("support-") {
            Some(name) => ("support-", name),
            None => ("", id),
        };
        if let Some(point) = self.points.get(name) {
            return Some(format!("{prefix}{point}"));
        }
        if let Some(patch) = self.patches.get(name) {
            return Some(format!("{prefix}{patch}"));
        }
        let Some((patch, label)) = name.split_once('.') else {
            return Some(id.to_owned());
        };
        if !self.known.contains(patch) {
            return Some(id.to_owned());
        }
        let label = match self.members.get(patch) {
            Some(families) => renumber(families, label)?,
            None => label.to_owned(),
        };
        let patch = self.patches.get(patch).map_or(patch, String::as_str);
        Some(format!("{prefix}{patch}.{label}"))
    }

    fn detect_points(&mut self, before: &Plan, after: &Plan, radius: f64) {
        let kept: BTreeSet<&str> = after.points.iter().map(|point| &*point.id).collect();
        let old: BTreeSet<&str> = before.points.iter().map(|point| &*point.id).collect();
        let gone: Vec<_> = before
            .points
            .iter()
            .filter(|point| !kept.contains(&*point.id))
            .collect();
        let mut new: Vec<_> = after
            .points
            .iter()
            .filter(|point| !old.contains(&*point.id))
            .collect();
        for point in gone {
            let nearest = new
                .iter()
                .enumerate()
                .map(|(i, other)| (distance(point.position, other.position), i))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((apart, i)) = nearest
                && apart <= radius
            {
                let other = new.remove(i);
                self.points.insert(point.id.clone(), other.id.clone());
            }
        }
    }

    fn detect_strips(&mut self, before: &Plan, after: &Plan) {
        let mut new: Vec<&StripRecord> = after.strips.iter().collect();
        for strip in &before.strips {
            let families: BTreeSet<String> =
                strip.families.iter().filter_map(|id| self.id(id)).collect();
            let of_these =
                |other: &&StripRecord| other.families.iter().any(|f| families.contains(f));
            let Some(position) = new.iter().position(of_these) else {
                continue;
            };
            let other = new.remove(position);
            if self.id(&strip.id).as_ref() != Some(&other.id) {
                self.strips.insert(strip.id.clone(), other.id.clone());
            }
        }
    }

    fn detect_patches(&mut self, before: &Plan, after: &Plan, radius: f64) {
        let is_in = |plan: &Plan, id: &str| plan.patches.iter().any(|patch| patch.id == id);
        let gone = before.patches.iter().filter(|p| !is_in(after, &p.id));
        let mut new: Vec<&PatchRecord> = after
            .patches
            .iter()
            .filter(|patch| !is_in(before, &patch.id))
            .collect();
        for patch in gone {
            let corners = patch.corners.each_ref().map(|corner| {
                let renamed = self.points.get(corner);
                renamed.unwrap_or(corner).clone()
            });
            let by_names = new.iter().position(|other| other.corners == corners);
            let found = by_names.or_else(|| {
                let places = places(before, patch)?;
                new.iter().position(|other| {
                    self::places(after, other).is_some_and(|others| {
                        let mut pairs = places.iter().zip(others);
                        pairs.all(|(a, b)| distance(*a, b) <= radius)
                    })
                })
            });
            if let Some(i) = found {
                let other = new.remove(i);
                self.patches.insert(patch.id.clone(), other.id.clone());
            }
        }
    }
}

/// Places of the corners of a patch.
fn places(plan: &Plan, patch: &PatchRecord) -> Option<Vec<[f64; 3]>> {
    let place = |corner: &String| {
        let point = plan.points.iter().find(|point| point.id == *corner)?;
        Some(point.position)
    };
    patch.corners.iter().map(place).collect()
}

/// Numbers of a family's members before and after; nothing where the count is the same, since
/// then the numbers stand for themselves.
fn renumbered(before: &[MemberRecord], after: &[MemberRecord]) -> BTreeMap<u32, Option<u32>> {
    let mut numbers = BTreeMap::new();
    if before.len() == after.len() || before.is_empty() || after.is_empty() {
        return numbers;
    }
    let ends = |member: &MemberRecord| -> Option<[[f64; 3]; 2]> {
        Some([*member.polyline.first()?, *member.polyline.last()?])
    };
    let mut free: BTreeMap<u32, &MemberRecord> = after.iter().map(|m| (m.index, m)).collect();
    for member in before {
        let same = free.values().find(|other| {
            ends(member).zip(ends(other)).is_some_and(|(a, b)| {
                let mut pairs = a.into_iter().zip(b);
                pairs.all(|(a, b)| distance(a, b) <= MEMBER_RADIUS)
            })
        });
        if let Some(index) = same.map(|other| other.index) {
            free.remove(&index);
            numbers.insert(member.index, Some(index));
        }
    }
    // The others all moved: those with the same number are compared, the rest came or went.
    for member in before {
        numbers
            .entry(member.index)
            .or_insert_with(|| free.remove(&member.index).map(|other| other.index));
    }
    numbers
}

/// Puts numbers after into a label such as `u03`, `u03a`, `u03-v05` or `u03-v05.u`; none if one
/// of its members is gone.
fn renumber(families: &[BTreeMap<u32, Option<u32>>; 2], label: &str) -> Option<String> {
    let mut out = String::with_capacity(label.len());
    for (i, word) in label.split_inclusive(['-', '.']).enumerate() {
        let family = match word.as_bytes().first() {
            Some(b'u') => 0,
            Some(b'v') => 1,
            _ => return Some(label.to_owned()),
        };
        let digits = word[1..].bytes().take_while(u8::is_ascii_digit).count();
        if digits == 0 && i > 0 {
            // The family at the end of a sticker's id.
            out.push_str(word);
            continue;
        }
        let (number, rest) = word[1..].split_at(digits);
        match number
            .parse()
            .ok()
            .and_then(|n: u32| families[family].get(&n))
        {
            Some(Some(new)) => {
                out.push_str(&word[..1]);
                let _ = write!(out, "{new:02}");
                out.push_str(rest);
            }
            Some(None) => return None,
            None => out.push_str(word),
        }
    }
    Some(out)
}

/// Diagonal of a plan's surface.
fn size(plan: &Plan) -> f64 {
    let [low, high] = plan.surface.bounding_box;
    distance(low, high)
}

/// Distance of two places.
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum();
    squares.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inserted() -> Renames {
        let numbers = [(1, Some(1)), (2, Some(2)), (3, Some(4)), (4, None)];
        Renames {
            patches: BTreeMap::from([("west".to_owned(), "ufer".to_owned())]),
            points: BTreeMap::from([("a".to_owned(), "gate".to_owned())]),
            members: BTreeMap::from([("west".to_owned(), [numbers.into(), BTreeMap::new()])]),
            strips: BTreeMap::new(),
            known: ["west".to_owned(), "east".to_owned()].into(),
        }
    }

    #[test]
    fn ids_follow_patches_points_and_numbers() {
        let renames = inserted();
        let id = |id: &str| renames.id(id);
        assert_eq!(id("west").as_deref(), Some("ufer"));
        assert_eq!(id("west.u03").as_deref(), Some("ufer.u04"));
        assert_eq!(id("west.u03b").as_deref(), Some("ufer.u04b"));
        assert_eq!(id("west.u03-v05").as_deref(), Some("ufer.u04-v05"));
        assert_eq!(id("west.u03-v05.u").as_deref(), Some("ufer.u04-v05.u"));
        assert_eq!(
            id("support-west.u03-v05").as_deref(),
            Some("support-ufer.u04-v05")
        );
        assert_eq!(id("support-a").as_deref(), Some("support-gate"));
        assert_eq!(id("east.u03").as_deref(), Some("east.u03"));
        assert_eq!(
            id("shell-brass-5x0.5").as_deref(),
            Some("shell-brass-5x0.5")
        );
    }

    #[test]
    fn what_hangs_on_a_member_that_is_gone_is_gone() {
        let renames = inserted();
        assert_eq!(renames.id("west.u04"), None);
        assert_eq!(renames.id("west.u04-v01.v"), None);
        assert_eq!(renames.id("west.v04").as_deref(), Some("ufer.v04"));
    }

    #[test]
    fn a_strip_that_is_called_after_another_family_is_the_same_strip() {
        let plan = |strips: &[&[&str]]| Plan {
            strips: strips
                .iter()
                .map(|families| StripRecord {
                    id: families[0].to_owned(),
                    families: families.iter().map(|&family| family.to_owned()).collect(),
                    evenness_gained: 1.0,
                    ring: None,
                })
                .collect(),
            ..Plan::default()
        };
        let mut renames = inserted();
        renames.detect_strips(
            &plan(&[&["east.u"], &["east.v", "west.v"], &["west.u"]]),
            &plan(&[&["annex.v", "east.v", "ufer.v"], &["east.u"], &["ufer.u"]]),
        );
        let strip = |id: &str| renames.part(Kind::Strip, id);
        assert_eq!(strip("east.v").as_deref(), Some("annex.v"));
        assert_eq!(strip("east.u").as_deref(), Some("east.u"));
        assert_eq!(strip("west.u").as_deref(), Some("ufer.u"));
        // As a family it keeps its name.
        assert_eq!(renames.id("east.v").as_deref(), Some("east.v"));
    }
}
