//! Parts of a soup: faces are turned to agree with their neighbours, crumbs dropped, and it is told
//! what cannot be one surface.

use super::checks::{SEAM, near_pairs};
use super::findings::Findings;
use super::ignored::at_lines;
use super::soup::{NONE, Origin, Soup};
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};
use crate::surface::Point3;
use std::collections::VecDeque;

/// A part with less than this share of the largest part's area is a crumb.
const CRUMB: f64 = 1e-3;
/// Parts that the message about several parts describes.
const PARTS_SHOWN: usize = 6;

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
