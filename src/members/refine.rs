//! Exact members: the end share at which the exact shortest distance on the surface equals the
//! distance in the plane.
//!
//! Cladding functions come from interpolated distances. Here each member is solved again on exact
//! ones, so that its two lengths agree to rounding (condition (i) of the paper, section 3.1).

use super::Member;
use crate::cladding::{PlanarQuad, Point2};
use crate::geodesic::{GeodesicError, Geodesics, Path, Reach};
use crate::layout::Side;
use crate::project::model::Family;
use crate::surface::SurfacePoint;
use serde::{Deserialize, Serialize};

/// Which end of a member is given; the other one is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Given {
    /// The share of the start side.
    Start,
    /// The share of the end side.
    End,
}

/// The two sides that a family joins, and the plan.
#[derive(Debug, Clone, Copy)]
pub struct Between<'a> {
    /// The family.
    pub family: Family,
    /// Where it starts.
    pub start: &'a Side,
    /// Where it ends.
    pub end: &'a Side,
    /// The flat patch.
    pub quad: &'a PlanarQuad,
}

/// Why a member could not be made exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RefineError {
    /// No share of the other side near the one that the cladding function says gives equal
    /// lengths; the closest one and the difference of lengths there, metres.
    NoEqualLength {
        /// Share of the given side.
        given: f64,
        /// Share of the other side.
        closest: f64,
        /// Surface minus planar length, metres.
        difference: f64,
    },
    /// No geodesic.
    Geodesic(GeodesicError),
}

impl From<GeodesicError> for RefineError {
    fn from(error: GeodesicError) -> Self {
        Self::Geodesic(error)
    }
}

/// Lengths agree to this share of the length; rounding in distances over a few hundred faces lies
/// below 1e-12.
const EQUAL: f64 = 1e-11;
/// First distance of trial shares from the interpolated one: the error of good tables.
const FIRST: f64 = 1e-4;
/// Shares that are tried around one, in parts of the reach: several distances from one source cost
/// one solve, so a wide and a narrow bracket are asked for at once.
const TRIALS: [f64; 9] = [-1.0, -0.3, -0.1, -0.01, 0.0, 0.01, 0.1, 0.3, 1.0];
/// The exact share is sought this far from the interpolated one at most.
const SEARCH: f64 = 0.05;
/// Lengths along a branch agree to this share of the length when it is left for the exact solver.
const CLOSE: f64 = 0.2 * EQUAL;
/// Steps along a branch; each gains several digits.
const MOST_STEPS: usize = 12;
/// Solves for one member; each gains several digits.
const MOST_SOLVES: usize = 24;

