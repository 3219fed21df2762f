//! Triangles on their way to a mesh: welded vertices, polygons cut, every face with the record it
//! comes from.

use super::findings::Findings;
use super::ignored::at_lines;
use super::lines::Span;
use super::polygon::{self, MAX_POLYGON, PolygonFault};
use super::scan::Scan;
use super::{MAX_COORDINATE, ReadOptions};
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};
use crate::project::model::Axis;
use crate::surface::Point3;

/// No vertex.
pub(super) const NONE: u32 = u32::MAX;

/// Triangles over welded vertices.
#[derive(Debug)]
pub(super) struct Soup {
    /// Metres, z up; in the order of the file.
    pub(super) positions: Vec<Point3>,
    /// The first `v` record at each position.
    pub(super) records: Vec<u32>,
    /// Per `v` record its vertex, or [`NONE`].
    pub(super) vertex_of_record: Vec<u32>,
    /// Triangles.
    pub(super) faces: Vec<[u32; 3]>,
    /// The `f` record of each triangle.
    pub(super) sources: Vec<u32>,
}

/// The file behind the soup, for messages.
#[derive(Debug)]
pub(super) struct Origin {
    /// Place of each `v` record.
    pub(super) vertices: Vec<Span>,
    /// Place of each `f` record.
    pub(super) faces: Vec<Span>,
    /// Coordinates as written, per `v` record that a face names.
    pub(super) written: Vec<[f64; 3]>,
}

impl Origin {
    /// A position in the file's own coordinates, as the modelling program shows it.
    pub(super) fn place(&self, soup: &Soup, vertex: u32) -> String {
        let [x, y, z] = self.written[soup.records[vertex as usize] as usize];
        format!("({x}, {y}, {z})")
    }

    /// Place of a triangle's record.
    pub(super) fn span(&self, soup: &Soup, face: u32) -> Span {
        self.faces[soup.sources[face as usize] as usize]
    }
}

/// What tobj makes of the clean text: coordinates per `v` record that a face names, others NaN.
pub(super) fn parse(scan: &Scan) -> Result<Vec<[f64; 3]>, tobj::LoadError> {
    let options = tobj::LoadOptions {
        single_index: false,
        triangulate: false,
        ignore_points: true,
        ignore_lines: true,
    };
    let (models, _) = tobj::load_obj_buf(&mut scan.clean.as_slice(), &options, |_| {
        Ok(Default::default())
    })?;
    let mut written = vec![[f64::NAN; 3]; scan.vertices.len()];
    // Without groups there is one model; tobj numbers its vertices by first use and keeps the
    // order of faces and corners.
    let indices = models.iter().flat_map(|model| {
        let mesh = &model.mesh;
        mesh.indices
            .iter()
            .map(|&i| &mesh.positions[3 * i as usize..3 * i as usize + 3])
    });
    for (&record, position) in scan.corners.iter().zip(indices) {
        written[record as usize] = [position[0], position[1], position[2]];
    }
    Ok(written)
}

/// Scales and turns to metres with z up, welds vertices of equal position, cuts polygons.
pub(super) fn assemble(
    scan: Scan,
    written: Vec<[f64; 3]>,
    options: &ReadOptions,
    findings: &mut Findings,
) -> Option<(Soup, Origin)> {
    let placed: Vec<Point3> = written.iter().map(|&p| place(p, options)).collect();
    let mut soup = weld(&scan, &placed, findings);
    if findings.failed() {
        return None;
    }
    cut_polygons(&mut soup, &scan, findings);
    let origin = Origin {
        vertices: scan.vertices,
        faces: scan.faces,
        written,
    };
    Some((soup, origin))
}

/// Metres, z up. The mesh is turned by a right angle about the horizontal axis that it shares with
/// the project, so that x (for `up = "y"`) or y (for `up = "x"`) stays as the user knows it.
///
/// Adding zero turns -0 into 0, so that equal coordinates have equal bits.
fn place([x, y, z]: [f64; 3], options: &ReadOptions) -> Point3 {
    let turned = match options.up {
        Axis::X => [-z, y, x],
        Axis::Y => [x, -z, y],
        Axis::Z => [x, y, z],
    };
    Point3::from(turned.map(|c| c * options.metres_per_unit + 0.0))
}

