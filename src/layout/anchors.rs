//! Anchors: from what the project says to points on the surface.

use crate::diagnostics::codes::layout as codes;
use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::project::model::Anchor;
use crate::surface::{Locator, Mesh, NoVertex, Point3, SurfaceMesh, SurfacePoint};

/// An anchor further from the surface than this share of its diagonal deserves a word.
const FAR: f64 = 0.05;

/// Places anchors on the surface, in the order given. Anchors on a geodesic have no place of
/// their own and come out as `None`.
///
/// Diagnostics point at the fields `[i]` of the list.
pub fn place_anchors(
    surface: &SurfaceMesh,
    anchors: &[(String, Anchor)],
) -> Checked<Vec<Option<SurfacePoint>>> {
    let locator = Locator::new(&surface.mesh);
    let mut placed = Vec::with_capacity(anchors.len());
    let mut told = Vec::new();
    for (i, (name, anchor)) in anchors.iter().enumerate() {
        match place(surface, &locator, name, anchor) {
            Ok((point, warning)) => {
                placed.push(point);
                told.extend(warning.map(|w| w.at_key(format!(".[{i}]"), "this anchor")));
            }
            Err(error) => told.push(error.at_key(format!(".[{i}]"), "this anchor")),
        }
    }
    if placed.len() == anchors.len() {
        Ok(Warned {
            value: placed,
            warnings: told,
        })
    } else {
        Err(told)
    }
}

type Placed = (Option<SurfacePoint>, Option<Diagnostic>);

fn place(
    surface: &SurfaceMesh,
    locator: &Locator<'_>,
    name: &str,
    anchor: &Anchor,
) -> Result<Placed, Diagnostic> {
    let mesh = &surface.mesh;
    match *anchor {
        Anchor::On { .. } => Ok((None, None)),
        Anchor::Above(plan) => match locator.topmost(plan) {
            Ok(point) => Ok((Some(point), None)),
            Err(miss) => {
                let near = miss.nearest.position(mesh);
                Err(Diagnostic::error(
                    codes::OFF_SURFACE,
                    format!(
                        "there is no surface over `{name}` at ({}, {}) m",
                        plan[0], plan[1]
                    ),
                )
                .about(name)
                .note(format!(
                    "the nearest place over the surface is ({}, {}) m, {} m away",
                    metres(near.x, mesh),
                    metres(near.y, mesh),
                    metres(miss.distance, mesh)
                ))
                .note(extent(mesh))
                .help("move the anchor, or check `project.units` and `surface.units`"))
            }
        },
        Anchor::Near(at) => {
            let closest = locator.closest(&Point3::from(at)).ok_or_else(|| {
                Diagnostic::error(
                    codes::OFF_SURFACE,
                    format!("no surface point is near `{name}`"),
                )
                .about(name)
            })?;
            let (low, high) = mesh.bounding_box();
            let far = closest.distance > FAR * (high - low).norm();
            let warning = far.then(|| {
                Diagnostic::warning(
                    codes::FAR_ANCHOR,
                    format!(
                        "`{name}` at {} is {} m away from the surface",
                        super::place(Point3::from(at)),
                        metres(closest.distance, mesh)
                    ),
                )
                .about(name)
                .note(format!(
                    "it was moved to {}",
                    super::place(closest.point.position(mesh))
                ))
                .note(extent(mesh))
                .help("check the coordinates, `project.units` and `surface.units`")
            });
            Ok((Some(closest.point), warning))
        }
        Anchor::Vertex(record) => match surface.vertex(record) {
            Ok(vertex) => Ok((Some(SurfacePoint::Vertex(vertex)), None)),
            Err(NoVertex::OutOfRange { records }) => Err(Diagnostic::error(
                codes::NO_VERTEX,
                format!("`{name}` names vertex {record}, but the mesh has {records}"),
            )
            .about(name)
            .help(format!(
                "vertices are counted from 0 to {}",
                records.saturating_sub(1)
            ))),
            Err(NoVertex::Unused) => Err(Diagnostic::error(
                codes::NO_VERTEX,
                format!("`{name}` names vertex {record}, which no face of the surface uses"),
            )
            .about(name)
            .help("name another vertex, or give coordinates")),
        },
    }
}

fn extent(mesh: &Mesh) -> String {
    let (low, high) = mesh.bounding_box();
    let place = |p: Point3| {
        let [x, y, z] = [p.x, p.y, p.z].map(|x| metres(x, mesh));
        format!("({x}, {y}, {z})")
    };
    format!(
        "the surface reaches from {} to {} m",
        place(low),
        place(high)
    )
}

/// A length to a thousandth of the size of the surface, or better.
fn metres(length: f64, mesh: &Mesh) -> String {
    let (low, high) = mesh.bounding_box();
    let magnitude = libm::ceil(libm::log10((high - low).norm()));
    let decimals = (4.0 - magnitude).clamp(0.0, 9.0) as usize;
    format!("{length:.decimals$}")
}
