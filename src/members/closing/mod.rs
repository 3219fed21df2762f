//! Closed rings: members that run once around and end where they began.
//!
//! A member that begins at the share u of the first side comes back at P(u), where P is composed of
//! the cladding functions of all patches of the ring (paper, section 4.4). P keeps 0 and 1 and, in
//! general, no other share, so members cannot be laid closed in a ring whose plans are given. But
//! each cladding function depends on the planar angle of its patch, and angles are free within
//! their feasible intervals. Closing a ring means solving
//!
//! > P(u_j; ᾱ_1 … ᾱ_k) = u_j for each inner member j
//!
//! for shares *and* angles, such that members stay as even (Problem 3) and plans as compact as they
//! can. n members ask for n equations: k free angles close k members in general, and any number
//! where patches are mirror images of each other, for there one patch undoes what the other does.
//! Lengths are not touched: each plan is that of its patch, to the last bit.
//!
//! | step | in |
//! |---|---|
//! | a ring: what a member meets on the way, how far beside its beginning it comes back | [`ring`] |
//! | which way each patch collapses: the interval in which its angle is sought | [`collapse`] |
//! | shares and angles on interpolated distances: sequential quadratic programming | [`solve`], [`step`] |
//! | the same on exact distances, by Newton's method | here |

mod collapse;
mod ring;
mod solve;
mod step;

use super::schedule::Schedule;
use super::threads::{LinePiece, ThreadFault};
use super::{Ground, WeaveError, come_back};
use crate::cladding::{Clad, Maps};
use crate::layout::Domain;
use crate::project::model::Family;
use ring::Ring;
use serde::{Deserialize, Serialize};
use solve::{Laid, Problem};

/// A patch that rings pass.
#[derive(Debug, Clone, Copy)]
pub struct RingPatch<'a> {
    /// Mesh and sides.
    pub domain: &'a Domain,
    /// Its distance maps.
    pub maps: Maps<'a>,
    /// Its plan as it is without the ring.
    pub alone: &'a Clad,
    /// Feasible intervals of its planar angle, radians; `None` where the angle is given.
    pub free: Option<&'a [(f64, f64)]>,
}

/// One family of one patch in a ring.
#[derive(Debug, Clone, Copy)]
pub struct RingPassage {
    /// The patch.
    pub patch: usize,
    /// The family.
    pub family: Family,
    /// Its start side on its line.
    pub start: LinePiece,
    /// Its end side on its line.
    pub end: LinePiece,
    /// Number of members.
    pub count: u32,
    /// Importance of the start and the end side.
    pub weights: [f64; 2],
}

/// Angles and members of rings that close.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Closed {
    /// Planar angle of each patch, radians.
    pub angles: Vec<f64>,
    /// The members of each ring.
    pub schedules: Vec<Schedule>,
}

/// Why rings cannot be closed.
#[derive(Debug, Clone, PartialEq)]
pub enum CannotClose {
    /// Members cannot be laid at all.
    Threads {
        /// The ring.
        ring: usize,
        /// Why.
        fault: ThreadFault,
    },
    /// A corner stands inside a side of the ring: the member through it is given, and has no
    /// freedom to close.
    Junction {
        /// The ring.
        ring: usize,
    },
    /// The angles and shares that come closest leave members beside their beginnings.
    Open(Shortfall),
    /// An exact member does not exist.
    Member {
        /// The ring.
        ring: usize,
        /// Which member, and why.
        error: WeaveError,
    },
}

/// How far rings are from closing at best.
#[derive(Debug, Clone, PartialEq)]
pub struct Shortfall {
    /// The ring whose member misses most.
    pub ring: usize,
    /// The member, counted along the side where it begins; boundary members count.
    pub member: usize,
    /// By how much, as a share of that side.
    pub share: f64,
    /// The same, metres.
    pub metres: f64,
    /// Inner members of all rings that had to close together.
    pub members: usize,
    /// The angles there: of each patch, radians.
    pub angles: Vec<f64>,
    /// Patches whose angle is free.
    pub free: Vec<usize>,
    /// Of these, those whose angle stands at an end of what is feasible.
    pub at_limit: Vec<usize>,
}

/// Members shall come back this exactly, in shares of the side: far below what is asked for, so
/// that nothing that follows makes up for it.
const EXACT: f64 = 1e-9;
/// What is asked for.
const CLOSES: f64 = 1e-6;
/// Newton's steps on exact distances; each gains some three digits.
const MOST_EXACT: usize = 6;

/// Closes rings that share patches with each other.
///
/// # Errors
/// What stands against it, with the closest that was reached.
pub fn close(patches: &[RingPatch<'_>], rings: &[Vec<RingPassage>]) -> Result<Closed, CannotClose> {
    let rings: Vec<Ring<'_>> = rings
        .iter()
        .enumerate()
        .map(|(i, passages)| Ring::new(i, passages, patches))
        .collect::<Result<_, _>>()?;
    let problem = Problem::new(patches, rings);
    let mut laid = problem.solve();
    if laid.worst() > CLOSES {
        return Err(CannotClose::Open(problem.shortfall(&laid, &laid.drifts)));
    }
    let mut drifts = exact_drifts(&problem, &laid)?;
    let mut best = (largest(&drifts), laid.clone(), drifts.clone());
    for _ in 0..MOST_EXACT {
        if best.0 <= EXACT {
            break;
        }
        let Some(next) = problem.corrected(&laid, &drifts) else {
            break;
        };
        laid = next;
        drifts = exact_drifts(&problem, &laid)?;
        let now = largest(&drifts);
        if now < best.0 {
            best = (now, laid.clone(), drifts.clone());
        }
    }
    let (worst, laid, drifts) = best;
    if worst > CLOSES {
        return Err(CannotClose::Open(problem.shortfall(&laid, &drifts)));
    }
    Ok(Closed {
        schedules: problem.schedules(&laid),
        angles: laid.angles,
    })
}

/// How far beside their beginnings exact members come back, in shares of the sides.
fn exact_drifts(problem: &Problem<'_>, laid: &Laid) -> Result<Vec<f64>, CannotClose> {
    let mut drifts = Vec::new();
    for (i, schedule) in problem.schedules(laid).iter().enumerate() {
        let ring = &problem.rings[i];
        let grounds: Vec<Ground<'_>> = ring
            .passages
            .iter()
            .map(|passage| Ground {
                domain: problem.patches[passage.patch].domain,
                clad: &laid.clads[passage.patch],
                family: passage.family,
                start: passage.start,
                end: passage.end,
            })
            .collect();
        let back = come_back(&grounds, schedule)
            .map_err(|error| CannotClose::Member { ring: i, error })?;
        let begin = ring.passages[ring.first()].start;
        let begins = &laid.shares[i];
        drifts.extend(
            back.iter()
                .zip(begins)
                .map(|(at, share)| begin.side_share(*at) - share),
        );
    }
    Ok(drifts)
}

fn largest(drifts: &[f64]) -> f64 {
    drifts.iter().fold(0.0, |most, drift| most.max(drift.abs()))
}
