//! Which way patches collapse: in which of its feasible intervals each angle is sought.
//!
//! A cladding function is close to a Möbius function, k u / (1 + (k - 1) u), and these commute and
//! multiply their k. So log k of all patches, with the sense in which the ring passes them, has to
//! cancel; each interval gives a range of it. On a ring of equal, symmetric patches every second
//! one collapses the other way.

use super::ring::Ring;
use super::{RingPassage, RingPatch};
use crate::cladding::{Clad, PlanarQuad, lay};

/// An interval of one patch.
#[derive(Debug, Clone, Copy)]
struct Way {
    interval: (f64, f64),
    /// The most compact plan in it: where the search begins.
    start: f64,
    /// Logarithm of the area there, over that of the smallest plan of the patch.
    size: f64,
}

/// Where the angle of each free patch may lie, and where its search begins.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Choice {
    pub(super) intervals: Vec<(f64, f64)>,
    pub(super) starts: Vec<f64>,
}

/// This many combinations are looked at one by one.
const MOST_LISTED: usize = 4096;

/// Combinations of intervals, the likeliest to close with small plans first, at most `most`.
pub(super) fn choices(
    patches: &[RingPatch<'_>],
    free: &[usize],
    rings: &[Ring<'_>],
    most: usize,
) -> Vec<Choice> {
    let ways: Vec<Vec<Way>> = free.iter().map(|&patch| ways(&patches[patch])).collect();
    let signs: Vec<Vec<(&RingPassage, f64)>> = rings.iter().map(Ring::signs).collect();
    // Of each ring: what patches with given angles add, and by free patch and way the range of what
    // is added and what is at the start.
    let mut fixed = vec![0.0; rings.len()];
    let mut ranges: Vec<Vec<Vec<[f64; 3]>>> = Vec::new();
    for (ring, signs) in signs.iter().enumerate() {
        let mut of_ring: Vec<Vec<[f64; 3]>> =
            ways.iter().map(|ways| vec![[0.0; 3]; ways.len()]).collect();
        for &(passage, sign) in signs {
            let add = |clad: &Clad| sign * strength(clad, passage);
            let Some(index) = free.iter().position(|&patch| patch == passage.patch) else {
                fixed[ring] += add(patches[passage.patch].alone);
                continue;
            };
            for (range, way) in of_ring[index].iter_mut().zip(&ways[index]) {
                let (low, high) = way.interval;
                let [a, b, c] = [low, high, way.start].map(|alpha| {
                    lay(&patches[passage.patch].maps, alpha).map_or(0.0, |clad| add(&clad))
                });
                range[0] += a.min(b);
                range[1] += a.max(b);
                range[2] += c;
            }
        }
        ranges.push(of_ring);
    }
    let cost = |picked: &[usize]| {
        let size: f64 = picked
            .iter()
            .zip(&ways)
            .map(|(&w, ways)| ways[w].size)
            .sum();
        let miss: f64 = ranges
            .iter()
            .zip(&fixed)
            .map(|(of_ring, fixed)| {
                let mut sum = [*fixed; 3];
                for (&w, of_patch) in picked.iter().zip(of_ring) {
                    for (sum, add) in sum.iter_mut().zip(of_patch[w]) {
                        *sum += add;
                    }
                }
                // Out of reach counts most, a long way next.
                100.0 * sum[0].max(-sum[1]).max(0.0) + sum[2].abs()
            })
            .sum();
        size + miss
    };
    let mut listed = listed(&ways, &cost);
    listed.sort_by(|a, b| a.0.total_cmp(&b.0));
    listed.truncate(most);
    listed
        .into_iter()
        .map(|(_, picked)| {
            let taken = || picked.iter().zip(&ways).map(|(&w, ways)| ways[w]);
            Choice {
                intervals: taken().map(|way| way.interval).collect(),
                starts: taken().map(|way| way.start).collect(),
            }
        })
        .collect()
}

/// All combinations, or those on the way of single changes that each help most.
fn listed(ways: &[Vec<Way>], cost: &impl Fn(&[usize]) -> f64) -> Vec<(f64, Vec<usize>)> {
    let all = ways
        .iter()
        .try_fold(1_usize, |product, ways| product.checked_mul(ways.len()));
    if let Some(all) = all.filter(|&all| all <= MOST_LISTED) {
        return (0..all)
            .map(|mut number| {
                let digit = |ways: &Vec<Way>| {
                    let digit = number % ways.len();
                    number /= ways.len();
                    digit
                };
                let picked: Vec<usize> = ways.iter().map(digit).collect();
                (cost(&picked), picked)
            })
            .collect();
    }
    let mut picked: Vec<usize> = ways
        .iter()
        .map(|ways| {
            let smallest = ways
                .iter()
                .enumerate()
                .min_by(|a, b| a.1.size.total_cmp(&b.1.size));
            smallest.map_or(0, |(way, _)| way)
        })
        .collect();
    let mut seen = vec![(cost(&picked), picked.clone())];
    loop {
        let mut best = (seen[seen.len() - 1].0, None);
        for (patch, ways) in ways.iter().enumerate() {
            for way in 0..ways.len() {
                let mut other = picked.clone();
                other[patch] = way;
                let costs = cost(&other);
                if costs < best.0 {
                    best = (costs, Some(other));
                }
            }
        }
        let (costs, Some(next)) = best else {
            return seen;
        };
        picked.clone_from(&next);
        seen.push((costs, next));
    }
}

/// The feasible intervals of a patch with their most compact plans.
fn ways(patch: &RingPatch<'_>) -> Vec<Way> {
    let area = |alpha: f64| {
        PlanarQuad::new(patch.maps.sides, alpha).map_or(f64::INFINITY, |quad| quad.area())
    };
    let alone = patch.alone.alpha;
    let mut ways: Vec<Way> = patch
        .free
        .unwrap_or_default()
        .iter()
        .map(|&interval| {
            let (low, high) = interval;
            // The area rises from either end of the convex range (see `choose_angle`).
            let start = if (low..=high).contains(&alone) {
                alone
            } else if area(low) <= area(high) {
                low
            } else {
                high
            };
            Way {
                interval,
                start,
                size: libm::log(area(start)),
            }
        })
        .collect();
    let least = ways
        .iter()
        .map(|way| way.size)
        .fold(f64::INFINITY, f64::min);
    for way in &mut ways {
        way.size -= least;
    }
    ways
}

/// Logarithm of the k of the Möbius function that agrees in the middle.
fn strength(clad: &Clad, passage: &RingPassage) -> f64 {
    let middle = clad.function(passage.family).at(0.5).0;
    libm::log(middle / (1.0 - middle))
}
