//! Where sides end that leave a peak along the principal directions of curvature (paper,
//! Algorithm 2).

use super::JudgedPeak;
use crate::geodesic::{Geodesics, Reach};
use crate::layout::{Domain, Side};
use crate::surface::{Curvature, SurfacePoint};

/// Places of a side to which sides along principal directions may run.
const FEET: usize = 33;
/// Principal curvatures that differ by less than this share have no directions.
const UMBILIC: f64 = 0.1;

/// Shares of the sides AB, BC, DC, AD at which shortest paths from the peak arrive that leave it
/// along the principal directions; `None` at a peak without directions.
pub(super) fn principal_feet(
    curvature: &Curvature,
    domain: &Domain,
    peak: &JudgedPeak,
) -> Option<[f64; 4]> {
    let SurfacePoint::Vertex(vertex) = peak.coverage[0].peak else {
        return None;
    };
    let bend = curvature.vertex(domain.part.vertex_to_parent(vertex));
    let [k1, k2] = bend.principal;
    if (k1 - k2).abs() < UMBILIC * k1.abs().max(k2.abs()) {
        return None;
    }
    let [e1, e2] = bend.directions;
    // Counter-clockwise around the normal, as the sides of a patch that turns left.
    let mut directions = [e1, e2, -e1, -e2];
    if !domain.turns_left() {
        directions.reverse();
    }
    let share = |i: usize| i as f64 / (FEET - 1) as f64;
    let feet = |side: &Side| -> Vec<SurfacePoint> {
        (0..FEET)
            .map(|i| side.at(domain.mesh(), share(i)))
            .collect()
    };
    let sides = [&domain.ab, &domain.bc, &domain.dc, &domain.ad].map(feet);
    let all: Vec<SurfacePoint> = sides.iter().flatten().copied().collect();
    let geodesics = Geodesics::new(domain.mesh());
    let field = geodesics
        .field(&SurfacePoint::Vertex(vertex), Reach::Targets(&all))
        .ok()?;
    // How well the best path to each side keeps to each direction, and where it arrives.
    let mut fits = [[(f64::NEG_INFINITY, 0.5); 4]; 4];
    for (fit, side) in fits.iter_mut().zip(&sides) {
        for (i, foot) in side.iter().enumerate() {
            let leaves = field.path_to(foot).ok()?.start.direction;
            for (best, direction) in fit.iter_mut().zip(&directions) {
                let along = leaves.dot(direction);
                if along > best.0 {
                    *best = (along, share(i));
                }
            }
        }
    }
    // The sides AB, BC, CD, DA lie around the peak in the order of the directions.
    let turn = |k: usize| (0..4).map(|side| fits[side][(side + k) % 4].0).sum::<f64>();
    let best = (1..4).fold(0, |best, k| if turn(k) > turn(best) { k } else { best });
    Some(std::array::from_fn(|side| fits[side][(side + best) % 4].1))
}
