//! Shares and angles with which rings close, on interpolated distances.

use super::collapse::{Choice, choices};
use super::ring::{Look, Ring};
use super::step::Model;
use super::{RingPatch, Shortfall, largest};
use crate::cladding::{Clad, PlanarQuad, lay};
use crate::members::schedule::Schedule;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// Rings that share patches.
#[derive(Debug)]
pub(super) struct Problem<'a> {
    pub(super) patches: &'a [RingPatch<'a>],
    pub(super) rings: Vec<Ring<'a>>,
    /// Patches whose angle is free.
    free: Vec<usize>,
}

/// Plans and members.
#[derive(Debug, Clone)]
pub(super) struct Laid {
    /// Of each patch, radians.
    pub(super) angles: Vec<f64>,
    /// Inner members of each ring, shares of the side where they begin.
    pub(super) shares: Vec<Vec<f64>>,
    /// The plan of each patch.
    pub(super) clads: Vec<Clad>,
    /// How far beside its beginning each inner member comes back, ring by ring.
    pub(super) drifts: Vec<f64>,
    /// Where the angles of free patches may lie and where their search began.
    choice: Choice,
    /// Where members may lie: around their even distribution.
    corridors: Vec<[f64; 2]>,
    /// What is minimised: unevenness of each ring over that of its even distribution, and the
    /// squares of how far angles have moved.
    objective: f64,
}

impl Laid {
    /// The largest drift.
    pub(super) fn worst(&self) -> f64 {
        largest(&self.drifts)
    }
}

/// Drifts of all members, ring by ring, and the unevenness of all rings together.
type Seen = (Vec<f64>, f64);

/// Step of difference quotients by angles, radians. Cladding functions are smooth and known to
/// rounding, so the quotient is good to 1e-9.
const DIFFERENCE: f64 = 1e-5;
/// A member keeps within this share of the spacing of its place in the even distribution.
const CORRIDOR: f64 = 0.4;
/// What a drift of 1 counts beside the objective: more than closing can cost.
const PENALTY: f64 = 1e4;
/// A drift that is rounding of the interpolation.
const CLOSED: f64 = 1e-11;
/// A move that is none.
const SETTLED: f64 = 1e-8;
const MOST_STEPS: usize = 60;
/// In so many steps a drift that vanishes in the end is halved at least.
const PATIENCE: usize = 10;
/// Ways to collapse that are followed to the end and compared.
const TRIES: usize = 12;
/// If none of these closes, the next ones are tried, up to this many.
const MOST_TRIES: usize = 96;
/// A later way has to be better by this.
const CLEARLY: f64 = 0.01;
/// An angle this close to an end of its interval stands there, radians.
const AT_LIMIT: f64 = 1e-6;

