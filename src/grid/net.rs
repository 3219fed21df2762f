//! The grid of a patch: every crossing of its two families, on the surface and in the plane.

use crate::cladding::Point2;
use crate::geodesic::angle_between;
use crate::geodesic::{Curve, Hit, crossings};
use crate::members::Member;
use crate::surface::{Mesh, SurfacePoint};
use serde::{Deserialize, Serialize};

/// Where a u-member meets a v-member.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Crossing {
    /// Index of the u-member.
    pub u: u32,
    /// Index of the v-member.
    pub v: u32,
    /// On the surface.
    pub point: SurfacePoint,
    /// In the plane, metres.
    pub planar: Point2,
    /// Arc length on the u-member.
    pub on_u: Positions,
    /// Arc length on the v-member.
    pub on_v: Positions,
    /// Angle between the directions of travel on the surface, radians.
    pub angle_surface: f64,
    /// Angle between the directions of travel in the plane, radians.
    pub angle_planar: f64,
}

/// Arc length of a crossing from the start of a member, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Positions {
    /// Deployed.
    pub surface: f64,
    /// Flat.
    pub planar: f64,
}

impl Positions {
    /// How far the bolt slides from the flat to the deployed state, metres, signed.
    pub fn slide(self) -> f64 {
        self.surface - self.planar
    }
}

/// Two members that do not meet exactly once.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Miscrossing {
    /// Index of the u-member.
    pub u: u32,
    /// Index of the v-member.
    pub v: u32,
    /// How often they meet on the surface.
    pub on_surface: u32,
    /// How often they meet in the plane.
    pub in_plane: u32,
}

/// All crossings of a patch, u-members first, or the pairs that do not meet exactly once.
///
/// Both families hold their two boundary members, first and last. Crossings on these are known
/// from the shares at which members end there; only inner members are intersected.
pub fn crossings_of(
    mesh: &Mesh,
    u: &[Member],
    v: &[Member],
) -> Result<Vec<Crossing>, Vec<Miscrossing>> {
    let (u_curves, v_curves) = (curves(mesh, u), curves(mesh, v));
    let mut all = Vec::with_capacity(u.len() * v.len());
    let mut wrong = Vec::new();
    for (along, u_curve) in u.iter().zip(&u_curves) {
        for (across, v_curve) in v.iter().zip(&v_curves) {
            if along.boundary || across.boundary {
                all.push(at_the_side(mesh, along, across));
                continue;
            }
            let hits = crossings(u_curve, v_curve);
            let planar = straight_crossing(along, across);
            match (hits.as_slice(), planar) {
                ([hit], Some((s, t))) => all.push(inside(along, across, hit, s, t)),
                _ => wrong.push(Miscrossing {
                    u: along.index,
                    v: across.index,
                    on_surface: hits.len() as u32,
                    in_plane: u32::from(planar.is_some()),
                }),
            }
        }
    }
    if wrong.is_empty() {
        Ok(all)
    } else {
        Err(wrong)
    }
}

fn curves<'a>(mesh: &'a Mesh, members: &'a [Member]) -> Vec<Curve<'a>> {
    members
        .iter()
        .map(|m| Curve::new(mesh, &m.path.points))
        .collect()
}

/// A crossing of two inner members, at the shares `s` and `t` of their planar lengths.
fn inside(along: &Member, across: &Member, hit: &Hit, s: f64, t: f64) -> Crossing {
    Crossing {
        u: along.index,
        v: across.index,
        point: hit.point,
        planar: along.planar[0] + (along.planar[1] - along.planar[0]) * s,
        on_u: Positions {
            surface: hit.on_first,
            planar: s * along.length_planar(),
        },
        on_v: Positions {
            surface: hit.on_second,
            planar: t * across.length_planar(),
        },
        angle_surface: hit.angle,
        angle_planar: planar_angle(along, across),
    }
}

/// A crossing on a side of the patch: one member ends on the other.
fn at_the_side(mesh: &Mesh, along: &Member, across: &Member) -> Crossing {
    // The first u-member is the side on which v-members start, the last the one where they end.
    let on_boundary = |side: &Member, other: &Member| {
        if side.index == 0 {
            (other.start, 0.0)
        } else {
            (other.end, 1.0)
        }
    };
    let (s, t) = if along.boundary {
        on_boundary(along, across)
    } else {
        let (t, s) = on_boundary(across, along);
        (s, t)
    };
    let positions = |member: &Member, share: f64| Positions {
        surface: share * member.length_surface(),
        planar: share * member.length_planar(),
    };
    let point = if along.boundary {
        end_point(across, t)
    } else {
        end_point(along, s)
    };
    let (on_u, on_v) = (positions(along, s), positions(across, t));
    let tangents = (
        along.path.tangent_at(mesh, on_u.surface),
        across.path.tangent_at(mesh, on_v.surface),
    );
    let angle = angle_between(mesh, &point, &tangents.0, &tangents.1).unwrap_or_else(|| {
        // A tangent of the side may name the neighbouring face when the point sits on an edge.
        let (p, q) = (tangents.0.direction, tangents.1.direction);
        libm::atan2(p.cross(&q).norm(), p.dot(&q))
    });
    Crossing {
        u: along.index,
        v: across.index,
        point,
        planar: along.planar[0] + (along.planar[1] - along.planar[0]) * s,
        on_u,
        on_v,
        angle_surface: angle,
        angle_planar: planar_angle(along, across),
    }
}

fn end_point(member: &Member, share: f64) -> SurfacePoint {
    let points = &member.path.points;
    if share < 0.5 {
        points[0]
    } else {
        points[points.len() - 1]
    }
}

/// Shares of the planar lengths at which two members cross, if they do.
fn straight_crossing(along: &Member, across: &Member) -> Option<(f64, f64)> {
    let ([a, b], [c, d]) = (along.planar, across.planar);
    let (u, v) = (b - a, d - c);
    let det = u.perp(&v);
    let (s, t) = ((c - a).perp(&v) / det, (c - a).perp(&u) / det);
    let within = |x: f64| (0.0..=1.0).contains(&x);
    (within(s) && within(t)).then_some((s, t))
}

fn planar_angle(along: &Member, across: &Member) -> f64 {
    let (u, v) = (
        along.planar[1] - along.planar[0],
        across.planar[1] - across.planar[0],
    );
    libm::atan2(u.perp(&v).abs(), u.dot(&v))
}
