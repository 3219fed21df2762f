//! The even distribution of members over all sides that they cross (paper, section 4.4,
//! Problem 3).
//!
//! A member is one number: its share of the side where it starts. Cladding functions carry it to
//! the other sides, so the objective is a function of these numbers alone, and each difference
//! couples two neighbours: the normal matrix is tridiagonal.

use crate::cladding::CladdingFunction;

/// One step on the way from the origin of a member to another side.
#[derive(Debug, Clone, Copy)]
pub enum Step<'a> {
    /// Across a patch, from the start side of the family to its end side.
    Forward(&'a CladdingFunction),
    /// Across a patch, from the end side of the family to its start side.
    Backward(&'a CladdingFunction),
    /// To the share of another parametrisation of the same side: `offset + scale * share`.
    Rescale {
        /// Share at share 0.
        offset: f64,
        /// Change per share; negative where the other one runs the other way.
        scale: f64,
    },
}

/// A side that the members cross.
#[derive(Debug, Clone)]
pub struct Crossed<'a> {
    /// Importance of the side.
    pub weight: f64,
    /// How a member gets there from the origin.
    pub steps: Vec<Step<'a>>,
}

impl Crossed<'_> {
    /// Share of this side and its derivative, for a share of the origin.
    pub fn share(&self, origin: f64) -> (f64, f64) {
        self.steps
            .iter()
            .fold((origin, 1.0), |(share, slope), step| {
                let (next, by) = match *step {
                    Step::Forward(f) => f.at(share),
                    Step::Backward(f) => f.inverse_at(share),
                    Step::Rescale { offset, scale } => (offset + scale * share, scale),
                };
                (next, slope * by)
            })
    }
}

/// Largest component of the gradient at the optimum, relative to the even spacing.
const OPTIMAL: f64 = 1e-13;
/// Gauss-Newton converges in a handful of steps; the bound only guards against rounding.
const MOST_STEPS: usize = 60;

