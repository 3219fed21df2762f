//! Printed supports against the plan: closed bodies of the right volume, foot and height.

use super::{Agreement, Findings, Folder};
use crate::fabrication::names::distinct_file_names;
use crate::fabrication::supports::solid::{cross, dot};
use crate::fabrication::units::MM;
use crate::plan::{Plan, SupportBody, SupportRecord};
use crate::project::model::SupportKind;
use std::collections::BTreeMap;
use std::io::Cursor;

/// Coordinates of an STL have 24 bits, those of a 3MF four decimals, millimetres.
const OFF: f64 = 0.001;
/// The plan keeps volumes to this, cubic millimetres.
const VOLUME_OFF: f64 = 1.0;
/// All supports for the printer's plate.
const PLATE: &str = "supports/supports.3mf";
/// Bytes of a triangle in a binary STL: a normal, three corners, two bytes.
const TRIANGLE: usize = 50;
/// Bytes before the first triangle: a title and their number.
const HEAD: usize = 84;

/// Three corners of each triangle, counter-clockwise as seen from outside, millimetres.
type Triangles = Vec<[[f64; 3]; 3]>;

/// Every support that is printed, by itself and on the plate.
pub(super) fn check(
    plan: &Plan,
    folder: &Folder,
    agreement: &mut Agreement,
    findings: &mut Findings,
) {
    let names = distinct_file_names(plan.supports.iter().map(|support| support.id.as_str()));
    let printed: Vec<(&SupportRecord, SupportBody, String)> = plan
        .supports
        .iter()
        .zip(names)
        .filter(|(support, _)| support.kind == SupportKind::Printed)
        .filter_map(|(support, name)| Some((support, support.body?, name)))
        .collect();
    if printed.is_empty() {
        return;
    }
    for (support, body, name) in &printed {
        let path = format!("supports/{name}.stl");
        match folder.get(&path).map(|bytes| stl(bytes)) {
            None => findings.missing(&format!("`{path}`"), &support.id),
            Some(None) => findings.unreadable(&path, "it is no binary STL"),
            Some(Some(triangles)) => {
                agreement.solids += 1;
                if let Some(how) = difference(&triangles, support, body) {
                    findings.part(&path, &support.id, &how);
                }
            }
        }
    }
    let Some(bytes) = folder.get(PLATE) else {
        return findings.missing(&format!("`{PLATE}`"), PLATE);
    };
    let mut objects = match three_mf(bytes) {
        Ok(objects) => objects,
        Err(why) => return findings.unreadable(PLATE, &why),
    };
    for (support, body, _) in &printed {
        match objects.remove(&support.id) {
            None => findings.part(PLATE, &support.id, "is missing"),
            Some(triangles) => {
                if let Some(how) = difference(&triangles, support, body) {
                    findings.part(PLATE, &support.id, &how);
                }
            }
        }
    }
    for name in objects.keys() {
        findings.part(PLATE, name, "is not of this plan");
    }
}

/// How a solid differs from the body of its support.
fn difference(
    triangles: &Triangles,
    support: &SupportRecord,
    body: &SupportBody,
) -> Option<String> {
    if !is_closed(triangles) {
        return Some("is no closed body".to_owned());
    }
    let corners = || triangles.iter().flatten();
    let lowest = corners().map(|p| p[2]).fold(f64::INFINITY, f64::min);
    let highest = corners().map(|p| p[2]).fold(f64::NEG_INFINITY, f64::max);
    let rim = body.block + 0.5 * body.pad * libm::sin(support.tilt.to_radians());
    if lowest.abs() > OFF || (highest - rim * MM).abs() > OFF {
        return Some(format!(
            "reaches from {lowest:.3} to {highest:.3} mm, the plan says from 0 to {:.3} mm",
            rim * MM
        ));
    }
    let on_ground = corners().filter(|p| p[2].abs() <= OFF);
    let foot = 2.0
        * on_ground
            .map(|p| libm::hypot(p[0], p[1]))
            .fold(0.0, f64::max);
    if (foot - body.foot * MM).abs() > 2.0 * OFF {
        return Some(format!(
            "has a foot of {foot:.3} mm, the plan says {:.3} mm",
            body.foot * MM
        ));
    }
    let (volume, planned) = (volume(triangles), body.volume * MM * MM * MM);
    // What the coordinates are off, over the whole surface.
    let off = VOLUME_OFF + OFF * surface(triangles);
    ((volume - planned).abs() > off)
        .then(|| format!("has {volume:.0} mm3, the plan says {planned:.0} mm3"))
}