/// One vertex for each position that a face uses, numbered in the order of the file.
fn weld(scan: &Scan, placed: &[Point3], findings: &mut Findings) -> Soup {
    let mut used: Vec<u32> = scan.corners.clone();
    used.sort_unstable();
    used.dedup();
    for &record in &used {
        let p = &placed[record as usize];
        if !p.iter().all(|c| c.abs() <= MAX_COORDINATE) {
            findings.add(&codes::BAD_VERTEX, || {
                out_of_range(p, scan.vertices[record as usize])
            });
        }
    }
    let key = |record: u32| placed[record as usize].coords.data.0[0].map(ordered_bits);
    let mut by_position = used.clone();
    by_position.sort_unstable_by_key(|&record| (key(record), record));
    let mut first_of = vec![NONE; placed.len()];
    for group in by_position.chunk_by(|&a, &b| key(a) == key(b)) {
        for &record in group {
            first_of[record as usize] = group[0];
        }
    }
    let mut vertex_of_record = vec![NONE; placed.len()];
    let mut records = Vec::new();
    for &record in &used {
        let first = first_of[record as usize] as usize;
        // The first record of a group comes before its others.
        if first == record as usize {
            vertex_of_record[first] = records.len() as u32;
            records.push(record);
        } else {
            vertex_of_record[record as usize] = vertex_of_record[first];
        }
    }
    Soup {
        positions: records.iter().map(|&r| placed[r as usize]).collect(),
        records,
        vertex_of_record,
        faces: Vec::with_capacity(scan.faces.len()),
        sources: Vec::with_capacity(scan.faces.len()),
    }
}

/// Bits that sort as the numbers do (the order of `f64::total_cmp`).
fn ordered_bits(x: f64) -> u64 {
    let bits = x.to_bits();
    if bits >> 63 == 1 {
        !bits
    } else {
        bits | 1 << 63
    }
}

fn out_of_range(p: &Point3, span: Span) -> Diagnostic {
    let farthest = p.coords.amax();
    Diagnostic::error(
        codes::BAD_VERTEX,
        format!(
            "a vertex lies {farthest:.1e} m from the origin, the limit is {MAX_COORDINATE:.0e} m (line {})",
            span.line
        ),
    )
    .at_bytes(File::Mesh, span.bytes(), "this vertex")
    .help("check `surface.units`, or move the surface to the origin")
}

/// Triangles from polygons; corners that weld together with the one before are left out.
fn cut_polygons(soup: &mut Soup, scan: &Scan, findings: &mut Findings) {
    let mut collapsed: Option<(usize, Span)> = None;
    for (source, &span) in scan.faces.iter().enumerate() {
        let mut corners: Vec<u32> = scan
            .corners_of(source)
            .iter()
            .map(|&record| soup.vertex_of_record[record as usize])
            .collect();
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() < 3 {
            collapsed = Some(collapsed.map_or((1, span), |(count, first)| (count + 1, first)));
            continue;
        }
        let points: Vec<Point3> = corners
            .iter()
            .map(|&v| soup.positions[v as usize])
            .collect();
        let triangles = if repeats(&corners) {
            Err(PolygonFault::Crossing)
        } else {
            polygon::cut(&points)
        };
        match triangles {
            Ok(triangles) => {
                for t in triangles {
                    soup.faces.push(t.map(|i| corners[i]));
                    soup.sources.push(source as u32);
                }
            }
            Err(fault) => {
                findings.add(&codes::BAD_POLYGON, || {
                    bad_polygon(fault, corners.len(), span)
                });
            }
        }
    }
    if let Some((count, span)) = collapsed {
        findings.add(&codes::DROPPED_FACES, || {
            dropped(count, "with fewer than three distinct corners", span)
        });
    }
}

fn repeats(corners: &[u32]) -> bool {
    if corners.len() <= 4 {
        // Neighbours differ already.
        return corners.len() == 4 && (corners[0] == corners[2] || corners[1] == corners[3]);
    }
    let mut sorted = corners.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).any(|pair| pair[0] == pair[1])
}

fn bad_polygon(fault: PolygonFault, corners: usize, span: Span) -> Diagnostic {
    let reason = match fault {
        PolygonFault::TooManyCorners => format!("has more than {MAX_POLYGON}"),
        PolygonFault::Flat => "encloses no area".into(),
        PolygonFault::Crossing => "crosses or touches itself".into(),
    };
    Diagnostic::error(
        codes::BAD_POLYGON,
        format!(
            "a face with {corners} corners {reason} (line {})",
            span.line
        ),
    )
    .at_bytes(File::Mesh, span.bytes(), "this face")
    .help("triangulate the mesh in the modelling program")
}

/// The warning that faces were taken out.
pub(super) fn dropped(count: usize, which: &str, first: Span) -> Diagnostic {
    let faces = if count == 1 { "face" } else { "faces" };
    let message = format!(
        "{count} {faces} {which} taken out ({})",
        at_lines(count, first)
    );
    Diagnostic::warning(codes::DROPPED_FACES, message).at_bytes(
        File::Mesh,
        first.bytes(),
        "taken out",
    )
}