/// Solves the other end of an inner member; its index is for whoever knows the others.
pub fn refine(
    geodesics: &Geodesics<'_>,
    between: &Between<'_>,
    given: Given,
    share: f64,
    guess: f64,
) -> Result<Member, RefineError> {
    let mesh = geodesics.mesh();
    let (from, to) = match given {
        Given::Start => (between.start, between.end),
        Given::End => (between.end, between.start),
    };
    let source = from.at(mesh, share);
    let planar_length = |other: f64| {
        let (start, end) = in_order(given, share, other);
        between
            .quad
            .distance_squared(between.family, start, end)
            .0
            .sqrt()
    };
    let member = |other: f64, path: Path| {
        let (start, end) = in_order(given, share, other);
        Member {
            family: between.family,
            index: 0,
            boundary: false,
            start,
            end,
            path: if given == Given::Start {
                path
            } else {
                path.reversed()
            },
            planar: planar(between, start, end),
        }
    };
    let difference = |other: f64, length: f64| length - planar_length(other);
    if let Some((other, path)) = follow(geodesics, &source, to, guess, &difference) {
        return Ok(member(other, path));
    }
    let mut search = Search {
        guess,
        tried: Vec::new(),
    };
    let mut reach = FIRST;
    for _ in 0..MOST_SOLVES {
        let shares = match search.next_shares() {
            Some(shares) => shares,
            None if reach > SEARCH => break,
            None => {
                let mut around = TRIALS.map(|k| (guess + k * reach).clamp(0.0, 1.0)).to_vec();
                around.dedup();
                reach *= 8.0;
                around
            }
        };
        let targets: Vec<_> = shares.iter().map(|&x| to.at(mesh, x)).collect();
        let field = geodesics.field(&source, Reach::Targets(&targets))?;
        for (&other, target) in shares.iter().zip(&targets) {
            let length = field.distance(target)?;
            let difference = difference(other, length);
            if difference.abs() <= EQUAL * length {
                return Ok(member(other, field.path_to(target)?));
            }
            search.tried.push((other, difference));
        }
        search.tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let closest = search
        .tried
        .iter()
        .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let &(closest, difference) = closest.unwrap_or(&(guess, f64::NAN));
    Err(RefineError::NoEqualLength {
        given: share,
        closest,
        difference,
    })
}

/// The share with equal lengths found along one branch of paths: the shortest path to the guess is
/// followed by secant steps, and what is found is proved to be shortest.
///
/// `None` where the branch ends, is not the shortest where lengths are equal, or does not lead
/// there in a few steps.
fn follow(
    geodesics: &Geodesics<'_>,
    source: &SurfacePoint,
    to: &Side,
    guess: f64,
    difference: &impl Fn(f64, f64) -> f64,
) -> Option<(f64, Path)> {
    let mesh = geodesics.mesh();
    let first = geodesics.shortest(source, &to.at(mesh, guess)).ok()?;
    let mut branch = geodesics.follow(&first)?;
    let mut before = (guess, difference(guess, first.length));
    let mut share = guess + if guess < 0.5 { FIRST } else { -FIRST };
    for _ in 0..MOST_STEPS {
        if !((share - guess).abs() <= SEARCH && (0.0..=1.0).contains(&share)) {
            return None;
        }
        let length = branch.to(&to.at(mesh, share))?.length;
        let here = (share, difference(share, length));
        if here.1.abs() <= CLOSE * length {
            let end = to.at(mesh, share);
            let proven = branch.proven(&end);
            let path = proven.or_else(|| geodesics.shortest(source, &end).ok())?;
            let equal = difference(share, path.length).abs() <= EQUAL * path.length;
            return equal.then_some((share, path));
        }
        share -= here.1 * (here.0 - before.0) / (here.1 - before.1);
        before = here;
    }
    None
}

fn in_order(given: Given, share: f64, other: f64) -> (f64, f64) {
    match given {
        Given::Start => (share, other),
        Given::End => (other, share),
    }
}

/// What is known of the difference of lengths over the sought share.
struct Search {
    guess: f64,
    /// (share, surface minus planar length), ascending.
    tried: Vec<(f64, f64)>,
}

impl Search {
    /// Shares to try next, once a change of sign is known: the zero of the chord over the change
    /// closest to the guess, and shares closer and closer around it that tighten the bracket.
    fn next_shares(&self) -> Option<Vec<f64>> {
        let (a, b) = self
            .tried
            .windows(2)
            .filter(|w| (w[0].1 > 0.0) != (w[1].1 > 0.0))
            .map(|w| (w[0], w[1]))
            .min_by(|p, q| self.far(p).total_cmp(&self.far(q)))?;
        let width = b.0 - a.0;
        let zero = (a.0 * b.1 - b.0 * a.1) / (b.1 - a.1);
        let inside = |x: f64| x > a.0 && x < b.0;
        let zero = if inside(zero) {
            zero
        } else {
            0.5 * (a.0 + b.0)
        };
        let close = TRIALS.map(|k| zero + 0.1 * k * width);
        let shares = close.into_iter().chain([0.5 * (a.0 + b.0)]);
        let mut shares: Vec<f64> = shares.filter(|&x| inside(x)).collect();
        shares.sort_by(f64::total_cmp);
        shares.dedup();
        Some(shares).filter(|shares| !shares.is_empty())
    }

    fn far(&self, (a, b): &((f64, f64), (f64, f64))) -> f64 {
        (0.5 * (a.0 + b.0) - self.guess).abs()
    }
}

/// A boundary member: a side of the patch itself.
pub fn boundary_member(between: &Between<'_>, share: f64, path: Path) -> Member {
    Member {
        family: between.family,
        index: 0,
        boundary: true,
        start: share,
        end: share,
        path,
        planar: planar(between, share, share),
    }
}

fn planar(between: &Between<'_>, start: f64, end: f64) -> [Point2; 2] {
    [
        between.quad.start(between.family, start),
        between.quad.end(between.family, end),
    ]
}
