//! Threads: members that run on from patch to patch, and the lanes between those that are given.
//!
//! A member that reaches a side runs on into the patch behind it. Where a corner of one patch
//! stands inside a side of another (a T-junction) the member through it is given: it is the
//! boundary member of the smaller patch (paper, section 4.4). Given threads are followed through
//! all patches by their cladding functions; between neighbouring ones lie *lanes*, in which the
//! free members are distributed independently of each other.
//!
//! Everything lives on lines: a side of a passage is a piece of a line, and two passages meet
//! where their pieces do.

use crate::cladding::CladdingFunction;
use serde::{Deserialize, Serialize};

/// A piece of a line as the side of a passage: the shares of the line at the side's share 0 and 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LinePiece {
    /// Which line.
    pub line: u32,
    /// Share of the line where the side begins.
    pub from: f64,
    /// Share of the line where the side ends; may be smaller.
    pub to: f64,
}

impl LinePiece {
    /// Share of the line at a share of the side.
    pub fn line_share(self, share: f64) -> f64 {
        self.from + share * (self.to - self.from)
    }

    /// Share of the side at a share of the line.
    pub fn side_share(self, line_share: f64) -> f64 {
        (line_share - self.from) / (self.to - self.from)
    }

    fn range(self) -> (f64, f64) {
        (self.from.min(self.to), self.from.max(self.to))
    }
}

/// One family crossing one patch.
#[derive(Debug, Clone, Copy)]
pub struct Passage<'a> {
    /// Where its members start.
    pub start: LinePiece,
    /// Where they end.
    pub end: LinePiece,
    /// From shares of the start side to shares of the end side.
    pub function: &'a CladdingFunction,
    /// Number of members, both boundary members included; found from the others where unsaid.
    pub count: Option<u32>,
}

impl Passage<'_> {
    /// The side at one of its ends.
    pub fn piece(&self, end: End) -> LinePiece {
        match end {
            End::Start => self.start,
            End::End => self.end,
        }
    }
}

/// One end of a passage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum End {
    /// The start side.
    Start,
    /// The end side.
    End,
}

/// Two places on a line closer than this are one, in shares of the line.
const SAME: f64 = 1e-7;
/// More given threads than this through one passage are a spiral, no design.
const MOST_GIVEN: usize = 64;

/// Why threads cannot be laid.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum ThreadFault {
    /// Given threads run round and round through a passage.
    Spiral {
        /// The passage.
        passage: usize,
    },
    /// The counts contradict each other: members of the passage by its own count and by those of
    /// the passages that it meets.
    Counts {
        /// The passage.
        passage: usize,
        /// By its own count.
        own: u32,
        /// Least that the others need.
        others: u32,
    },
    /// Nothing says how many members a passage has.
    Uncounted {
        /// The passage.
        passage: usize,
    },
}

/// A member that runs through one or several passages, from a place on a line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Thread {
    /// The line.
    pub line: u32,
    /// Share of the line.
    pub at: f64,
    /// The ways from there, each through passages in order.
    pub walks: Vec<Vec<Hop>>,
}

/// A passage that a thread enters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hop {
    /// The passage.
    pub passage: usize,
    /// By which of its ends.
    pub enter: End,
}

/// A stretch of a passage between two given threads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// The passage.
    pub passage: usize,
    /// Shares of its start side.
    pub start: [f64; 2],
    /// Shares of its end side.
    pub end: [f64; 2],
    /// The lane it belongs to.
    pub lane: usize,
}

/// Given threads and lanes of passages that meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Lanes {
    /// Stretches of each passage, by ascending share of its start side.
    pub stretches: Vec<Vec<Stretch>>,
    /// Spaces between members in each lane.
    pub spaces: Vec<u32>,
    /// Given threads that run inside of passages.
    pub given: Vec<Thread>,
}

