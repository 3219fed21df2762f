//! Reads the design surface from a Wavefront OBJ file and repairs what can be repaired without
//! guessing.
//!
//! | step | file | what it does |
//! |---|---|---|
//! | is it OBJ text? | `format` | byte order mark; binary, UTF-16 and other formats named |
//! | scan | `scan`, `lines`, `ignored` | every line judged with its number; clean `v` and `f` records |
//! | parse | `soup` | tobj reads the clean records |
//! | place | `soup` | metres, z up |
//! | weld | `soup` | one vertex for equal positions; seams of texture or groups close |
//! | cut | `polygon` | polygons into triangles |
//! | topology | `topology`, `parts` | duplicates out, edges checked, crumbs out, one orientation |
//! | flat faces | `flat_faces` | faces without area out, without a slit |
//! | side | here | normals up (or outward on closed surfaces) |
//! | checks | `checks` | seams, size, border, slivers |
//!
//! Everything is linear or n log n in the size of the file, and nothing is allocated from a number
//! that the file claims.

mod checks;
mod findings;
mod flat_faces;
mod format;
mod ignored;
mod lines;
mod parts;
mod polygon;
mod scan;
mod soup;
mod topology;

use super::adjacency::split_vertices;
use super::{Mesh, Vector3};
use crate::diagnostics::{Checked, Diagnostic, File, codes::surface as codes};
use crate::project::model::{Axis, Surface};
use findings::Findings;
use serde::{Deserialize, Serialize};
use soup::{NONE, Origin, Soup};

/// Largest file, bytes: a quarter of a gigabyte, some four million faces. Reading that takes about
/// a gigabyte of memory.
const MAX_BYTES: usize = 256 << 20;
/// Most `v` records.
const MAX_VERTICES: usize = 2_000_000;
/// Most corners of all faces.
const MAX_CORNERS: usize = 12_000_000;
/// Largest coordinate, metres; beyond, squares and products of lengths lose their meaning.
const MAX_COORDINATE: f64 = 1e8;
/// A surface whose mean normal is flatter than this has no upper side to speak of.
const UPRIGHT: f64 = 1e-3;

/// How the mesh file is meant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReadOptions {
    /// Metres per unit of the file.
    pub metres_per_unit: f64,
    /// Which axis of the file points up; the mesh is turned about y (for x) or x (for y).
    pub up: Axis,
    /// Which side of the surface is outside.
    pub side: Side,
}

impl ReadOptions {
    /// As a project says.
    pub fn of(surface: &Surface) -> Self {
        Self {
            metres_per_unit: surface.metres_per_unit,
            up: surface.up,
            side: if surface.flip {
                Side::Lower
            } else {
                Side::Upper
            },
        }
    }
}

/// Which side of the surface is its outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// The upper one, or the outer one of a closed surface.
    Upper,
    /// The other one.
    Lower,
}

/// A mesh with the numbers of its vertices in the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SurfaceMesh {
    /// The mesh.
    pub mesh: Mesh,
    /// Per `v` record its vertex, or [`NONE`] if no face uses it.
    vertex_of_record: Vec<u32>,
}

/// Why a `v` record is no vertex of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoVertex {
    /// The file has fewer `v` records.
    OutOfRange {
        /// How many it has.
        records: u32,
    },
    /// No face of the surface uses it.
    Unused,
}

impl SurfaceMesh {
    /// The vertex of a `v` record, numbered from 0 in the order of the file. Records with equal
    /// positions are one vertex.
    pub fn vertex(&self, record: u32) -> Result<u32, NoVertex> {
        match self.vertex_of_record.get(record as usize) {
            Some(&NONE) => Err(NoVertex::Unused),
            Some(&vertex) => Ok(vertex),
            None => Err(NoVertex::OutOfRange {
                records: self.vertex_of_record.len() as u32,
            }),
        }
    }

    /// How many `v` records the file has.
    pub fn records(&self) -> u32 {
        self.vertex_of_record.len() as u32
    }
}

