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

/// Id of a member: `west.u03`, counted from 1.
pub fn member_id(patch: &str, family: Family, index: u32) -> String {
    format!("{patch}.{}", label(family, index))
}

/// Id of a crossing: `west.u03-v05`, counted from 1.
pub fn crossing_id(patch: &str, u: u32, v: u32) -> String {
    format!("{patch}.{}-{}", label(Family::U, u), label(Family::V, v))
}

fn label(family: Family, index: u32) -> String {
    let letter = match family {
        Family::U => 'u',
        Family::V => 'v',
    };
    format!("{letter}{:02}", index + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_start_with_the_users_name_and_count_from_one() {
        assert_eq!(member_id("west", Family::U, 2), "west.u03");
        assert_eq!(member_id("west", Family::V, 99), "west.v100");
        assert_eq!(crossing_id("west", 2, 4), "west.u03-v05");
    }
}
