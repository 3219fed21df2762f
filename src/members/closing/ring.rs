//! One ring: the way around, and how far beside its beginning a member comes back.

use super::{CannotClose, RingPassage, RingPatch};
use crate::cladding::Clad;
use crate::members::distribution::{Crossed, Linearised, Step, distribute, objective};
use crate::members::schedule::Schedule;
use crate::members::threads::{End, Hop, Lanes, Passage, Thread, lanes};
use crate::members::walk::{Walked, opposite};

/// A ring of patches that share whole sides.
#[derive(Debug)]
pub(super) struct Ring<'a> {
    pub(super) passages: &'a [RingPassage],
    walked: Walked,
    /// Spaces between members.
    spaces: u32,
}

/// A ring at given plans and shares.
pub(super) struct Look {
    /// How far beside its beginning each inner member comes back, in shares of the side.
    pub(super) drifts: Vec<f64>,
    /// Derivatives of these by the shares.
    pub(super) by_share: Vec<f64>,
    /// Unevenness (Problem 3) over all sides, each once.
    pub(super) evenness: Linearised,
}

impl<'a> Ring<'a> {
    /// Finds the way around.
    pub(super) fn new(
        ring: usize,
        passages: &'a [RingPassage],
        patches: &[RingPatch<'_>],
    ) -> Result<Self, CannotClose> {
        let alone: Vec<&Clad> = patches.iter().map(|patch| patch.alone).collect();
        let crossed = crossed(passages, &alone);
        let Lanes {
            stretches, spaces, ..
        } = lanes(&crossed).map_err(|fault| CannotClose::Threads { ring, fault })?;
        let walked = Walked::new(&crossed, &stretches, 0);
        let whole = spaces.len() == 1 && walked.forward.len() == passages.len();
        if !whole || walked.seam.is_none() {
            return Err(CannotClose::Junction { ring });
        }
        Ok(Self {
            passages,
            walked,
            spaces: spaces[0],
        })
    }

    /// The passage on whose start side members begin.
    pub(super) fn first(&self) -> usize {
        self.walked.origin.passage
    }

    /// Inner members.
    pub(super) fn members(&self) -> usize {
        self.spaces as usize - 1
    }

    /// One over the unevenness of members that are even on all sides.
    pub(super) fn scale(&self) -> f64 {
        // Each side is entered once.
        let weights = self.walked.forward.iter();
        let weights = weights.map(|hop| self.passages[hop.passage].weights[hop.enter as usize]);
        f64::from(self.spaces) / weights.sum::<f64>()
    }

    /// The way around: each passage, and whether its cladding function carries members up (1) or
    /// back down (-1) as they are counted on the first side.
    pub(super) fn signs(&self) -> Vec<(&'a RingPassage, f64)> {
        let piece = |hop: &Hop, end: End| match end {
            End::Start => self.passages[hop.passage].start,
            End::End => self.passages[hop.passage].end,
        };
        let mut from = self.passages[self.first()].start;
        let mut sense = 1.0;
        let mut signs = Vec::new();
        for hop in &self.walked.forward {
            let side = piece(hop, hop.enter);
            if (side.from < side.to) != (from.from < from.to) {
                sense = -sense;
            }
            let across = if hop.enter == End::Start { 1.0 } else { -1.0 };
            signs.push((&self.passages[hop.passage], sense * across));
            from = piece(hop, opposite(hop.enter));
        }
        signs
    }

    /// Members that are even without having to close, inner ones.
    pub(super) fn even(&self, clads: &[&Clad]) -> Vec<f64> {
        let passages = crossed(self.passages, clads);
        let (sides, _) = self.sides(&passages);
        let all = distribute(&sides, (0.0, 1.0), self.spaces + 1);
        all[1..all.len() - 1].to_vec()
    }

    /// Drift and evenness of members with plans.
    pub(super) fn look(&self, clads: &[&Clad], shares: &[f64]) -> Look {
        let passages = crossed(self.passages, clads);
        let (sides, back) = self.sides(&passages);
        let around: Vec<(f64, f64)> = shares.iter().map(|&share| back.share(share)).collect();
        Look {
            drifts: around.iter().zip(shares).map(|(p, u)| p.0 - u).collect(),
            by_share: around.iter().map(|p| p.1 - 1.0).collect(),
            evenness: Linearised::new(&sides, &with_ends(shares)),
        }
    }

    /// The members as threads.
    pub(super) fn schedule(&self, clads: &[&Clad], shares: &[f64]) -> Schedule {
        let passages = crossed(self.passages, clads);
        let (sides, _) = self.sides(&passages);
        let spaces = f64::from(self.spaces);
        let evenly: Vec<f64> = (0..=self.spaces).map(|i| f64::from(i) / spaces).collect();
        let begin = self.passages[self.first()].start;
        let thread = |&share: &f64| Thread {
            line: begin.line,
            at: begin.line_share(share),
            walks: self.walked.walks(),
        };
        let taken = objective(&sides, &with_ends(shares));
        Schedule {
            threads: shares.iter().map(thread).collect(),
            evenness_gained: objective(&sides, &evenly) / taken,
            seams: self.walked.seam.into_iter().collect(),
        }
    }

    /// All sides, each once, and the way once around.
    fn sides<'c>(&self, passages: &[Passage<'c>]) -> (Vec<Crossed<'c>>, Crossed<'c>) {
        let weight = |passage: usize, end: End| self.passages[passage].weights[end as usize];
        let mut sides = self.walked.sides(passages, &weight);
        // The last side is the first one, with the shares of the patch on its other side.
        let mut back = sides.pop().expect("a lane crosses sides");
        let begin = passages[self.first()].start;
        let last = self.walked.forward[self.walked.forward.len() - 1];
        let end = passages[last.passage].piece(opposite(last.enter));
        let extent = begin.to - begin.from;
        back.steps.push(Step::Rescale {
            offset: (end.from - begin.from) / extent,
            scale: (end.to - end.from) / extent,
        });
        (sides, back)
    }
}

fn crossed<'c>(passages: &[RingPassage], clads: &[&'c Clad]) -> Vec<Passage<'c>> {
    let passage = |passage: &RingPassage| Passage {
        start: passage.start,
        end: passage.end,
        function: clads[passage.patch].function(passage.family),
        count: Some(passage.count),
    };
    passages.iter().map(passage).collect()
}

fn with_ends(inner: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0];
    all.extend_from_slice(inner);
    all.push(1.0);
    all
}
