//! Where the border of the surface is in the way: sides that bend around it, and patches with a
//! hole of the surface inside.

use super::Domain;
use super::vertices_inside;
use crate::geodesic::Path;
use crate::surface::{HalfEdge, Mesh, Point3, SurfacePoint, Vector3};
use std::f64::consts::PI;

/// How a path bends around the border of a surface: it is shortest, and no geodesic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// All its bends together, radians.
    pub total: f64,
    /// Where it bends most.
    pub at: Point3,
}

/// A bend below this is the rounding of a border that was cut along a geodesic, radians: five
/// degrees over the length of a member, which a lamella follows.
const STRAIGHT: f64 = 0.087;

/// Whether a path bends around the border of the mesh. A bend at a vertex is one on the surface and
/// in space: along a border that is straight in space, the angles of the faces beside it scatter
/// around the straight one.
pub fn bend_at_border(mesh: &Mesh, path: &Path) -> Option<Bend> {
    let mut bend = Bend {
        total: 0.0,
        at: path.points[0].position(mesh),
    };
    let mut sharpest = 0.0;
    for i in 1..path.points.len() - 1 {
        let SurfacePoint::Vertex(v) = path.points[i] else {
            continue;
        };
        if !mesh.is_border_vertex(v) {
            continue;
        }
        let place = |k: usize| path.points[k].position(mesh);
        let back = (path.faces[i - 1], place(i - 1) - place(i));
        let on = (path.faces[i], place(i + 1) - place(i));
        let on_surface = (angle_in_fan(mesh, v, back, on) - PI).max(0.0);
        let excess = on_surface.min(PI - angle(&back.1, &on.1));
        bend.total += excess;
        if excess > sharpest {
            sharpest = excess;
            bend.at = place(i);
        }
    }
    (bend.total > STRAIGHT).then_some(bend)
}

/// The angle between two directions at a border vertex through the faces between them, radians.
fn angle_in_fan(mesh: &Mesh, v: u32, one: (u32, Vector3), other: (u32, Vector3)) -> f64 {
    let mut total = 0.0;
    let mut places = [0.0; 2];
    for h in mesh.outgoing(v) {
        let along = mesh.edge_vector(h);
        for (place, (face, direction)) in places.iter_mut().zip([one, other]) {
            if face == h.face() {
                *place = total + angle(&along, &direction);
            }
        }
        total += angle(&along, &-mesh.edge_vector(HalfEdge::prev(h)));
    }
    f64::abs(places[0] - places[1])
}

fn angle(a: &Vector3, b: &Vector3) -> f64 {
    libm::atan2(a.cross(b).norm(), a.dot(b))
}

/// A place on the border of a hole of the surface inside a patch, if there is one.
pub fn hole_inside(surface: &Mesh, domain: &Domain) -> Option<Point3> {
    vertices_inside(domain.mesh(), &domain.ring(), domain.turns_left())
        .into_iter()
        .map(|vertex| domain.part.vertex_to_parent(vertex))
        .find(|&vertex| surface.is_border_vertex(vertex))
        .map(|vertex| surface.position(vertex))
}