impl<'a> Problem<'a> {
    pub(super) fn new(patches: &'a [RingPatch<'a>], rings: Vec<Ring<'a>>) -> Self {
        let free = (0..patches.len()).filter(|&i| patches[i].free.is_some_and(|f| !f.is_empty()));
        Self {
            patches,
            rings,
            free: free.collect(),
        }
    }

    /// The most compact and even way to close; where there is none, the one that misses least.
    pub(super) fn solve(&self) -> Laid {
        if self.rings.iter().all(|ring| ring.members() == 0) {
            return self.as_they_are();
        }
        let all = choices(self.patches, &self.free, &self.rings, MOST_TRIES);
        let mut best: Option<(f64, Laid)> = None;
        let mut closest: Option<Laid> = None;
        for some in all.chunks(TRIES) {
            let tried = some.par_iter().map(|choice| self.descend(choice.clone()));
            for laid in tried.collect::<Vec<_>>().into_iter().flatten() {
                if laid.worst() <= CLOSED {
                    let score = self.score(&laid);
                    if best
                        .as_ref()
                        .is_none_or(|(least, _)| score < least - CLEARLY)
                    {
                        best = Some((score, laid));
                    }
                } else if closest.as_ref().is_none_or(|c| laid.worst() < c.worst()) {
                    closest = Some(laid);
                }
            }
            if best.is_some() {
                break;
            }
        }
        let found = best.map(|(_, laid)| laid).or(closest);
        found.unwrap_or_else(|| self.as_they_are())
    }

    /// Sizes of plans, as logarithms, and the cost of moving members and angles.
    fn score(&self, laid: &Laid) -> f64 {
        let area = |&i: &usize| {
            let quad = PlanarQuad::new(self.patches[i].maps.sides, laid.angles[i]);
            libm::log(quad.map_or(f64::INFINITY, |quad| quad.area()))
        };
        self.free.iter().map(area).sum::<f64>() + laid.objective
    }

    /// The plans of the patches alone, for rings of which nothing better is known.
    fn as_they_are(&self) -> Laid {
        let angles: Vec<f64> = self.patches.iter().map(|p| p.alone.alpha).collect();
        let starts: Vec<f64> = self.free.iter().map(|&i| angles[i]).collect();
        let choice = Choice {
            intervals: starts.iter().map(|&at| (at, at)).collect(),
            starts,
        };
        let clads: Vec<Clad> = self.patches.iter().map(|p| p.alone.clone()).collect();
        self.begin(choice, angles, clads)
    }

    fn begin(&self, choice: Choice, angles: Vec<f64>, clads: Vec<Clad>) -> Laid {
        let plans: Vec<&Clad> = clads.iter().collect();
        let shares: Vec<Vec<f64>> = self.rings.iter().map(|ring| ring.even(&plans)).collect();
        let mut corridors = Vec::new();
        for inner in &shares {
            for (j, &at) in inner.iter().enumerate() {
                let before = if j == 0 { 0.0 } else { inner[j - 1] };
                let after = inner.get(j + 1).copied().unwrap_or(1.0);
                corridors.push([at - CORRIDOR * (at - before), at + CORRIDOR * (after - at)]);
            }
        }
        let mut laid = Laid {
            angles,
            shares,
            clads,
            drifts: Vec::new(),
            choice,
            corridors,
            objective: 0.0,
        };
        self.judge(&mut laid);
        laid
    }

    fn look(&self, laid: &Laid) -> Vec<Look> {
        let plans: Vec<&Clad> = laid.clads.iter().collect();
        let rings = self.rings.iter().zip(&laid.shares);
        rings
            .map(|(ring, shares)| ring.look(&plans, shares))
            .collect()
    }

    /// All drifts, and the unevenness of all rings together.
    fn seen(&self, plans: &[&Clad], shares: &[Vec<f64>]) -> Seen {
        let (mut drifts, mut uneven) = (Vec::new(), 0.0);
        for (ring, shares) in self.rings.iter().zip(shares) {
            let look = ring.look(plans, shares);
            drifts.extend(look.drifts);
            uneven += ring.scale() * look.evenness.objective;
        }
        (drifts, uneven)
    }

    /// Puts down how rings close and what that costs.
    fn judge(&self, laid: &mut Laid) {
        let plans: Vec<&Clad> = laid.clads.iter().collect();
        let (drifts, uneven) = self.seen(&plans, &laid.shares);
        let moved = self.free.iter().zip(&laid.choice.starts);
        let moved: f64 = moved
            .map(|(&i, at)| (laid.angles[i] - at) * (laid.angles[i] - at))
            .sum();
        laid.drifts = drifts;
        laid.objective = moved + uneven;
    }

    /// Sequential quadratic programming from one choice of intervals.
    fn descend(&self, choice: Choice) -> Option<Laid> {
        let mut angles: Vec<f64> = self.patches.iter().map(|p| p.alone.alpha).collect();
        for (&i, &start) in self.free.iter().zip(&choice.starts) {
            angles[i] = start;
        }
        let clads = self.plans(&angles)?;
        let mut laid = self.begin(choice, angles, clads);
        let mut before = f64::INFINITY;
        for k in 1..=MOST_STEPS {
            // What hardly comes closer any more does not close this way.
            if k % PATIENCE == 0 {
                if laid.worst() > CLOSED && laid.worst() > 0.5 * before {
                    break;
                }
                before = laid.worst();
            }
            let model = self.model(&laid);
            let step = model.step()?;
            let least = merit(&laid);
            let mut factor = 1.0;
            let better = loop {
                let trial = self.moved(&laid, &(&step * factor));
                if let Some(trial) = trial.filter(|trial| merit(trial) < least) {
                    break Some(trial);
                }
                factor *= 0.5;
                if factor < 1e-3 {
                    break None;
                }
            };
            let Some(better) = better else { break };
            let settled = step.amax() * factor < SETTLED;
            laid = better;
            if settled && laid.worst() <= CLOSED {
                break;
            }
        }
        Some(laid)
    }

    /// One of Newton's steps from exact drifts: the smallest move that takes them away.
    pub(super) fn corrected(&self, laid: &Laid, exact: &[f64]) -> Option<Laid> {
        let mut model = self.model(laid);
        model.gradient.fill(0.0);
        model.residual = DVector::from_column_slice(exact);
        let step = model.step()?;
        self.moved(laid, &step)
    }

    fn plans(&self, angles: &[f64]) -> Option<Vec<Clad>> {
        let all = self.patches.par_iter().zip(angles);
        all.map(|(patch, &alpha)| plan(patch, alpha)).collect()
    }

    /// Where a step leads; `None` where a plan or the order of members is lost.
    fn moved(&self, laid: &Laid, step: &DVector<f64>) -> Option<Laid> {
        let mut next = laid.clone();
        for (k, &i) in self.free.iter().enumerate() {
            let (low, high) = laid.choice.intervals[k];
            next.angles[i] = (next.angles[i] + step[k]).clamp(low, high);
        }
        next.clads = self.plans(&next.angles)?;
        let mut row = self.free.len();
        for shares in &mut next.shares {
            for share in shares.iter_mut() {
                *share += step[row];
                row += 1;
            }
            let ordered = shares.windows(2).all(|w| w[0] < w[1]);
            let inside = shares.iter().all(|share| (0.0..=1.0).contains(share));
            if !(ordered && inside) {
                return None;
            }
        }
        self.judge(&mut next);
        Some(next)
    }

    /// The quadratic model where things are laid: angles first, then members ring by ring.
    fn model(&self, laid: &Laid) -> Model {
        let angles = self.free.len();
        let members = laid.drifts.len();
        let count = angles + members;
        let mut model = Model {
            gradient: DVector::zeros(count),
            hessian: DMatrix::identity(count, count) * 2.0,
            residual: DVector::from_column_slice(&laid.drifts),
            jacobian: DMatrix::zeros(members, count),
            low: Vec::with_capacity(count),
            high: Vec::with_capacity(count),
        };
        let by_angle: Vec<Seen> = self
            .free
            .par_iter()
            .map(|&patch| self.by_angle(laid, patch))
            .collect();
        for (k, (drifts, uneven)) in by_angle.into_iter().enumerate() {
            let at = laid.angles[self.free[k]];
            model.jacobian.set_column(k, &DVector::from_vec(drifts));
            model.gradient[k] = uneven + 2.0 * (at - laid.choice.starts[k]);
            let (low, high) = laid.choice.intervals[k];
            model.low.push((low - at).min(0.0));
            model.high.push((high - at).max(0.0));
        }
        let mut row = 0;
        for ((ring, look), shares) in self.rings.iter().zip(self.look(laid)).zip(&laid.shares) {
            let scale = 2.0 * ring.scale();
            let Look {
                by_share, evenness, ..
            } = look;
            for (j, &slope) in by_share.iter().enumerate() {
                let column = angles + row;
                model.jacobian[(row, column)] = slope;
                model.gradient[column] = scale * evenness.gradient[j];
                model.hessian[(column, column)] = scale * evenness.diagonal[j];
                if j + 1 < by_share.len() {
                    model.hessian[(column, column + 1)] = scale * evenness.off_diagonal[j];
                    model.hessian[(column + 1, column)] = scale * evenness.off_diagonal[j];
                }
                let [low, high] = laid.corridors[row];
                model.low.push((low - shares[j]).min(0.0));
                model.high.push((high - shares[j]).max(0.0));
                row += 1;
            }
        }
        model
    }

    /// Derivatives by the angle of a free patch: of all drifts, and of the unevenness.
    fn by_angle(&self, laid: &Laid, patch: usize) -> (Vec<f64>, f64) {
        let at = |by: f64| {
            let clad = lay(&self.patches[patch].maps, laid.angles[patch] + by)?;
            let mut plans: Vec<&Clad> = laid.clads.iter().collect();
            plans[patch] = &clad;
            Some((self.seen(&plans, &laid.shares), by))
        };
        let here = || {
            let plans: Vec<&Clad> = laid.clads.iter().collect();
            (self.seen(&plans, &laid.shares), 0.0)
        };
        // Where there is no plan on one side, the other side tells.
        let (after, up) = at(DIFFERENCE).unwrap_or_else(here);
        let (before, down) = at(-DIFFERENCE).unwrap_or_else(here);
        let width = (up - down).max(DIFFERENCE);
        let drifts = after.0.iter().zip(&before.0).map(|(a, b)| (a - b) / width);
        (drifts.collect(), (after.1 - before.1) / width)
    }

    /// The members of each ring.
    pub(super) fn schedules(&self, laid: &Laid) -> Vec<Schedule> {
        let plans: Vec<&Clad> = laid.clads.iter().collect();
        let rings = self.rings.iter().zip(&laid.shares);
        rings
            .map(|(ring, shares)| ring.schedule(&plans, shares))
            .collect()
    }

    /// What is told where rings stay open.
    pub(super) fn shortfall(&self, laid: &Laid, drifts: &[f64]) -> Shortfall {
        let mut worst = (0, 0, 0.0_f64);
        let mut rest = drifts;
        for (i, ring) in self.rings.iter().enumerate() {
            let (own, others) = rest.split_at(ring.members());
            rest = others;
            for (j, drift) in own.iter().enumerate() {
                if drift.abs() > worst.2 {
                    worst = (i, j + 1, drift.abs());
                }
            }
        }
        let (ring, member, share) = worst;
        let first = self.rings[ring].passages[self.rings[ring].first()];
        let side = self.patches[first.patch].domain.start(first.family);
        let limits = self.free.iter().zip(&laid.choice.intervals);
        let at_limit = limits.filter(|&(&i, &(low, high))| {
            let angle = laid.angles[i];
            angle - low < AT_LIMIT || high - angle < AT_LIMIT
        });
        Shortfall {
            ring,
            member,
            share,
            metres: share * side.length(),
            members: drifts.len(),
            angles: laid.angles.clone(),
            at_limit: at_limit.map(|(&i, _)| i).collect(),
            free: self.free.clone(),
        }
    }
}

fn merit(laid: &Laid) -> f64 {
    laid.objective + PENALTY * laid.drifts.iter().map(|drift| drift.abs()).sum::<f64>()
}

/// The plan of a patch with an angle; its own where that is the angle.
fn plan(patch: &RingPatch<'_>, alpha: f64) -> Option<Clad> {
    if alpha == patch.alone.alpha {
        Some(patch.alone.clone())
    } else {
        lay(&patch.maps, alpha)
    }
}
