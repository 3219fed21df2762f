//! What is worth a warning about a mesh that can be used: open seams, an unlikely size, no border,
//! slivers.

use super::findings::Findings;
use super::flat_faces::flatness;
use super::ignored::at_lines;
use super::soup::{Origin, Soup};
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};
use crate::surface::{Mesh, Point3};
use std::collections::BTreeMap;

/// Border vertices closer than this share of the bounding box's diagonal nearly coincide.
pub(super) const SEAM: f64 = 1e-6;
/// Vertices of one cell that are looked at; a mesh with more in such a small place is damaged, and
/// looking at all pairs would take for ever.
const CROWD: usize = 64;
/// Largest extents between which structures are built, metres: a small model, a stadium.
const USUAL_SIZE: [f64; 2] = [0.05, 500.0];
/// A face lower than this share of its longest side is a sliver.
const SLIVER: f64 = 1e-3;

pub(super) fn check(mesh: &Mesh, soup: &Soup, origin: &Origin, findings: &mut Findings) {
    check_seams(mesh, soup, origin, findings);
    check_size(mesh, findings);
    check_border(mesh, findings);
    check_slivers(mesh, soup, origin, findings);
}

fn check_seams(mesh: &Mesh, soup: &Soup, origin: &Origin, findings: &mut Findings) {
    let (low, high) = mesh.bounding_box();
    let reach = SEAM * (high - low).norm();
    let border: Vec<u32> = (0..mesh.vertex_count())
        .filter(|&v| mesh.is_border_vertex(v))
        .collect();
    // Two ends of a short edge are no seam.
    let seams = near_pairs(mesh.positions(), &border, reach, |v, w| {
        mesh.neighbours(v).any(|n| n == w)
    });
    let Some(&[v, w]) = seams.first() else {
        return;
    };
    let widest = seams
        .iter()
        .map(|pair| (mesh.position(pair[0]) - mesh.position(pair[1])).norm())
        .fold(0.0, f64::max);
    let [span, other] = [v, w].map(|v| origin.vertices[soup.records[v as usize] as usize]);
    findings.add(&codes::OPEN_SEAM, || {
        let count = seams.len();
        let noun = if count == 1 { "vertex nearly coincides" } else { "vertices nearly coincide" };
        Diagnostic::warning(
            codes::OPEN_SEAM,
            format!(
                "{count} border {noun} with another, at most {widest:.1e} m apart: an open seam (first: line {})",
                span.line
            ),
        )
        .at_bytes(File::Mesh, span.bytes(), "this vertex")
        .at_bytes(File::Mesh, other.bytes(), "nearly here as well")
        .note(format!("at {}", origin.place(soup, v)))
        .help("weld or join the vertices in the modelling program")
    });
}

/// For each listed vertex that has one, a later listed vertex within reach to which it is not
/// linked.
pub(super) fn near_pairs(
    positions: &[Point3],
    listed: &[u32],
    reach: f64,
    linked: impl Fn(u32, u32) -> bool,
) -> Vec<[u32; 2]> {
    let position = |v: u32| positions[v as usize];
    let low = listed
        .iter()
        .fold(Point3::from([f64::INFINITY; 3]), |low, &v| {
            low.inf(&position(v))
        });
    let cell = |p: Point3| ((p - low) / reach).data.0[0].map(|c| c as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    let mut pairs = Vec::new();
    // Backwards, so that the cells hold the later ones.
    for &v in listed.iter().rev() {
        let p = position(v);
        let [i, j, k] = cell(p);
        let steps = -1..=1;
        let around = steps.clone().flat_map(|x| {
            let steps = steps.clone();
            steps
                .clone()
                .flat_map(move |y| steps.clone().map(move |z| [i + x, j + y, k + z]))
        });
        let partner = around
            .filter_map(|cell| cells.get(&cell))
            .flat_map(|cell| cell.iter().take(CROWD))
            .find(|&&w| (position(w) - p).norm() <= reach && !linked(v, w));
        pairs.extend(partner.map(|&w| [v, w]));
        cells.entry([i, j, k]).or_default().push(v);
    }
    pairs.reverse();
    pairs
}

fn check_size(mesh: &Mesh, findings: &mut Findings) {
    let (low, high) = mesh.bounding_box();
    let size = high - low;
    let [least, most] = USUAL_SIZE;
    let what = if size.max() < least {
        "small"
    } else if size.max() > most {
        "large"
    } else {
        return;
    };
    findings.add(&codes::SIZE, || {
        Diagnostic::note_only(
            codes::SIZE,
            format!(
                "the surface is unusually {what}: {:.4} x {:.4} x {:.4} m",
                size.x, size.y, size.z
            ),
        )
        .at_key("surface", "the mesh's unit comes from here")
        .help("check `surface.units`, the unit of the mesh file")
    });
}

fn check_border(mesh: &Mesh, findings: &mut Findings) {
    if mesh.half_edges().all(|h| mesh.twin(h).is_some()) {
        findings.add(&codes::CLOSED, || {
            Diagnostic::warning(codes::CLOSED, "the surface is closed, without a border")
                .at_key("surface.mesh", "a closed mesh")
                .help("if this is a solid with a thickness, export only its upper side")
        });
    }
}

fn check_slivers(mesh: &Mesh, soup: &Soup, origin: &Origin, findings: &mut Findings) {
    let slivers: Vec<u32> = (0..mesh.face_count())
        .filter(|&face| flatness(mesh.corners(face)).0 < SLIVER)
        .collect();
    let Some(&first) = slivers.first() else {
        return;
    };
    let span = origin.span(soup, first);
    findings.add(&codes::SLIVERS, || {
        let count = slivers.len();
        let noun = if count == 1 { "face is" } else { "faces are" };
        Diagnostic::note_only(
            codes::SLIVERS,
            format!(
                "{count} {noun} more than 1000 times longer than high ({})",
                at_lines(count, span)
            ),
        )
        .at_bytes(File::Mesh, span.bytes(), "a sliver")
        .help("remesh with triangles of even size")
    });
}
