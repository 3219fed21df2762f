//! Significant peaks of the Gaussian curvature: where a patch may be too domed for its members to
//! be unique (paper, section 4.1, criterion eta).
//!
//! A peak is significant by its prominence, as of mountains: how far the curvature falls on the
//! best way to a higher peak. That counts a broad dome once however rough its estimate, and two
//! domes of a chain twice.

use super::{BORDER_RINGS, Curvature};
use crate::surface::Mesh;
use crate::surface::union_find::UnionFind;
use serde::{Deserialize, Serialize};

/// What makes a peak significant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PeakOptions {
    /// Least prominence, as a share of the highest curvature of the region. Estimated curvature of
    /// an even dome scatters by less than a hundredth; checking a peak too many costs little.
    pub prominence: f64,
    /// Least curvature times the region's area, steradian. Below it the region is small compared
    /// to the length pi / sqrt(K) up to which geodesics are unique.
    pub solid_angle: f64,
}

impl Default for PeakOptions {
    /// A twentieth of the highest, and 1/10 sr: a square region's side is then 10 % of pi / sqrt(K).
    fn default() -> Self {
        Self {
            prominence: 0.05,
            solid_angle: 0.1,
        }
    }
}

/// A local maximum of the Gaussian curvature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Peak {
    /// The vertex.
    pub vertex: u32,
    /// Gaussian curvature there, 1/m².
    pub gaussian: f64,
    /// How far the curvature falls on the best way to a higher peak, or to the lowest point of
    /// its connected part of the region if there is none, 1/m². Counted down to zero only: how far
    /// it is negative between two domes does not make them steeper.
    pub prominence: f64,
    /// Whether a neighbour lies outside the region, so that the curvature may still rise there.
    pub on_rim: bool,
}

/// The significant peaks of positive Gaussian curvature among the listed vertices, highest first.
///
/// Vertices within [`BORDER_RINGS`] rings of the mesh border are left out, their curvature is
/// uncertain. The highest peak of each connected part is measured against its lowest point.
pub fn peaks(
    mesh: &Mesh,
    curvature: &Curvature,
    region: &[u32],
    options: PeakOptions,
) -> Vec<Peak> {
    let rings = mesh.rings_from_border(BORDER_RINGS);
    let mut listed = vec![false; rings.len()];
    for &v in region {
        listed[v as usize] = true;
    }
    let inside = |v: u32| listed[v as usize] && rings[v as usize] > BORDER_RINGS;
    let height = |v: u32| curvature.vertex(v).gaussian();

    // From the highest down: a vertex with no higher neighbour is a peak; where two peaks' slopes
    // meet, the lower one's prominence is known.
    let mut order: Vec<u32> = (0..mesh.vertex_count()).filter(|&v| inside(v)).collect();
    order.sort_by(|&v, &w| height(w).total_cmp(&height(v)).then(v.cmp(&w)));
    let mut rank = vec![u32::MAX; rings.len()];
    for (i, &v) in (0..).zip(&order) {
        rank[v as usize] = i;
    }
    let mut slopes = UnionFind::new(mesh.vertex_count());
    let mut lowest: Vec<f64> = vec![f64::NAN; rings.len()];
    let mut prominence: Vec<(u32, f64)> = Vec::new();
    for &v in &order {
        lowest[v as usize] = height(v);
        for n in mesh.neighbours(v) {
            if rank[n as usize] >= rank[v as usize] {
                continue;
            }
            let (own, other) = (slopes.find(v), slopes.find(n));
            if own == other {
                continue;
            }
            let (high, low) = if rank[own as usize] < rank[other as usize] {
                (own, other)
            } else {
                (other, own)
            };
            if low != v {
                prominence.push((low, height(low) - height(v).max(0.0)));
            }
            lowest[high as usize] = height(v);
            slopes.join(low, high);
        }
    }
    for &v in &order {
        if slopes.find(v) == v {
            prominence.push((v, height(v) - lowest[v as usize].max(0.0)));
        }
    }

    let Some(&top) = order.first() else {
        return Vec::new();
    };
    let area = region_area(mesh, inside);
    let mut peaks: Vec<Peak> = prominence
        .into_iter()
        .filter(|&(v, prominence)| {
            height(v) * area >= options.solid_angle
                && (v == top || prominence >= options.prominence * height(top))
        })
        .map(|(vertex, prominence)| Peak {
            vertex,
            gaussian: height(vertex),
            prominence,
            on_rim: mesh.neighbours(vertex).any(|n| !inside(n)),
        })
        .collect();
    peaks.sort_by_key(|peak| rank[peak.vertex as usize]);
    peaks
}

/// Area of the faces with all corners in a region, square metres.
fn region_area(mesh: &Mesh, inside: impl Fn(u32) -> bool) -> f64 {
    (0..mesh.face_count())
        .filter(|&face| mesh.faces()[face as usize].iter().all(|&v| inside(v)))
        .map(|face| 0.5 * mesh.face_cross(face).norm())
        .sum()
}