/// The triangles of a binary STL.
fn stl(bytes: &[u8]) -> Option<Triangles> {
    let number = u32::from_le_bytes(bytes.get(80..HEAD)?.try_into().ok()?) as usize;
    let body = bytes.get(HEAD..)?;
    if body.len() != number.checked_mul(TRIANGLE)? {
        return None;
    }
    let value = |at: &[u8]| {
        let value = f32::from_le_bytes(at.try_into().ok()?);
        value.is_finite().then(|| f64::from(value))
    };
    body.chunks_exact(TRIANGLE)
        .map(|triangle| {
            let values: Vec<f64> = triangle[12..48]
                .chunks_exact(4)
                .map(value)
                .collect::<Option<_>>()?;
            Some([0, 3, 6].map(|at| [values[at], values[at + 1], values[at + 2]]))
        })
        .collect()
}

/// The triangles of every object of a 3MF, by its name.
fn three_mf(bytes: &[u8]) -> Result<BTreeMap<String, Triangles>, String> {
    let models = threemf::read(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let mut objects = BTreeMap::new();
    for object in models.into_iter().flat_map(|model| model.resources.object) {
        let name = object.name.unwrap_or_default();
        let Some(mesh) = object.mesh else {
            return Err(format!("object `{name}` has no mesh"));
        };
        let vertex = |index: usize| {
            let vertex = mesh.vertices.vertex.get(index)?;
            let place = [vertex.x, vertex.y, vertex.z];
            place.iter().all(|value| value.is_finite()).then_some(place)
        };
        let triangles: Option<Triangles> = mesh
            .triangles
            .triangle
            .iter()
            .map(|triangle| {
                Some([
                    vertex(triangle.v1)?,
                    vertex(triangle.v2)?,
                    vertex(triangle.v3)?,
                ])
            })
            .collect();
        let Some(triangles) = triangles else {
            return Err(format!("object `{name}` has triangles without corners"));
        };
        objects.insert(name, triangles);
    }
    Ok(objects)
}

/// Whether as many triangles run along every edge one way as the other: the surface has no border.
/// Corners are the same where all their bits are.
fn is_closed(triangles: &Triangles) -> bool {
    // -0 and 0 are one place.
    let bits = |p: [f64; 3]| p.map(|value| (value + 0.0).to_bits());
    let mut edges: BTreeMap<[[u64; 3]; 2], i32> = BTreeMap::new();
    for &[a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (from, to) = (bits(from), bits(to));
            let (edge, way) = if from < to {
                ([from, to], 1)
            } else {
                ([to, from], -1)
            };
            *edges.entry(edge).or_default() += way;
        }
    }
    !triangles.is_empty() && edges.values().all(|&ways| ways == 0)
}

/// By the divergence theorem: tetrahedra to the origin.
fn volume(triangles: &Triangles) -> f64 {
    let of = |[a, b, c]: [[f64; 3]; 3]| dot(a, cross(b, c)) / 6.0;
    triangles.iter().copied().map(of).sum()
}

/// Area of all triangles.
fn surface(triangles: &Triangles) -> f64 {
    let area = |[a, b, c]: [[f64; 3]; 3]| {
        let along = |p: [f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
        let normal = cross(along(b), along(c));
        0.5 * libm::sqrt(dot(normal, normal))
    };
    triangles.iter().copied().map(area).sum()
}
