//! Whether patches stand beside each other as they should: no two overlap, and a corner that stands
//! on the side of a neighbour says so.

use super::{Domain, Line, Side, SidePiece, edge_id, place, vertices_inside};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::layout as codes;
use crate::geodesic::{Curve, Hit, crossings};
use crate::surface::{Mesh, Point3, SurfacePoint};
use std::collections::BTreeSet;

/// A patch with its names.
#[derive(Debug, Clone, Copy)]
pub struct PlacedPatch<'a> {
    /// Its name.
    pub name: &'a str,
    /// Names of its corners.
    pub corners: &'a [String; 4],
    /// Its sides 1-2, 2-3, 3-4, 4-1 on their lines.
    pub sides: [SidePiece; 4],
    /// Where it lies.
    pub domain: &'a Domain,
}

/// All lines and patches on their surface.
#[derive(Debug, Clone)]
pub struct Structure<'a> {
    /// The whole surface.
    pub mesh: &'a Mesh,
    /// Lines with their stations.
    pub lines: Vec<(&'a Line, &'a Side)>,
    /// Patches.
    pub patches: Vec<PlacedPatch<'a>>,
}

/// A station of both lines is met this close to it, in shares of the line.
const SAME: f64 = 1e-6;
/// A corner that misses the side of a neighbour by less was meant to stand on it, in shares of the
/// side's length.
const CLOSE: f64 = 0.02;

/// Patches that overlap, and corners that stand on a side, or nearly so, without saying it. Key
/// paths name the field `patches`.
pub fn check_network(structure: &Structure<'_>) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    // Pairs of patches about which enough is said.
    let mut known: BTreeSet<(usize, usize)> = BTreeSet::new();
    let mut corners: BTreeSet<(String, usize)> = BTreeSet::new();
    let curves: Vec<Curve<'_>> = structure
        .lines
        .iter()
        .map(|(_, side)| Curve::new(structure.mesh, &side.path().points))
        .collect();
    let boxes: Vec<[Point3; 2]> = structure
        .lines
        .iter()
        .map(|(_, side)| extent(structure.mesh, side))
        .collect();
    for i in 0..curves.len() {
        for j in i + 1..curves.len() {
            if !touch(boxes[i], boxes[j]) {
                continue;
            }
            for hit in crossings(&curves[i], &curves[j]) {
                structure.crossed([i, j], &hit, &mut known, &mut corners, &mut told);
            }
        }
    }
    structure.near_misses(&corners, &mut told);
    structure.covered_twice(&known, &mut told);
    told
}

