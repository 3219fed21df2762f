//! A lane walked from passage to passage: all sides that its members cross, with the way there.

use super::distribution::{Crossed, Step};
use super::schedule::{Seam, Weight};
use super::threads::{End, Hop, Passage, Stretch};

/// A lane walked from its first stretch: forward over the end side, backward over the start side.
#[derive(Debug, Clone)]
pub(super) struct Walked {
    pub(super) origin: Stretch,
    pub(super) forward: Vec<Hop>,
    backward: Vec<Hop>,
    /// Where the lane comes back to its first stretch, if it is a ring.
    pub(super) seam: Option<Seam>,
}

impl Walked {
    pub(super) fn new(passages: &[Passage<'_>], stretches: &[Vec<Stretch>], lane: usize) -> Self {
        let all: Vec<Stretch> = stretches
            .iter()
            .flatten()
            .filter(|s| s.lane == lane)
            .copied()
            .collect();
        let origin = all[0];
        let mut seen = vec![origin.passage];
        let mut walk = |mut from: Stretch, mut leave: End| {
            let mut hops = Vec::new();
            let mut last = (from, leave);
            while let Some((next, enter)) = meeting(passages, &all, &from, leave, &seen) {
                seen.push(next.passage);
                hops.push(Hop {
                    passage: next.passage,
                    enter,
                });
                from = next;
                leave = opposite(enter);
                last = (from, leave);
            }
            (hops, last)
        };
        let mut forward = vec![Hop {
            passage: origin.passage,
            enter: End::Start,
        }];
        let (onward, (last, leave)) = walk(origin, End::End);
        forward.extend(onward);
        let (backward, _) = walk(origin, End::Start);
        let comes_back = overlaps(
            on_line(passages, &last, leave),
            on_line(passages, &origin, End::Start),
        );
        Self {
            origin,
            forward,
            backward,
            seam: comes_back.then_some(Seam {
                first: origin.passage,
                last: last.passage,
                leave,
            }),
        }
    }

    pub(super) fn walks(&self) -> Vec<Vec<Hop>> {
        let walks = [self.forward.clone(), self.backward.clone()];
        walks.into_iter().filter(|walk| !walk.is_empty()).collect()
    }

    /// All sides that the lane crosses, each once, with the way there from the origin.
    pub(super) fn sides<'a>(
        &self,
        passages: &[Passage<'a>],
        weight: Weight<'_>,
    ) -> Vec<Crossed<'a>> {
        let first = self.origin.passage;
        let mut sides = vec![Crossed {
            weight: weight(first, End::Start),
            steps: Vec::new(),
        }];
        for walk in [&self.forward, &self.backward] {
            let mut steps: Vec<Step<'a>> = Vec::new();
            let mut from = passages[first].start;
            for hop in walk {
                let passage = &passages[hop.passage];
                let side = passage.piece(hop.enter);
                if (side.from, side.to) != (from.from, from.to) {
                    // Share of the previous side to share of the line to share of this side.
                    let scale = (from.to - from.from) / (side.to - side.from);
                    let offset = (from.from - side.from) / (side.to - side.from);
                    steps.push(Step::Rescale { offset, scale });
                    let same_piece = (side.from, side.to) == (from.to, from.from);
                    if !same_piece {
                        sides.push(Crossed {
                            weight: weight(hop.passage, hop.enter),
                            steps: steps.clone(),
                        });
                    }
                }
                steps.push(match hop.enter {
                    End::Start => Step::Forward(passage.function),
                    End::End => Step::Backward(passage.function),
                });
                let leave = opposite(hop.enter);
                sides.push(Crossed {
                    weight: weight(hop.passage, leave),
                    steps: steps.clone(),
                });
                from = passage.piece(leave);
            }
        }
        sides
    }
}

/// The stretch of the lane behind the side by which it leaves a stretch, and by which end it is
/// entered.
fn meeting(
    passages: &[Passage<'_>],
    all: &[Stretch],
    from: &Stretch,
    leave: End,
    seen: &[usize],
) -> Option<(Stretch, End)> {
    let here = on_line(passages, from, leave);
    all.iter()
        .filter(|s| !seen.contains(&s.passage))
        .find_map(|next| {
            [End::Start, End::End].into_iter().find_map(|enter| {
                let there = on_line(passages, next, enter);
                overlaps(here, there).then_some((*next, enter))
            })
        })
}

fn on_line(passages: &[Passage<'_>], stretch: &Stretch, end: End) -> (u32, f64, f64) {
    let piece = passages[stretch.passage].piece(end);
    let shares = if end == End::Start {
        stretch.start
    } else {
        stretch.end
    };
    let [a, b] = shares.map(|share| piece.line_share(share));
    (piece.line, a.min(b), a.max(b))
}

/// Whether two stretches of a line are one but for rounding.
fn overlaps(here: (u32, f64, f64), there: (u32, f64, f64)) -> bool {
    let overlap = here.2.min(there.2) - here.1.max(there.1);
    here.0 == there.0 && overlap > 0.5 * (here.2 - here.1)
}

pub(super) fn opposite(end: End) -> End {
    match end {
        End::Start => End::End,
        End::End => End::Start,
    }
}