/// Follows given threads and divides passages into lanes with their numbers of members.
pub fn lanes(passages: &[Passage<'_>]) -> Result<Lanes, ThreadFault> {
    let (shares, given) = given_threads(passages)?;
    let mut stretches: Vec<Vec<Stretch>> = shares
        .iter()
        .enumerate()
        .map(|(passage, shares)| {
            let between = |w: &[[f64; 2]]| Stretch {
                passage,
                start: [w[0][0], w[1][0]],
                end: [w[0][1], w[1][1]],
                lane: usize::MAX,
            };
            shares.windows(2).map(between).collect()
        })
        .collect();
    let count = number_lanes(passages, &mut stretches);
    let spaces = count_spaces(passages, &stretches, count)?;
    Ok(Lanes {
        stretches,
        spaces,
        given,
    })
}

/// Shares (start, end) of the given threads of each passage, ascending: its own boundary members
/// and whatever corner or given thread comes in from a neighbour; and these threads themselves.
fn given_threads(
    passages: &[Passage<'_>],
) -> Result<(Vec<Vec<[f64; 2]>>, Vec<Thread>), ThreadFault> {
    // Corners in the order of passages; each place on a line is followed once.
    let mut places: Vec<(u32, f64)> = Vec::new();
    for piece in passages.iter().flat_map(|p| [p.start, p.end]) {
        for at in [piece.from, piece.to] {
            if !is_known(&places, piece.line, at) {
                places.push((piece.line, at));
            }
        }
    }
    let mut given: Vec<Vec<[f64; 2]>> = vec![vec![[0.0, 0.0], [1.0, 1.0]]; passages.len()];
    let mut threads = Vec::new();
    for (line, at) in places.clone() {
        let mut thread = Thread {
            line,
            at,
            walks: Vec::new(),
        };
        for hop in entries(passages, line, at) {
            let mut walk = vec![hop];
            let (mut hop, mut at) = (hop, at);
            loop {
                let (pair, next_line, next_at) = pass(passages, hop, at);
                given[hop.passage].push(pair);
                if given[hop.passage].len() > MOST_GIVEN {
                    return Err(ThreadFault::Spiral {
                        passage: hop.passage,
                    });
                }
                // It ends where another given thread begins or passes already.
                if is_known(&places, next_line, next_at) {
                    break;
                }
                places.push((next_line, next_at));
                let onward = entries(passages, next_line, next_at)
                    .into_iter()
                    .find(|next| next.passage != hop.passage);
                let Some(next) = onward else { break };
                walk.push(next);
                (hop, at) = (next, next_at);
            }
            thread.walks.push(walk);
        }
        if !thread.walks.is_empty() {
            threads.push(thread);
        }
    }
    for shares in &mut given {
        shares.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    Ok((given, threads))
}

fn is_known(places: &[(u32, f64)], line: u32, at: f64) -> bool {
    places
        .iter()
        .any(|&(l, known)| l == line && (known - at).abs() < SAME)
}

/// The passages that a place on a line lies strictly inside the side of, and by which end a thread
/// enters them there.
pub(super) fn entries(passages: &[Passage<'_>], line: u32, at: f64) -> Vec<Hop> {
    let mut entries = Vec::new();
    for (passage, p) in passages.iter().enumerate() {
        for enter in [End::Start, End::End] {
            let piece = p.piece(enter);
            let (low, high) = piece.range();
            if piece.line == line && at > low + SAME && at < high - SAME {
                entries.push(Hop { passage, enter });
            }
        }
    }
    entries
}

/// Crosses a passage from a place on a line: shares of its start and end side, and where on which
/// line it comes out.
fn pass(passages: &[Passage<'_>], hop: Hop, at: f64) -> ([f64; 2], u32, f64) {
    let passage = &passages[hop.passage];
    let share = passage.piece(hop.enter).side_share(at);
    let (pair, out) = match hop.enter {
        End::Start => ([share, passage.function.at(share).0], passage.end),
        End::End => ([passage.function.inverse_at(share).0, share], passage.start),
    };
    let leave = if hop.enter == End::Start {
        pair[1]
    } else {
        pair[0]
    };
    (pair, out.line, out.line_share(leave))
}

/// Joins stretches that meet on a line into lanes; returns their number.
fn number_lanes(passages: &[Passage<'_>], stretches: &mut [Vec<Stretch>]) -> usize {
    let on_line = |s: &Stretch, end: End| {
        let piece = passages[s.passage].piece(end);
        let shares = if end == End::Start { s.start } else { s.end };
        let [a, b] = shares.map(|share| piece.line_share(share));
        (piece.line, a.min(b), a.max(b))
    };
    let index: Vec<(usize, usize)> = stretches
        .iter()
        .enumerate()
        .flat_map(|(p, list)| (0..list.len()).map(move |i| (p, i)))
        .collect();
    let mut next = 0;
    for &(p, i) in &index {
        if stretches[p][i].lane != usize::MAX {
            continue;
        }
        stretches[p][i].lane = next;
        let mut queue = vec![(p, i)];
        while let Some((p, i)) = queue.pop() {
            for end in [End::Start, End::End] {
                let here = on_line(&stretches[p][i], end);
                for &(q, j) in &index {
                    let other = stretches[q][j];
                    if other.lane != usize::MAX {
                        continue;
                    }
                    let meets = [End::Start, End::End].into_iter().any(|end| {
                        let there = on_line(&other, end);
                        // Neighbouring stretches overlap by rounding only; the same one by nearly
                        // all of its width.
                        let overlap = here.2.min(there.2) - here.1.max(there.1);
                        here.0 == there.0 && overlap > 0.5 * (here.2 - here.1)
                    });
                    if meets {
                        stretches[q][j].lane = next;
                        queue.push((q, j));
                    }
                }
            }
        }
        next += 1;
    }
    next
}

/// Spaces of each lane from the counts of passages: what a passage has left after its counted
/// lanes is shared by its other lanes in proportion to their width.
fn count_spaces(
    passages: &[Passage<'_>],
    stretches: &[Vec<Stretch>],
    count: usize,
) -> Result<Vec<u32>, ThreadFault> {
    let mut spaces: Vec<Option<u32>> = vec![None; count];
    let mut open: Vec<usize> = (0..passages.len())
        .filter(|&p| passages[p].count.is_some())
        .collect();
    while !open.is_empty() {
        // The passage with the fewest undecided lanes first; ties by their order.
        let undecided = |p: usize| {
            stretches[p]
                .iter()
                .filter(|s| spaces[s.lane].is_none())
                .count()
        };
        let (at, &passage) = open
            .iter()
            .enumerate()
            .min_by_key(|(_, p)| undecided(**p))
            .expect("the list is not empty");
        open.remove(at);
        let own = passages[passage].count.unwrap_or(2);
        let total = own.saturating_sub(1);
        let decided: u32 = stretches[passage]
            .iter()
            .filter_map(|s| spaces[s.lane])
            .sum();
        let free: Vec<&Stretch> = stretches[passage]
            .iter()
            .filter(|s| spaces[s.lane].is_none())
            .collect();
        let least = decided + free.len() as u32;
        if total < least || free.is_empty() && total != decided {
            return Err(ThreadFault::Counts {
                passage,
                own,
                others: least + 1,
            });
        }
        let widths: Vec<f64> = free.iter().map(|s| s.start[1] - s.start[0]).collect();
        for (stretch, share) in free.iter().zip(apportion(total - decided, &widths)) {
            spaces[stretch.lane] = Some(share);
        }
    }
    let uncounted = |lane: usize| {
        let passage = stretches
            .iter()
            .flatten()
            .find(|s| s.lane == lane)
            .map_or(0, |s| s.passage);
        ThreadFault::Uncounted { passage }
    };
    spaces
        .iter()
        .enumerate()
        .map(|(lane, n)| n.ok_or_else(|| uncounted(lane)))
        .collect()
}

/// Divides a number among parts in proportion to their widths, each at least one (largest
/// remainders, the first of equal ones first).
fn apportion(total: u32, widths: &[f64]) -> Vec<u32> {
    let sum: f64 = widths.iter().sum();
    let exact: Vec<f64> = widths.iter().map(|w| f64::from(total) * w / sum).collect();
    let mut parts: Vec<u32> = exact.iter().map(|x| (x.floor() as u32).max(1)).collect();
    // One at a time to the part that is furthest below its share, or from the one furthest above.
    loop {
        let given: u32 = parts.iter().sum();
        let lack = |&i: &usize| exact[i] - f64::from(parts[i]);
        let furthest = |a: &usize, b: &usize| lack(a).total_cmp(&lack(b)).then(b.cmp(a));
        let all = 0..parts.len();
        let part = match given.cmp(&total) {
            std::cmp::Ordering::Equal => return parts,
            std::cmp::Ordering::Less => all.max_by(furthest),
            std::cmp::Ordering::Greater => all.filter(|&i| parts[i] > 1).min_by(furthest),
        };
        match part {
            Some(i) if given < total => parts[i] += 1,
            Some(i) => parts[i] -= 1,
            None => return parts,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn one_patch_is_one_lane() {
        let f = moebius(0.7);
        let one = Passage {
            start: piece(0, 0.0, 1.0),
            end: piece(1, 1.0, 0.0),
            function: &f,
            count: Some(7),
        };
        let lanes = lanes(&[one]).unwrap();
        assert_eq!(lanes.spaces, [6]);
        assert_eq!(lanes.stretches[0].len(), 1);
    }

    #[test]
    fn a_chain_has_one_count_whichever_patch_says_it() {
        let (f, g) = (moebius(0.7), moebius(1.4));
        let first = Passage {
            start: piece(0, 0.0, 1.0),
            end: piece(1, 0.0, 1.0),
            function: &f,
            count: None,
        };
        let second = Passage {
            start: piece(2, 0.0, 1.0),
            end: piece(1, 1.0, 0.0),
            function: &g,
            count: Some(9),
        };
        let lanes = lanes(&[first, second]).unwrap();
        assert_eq!(lanes.spaces, [8]);
        let uncounted = super::lanes(&[
            first,
            Passage {
                count: None,
                ..second
            },
        ])
        .unwrap_err();
        assert_eq!(uncounted, ThreadFault::Uncounted { passage: 0 });
    }

    /// A long patch below two short ones, and a gap between these.
    fn t_junction(counts: [Option<u32>; 3]) -> (Vec<CladdingFunction>, [Option<u32>; 3]) {
        (vec![moebius(0.8), moebius(1.0), moebius(1.3)], counts)
    }

    fn passages(f: &[CladdingFunction], counts: [Option<u32>; 3]) -> Vec<Passage<'_>> {
        vec![
            Passage {
                start: piece(0, 0.0, 1.0),
                end: piece(1, 0.0, 1.0),
                function: &f[0],
                count: counts[0],
            },
            Passage {
                start: piece(1, 0.0, 0.25),
                end: piece(2, 0.0, 1.0),
                function: &f[1],
                count: counts[1],
            },
            Passage {
                start: piece(3, 0.0, 1.0),
                end: piece(1, 1.0, 0.5),
                function: &f[2],
                count: counts[2],
            },
        ]
    }

    #[test]
    fn corners_in_a_long_side_give_threads_and_lanes() {
        let (f, counts) = t_junction([Some(12), Some(4), Some(5)]);
        let lanes = lanes(&passages(&f, counts)).unwrap();
        assert_eq!(lanes.stretches[0].len(), 3);
        let ends: Vec<f64> = lanes.stretches[0].iter().map(|s| s.end[1]).collect();
        assert!((ends[0] - 0.25).abs() < 1e-12 && (ends[1] - 0.5).abs() < 1e-12);
        assert_eq!(lanes.stretches[0][0].lane, lanes.stretches[1][0].lane);
        assert_eq!(lanes.stretches[0][2].lane, lanes.stretches[2][0].lane);
        let spaces = |i: usize| lanes.spaces[lanes.stretches[0][i].lane];
        assert_eq!([spaces(0), spaces(1), spaces(2)], [3, 4, 4]);
    }

    #[test]
    fn counts_that_contradict_are_told() {
        let (f, counts) = t_junction([Some(8), Some(4), Some(5)]);
        let fault = lanes(&passages(&f, counts)).unwrap_err();
        assert_eq!(
            fault,
            ThreadFault::Counts {
                passage: 0,
                own: 8,
                others: 9
            }
        );
    }

    #[test]
    fn a_given_thread_runs_on_through_the_next_patch() {
        let (f, counts) = t_junction([Some(12), Some(4), Some(5)]);
        let mut all = passages(&f, counts);
        let g = moebius(1.1);
        all.push(Passage {
            start: piece(0, 1.0, 0.0),
            end: piece(4, 0.0, 1.0),
            function: &g,
            count: None,
        });
        let lanes = lanes(&all).unwrap();
        assert_eq!(lanes.stretches[3].len(), 3);
        assert_eq!(lanes.stretches[3][2].lane, lanes.stretches[0][0].lane);
        // Two corners stand in the long side, and the threads through them end at the far side
        // of the passage below.
        assert_eq!(lanes.given.len(), 2);
        let hops: Vec<usize> = lanes.given[0].walks[0].iter().map(|h| h.passage).collect();
        assert_eq!(hops, [0, 3]);
    }

    #[test]
    fn numbers_are_apportioned_by_width_with_one_at_least() {
        assert_eq!(apportion(10, &[0.5, 0.25, 0.25]), [5, 3, 2]);
        assert_eq!(apportion(3, &[0.98, 0.01, 0.01]), [1, 1, 1]);
    }
}
