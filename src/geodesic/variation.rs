//! How a shortest distance changes when an end point moves.

use crate::surface::{HalfEdge, Mesh, SurfacePoint, Tangent, Vector3};
use std::f64::consts::PI;

/// ∂D/∂s of the length D of a shortest path while its start moves along the surface with unit
/// speed: -cos of the angle between the path and the motion (first variation of arc length).
///
/// `path_start` is the direction in which the path leaves the point `at`, `moving` the direction
/// of motion there. For the end of a path pass its reversed direction. The angle is measured on
/// the surface: across an edge with both faces laid flat, around a vertex the shorter way that
/// stays on the surface.
///
/// Returns `None` when a tangent names a face that the point is not in.
pub fn derivative_along(
    mesh: &Mesh,
    at: &SurfacePoint,
    moving: &Tangent,
    path_start: &Tangent,
) -> Option<f64> {
    Some(-libm::cos(angle_between(mesh, at, moving, path_start)?))
}

/// The angle between two directions at a point, measured on the surface, radians in [0, π].
///
/// Returns `None` when a tangent names a face that the point is not in.
pub fn angle_between(
    mesh: &Mesh,
    at: &SurfacePoint,
    one: &Tangent,
    other: &Tangent,
) -> Option<f64> {
    at.bary_in(mesh, one.face)?;
    at.bary_in(mesh, other.face)?;
    if one.face == other.face {
        return Some(flat_angle(&one.direction, &other.direction));
    }
    match *at {
        SurfacePoint::Face { .. } => None,
        SurfacePoint::Edge { half_edge, .. } => {
            // Both angles from the edge: laid flat they add up, or make a full turn.
            let edge = mesh.edge_vector(half_edge);
            let sum = flat_angle(&edge, &one.direction) + flat_angle(&edge, &other.direction);
            Some(sum.min(2.0 * PI - sum))
        }
        SurfacePoint::Vertex(v) => Some(angle_around(mesh, v, one, other)),
    }
}

/// The angle around a vertex, the shorter way; around a border vertex there is only one.
///
/// A direction of travel may point out of its face: that of a path which arrives at the vertex.
fn angle_around(mesh: &Mesh, v: u32, one: &Tangent, other: &Tangent) -> f64 {
    let mut total = 0.0;
    let mut places = [0.0; 2];
    for h in mesh.outgoing(v) {
        let along = mesh.edge_vector(h);
        let last = -mesh.edge_vector(HalfEdge::prev(h));
        let normal = along.cross(&last);
        for (place, tangent) in places.iter_mut().zip([one, other]) {
            if tangent.face == h.face() {
                let turn = flat_angle(&along, &tangent.direction);
                let onwards = along.cross(&tangent.direction).dot(&normal) >= 0.0;
                *place = total + if onwards { turn } else { -turn };
            }
        }
        total += flat_angle(&along, &last);
    }
    let between = (places[0] - places[1]).abs();
    let shorter = if mesh.is_border_vertex(v) {
        between
    } else {
        let between = between % total;
        between.min(total - between)
    };
    shorter.min(PI)
}

/// The angle between two vectors, accurate near 0 and π.
fn flat_angle(a: &Vector3, b: &Vector3) -> f64 {
    libm::atan2(a.cross(b).norm(), a.dot(b))
}
