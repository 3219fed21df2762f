//! The domain of a patch: the mesh that it is solved on and its four sides.

use super::{Side, SideLengths};
use crate::geodesic::angle_between;
use crate::project::model::Family;
use crate::surface::{Mesh, SubMesh, SurfacePoint};
use serde::{Deserialize, Serialize};

/// A geodesic quadrilateral A, B, C, D on a mesh. Its sides run the way its members do: AB and DC
/// carry the coordinate of the u-family, AD and BC that of the v-family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// The part of the surface around the patch.
    pub part: SubMesh,
    /// Where u-members start, from A to B.
    pub ab: Side,
    /// Where v-members end, from B to C.
    pub bc: Side,
    /// Where u-members end, from D to C.
    pub dc: Side,
    /// Where v-members start, from A to D.
    pub ad: Side,
}

impl Domain {
    /// The mesh of the part; the sides lie on it.
    pub fn mesh(&self) -> &Mesh {
        self.part.mesh()
    }

    /// Where a family starts.
    pub fn start(&self, family: Family) -> &Side {
        match family {
            Family::U => &self.ab,
            Family::V => &self.ad,
        }
    }

    /// Where a family ends.
    pub fn end(&self, family: Family) -> &Side {
        match family {
            Family::U => &self.dc,
            Family::V => &self.bc,
        }
    }

    /// The sides that are the first and the last member of a family.
    pub fn boundary_members(&self, family: Family) -> [&Side; 2] {
        match family {
            Family::U => [&self.ad, &self.bc],
            Family::V => [&self.ab, &self.dc],
        }
    }

    /// Lengths of the sides, metres.
    pub fn lengths(&self) -> SideLengths {
        SideLengths {
            ab: self.ab.length(),
            bc: self.bc.length(),
            cd: self.dc.length(),
            da: self.ad.length(),
        }
    }

    /// The way around it.
    fn outline(&self) -> Outline<'_> {
        Outline {
            mesh: self.mesh(),
            ab: &self.ab,
            bc: &self.bc,
            dc: &self.dc,
            ad: &self.ad,
        }
    }

    /// The corners A, B, C, D.
    pub fn corners(&self) -> [SurfacePoint; 4] {
        self.outline().corners()
    }

    /// Angle on the surface between the sides at A, radians; `None` where the sides do not meet.
    pub fn angle_at_a(&self) -> Option<f64> {
        let at = self.ab.path().points[0];
        angle_between(
            self.mesh(),
            &at,
            &self.ab.path().start,
            &self.ad.path().start,
        )
    }

    /// Whether the corners run counter-clockwise seen from outside, so that the patch lies on the
    /// left of its sides: by the sense in which most corners turn.
    pub fn turns_left(&self) -> bool {
        self.outline().turns_left()
    }

    /// Whether the way around turns left at A, B, C and D, seen from outside.
    pub fn corners_turn_left(&self) -> [bool; 4] {
        self.outline().corners_turn_left()
    }

    /// The loop A, B, C, D as points, each corner once.
    pub fn ring(&self) -> Vec<SurfacePoint> {
        self.outline().ring()
    }
}

/// The four sides of a patch on a mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outline<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) ab: &'a Side,
    pub(super) bc: &'a Side,
    pub(super) dc: &'a Side,
    pub(super) ad: &'a Side,
}

impl Outline<'_> {
    pub(super) fn corners(&self) -> [SurfacePoint; 4] {
        let first = |side: &Side| side.path().points[0];
        let last = |side: &Side| side.path().points[side.path().points.len() - 1];
        [first(self.ab), first(self.bc), last(self.dc), last(self.ad)]
    }

    pub(super) fn turns_left(&self) -> bool {
        let left = self.corners_turn_left().into_iter().filter(|&left| left);
        left.count() > 2
    }

    fn corners_turn_left(&self) -> [bool; 4] {
        let [ab, bc, dc, ad] = [self.ab, self.bc, self.dc, self.ad].map(Side::path);
        // From the way on to the way back, at A, B, C and D.
        let turns = [
            ab.start.direction.cross(&ad.start.direction),
            ab.end.direction.cross(&bc.start.direction),
            dc.end.direction.cross(&bc.end.direction),
            dc.start.direction.cross(&ad.end.direction),
        ];
        let corners = self.corners();
        std::array::from_fn(|i| turns[i].dot(&corners[i].normal(self.mesh)) > 0.0)
    }

    pub(super) fn ring(&self) -> Vec<SurfacePoint> {
        let mut ring = Vec::new();
        for (side, forward) in [
            (self.ab, true),
            (self.bc, true),
            (self.dc, false),
            (self.ad, false),
        ] {
            let points = &side.path().points;
            let inner = points.len() - 1;
            if forward {
                ring.extend_from_slice(&points[..inner]);
            } else {
                ring.extend(points[1..].iter().rev());
            }
        }
        ring
    }
}
