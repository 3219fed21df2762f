//! Printed supports as closed triangle meshes, and the two formats that printers read.
//!
//! A foot is the hull between a circle on the ground and the round contact face, with a blind
//! hole for the bolt square to that face: the bolt cuts its thread in the plastic, or the hole is
//! drilled up for an insert. Every edge belongs to two triangles that run along it in opposite
//! directions, and every triangle is counter-clockwise as seen from outside.
//!
//! Frame: millimetres, the middle of the foot at the origin, z up, x and y those of the surface.

use super::super::units::MM;
use crate::plan::{SupportBody, SupportRecord};
use crate::project::model::SupportKind;
use core::f64::consts::PI;
use std::io::Cursor;

/// Sides of circles: an eighth of a percent of the radius from a true one at the worst.
const SIDES: u32 = 64;

/// Distance of two supports on the plate of a 3MF, millimetres.
const PLATE_GAP: f64 = 10.0;

/// A closed surface of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// Millimetres.
    pub vertices: Vec<[f64; 3]>,
    /// Counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// The solid of a printed support; none for other kinds and for faces without a foot.
pub fn of(record: &SupportRecord) -> Option<Solid> {
    let body = record
        .body
        .filter(|_| record.kind == SupportKind::Printed)?;
    let [tilt, azimuth] = [record.tilt, record.azimuth].map(f64::to_radians);
    Some(printed(&body, tilt, azimuth))
}

/// A printed foot whose contact face falls by `tilt` in the direction of `azimuth` (radians).
pub fn printed(body: &SupportBody, tilt: f64, azimuth: f64) -> Solid {
    let frame = Frame::new(body.block * MM, tilt, azimuth);
    let mut solid = Solid {
        vertices: Vec::with_capacity(4 * SIDES as usize + 2),
        triangles: Vec::with_capacity(8 * SIDES as usize),
    };
    let foot = solid.ring(|cos, sin| frame.level(cos, sin, 0.5 * body.foot * MM));
    let face = solid.ring(|cos, sin| frame.inclined(cos, sin, 0.5 * body.pad * MM, 0.0));
    let bore = 0.5 * body.bore * MM;
    let mouth = solid.ring(|cos, sin| frame.inclined(cos, sin, bore, 0.0));
    let end = solid.ring(|cos, sin| frame.inclined(cos, sin, bore, body.depth * MM));
    let below = solid.vertex([0.0; 3]);
    let bottom = solid.vertex(frame.inclined(0.0, 0.0, 0.0, body.depth * MM));
    for k in 0..SIDES {
        let next = (k + 1) % SIDES;
        solid.triangles.extend([
            [below, foot + next, foot + k],
            [bottom, end + k, end + next],
        ]);
        for (outer, inner) in [(foot, face), (face, mouth), (mouth, end)] {
            solid.triangles.extend([
                [outer + k, outer + next, inner + next],
                [outer + k, inner + next, inner + k],
            ]);
        }
    }
    solid
}

/// Directions of a contact face.
struct Frame {
    height: f64,
    /// Along the fall, in the face and level.
    fall: [f64; 3],
    level: [f64; 3],
    /// Across both.
    across: [f64; 3],
    normal: [f64; 3],
}

impl Frame {
    fn new(height: f64, tilt: f64, azimuth: f64) -> Self {
        let (sin, cos) = libm::sincos(tilt);
        let (y, x) = libm::sincos(azimuth);
        Self {
            height,
            fall: [x * cos, y * cos, -sin],
            level: [x, y, 0.0],
            across: [-y, x, 0.0],
            normal: [x * sin, y * sin, cos],
        }
    }

    fn level(&self, cos: f64, sin: f64, radius: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| radius * (cos * self.level[i] + sin * self.across[i]))
    }

    /// A point of a circle in the contact face, or that much below it.
    fn inclined(&self, cos: f64, sin: f64, radius: f64, depth: f64) -> [f64; 3] {
        let middle = [0.0, 0.0, self.height];
        [0, 1, 2].map(|i| {
            let in_face = radius * (cos * self.fall[i] + sin * self.across[i]);
            middle[i] + in_face - depth * self.normal[i]
        })
    }
}

impl Solid {
    fn vertex(&mut self, position: [f64; 3]) -> u32 {
        self.vertices.push(position);
        self.vertices.len() as u32 - 1
    }

    /// A ring of vertices; gives the index of the first.
    fn ring(&mut self, point: impl Fn(f64, f64) -> [f64; 3]) -> u32 {
        let first = self.vertices.len() as u32;
        for k in 0..SIDES {
            let (sin, cos) = libm::sincos(2.0 * PI * f64::from(k) / f64::from(SIDES));
            self.vertex(point(cos, sin));
        }
        first
    }

    fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|i| self.vertices[i as usize])
    }

    /// Enclosed volume, cubic millimetres, and its centre: sums over the tetrahedra of the
    /// triangles and the origin (divergence theorem).
    pub fn volume_and_centre(&self) -> (f64, [f64; 3]) {
        let mut volume = 0.0;
        let mut moment = [0.0; 3];
        for triangle in &self.triangles {
            let [a, b, c] = self.corners(*triangle);
            let part = dot(a, cross(b, c)) / 6.0;
            volume += part;
            for (i, sum) in moment.iter_mut().enumerate() {
                *sum += part * (a[i] + b[i] + c[i]) / 4.0;
            }
        }
        (volume, moment.map(|m| m / volume))
    }

    /// Smallest and largest coordinates.
    fn bounds(&self) -> [[f64; 3]; 2] {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for vertex in &self.vertices {
            for (i, value) in vertex.iter().enumerate() {
                bounds[0][i] = bounds[0][i].min(*value);
                bounds[1][i] = bounds[1][i].max(*value);
            }
        }
        bounds
    }
}

pub(in crate::fabrication) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(in crate::fabrication) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Binary STL: an 80 byte head, the count, and for each triangle its normal and corners as
/// 32 bit numbers, little endian. The format has no unit; millimetres are its custom.
pub fn stl(name: &str, solid: &Solid) -> Vec<u8> {
    let mut head = format!("{name}, millimetres").into_bytes();
    // A head that begins with "solid" is taken for the text form of the format.
    head.splice(0..0, *b"egg ");
    head.resize(80, b' ');
    let mut bytes = head;
    bytes.extend((solid.triangles.len() as u32).to_le_bytes());
    for triangle in &solid.triangles {
        let corners = solid.corners(*triangle);
        let [a, b, c] = corners;
        let edge = |p: [f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
        let normal = cross(edge(b), edge(c));
        let length = libm::sqrt(dot(normal, normal)).max(f64::MIN_POSITIVE);
        let normal = normal.map(|v| v / length);
        for value in [normal].iter().chain(&corners).flatten() {
            bytes.extend((*value as f32).to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    bytes
}

/// All supports as objects of one 3MF, side by side on a plate in their order.
///
/// # Panics
/// Never: memory takes every byte, and numbers and ids are XML.
pub fn three_mf(solids: &[(&str, Solid)]) -> Vec<u8> {
    use threemf::model::{Build, Item, Metadata, Model, Object, Resources};
    let mut model = Model {
        metadata: vec![Metadata {
            name: "Application".to_owned(),
            value: Some("egg".to_owned()),
        }],
        // Nothing here is of the materials extension.
        xmlns_m: None,
        resources: Resources::default(),
        build: Build::default(),
        ..Model::default()
    };
    for ((name, solid), place) in solids.iter().zip(plate(solids)) {
        let id = model.resources.object.len() + 1;
        model.resources.object.push(Object {
            id,
            name: Some((*name).to_owned()),
            mesh: Some(mesh(solid)),
            ..Object::default()
        });
        let [x, y] = place;
        model.build.item.push(Item {
            objectid: id,
            transform: Some([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, x, y, 0.0]),
            partnumber: None,
        });
    }
    let mut bytes = Cursor::new(Vec::new());
    threemf::write(&mut bytes, model).expect("memory takes every byte, and numbers are XML");
    bytes.into_inner()
}

fn mesh(solid: &Solid) -> threemf::Mesh {
    use threemf::model::{Triangle, Triangles, Vertex, Vertices};
    // A tenth of a micrometre is far below what any printer places.
    let round = |v: f64| libm::round(v * 1e4) / 1e4 + 0.0;
    threemf::Mesh {
        vertices: Vertices {
            vertex: solid
                .vertices
                .iter()
                .map(|p| p.map(round))
                .map(|[x, y, z]| Vertex { x, y, z })
                .collect(),
        },
        triangles: Triangles {
            triangle: solid
                .triangles
                .iter()
                .map(|t| t.map(|i| i as usize))
                .map(|[v1, v2, v3]| Triangle { v1, v2, v3 })
                .collect(),
        },
    }
}

/// Where the middle of each foot stands, in rows of a square as nearly as can be.
fn plate(solids: &[(&str, Solid)]) -> Vec<[f64; 2]> {
    let pitch = solids
        .iter()
        .map(|(_, solid)| {
            let [low, high] = solid.bounds();
            (0..2).map(|i| high[i].max(-low[i])).fold(0.0, f64::max)
        })
        .fold(0.0, f64::max);
    let pitch = libm::ceil(2.0 * pitch + PLATE_GAP);
    let columns = (1..=solids.len())
        .find(|n| n * n >= solids.len())
        .unwrap_or(1);
    (0..solids.len())
        .map(|i| [i % columns, i / columns].map(|place| (place as f64 + 0.5) * pitch))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    fn body(pad: f64, foot: f64, height: f64) -> SupportBody {
        SupportBody {
            pad,
            foot,
            bore: 0.0033,
            depth: 0.012,
            block: height,
            volume: 0.0,
            mass: 0.0,
            tipping_thrust: 0.0,
        }
    }

    /// Area of the regular polygon that stands for a circle, per square of its radius.
    fn polygon() -> f64 {
        let sides = f64::from(SIDES);
        0.5 * sides * libm::sin(2.0 * PI / sides)
    }

    #[test]
    fn a_level_foot_is_a_frustum_less_its_hole() {
        let (volume, centre) = printed(&body(0.045, 0.063, 0.05), 0.0, 0.0).volume_and_centre();
        let [r, s] = [22.5, 31.5];
        let frustum = polygon() * 50.0 / 3.0 * (r * r + r * s + s * s);
        let hole = polygon() * 1.65 * 1.65 * 12.0;
        assert!((volume / (frustum - hole) - 1.0).abs() < 1e-12);
        assert!(centre[0].abs() < 1e-9 && centre[1].abs() < 1e-9);
        assert!(centre[2] > 20.0 && centre[2] < 25.0);
    }

    #[test]
    fn an_azimuth_turns_the_foot_and_keeps_its_volume() {
        let body = body(0.045, 0.08, 0.05);
        let (straight, centre) = printed(&body, 0.5, 0.0).volume_and_centre();
        let (turned, elsewhere) = printed(&body, 0.5, 2.0).volume_and_centre();
        assert!((straight / turned - 1.0).abs() < 1e-12);
        // The higher side, against the fall, is the heavier one.
        assert!(centre[0] < -2.0);
        let (sin, cos) = libm::sincos(2.0);
        assert!((elsewhere[0] - (cos * centre[0] - sin * centre[1])).abs() < 1e-9);
        assert!((elsewhere[1] - (sin * centre[0] + cos * centre[1])).abs() < 1e-9);
    }

    proptest! {
        #[test]
        fn every_edge_belongs_to_two_triangles_that_run_against_each_other(
            tilt in 0.0..1.2_f64,
            azimuth in -3.0..3.0_f64,
            pad in 0.015..0.1_f64,
        ) {
            let solid = printed(&body(pad, 2.0 * pad, 0.1), tilt, azimuth);
            let mut edges: BTreeMap<(u32, u32), i32> = BTreeMap::new();
            for [a, b, c] in &solid.triangles {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    let key = (*from.min(to), *from.max(to));
                    let way = if from < to { 1 } else { 100 };
                    *edges.entry(key).or_default() += way;
                }
            }
            prop_assert!(edges.values().all(|&ways| ways == 101));
            prop_assert!(solid.volume_and_centre().0 > 0.0);
        }
    }

    #[test]
    fn an_stl_has_fifty_bytes_a_triangle_and_unit_normals() {
        let solid = printed(&body(0.03, 0.05, 0.04), 0.3, 1.0);
        let bytes = stl("support-a", &solid);
        assert_eq!(bytes.len(), 84 + 50 * solid.triangles.len());
        assert!(bytes.starts_with(b"egg support-a, millimetres "));
        let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
        for triangle in 0..solid.triangles.len() {
            let at = 84 + 50 * triangle;
            let normal = [0, 4, 8].map(|i| number(at + i));
            let length: f32 = normal.iter().map(|v| v * v).sum();
            assert!((length - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn a_3mf_is_read_back_by_the_library_that_wrote_it() {
        let solids: Vec<(&str, Solid)> = ["support-a", "support-b", "support-c"]
            .map(|name| (name, printed(&body(0.03, 0.05, 0.04), 0.3, 1.0)))
            .into();
        let bytes = three_mf(&solids);
        let models = threemf::read(Cursor::new(bytes.clone())).expect("a 3MF");
        let objects: Vec<&threemf::model::Object> = models
            .iter()
            .flat_map(|model| &model.resources.object)
            .collect();
        assert_eq!(objects.len(), 3);
        assert_eq!(objects[1].name.as_deref(), Some("support-b"));
        let mesh = objects[2].mesh.as_ref().expect("a mesh");
        assert_eq!(mesh.triangles.triangle.len(), solids[2].1.triangles.len());
        assert_eq!(bytes, three_mf(&solids));
    }
}
