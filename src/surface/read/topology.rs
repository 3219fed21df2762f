//! From a soup of triangles to one consistently oriented piece: duplicates out, edges checked,
//! crumbs dropped, faces turned to agree with their neighbours.

use super::checks::{SEAM, near_pairs};
use super::findings::Findings;
use super::scan::at_lines;
use super::soup::{NONE, Origin, Soup, dropped};
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};
use crate::surface::{Point3, Vector3};
use std::collections::VecDeque;

/// A part with less than this share of the largest part's area is a crumb.
const CRUMB: f64 = 1e-3;
/// Parts that the message about several parts describes.
const PARTS_SHOWN: usize = 6;

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

/// A part: faces that hang together over edges.
#[derive(Debug)]
struct Part {
    first: u32,
    faces: usize,
    /// Square metres.
    area: f64,
    low: Point3,
    high: Point3,
}

/// Turns faces so that neighbours agree, drops crumbs, and tells what cannot be one surface.
///
/// The smaller share (by area) of each part is turned over.
pub(super) fn orient(soup: &mut Soup, across: &[u32], origin: &Origin, findings: &mut Findings) {
    let count = soup.faces.len();
    let mut part_of = vec![NONE; count];
    let mut turned = vec![false; count];
    let mut parts: Vec<Part> = Vec::new();
    for first in 0..count as u32 {
        if part_of[first as usize] != NONE {
            continue;
        }
        let id = parts.len() as u32;
        part_of[first as usize] = id;
        let mut queue = VecDeque::from([first]);
        let mut members = Vec::new();
        let mut conflict = None;
        while let Some(face) = queue.pop_front() {
            members.push(face);
            for h in 3 * face..3 * face + 3 {
                let twin = across[h as usize];
                if twin == NONE {
                    continue;
                }
                let other = twin / 3;
                // Neighbours agree if they run along the edge in opposite directions.
                let same_direction = soup.origin(h) == soup.origin(twin);
                let turn = turned[face as usize] != same_direction;
                if part_of[other as usize] == NONE {
                    part_of[other as usize] = id;
                    turned[other as usize] = turn;
                    queue.push_back(other);
                } else if turned[other as usize] != turn {
                    conflict.get_or_insert(h);
                }
            }
        }
        if let Some(h) = conflict {
            findings.add(&codes::ONE_SIDED, || one_sided(h, soup, origin));
        }
        parts.push(measure(soup, &members));
        let area = |turn| -> f64 {
            members
                .iter()
                .filter(|&&f| turned[f as usize] == turn)
                .map(|&f| soup.face_cross(f).norm())
                .sum()
        };
        if area(true) > area(false) {
            for &face in &members {
                turned[face as usize] = !turned[face as usize];
            }
        }
    }
    if findings.failed() {
        return;
    }
    let largest = parts.iter().map(|part| part.area).fold(0.0, f64::max);
    let is_crumb = |part: &Part| part.area < CRUMB * largest;
    drop_crumbs(soup, origin, &parts, is_crumb, findings);
    let mut whole: Vec<&Part> = parts.iter().filter(|part| !is_crumb(part)).collect();
    if whole.len() > 1 {
        whole.sort_by(|p, q| q.area.total_cmp(&p.area).then(p.first.cmp(&q.first)));
        findings.add(&codes::SEVERAL_PARTS, || {
            let seam = nearest_seam(soup, across, &part_of);
            several(&whole, soup, origin, seam)
        });
    }
    let keep: Vec<bool> = part_of
        .iter()
        .map(|&id| !is_crumb(&parts[id as usize]))
        .collect();
    turn_over(soup, &turned, &keep, origin, findings);
    soup.retain(&keep);
}

impl Soup {
    /// The vertex at which a half-edge starts.
    fn origin(&self, h: u32) -> u32 {
        self.faces[h as usize / 3][h as usize % 3]
    }
}

fn measure(soup: &Soup, members: &[u32]) -> Part {
    let mut part = Part {
        first: members[0],
        faces: members.len(),
        area: 0.0,
        low: Point3::from([f64::INFINITY; 3]),
        high: Point3::from([f64::NEG_INFINITY; 3]),
    };
    for &face in members {
        part.area += 0.5 * soup.face_cross(face).norm();
        for p in soup.corners(face) {
            part.low = part.low.inf(&p);
            part.high = part.high.sup(&p);
        }
    }
    part
}

fn one_sided(h: u32, soup: &Soup, origin: &Origin) -> Diagnostic {
    let span = origin.span(soup, h / 3);
    Diagnostic::error(
        codes::ONE_SIDED,
        format!(
            "the surface has only one side, like a Möbius band; it closes at {} (line {})",
            origin.place(soup, soup.origin(h)),
            span.line
        ),
    )
    .at_bytes(
        File::Mesh,
        span.bytes(),
        "turned against its neighbour whichever way",
    )
    .help("cut the band open")
}

