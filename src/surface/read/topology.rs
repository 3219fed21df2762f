//! Edges and faces of a soup: duplicates out, edges paired, unused vertices out.

use super::findings::Findings;
use super::ignored::at_lines;
use super::soup::{NONE, Origin, Soup, dropped};
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};
use crate::surface::{Point3, Vector3};

/// Takes out faces that repeat another one, in whatever rotation: layered and two-sided exports.
pub(super) fn drop_duplicates(soup: &mut Soup, origin: &Origin, findings: &mut Findings) {
    let mut order: Vec<([u32; 3], usize)> = soup
        .faces
        .iter()
        .enumerate()
        .map(|(face, corners)| {
            let mut corners = *corners;
            corners.sort_unstable();
            (corners, face)
        })
        .collect();
    order.sort_unstable();
    let mut keep = vec![true; soup.faces.len()];
    for group in order.chunk_by(|f, g| f.0 == g.0) {
        for &(_, face) in &group[1..] {
            keep[face] = false;
        }
    }
    let count = keep.iter().filter(|&&keep| !keep).count();
    if let Some(first) = keep.iter().position(|&keep| !keep) {
        let span = origin.span(soup, first as u32);
        findings.add(&codes::DROPPED_FACES, || {
            dropped(count, "present twice", span)
        });
    }
    soup.retain(&keep);
}

impl Soup {
    /// Keeps the marked faces.
    pub(super) fn retain(&mut self, keep: &[bool]) {
        let mut marks = keep.iter();
        self.faces.retain(|_| *marks.next().unwrap_or(&true));
        let mut marks = keep.iter();
        self.sources.retain(|_| *marks.next().unwrap_or(&true));
    }

    /// Renumbers the vertices that faces use, keeping their order, and forgets the others.
    pub(super) fn compact(&mut self) {
        let mut new_id = vec![NONE; self.positions.len()];
        for &v in self.faces.iter().flatten() {
            new_id[v as usize] = 0;
        }
        for (new, id) in (0..).zip(new_id.iter_mut().filter(|id| **id != NONE)) {
            *id = new;
        }
        let mut ids = new_id.iter();
        self.positions.retain(|_| ids.next() != Some(&NONE));
        let mut ids = new_id.iter();
        self.records.retain(|_| ids.next() != Some(&NONE));
        for v in self.faces.iter_mut().flatten() {
            *v = new_id[*v as usize];
        }
        for v in self.vertex_of_record.iter_mut().filter(|v| **v != NONE) {
            *v = new_id[*v as usize];
        }
    }

    /// Twice the area of a face along its normal, square metres.
    pub(super) fn face_cross(&self, face: u32) -> Vector3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(&(c - a))
    }

    /// The vertex at which a half-edge (`3 * face + corner`) starts.
    pub(super) fn origin(&self, h: u32) -> u32 {
        self.faces[h as usize / 3][h as usize % 3]
    }

    /// Corner positions of a face.
    pub(super) fn corners(&self, face: u32) -> [Point3; 3] {
        self.faces[face as usize].map(|v| self.positions[v as usize])
    }
}

/// Pairs half-edges of unoriented faces: per half-edge (`3 * face + corner`) the one across the
/// edge, or [`NONE`]; edges with more than two faces are told.
pub(super) fn pair_edges(soup: &Soup, origin: &Origin, findings: &mut Findings) -> Vec<u32> {
    let mut uses: Vec<(u32, u32, u32)> = (0..)
        .zip(&soup.faces)
        .flat_map(|(face, &[a, b, c])| {
            [(a, b, 0), (b, c, 1), (c, a, 2)]
                .map(|(from, to, corner)| (from.min(to), from.max(to), 3 * face + corner))
        })
        .collect();
    uses.sort_unstable();
    let mut across = vec![NONE; uses.len()];
    for group in uses.chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
        match *group {
            [_] => {}
            [(.., h), (.., k)] => {
                across[h as usize] = k;
                across[k as usize] = h;
            }
            _ => findings.add(&codes::EDGE_FAN, || edge_fan(group, soup, origin)),
        }
    }
    across
}

fn edge_fan(group: &[(u32, u32, u32)], soup: &Soup, origin: &Origin) -> Diagnostic {
    let (a, b, _) = group[0];
    let spans: Vec<_> = group
        .iter()
        .map(|&(.., h)| origin.span(soup, h / 3))
        .collect();
    let message = format!(
        "{} faces meet at the edge from {} to {} ({})",
        group.len(),
        origin.place(soup, a),
        origin.place(soup, b),
        at_lines(spans.len(), spans[0])
    );
    let texts = ["one of these faces", "another", "a third one"];
    spans
        .iter()
        .zip(texts)
        .fold(
            Diagnostic::error(codes::EDGE_FAN, message),
            |diagnostic, (span, text)| diagnostic.at_bytes(File::Mesh, span.bytes(), text),
        )
        .help("delete the faces that do not belong to the design surface")
}
