//! Takes out faces without area whose three corners differ: "caps", whose corners lie on a line.
//!
//! Simply dropping one would leave a slit through which no geodesic passes. Instead its longest
//! side is turned: the face and its neighbour over that side make a quadrilateral, which is cut
//! along its other diagonal. At the border the face can be cut off.

use super::findings::Findings;
use super::soup::{Origin, Soup, dropped};
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};
use crate::surface::{HalfEdge, Mesh, Point3};

/// A face lower than this share of its longest side has no area: its normal is rounding noise.
/// Single-precision exports resolve 6e-8 of a coordinate.
pub(super) const FLAT_FACE: f64 = 1e-9;

/// Rounds of turning; flat faces that share a vertex take a round each.
const ROUNDS: usize = 32;

/// Height over the longest side, and the corner of the half-edge along it.
pub(super) fn flatness([a, b, c]: [Point3; 3]) -> (f64, u32) {
    let sides = [b - a, c - b, a - c].map(|side| side.norm_squared());
    let longest = if sides[0] >= sides[1] && sides[0] >= sides[2] {
        0
    } else if sides[1] >= sides[2] {
        1
    } else {
        2
    };
    let cross = (b - a).cross(&(c - a)).norm();
    (cross / sides[longest as usize], longest)
}

/// The mesh of an oriented manifold soup, without flat faces; `None` if some cannot be taken out.
pub(super) fn straighten(
    soup: &mut Soup,
    origin: &Origin,
    findings: &mut Findings,
) -> Option<Mesh> {
    let mut first = None;
    let mut count = 0;
    let mut round = 0;
    let mesh = loop {
        soup.compact();
        let mesh = Mesh::new(soup.positions.clone(), soup.faces.clone()).ok()?;
        let flat: Vec<u32> = (0..mesh.face_count())
            .filter(|&face| flatness(mesh.corners(face)).0 <= FLAT_FACE)
            .collect();
        if flat.is_empty() {
            break Some(mesh);
        }
        let mut edit = Edit::new(&mesh);
        for &face in &flat {
            if edit.take_out(face) {
                first = first.or(Some(origin.span(soup, face)));
                count += 1;
            }
        }
        if !edit.changed || round == ROUNDS {
            for &face in &flat {
                findings.add(&codes::DEGENERATE, || stuck(face, soup, origin));
            }
            break None;
        }
        let Edit { faces, keep, .. } = edit;
        soup.faces = faces;
        soup.retain(&keep);
        round += 1;
    };
    if let (Some(span), Some(_)) = (first, &mesh) {
        findings.add(&codes::DROPPED_FACES, || {
            dropped(count, "without area", span)
        });
    }
    mesh
}

fn stuck(face: u32, soup: &Soup, origin: &Origin) -> Diagnostic {
    let span = origin.span(soup, face);
    let [a, b, c] = soup.faces[face as usize].map(|v| origin.place(soup, v));
    Diagnostic::error(
        codes::DEGENERATE,
        format!(
            "the corners {a}, {b} and {c} of a face lie on a line (line {})",
            span.line
        ),
    )
    .at_bytes(File::Mesh, span.bytes(), "this face")
    .help("remesh the surface there, or collapse the short edges")
}

/// Changes of one round, at places that have no vertex in common, so that each may look at the
/// unchanged mesh.
struct Edit<'m> {
    mesh: &'m Mesh,
    faces: Vec<[u32; 3]>,
    keep: Vec<bool>,
    touched: Vec<bool>,
    changed: bool,
}

impl<'m> Edit<'m> {
    fn new(mesh: &'m Mesh) -> Self {
        Self {
            mesh,
            faces: mesh.faces().to_vec(),
            keep: vec![true; mesh.faces().len()],
            touched: vec![false; mesh.positions().len()],
            changed: false,
        }
    }

    /// Turns the longest side of a flat face, or cuts the face off at the border, if the surface
    /// stays a manifold.
    fn take_out(&mut self, face: u32) -> bool {
        let mesh = self.mesh;
        let (_, corner) = flatness(mesh.corners(face));
        let side = HalfEdge::new(face, corner);
        let [a, b, c] = [side, side.next(), side.prev()].map(|h| mesh.origin(h));
        if let Some(twin) = mesh.twin(side) {
            let d = mesh.origin(twin.prev());
            let free = d != c && !mesh.neighbours(c).any(|v| v == d);
            let done = free && self.touch(&[a, b, c, d]);
            if done {
                self.faces[face as usize] = [c, a, d];
                self.faces[twin.face() as usize] = [d, b, c];
            }
            done
        } else {
            let inner = [side.next(), side.prev()]
                .iter()
                .filter(|&&h| mesh.twin(h).is_some())
                .count();
            let free = match inner {
                0 => false,
                1 => true,
                _ => !mesh.is_border_vertex(c),
            };
            let done = free && self.touch(&[a, b, c]);
            if done {
                self.keep[face as usize] = false;
            }
            done
        }
    }

    /// Claims vertices for a change; false if one of them belongs to another already.
    fn touch(&mut self, vertices: &[u32]) -> bool {
        let free = !vertices.iter().any(|&v| self.touched[v as usize]);
        if free {
            for &v in vertices {
                self.touched[v as usize] = true;
            }
            self.changed = true;
        }
        free
    }
}