/// Reads a Wavefront OBJ file: one oriented manifold surface in metres, z up.
///
/// Vertices keep the order of the file's `v` records and faces that of its `f` records, so the
/// result depends on nothing but positions and faces. Byte ranges of the diagnostics count the
/// bytes of the file as it is.
pub fn read_obj(bytes: &[u8], options: &ReadOptions) -> Checked<SurfaceMesh> {
    let mut findings = Findings::default();
    let surface = read(bytes, options, &mut findings);
    findings.finish(surface)
}

/// Each step needs the one before to have succeeded, so errors are told without their
/// consequences.
fn read(bytes: &[u8], options: &ReadOptions, findings: &mut Findings) -> Option<SurfaceMesh> {
    let start = match format::text_start(bytes) {
        Ok(start) => start,
        Err(diagnostic) => {
            findings.add(&diagnostic.code.clone(), || *diagnostic);
            return None;
        }
    };
    let scan = scan::scan(bytes, start, findings);
    if findings.failed() {
        return None;
    }
    let written = match soup::parse(&scan) {
        Ok(written) => written,
        Err(error) => {
            findings.add(&codes::NOT_OBJ, || {
                Diagnostic::error(
                    codes::NOT_OBJ,
                    format!("the mesh file is not read: {error}"),
                )
                .at_bytes(File::Mesh, 0..1, "the file")
            });
            return None;
        }
    };
    let (mut soup, origin) = soup::assemble(scan, written, options, findings)?;
    topology::drop_duplicates(&mut soup, &origin, findings);
    if soup.faces.is_empty() && !findings.failed() {
        findings.add(&codes::NO_FACES, || {
            Diagnostic::error(codes::NO_FACES, "no face of the mesh encloses an area")
                .at_bytes(File::Mesh, origin.faces[0].bytes(), "the first face")
                .help("check the export; all vertices may have the same position")
        });
    }
    let across = topology::pair_edges(&soup, &origin, findings);
    if findings.failed() {
        return None;
    }
    parts::orient(&mut soup, &across, &origin, findings);
    if findings.failed() {
        return None;
    }
    check_fans(&soup, &origin, findings);
    if findings.failed() {
        return None;
    }
    let mesh = flat_faces::straighten(&mut soup, &origin, findings)?;
    let mesh = choose_side(mesh, &mut soup, options.side);
    checks::check(&mesh, &soup, &origin, findings);
    Some(SurfaceMesh {
        mesh,
        vertex_of_record: soup.vertex_of_record,
    })
}

fn check_fans(soup: &Soup, origin: &Origin, findings: &mut Findings) {
    let split = split_vertices(soup.positions.len(), &soup.faces)
        .expect("edges have been paired and oriented");
    for v in split {
        findings.add(&codes::VERTEX_FANS, || {
            let span = origin.vertices[soup.records[v as usize] as usize];
            Diagnostic::error(
                codes::VERTEX_FANS,
                format!(
                    "parts of the surface touch only at {} (line {})",
                    origin.place(soup, v),
                    span.line
                ),
            )
            .at_bytes(File::Mesh, span.bytes(), "this vertex")
            .help("separate the parts, or fill the gap with a face")
        });
    }
}

/// Turns the whole surface over if its normals point the wrong way on average.
fn choose_side(mesh: Mesh, soup: &mut Soup, side: Side) -> Mesh {
    let (mut sum, mut total, mut volume) = (Vector3::zeros(), 0.0, 0.0);
    let origin = mesh.position(0);
    for face in 0..mesh.face_count() {
        let cross = mesh.face_cross(face);
        sum += cross;
        total += cross.norm();
        volume += cross.dot(&(mesh.corners(face)[0] - origin));
    }
    let closed = mesh.half_edges().all(|h| mesh.twin(h).is_some());
    // A wall has no upper side: it keeps the side of the file.
    let is_lower = if closed {
        volume < 0.0
    } else {
        sum.z < -UPRIGHT * total
    };
    if is_lower == (side == Side::Lower) {
        return mesh;
    }
    for face in &mut soup.faces {
        face.swap(1, 2);
    }
    Mesh::new(soup.positions.clone(), soup.faces.clone())
        .expect("turning all faces over keeps the topology")
}