impl Structure<'_> {
    /// Patches with a side over a share of a line.
    fn owners(&self, line: usize, share: f64) -> Vec<usize> {
        let covers = |piece: &SidePiece| {
            let stations = &self.lines[line].0.stations;
            let (a, b) = (stations[piece.from].share, stations[piece.to].share);
            share > a.min(b) - SAME && share < a.max(b) + SAME
        };
        let owns = |patch: &PlacedPatch<'_>| {
            let mut sides = patch.sides.iter();
            sides.any(|piece| piece.line == line && covers(piece))
        };
        (0..self.patches.len())
            .filter(|&p| owns(&self.patches[p]))
            .collect()
    }

    fn crossed(
        &self,
        pair: [usize; 2],
        hit: &Hit,
        known: &mut BTreeSet<(usize, usize)>,
        corners: &mut BTreeSet<(String, usize)>,
        told: &mut Vec<Diagnostic>,
    ) {
        let lines = pair.map(|i| self.lines[i]);
        let shares = [
            hit.on_first / lines[0].1.length(),
            hit.on_second / lines[1].1.length(),
        ];
        let at_common_station = lines[0].0.stations.iter().any(|station| {
            let mut others = lines[1].0.stations.iter();
            let other = others.find(|other| other.name == station.name);
            (station.share - shares[0]).abs() < SAME
                && other.is_some_and(|other| (other.share - shares[1]).abs() < SAME)
        });
        let owners = [0, 1].map(|k| self.owners(pair[k], shares[k]));
        if at_common_station || owners.iter().any(Vec::is_empty) {
            return;
        }
        // One patch that crosses itself is told about by its own check.
        let found = owners[0].iter().find_map(|&a| {
            let other = owners[1].iter().find(|&&b| b != a)?;
            Some((a.min(*other), a.max(*other)))
        });
        let Some(patches) = found else { return };
        for (k, other) in [(0, 1), (1, 0)] {
            let (line, side) = lines[k];
            let reach = CLOSE * lines[other].1.length() / side.length();
            let stations = &lines[other].0.stations;
            let stray = line.stations.iter().find(|station| {
                (station.share - shares[k]).abs() < reach
                    && !stations.iter().any(|s| s.name == station.name)
            });
            if let Some(stray) = stray {
                known.insert(patches);
                if corners.insert((stray.name.clone(), pair[other])) {
                    let by = (stray.share - shares[k]).abs() * side.length();
                    let at = hit.point.position(self.mesh);
                    told.push(self.undeclared(&stray.name, pair[other], shares[other], by, at));
                }
                return;
            }
        }
        if known.insert(patches) {
            let [first, second] = [patches.0, patches.1].map(|p| self.patches[p].name);
            let [one, other] = lines.map(|(line, _)| line.id());
            let at = place(hit.point.position(self.mesh));
            told.push(
                Diagnostic::error(
                    codes::OVERLAP,
                    format!(
                        "patches `{first}` and `{second}` overlap: the sides along `{one}` and \
                         `{other}` cross at {at}"
                    ),
                )
                .at_key(format!(".patches[{}].corners", patches.0), "this patch")
                .at_key(format!(".patches[{}].corners", patches.1), "and this one")
                .about(first)
                .help(
                    "move the corners so that sides meet only in anchors, or put an anchor where \
                     they cross and divide the patches there",
                ),
            );
        }
    }

    /// A corner beyond the side of a neighbour by little.
    fn undeclared(&self, name: &str, line: usize, share: f64, by: f64, at: Point3) -> Diagnostic {
        let id = self.lines[line].0.id();
        let how = if by < 1e-6 * self.lines[line].1.length() {
            "stands on".to_owned()
        } else {
            format!("reaches {:.2} mm over", 1e3 * by)
        };
        self.about_corner(
            Diagnostic::error(
                codes::UNDECLARED,
                format!(
                    "corner `{name}` {how} the side along `{id}` at {} and is no anchor of it",
                    place(at)
                ),
            ),
            name,
            line,
            share,
        )
    }

    /// Points at the patch with the corner, and says how to declare the junction.
    fn about_corner(&self, told: Diagnostic, name: &str, line: usize, share: f64) -> Diagnostic {
        let [a, b] = self.lines[line].0.ends();
        let told = told.about(name).help(format!(
            "declare it there: `{name} = {{ on = [\"{a}\", \"{b}\"], at = {share:.4} }}`, so that \
             members run on across the side"
        ));
        let corner = self.patches.iter().enumerate().find_map(|(p, patch)| {
            let i = patch.corners.iter().position(|corner| corner == name)?;
            Some(format!(".patches[{p}].corners[{i}]"))
        });
        match corner {
            Some(key) => told.at_key(key, "this corner"),
            None => told,
        }
    }

    /// Corners that stop short of a side by little.
    fn near_misses(&self, known: &BTreeSet<(String, usize)>, told: &mut Vec<Diagnostic>) {
        let mut seen: BTreeSet<&str> = BTreeSet::new();
        for patch in &self.patches {
            let corners = patch.corners.iter().zip(patch.domain.corners());
            for (name, corner) in corners {
                if !seen.insert(name) {
                    continue;
                }
                let corner = patch.domain.part.point_to_parent(&corner);
                for line in 0..self.lines.len() {
                    let declared = self.lines[line].0.stations.iter().any(|s| s.name == *name);
                    if !declared && !known.contains(&(name.clone(), line)) {
                        told.extend(self.near_miss(name, corner, line));
                    }
                }
            }
        }
    }

    fn near_miss(&self, name: &str, corner: SurfacePoint, line: usize) -> Option<Diagnostic> {
        let (record, side) = self.lines[line];
        let share = side.share_of(self.mesh, &corner);
        let at = corner.position(self.mesh);
        let off = (side.at(self.mesh, share).position(self.mesh) - at).norm();
        // Beside an end of the line it is close to that anchor, which is no junction.
        let inside = share > CLOSE && share < 1.0 - CLOSE;
        let mut owners = self.owners(line, share).into_iter();
        let by_another = owners.any(|p| self.patches[p].corners.iter().all(|c| c != name));
        if !inside || off > CLOSE * side.length() || !by_another {
            return None;
        }
        let id = record.id();
        let message = if off < SAME * side.length() {
            format!(
                "corner `{name}` stands on the side along `{id}` at {} and is no anchor of it",
                place(at)
            )
        } else {
            format!(
                "corner `{name}` at {} misses the side along `{id}` by {:.2} mm",
                place(at),
                1e3 * off
            )
        };
        let told = Diagnostic::warning(codes::NEAR_MISS, message);
        Some(self.about_corner(told, name, line, share))
    }

    /// Patches that cover the same part of the surface without crossing sides.
    fn covered_twice(&self, known: &BTreeSet<(usize, usize)>, told: &mut Vec<Diagnostic>) {
        let inside: Vec<Vec<u32>> = self
            .patches
            .iter()
            .map(|patch| {
                let domain = patch.domain;
                let own = vertices_inside(domain.mesh(), &domain.ring(), domain.turns_left());
                let mut all: Vec<u32> = own
                    .into_iter()
                    .map(|vertex| domain.part.vertex_to_parent(vertex))
                    .collect();
                all.sort_unstable();
                all
            })
            .collect();
        for i in 0..inside.len() {
            for j in i + 1..inside.len() {
                if known.contains(&(i, j)) {
                    continue;
                }
                let both = |v: &&u32| inside[j].binary_search(v).is_ok();
                let common: Vec<Point3> = inside[i]
                    .iter()
                    .filter(both)
                    .map(|&v| self.mesh.position(v))
                    .collect();
                let Some(at) = nearest_to_middle(&common) else {
                    continue;
                };
                let [first, second] = [i, j].map(|p| self.patches[p].name);
                told.push(
                    Diagnostic::error(
                        codes::OVERLAP,
                        format!(
                            "patches `{first}` and `{second}` overlap: both cover {}",
                            place(at)
                        ),
                    )
                    .at_key(format!(".patches[{i}].corners"), "this patch")
                    .at_key(format!(".patches[{j}].corners"), "and this one")
                    .about(first)
                    .note(self.shared_sides(i, j))
                    .help("patches that share a side lie on its two sides"),
                );
            }
        }
    }

    fn shared_sides(&self, i: usize, j: usize) -> String {
        let ids = |p: usize| -> BTreeSet<String> {
            let corners = self.patches[p].corners;
            (0..4)
                .map(|k| edge_id(&corners[k], &corners[(k + 1) % 4]))
                .collect()
        };
        let shared: Vec<String> = ids(i)
            .intersection(&ids(j))
            .map(|id| format!("`{id}`"))
            .collect();
        if shared.is_empty() {
            "they share no side: one lies within the other".to_owned()
        } else {
            format!("they share {}", shared.join(" and "))
        }
    }
}

/// Of some places the one nearest to their mean.
fn nearest_to_middle(places: &[Point3]) -> Option<Point3> {
    let count = places.len() as f64;
    let sum = places
        .iter()
        .fold(nalgebra::Vector3::zeros(), |sum, p| sum + p.coords);
    let middle = Point3::from(sum / count.max(1.0));
    places
        .iter()
        .min_by(|a, b| {
            let far = |p: &Point3| (p - middle).norm_squared();
            far(a).total_cmp(&far(b))
        })
        .copied()
}

fn extent(mesh: &Mesh, side: &Side) -> [Point3; 2] {
    let places = side.path().points.iter().map(|p| p.position(mesh));
    let first = side.path().points[0].position(mesh);
    places.fold([first, first], |[low, high], p| [low.inf(&p), high.sup(&p)])
}

fn touch([a, b]: [Point3; 2], [c, d]: [Point3; 2]) -> bool {
    (0..3).all(|k| a[k] <= d[k] && c[k] <= b[k])
}
