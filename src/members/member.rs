//! A grid curve: the same member on the surface and in the plane.

use crate::cladding::Point2;
use crate::geodesic::Path;
use crate::project::model::Family;
use serde::{Deserialize, Serialize};

/// A member of one family of a patch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Member {
    /// Its family.
    pub family: Family,
    /// From 0, in the order of the start side.
    pub index: u32,
    /// Whether it is a side of the patch.
    pub boundary: bool,
    /// Share of the start side.
    pub start: f64,
    /// Share of the end side.
    pub end: f64,
    /// The shortest geodesic between its ends.
    pub path: Path,
    /// Its ends in the plane, metres.
    pub planar: [Point2; 2],
}

impl Member {
    /// Length on the surface, metres.
    pub fn length_surface(&self) -> f64 {
        self.path.length
    }

    /// Length in the plane, metres.
    pub fn length_planar(&self) -> f64 {
        (self.planar[1] - self.planar[0]).norm()
    }
}

/// Name of a member within its patch, counted from 1: `u03`.
pub fn member_label(family: Family, index: u32) -> String {
    let letter = match family {
        Family::U => 'u',
        Family::V => 'v',
    };
    format!("{letter}{:02}", index + 1)
}

/// Name of a crossing within its patch: `u03-v05`.
pub fn crossing_label(u: u32, v: u32) -> String {
    format!(
        "{}-{}",
        member_label(Family::U, u),
        member_label(Family::V, v)
    )
}

/// Id of a member or a crossing in the structure: `west.u03`.
pub fn id_in(patch: &str, label: &str) -> String {
    format!("{patch}.{label}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_start_with_the_users_name_and_count_from_one() {
        assert_eq!(id_in("west", &member_label(Family::U, 2)), "west.u03");
        assert_eq!(id_in("west", &member_label(Family::V, 99)), "west.v100");
        assert_eq!(id_in("west", &crossing_label(2, 4)), "west.u03-v05");
    }
}