fn drop_crumbs(
    soup: &Soup,
    origin: &Origin,
    parts: &[Part],
    is_crumb: impl Fn(&Part) -> bool,
    findings: &mut Findings,
) {
    let crumbs: Vec<&Part> = parts.iter().filter(|part| is_crumb(part)).collect();
    let Some(first) = crumbs.first() else {
        return;
    };
    let area: f64 = crumbs.iter().map(|part| part.area).sum();
    let count = crumbs.len();
    let noun = if count == 1 { "part" } else { "parts" };
    let span = origin.span(soup, first.first);
    findings.add(&codes::DEBRIS, || {
        Diagnostic::warning(
            codes::DEBRIS,
            format!(
                "{count} separate {noun} of {area:.2e} m² in all dropped (first: line {})",
                span.line
            ),
        )
        .at_bytes(File::Mesh, span.bytes(), "a face of the first one")
    });
}

/// Vertices of different parts that nearly coincide.
fn nearest_seam(soup: &Soup, across: &[u32], part_of: &[u32]) -> Option<[u32; 2]> {
    let mut part = vec![NONE; soup.positions.len()];
    for h in (0..across.len() as u32).filter(|&h| across[h as usize] == NONE) {
        part[soup.origin(h) as usize] = part_of[h as usize / 3];
    }
    let border: Vec<u32> = (0..part.len() as u32)
        .filter(|&v| part[v as usize] != NONE)
        .collect();
    let mut low = Point3::from([f64::INFINITY; 3]);
    let mut high = Point3::from([f64::NEG_INFINITY; 3]);
    for p in &soup.positions {
        low = low.inf(p);
        high = high.sup(p);
    }
    let reach = SEAM * (high - low).norm();
    let distance =
        |&[v, w]: &[u32; 2]| (soup.positions[v as usize] - soup.positions[w as usize]).norm();
    near_pairs(&soup.positions, &border, reach, |v, w| {
        part[v as usize] == part[w as usize]
    })
    .into_iter()
    .min_by(|p, q| distance(p).total_cmp(&distance(q)))
}

fn several(parts: &[&Part], soup: &Soup, origin: &Origin, seam: Option<[u32; 2]>) -> Diagnostic {
    let message = format!("the mesh consists of {} separate parts", parts.len());
    let mut diagnostic = Diagnostic::error(codes::SEVERAL_PARTS, message);
    for (i, part) in parts.iter().take(PARTS_SHOWN).enumerate() {
        let span = origin.span(soup, part.first);
        let label = if i == 0 { "the largest" } else { "another one" };
        let (centre, size) = (
            nalgebra::center(&part.low, &part.high),
            part.high - part.low,
        );
        diagnostic = diagnostic
            .at_bytes(File::Mesh, span.bytes(), label)
            .note(format!(
                "part {}: {} {}, {:.4} m², {:.3} x {:.3} x {:.3} m around ({:.3}, {:.3}, {:.3}) m, from line {}",
                i + 1,
                part.faces,
                if part.faces == 1 { "face" } else { "faces" },
                part.area,
                size.x,
                size.y,
                size.z,
                centre.x,
                centre.y,
                centre.z,
                span.line
            ));
    }
    if parts.len() > PARTS_SHOWN {
        diagnostic = diagnostic.note(format!("and {} smaller ones", parts.len() - PARTS_SHOWN));
    }
    if let Some([v, w]) = seam {
        let gap = (soup.positions[v as usize] - soup.positions[w as usize]).norm();
        diagnostic = diagnostic.note(format!(
            "parts come within {gap:.1e} m of each other at {}: an open seam",
            origin.place(soup, v)
        ));
    }
    diagnostic.help("join them in the modelling program, or export only the one that is meant")
}

fn turn_over(
    soup: &mut Soup,
    turned: &[bool],
    keep: &[bool],
    origin: &Origin,
    findings: &mut Findings,
) {
    let mut first = None;
    let mut count = 0;
    for face in 0..soup.faces.len() {
        if turned[face] && keep[face] {
            first = first.or(Some(face as u32));
            count += 1;
            soup.faces[face].swap(1, 2);
        }
    }
    if let Some(first) = first {
        let span = origin.span(soup, first);
        let faces = if count == 1 {
            "face turned over to agree with its"
        } else {
            "faces turned over to agree with their"
        };
        findings.add(&codes::TURNED_FACES, || {
            Diagnostic::warning(
                codes::TURNED_FACES,
                format!("{count} {faces} neighbours ({})", at_lines(count, span)),
            )
            .at_bytes(
                File::Mesh,
                span.bytes(),
                "its vertices run the other way round",
            )
        });
    }
}
