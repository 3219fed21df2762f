//! Where a strip is broken: the fewest pieces, and of all ways to have so few the one whose
//! breaks cost least, by dynamic programming along the strip.

/// What pieces have to keep. Metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    /// Length of the strip.
    pub(super) length: f64,
    /// Longest piece, what it reaches over its joints included.
    pub(super) longest: f64,
    /// Shortest distance of two joints, and of a joint from an end.
    pub(super) shortest: f64,
    /// How far a piece reaches over the middle of a joint.
    pub(super) reach: f64,
}

/// Places that are tried lie so far apart, metres, on strips of up to [`PLACES`] of them.
const STEP: f64 = 0.001;
const PLACES: f64 = 1000.0;
/// Sums of lengths are exact to far less than this, metres.
const EXACT: f64 = 1e-9;
/// Pieces more than the fewest that would do on a strip without openings.
const SPARE_PIECES: usize = 4;

/// Middles of joints, ascending; `None` if there is no way. `cost` is `None` where no joint may
/// be.
pub(super) fn breaks(limits: &Limits, cost: impl Fn(f64) -> Option<f64>) -> Option<Vec<f64>> {
    let step = STEP.max(limits.length / PLACES);
    let last = libm::floor(limits.length / step - 1e-9).max(0.0) as usize;
    // The start, the places inside, the end.
    let mut places: Vec<(f64, f64, f64)> = vec![(0.0, 0.0, 0.0)];
    for i in 1..=last {
        let x = i as f64 * step;
        let inside = x >= limits.shortest && x <= limits.length - limits.shortest;
        if let Some(cost) = inside.then(|| cost(x)).flatten() {
            places.push((x, cost, limits.reach));
        }
    }
    places.push((limits.length, 0.0, 0.0));
    let fits = |from: usize, to: usize| {
        let ((x0, _, r0), (x1, _, r1)) = (places[from], places[to]);
        let apart = x1 - x0;
        apart >= limits.shortest && apart + r0 + r1 <= limits.longest - EXACT
    };
    let end = places.len() - 1;
    let fewest = libm::ceil(limits.length / limits.longest.max(1e-6)).min(1e3) as usize;
    // Cheapest way to every place with the pieces so far, and the place before it.
    let mut best: Vec<Option<f64>> = vec![None; places.len()];
    best[0] = Some(0.0);
    let mut before: Vec<Vec<usize>> = Vec::new();
    for _ in 0..fewest + SPARE_PIECES {
        let mut next: Vec<Option<f64>> = vec![None; places.len()];
        let mut from: Vec<usize> = vec![0; places.len()];
        for to in 1..=end {
            for start in (0..to).rev() {
                if places[to].0 - places[start].0 > limits.longest {
                    break;
                }
                let Some(so_far) = best[start].filter(|_| fits(start, to)) else {
                    continue;
                };
                let total = so_far + places[to].1;
                if next[to].is_none_or(|known| total < known) {
                    next[to] = Some(total);
                    from[to] = start;
                }
            }
        }
        before.push(from);
        best = next;
        if best[end].is_some() {
            let mut at = end;
            let mut found = Vec::new();
            for from in before.iter().rev() {
                at = from[at];
                found.push(places[at].0);
            }
            found.pop();
            found.reverse();
            return Some(found);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const LIMITS: Limits = Limits {
        length: 3.0,
        longest: 1.2,
        shortest: 0.1,
        reach: 0.01,
    };

    #[test]
    fn the_cheapest_of_the_ways_with_fewest_pieces_is_taken() {
        // Cost grows away from 1.1 and 2.05: both can be had with three pieces.
        let valley = |x: f64, at: f64| (x - at).abs();
        let found = breaks(&LIMITS, |x| Some(valley(x, 1.1).min(valley(x, 2.05))));
        let found = found.expect("a way");
        assert_eq!(found.len(), 2);
        assert!(
            (found[0] - 1.1).abs() < 2e-3 && (found[1] - 2.05).abs() < 2e-3,
            "{found:?}"
        );
    }

    #[test]
    fn a_forbidden_stretch_takes_one_more_piece_or_has_no_way() {
        // Free are 0.8 to 0.9 and 1.9 to 2.0: the last of three pieces is 1.0 + reach long.
        let free = |x: f64| (0.8..0.9).contains(&x) || (1.9..2.0).contains(&x);
        let found = breaks(&LIMITS, |x| free(x).then_some(0.0)).expect("a way");
        assert_eq!(found.len(), 2);
        assert_eq!(breaks(&LIMITS, |x| (x < 1.0).then_some(0.0)), None);
    }

    #[test]
    fn a_strip_that_fits_is_not_broken() {
        let fits = Limits {
            length: 1.1,
            ..LIMITS
        };
        assert_eq!(breaks(&fits, |_| Some(1.0)), Some(Vec::new()));
    }

    proptest! {
        #[test]
        fn pieces_keep_the_limits_and_joints_the_forbidden_places(
            length in 0.5f64..6.0,
            longest in 0.4f64..2.5,
            period in 0.05f64..0.4,
        ) {
            let limits = Limits { length, longest, shortest: 0.06, reach: 0.008 };
            let allowed = |x: f64| x % period > 0.03;
            let cost = |x: f64| allowed(x).then(|| libm::sin(9.0 * x) + 1.0);
            if let Some(found) = breaks(&limits, cost) {
                let ends = [0.0].into_iter().chain(found.iter().copied()).chain([length]);
                let ends: Vec<f64> = ends.collect();
                for (i, pair) in ends.windows(2).enumerate() {
                    let joints = usize::from(i > 0) + usize::from(i + 2 < ends.len());
                    let piece = pair[1] - pair[0] + joints as f64 * limits.reach;
                    prop_assert!(piece <= longest + 1e-6 && pair[1] - pair[0] >= 0.06 - 1e-6 || found.is_empty());
                }
                prop_assert!(found.iter().all(|x| allowed(*x)));
            }
        }
    }
}
