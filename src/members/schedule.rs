//! The schedule of a strip: where every member that is not a side of a patch begins, and through
//! which patches it runs.
//!
//! In each lane the free members are distributed evenly over all sides that the lane crosses.

use super::distribution::{distribute, objective};
use super::threads::{End, Lanes, Passage, Thread, ThreadFault, lanes};
use super::walk::Walked;
use serde::{Deserialize, Serialize};

/// Members of passages that meet, as threads, and what their distribution gained.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Schedule {
    /// Given threads, then free ones lane by lane.
    pub threads: Vec<Thread>,
    /// The objective (paper, Problem 3) with members even on the first side of each lane only,
    /// over that of the distribution taken: at least 1, unless a ring had to close.
    pub evenness_gained: f64,
    /// Where members that went once around come back to where they began.
    pub seams: Vec<Seam>,
}

/// Where a ring of passages closes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Seam {
    /// The passage on whose start side members begin.
    pub first: usize,
    /// The passage by which they come back.
    pub last: usize,
    /// The end by which they leave it.
    pub leave: End,
}

/// Importance of a side in the distribution.
pub type Weight<'a> = &'a dyn Fn(usize, End) -> f64;

/// Lays threads through passages. `weight` tells the importance of a passage's side.
pub fn schedule(passages: &[Passage<'_>], weight: Weight<'_>) -> Result<Schedule, ThreadFault> {
    let Lanes {
        stretches,
        spaces,
        given,
    } = lanes(passages)?;
    let mut threads = given;
    let (mut even, mut taken) = (0.0, 0.0);
    let mut seams = Vec::new();
    for (lane, &spaces) in spaces.iter().enumerate() {
        let walked = Walked::new(passages, &stretches, lane);
        let sides = walked.sides(passages, weight);
        let [low, high] = walked.origin.start;
        let shares = distribute(&sides, (low, high), spaces + 1);
        let step = (high - low) / f64::from(spaces);
        let evenly: Vec<f64> = (0..=spaces).map(|i| low + step * f64::from(i)).collect();
        seams.extend(walked.seam);
        even += objective(&sides, &evenly);
        taken += objective(&sides, &shares);
        let side = passages[walked.origin.passage].start;
        let inner = &shares[1..shares.len() - 1];
        threads.extend(inner.iter().map(|&share| Thread {
            line: side.line,
            at: side.line_share(share),
            walks: walked.walks(),
        }));
    }
    let evenness_gained = if taken > 0.0 { even / taken } else { 1.0 };
    Ok(Schedule {
        threads,
        evenness_gained,
        seams,
    })
}

#[cfg(test)]
mod tests {
    use super::super::threads::{Hop, LinePiece};
    use super::*;
    use crate::cladding::CladdingFunction;

    fn moebius(k: f64) -> CladdingFunction {
        let f = |x: f64| {
            [
                x,
                k * x / (1.0 + (k - 1.0) * x),
                k / (1.0 + (k - 1.0) * x).powi(2),
            ]
        };
        let mut samples: Vec<_> = (0..=64).map(|i| f(f64::from(i) / 64.0)).collect();
        samples[64][1] = 1.0;
        CladdingFunction::new(samples).unwrap()
    }

    fn piece(line: u32, from: f64, to: f64) -> LinePiece {
        LinePiece { line, from, to }
    }

    #[test]
    fn a_strip_of_two_patches_is_distributed_over_three_sides() {
        let (f, g) = (moebius(0.5), moebius(0.6));
        let passages = [
            Passage {
                start: piece(0, 0.0, 1.0),
                end: piece(1, 0.0, 1.0),
                function: &f,
                count: Some(6),
            },
            Passage {
                start: piece(1, 1.0, 0.0),
                end: piece(2, 0.0, 1.0),
                function: &g,
                count: None,
            },
        ];
        let schedule = schedule(&passages, &|_, _| 1.0).unwrap();
        assert_eq!(schedule.threads.len(), 4);
        assert!(
            schedule.evenness_gained > 1.01,
            "{}",
            schedule.evenness_gained
        );
        let hops: Vec<usize> = schedule.threads[0].walks[0]
            .iter()
            .map(|h| h.passage)
            .collect();
        assert_eq!(hops, [0, 1]);
        assert!(schedule.threads.windows(2).all(|w| w[0].at < w[1].at));
    }

    #[test]
    fn mirrored_strips_give_mirrored_members() {
        let (f, g) = (moebius(0.6), moebius(1.0 / 0.6));
        let shares = |f: &CladdingFunction| {
            let one = Passage {
                start: piece(0, 0.0, 1.0),
                end: piece(1, 0.0, 1.0),
                function: f,
                count: Some(8),
            };
            let schedule = schedule(&[one], &|_, _| 1.0).unwrap();
            schedule.threads.iter().map(|t| t.at).collect::<Vec<f64>>()
        };
        for (a, b) in shares(&f).iter().zip(shares(&g).iter().rev()) {
            assert!((a - (1.0 - b)).abs() < 1e-7);
        }
    }

    #[test]
    fn a_ring_is_walked_once_around() {
        let (f, g) = (moebius(0.8), moebius(0.9));
        let passages = [
            Passage {
                start: piece(0, 0.0, 1.0),
                end: piece(1, 0.0, 1.0),
                function: &f,
                count: Some(5),
            },
            Passage {
                start: piece(1, 0.0, 1.0),
                end: piece(0, 0.0, 1.0),
                function: &g,
                count: None,
            },
        ];
        let schedule = schedule(&passages, &|_, _| 1.0).unwrap();
        assert_eq!(schedule.threads.len(), 3);
        assert_eq!(schedule.threads[0].walks.len(), 1);
        assert_eq!(schedule.threads[0].walks[0].len(), 2);
        let seam = Seam {
            first: 0,
            last: 1,
            leave: End::End,
        };
        assert_eq!(schedule.seams, [seam]);
    }

    #[test]
    fn members_in_the_parts_of_a_long_side_are_even_there_too() {
        let identity = moebius(1.0);
        let f = &identity;
        let passages = [
            Passage {
                start: piece(0, 0.0, 1.0),
                end: piece(1, 0.0, 1.0),
                function: f,
                count: Some(11),
            },
            Passage {
                start: piece(1, 0.0, 0.3),
                end: piece(2, 0.0, 1.0),
                function: f,
                count: Some(4),
            },
        ];
        let schedule = schedule(&passages, &|_, _| 1.0).unwrap();
        let mut at: Vec<f64> = schedule.threads.iter().map(|t| t.at).collect();
        at.sort_by(f64::total_cmp);
        assert_eq!(at.len(), 9);
        for (i, x) in at.iter().enumerate() {
            assert!((x - 0.1 * (i + 1) as f64).abs() < 1e-9, "{at:?}");
        }
        // The thread through the corner is given and runs through the long patch only.
        assert_eq!(
            schedule.threads[0].walks,
            vec![vec![Hop {
                passage: 0,
                enter: End::End
            }]]
        );
    }
}