/// Shares of the origin side for `count` members between `range.0` and `range.1`, both of which
/// are members: minimises the weighted squared differences of neighbouring shares over all sides.
///
/// # Panics
/// If fewer than two members are asked for.
pub fn distribute(sides: &[Crossed<'_>], range: (f64, f64), count: u32) -> Vec<f64> {
    assert!(count >= 2, "the ends of the range are members");
    let last = count as usize - 1;
    let even = (range.1 - range.0) / last as f64;
    let mut shares: Vec<f64> = (0..=last).map(|i| range.0 + even * i as f64).collect();
    shares[last] = range.1;
    let mut state = Linearised::new(sides, &shares);
    for _ in 0..MOST_STEPS {
        if state
            .gradient
            .iter()
            .all(|g| g.abs() <= OPTIMAL * even.abs())
        {
            break;
        }
        let step = state.gauss_newton_step();
        // Halve until the members keep their order and the objective does not grow.
        let mut factor = 1.0;
        let better = loop {
            let trial: Vec<f64> = (0..=last)
                .map(|i| {
                    if i == 0 || i == last {
                        shares[i]
                    } else {
                        shares[i] - factor * step[i - 1]
                    }
                })
                .collect();
            let ordered = trial.windows(2).all(|w| (w[1] - w[0]) * even > 0.0);
            if ordered {
                let next = Linearised::new(sides, &trial);
                // Near the optimum the objective changes by less than its rounding; the gradient
                // still tells.
                let descends = next.objective < state.objective * (1.0 - 1e-13);
                let level = next.objective <= state.objective * (1.0 + 1e-13);
                if descends || level && next.steepness() < state.steepness() {
                    break Some((trial, next));
                }
            }
            factor *= 0.5;
            if factor < 1e-6 {
                break None;
            }
        };
        let Some((trial, next)) = better else { break };
        (shares, state) = (trial, next);
    }
    shares
}

/// Objective, and half of its gradient and of its Gauss-Newton matrix, at given shares.
pub(super) struct Linearised {
    pub(super) objective: f64,
    /// By the inner members.
    pub(super) gradient: Vec<f64>,
    pub(super) diagonal: Vec<f64>,
    pub(super) off_diagonal: Vec<f64>,
}

impl Linearised {
    pub(super) fn new(sides: &[Crossed<'_>], shares: &[f64]) -> Self {
        let inner = shares.len() - 2;
        let mut this = Self {
            objective: 0.0,
            gradient: vec![0.0; inner],
            diagonal: vec![0.0; inner],
            off_diagonal: vec![0.0; inner],
        };
        for side in sides {
            let on_side: Vec<_> = shares.iter().map(|&s| side.share(s)).collect();
            for (j, pair) in on_side.windows(2).enumerate() {
                let [(a, da), (b, db)] = [pair[0], pair[1]];
                let difference = b - a;
                this.objective += side.weight * difference * difference;
                // Member j is unknown j - 1, member j + 1 is unknown j.
                if j > 0 {
                    this.gradient[j - 1] -= side.weight * difference * da;
                    this.diagonal[j - 1] += side.weight * da * da;
                }
                if j < inner {
                    this.gradient[j] += side.weight * difference * db;
                    this.diagonal[j] += side.weight * db * db;
                }
                if j > 0 && j < inner {
                    this.off_diagonal[j - 1] -= side.weight * da * db;
                }
            }
        }
        this
    }

    fn steepness(&self) -> f64 {
        self.gradient.iter().map(|g| g * g).sum()
    }

    fn gauss_newton_step(&self) -> Vec<f64> {
        let n = self.gradient.len();
        let mut diagonal = self.diagonal.clone();
        let mut step = self.gradient.clone();
        for i in 1..n {
            let factor = self.off_diagonal[i - 1] / diagonal[i - 1];
            diagonal[i] -= factor * self.off_diagonal[i - 1];
            step[i] -= factor * step[i - 1];
        }
        for i in (0..n).rev() {
            let after = if i + 1 < n {
                self.off_diagonal[i] * step[i + 1]
            } else {
                0.0
            };
            step[i] = (step[i] - after) / diagonal[i];
        }
        step
    }
}

/// Sum of weighted squared differences: what [`distribute`] minimises.
pub fn objective(sides: &[Crossed<'_>], shares: &[f64]) -> f64 {
    Linearised::new(sides, shares).objective
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

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

    fn sides<'a>(
        f: &'a CladdingFunction,
        g: &'a CladdingFunction,
        w: [f64; 3],
    ) -> Vec<Crossed<'a>> {
        vec![
            Crossed {
                weight: w[0],
                steps: vec![],
            },
            Crossed {
                weight: w[1],
                steps: vec![Step::Forward(f)],
            },
            Crossed {
                weight: w[2],
                steps: vec![
                    Step::Forward(f),
                    Step::Rescale {
                        offset: 1.0,
                        scale: -1.0,
                    },
                    Step::Backward(g),
                ],
            },
        ]
    }

    proptest! {
        #[test]
        fn the_gradient_vanishes_and_no_move_of_a_member_helps(
            k in 0.4..2.5_f64, l in 0.4..2.5_f64,
            w in [0.1..5.0_f64, 0.1..5.0, 0.1..5.0],
            count in 3_u32..14, which in 0.0..1.0_f64, by in -0.3..0.3_f64,
        ) {
            let (f, g) = (moebius(k), moebius(l));
            let sides = sides(&f, &g, w);
            let shares = distribute(&sides, (0.0, 1.0), count);
            let even = 1.0 / f64::from(count - 1);
            let at = Linearised::new(&sides, &shares);
            prop_assert!(at.gradient.iter().all(|x| x.abs() < 1e-10 * even), "{:?}", at.gradient);
            prop_assert!(shares.windows(2).all(|w| w[0] < w[1]));
            let mut moved = shares.clone();
            let i = 1 + (which * f64::from(count - 2)) as usize;
            moved[i] += by * (moved[i + 1] - moved[i - 1]) * 0.5;
            prop_assert!(objective(&sides, &moved) >= objective(&sides, &shares));
        }

        #[test]
        fn a_side_and_its_mirror_image_give_mirrored_members(k in 0.4..2.5_f64, count in 3_u32..12) {
            // The inverse of the Moebius function of k is that of 1/k, and its mirror image too.
            let (f, g) = (moebius(k), moebius(1.0 / k));
            let one = |f| vec![
                Crossed { weight: 1.0, steps: vec![] },
                Crossed { weight: 1.0, steps: vec![Step::Forward(f)] },
            ];
            let forth = distribute(&one(&f), (0.0, 1.0), count);
            let back = distribute(&one(&g), (0.0, 1.0), count);
            for (a, b) in forth.iter().zip(back.iter().rev()) {
                prop_assert!((a - (1.0 - b)).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn members_of_a_parallel_strip_are_even_and_ends_stay() {
        let identity = moebius(1.0);
        let sides = sides(&identity, &identity, [1.0, 2.0, 3.0]);
        let shares = distribute(&sides, (0.25, 0.75), 5);
        for (share, exact) in shares.iter().zip([0.25, 0.375, 0.5, 0.625, 0.75]) {
            assert!((share - exact).abs() < 1e-14);
        }
        assert_eq!(distribute(&sides, (0.0, 1.0), 2), [0.0, 1.0]);
    }

    #[test]
    fn it_is_more_even_than_spacing_the_first_side_alone() {
        let f = moebius(0.45);
        let sides = vec![
            Crossed {
                weight: 1.0,
                steps: vec![],
            },
            Crossed {
                weight: 1.0,
                steps: vec![Step::Forward(&f)],
            },
        ];
        let even: Vec<f64> = (0..9).map(|i| f64::from(i) / 8.0).collect();
        let shares = distribute(&sides, (0.0, 1.0), 9);
        let gain = objective(&sides, &even) / objective(&sides, &shares);
        assert!(gain > 1.05, "{gain}");
    }
}
