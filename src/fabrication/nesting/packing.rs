//! One-dimensional bin packing: items of given sizes into the fewest bins of one capacity.
//!
//! Two constructions compete, best-fit-decreasing (S. Martello, P. Toth, *Knapsack Problems*,
//! 1990, chapter 8) and minimum bin slack (J. Gupta, J. Ho, *A new heuristic algorithm for the
//! one-dimensional bin-packing problem*, 1999: fill bin after bin with the subset that wastes
//! least), and both are improved by emptying bins through exchanges. The lower bound L2 of
//! Martello and Toth says how good the result is. Everything is deterministic: ties go to the
//! earlier item or bin.

/// Lengths are metres; sums of a few hundred of them are exact to far less than this.
const TOLERANCE: f64 = 1e-9;

/// Subsets that the search for one tight bin may visit: enough to fill bins of up to some twenty
/// items exactly, few enough to pack thousands of parts in a second.
const SUBSETS: usize = 20_000;

/// Bins of indices of items, each item once; larger items than the capacity get bins of their
/// own.
pub(super) fn pack(sizes: &[f64], capacity: f64) -> Vec<Vec<usize>> {
    let order = decreasing(sizes);
    let bound = lower_bound(sizes, capacity);
    let mut best: Option<Vec<Vec<usize>>> = None;
    for construct in [best_fit_decreasing, minimum_bin_slack] {
        let mut bins = construct(sizes, capacity, &order);
        while bins.len() > bound && empty_a_bin(&mut bins, sizes, capacity) {}
        if best.as_ref().is_none_or(|best| bins.len() < best.len()) {
            best = Some(bins);
        }
        if best.as_ref().is_some_and(|best| best.len() <= bound) {
            break;
        }
    }
    best.unwrap_or_default()
}

/// No packing has fewer bins: bound L2.
pub(super) fn lower_bound(sizes: &[f64], capacity: f64) -> usize {
    let half = 0.5 * capacity;
    let mut thresholds: Vec<f64> = sizes.iter().copied().filter(|s| *s <= half).collect();
    thresholds.push(0.0);
    thresholds.sort_by(f64::total_cmp);
    thresholds.dedup();
    thresholds
        .into_iter()
        .map(|alpha| {
            let alone = sizes
                .iter()
                .filter(|s| **s > capacity - alpha + TOLERANCE)
                .count();
            let large = sizes
                .iter()
                .filter(|s| **s > half + TOLERANCE && **s <= capacity - alpha + TOLERANCE);
            let (mut bins, mut room) = (0, 0.0);
            for size in large {
                bins += 1;
                room += capacity - size;
            }
            let small: f64 = sizes
                .iter()
                .filter(|s| **s >= alpha && **s <= half + TOLERANCE)
                .sum();
            let more = libm::ceil((small - room) / capacity - TOLERANCE).max(0.0);
            alone + bins + more as usize
        })
        .max()
        .unwrap_or(0)
}

fn decreasing(sizes: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|&a, &b| sizes[b].total_cmp(&sizes[a]).then(a.cmp(&b)));
    order
}

fn best_fit_decreasing(sizes: &[f64], capacity: f64, order: &[usize]) -> Vec<Vec<usize>> {
    let mut bins: Vec<(f64, Vec<usize>)> = Vec::new();
    for &item in order {
        let size = sizes[item];
        let fit = bins
            .iter_mut()
            .filter(|(rest, _)| *rest >= size - TOLERANCE)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match fit {
            Some((rest, bin)) => {
                *rest -= size;
                bin.push(item);
            }
            None => bins.push((capacity - size, vec![item])),
        }
    }
    bins.into_iter().map(|(_, bin)| bin).collect()
}

fn minimum_bin_slack(sizes: &[f64], capacity: f64, order: &[usize]) -> Vec<Vec<usize>> {
    let mut left = order.to_vec();
    let mut bins = Vec::new();
    while let Some(&first) = left.first() {
        let mut search = Search {
            sizes,
            items: &left[1..],
            chosen: Vec::new(),
            best: Vec::new(),
            slack: capacity - sizes[first],
            visits: SUBSETS,
        };
        search.fill(0, capacity - sizes[first]);
        let mut bin = vec![first];
        bin.extend(search.best);
        left.retain(|item| !bin.contains(item));
        bins.push(bin);
    }
    bins
}

/// Depth-first search for the subset of `items` (largest first) that leaves the least slack.
struct Search<'a> {
    sizes: &'a [f64],
    items: &'a [usize],
    chosen: Vec<usize>,
    best: Vec<usize>,
    slack: f64,
    visits: usize,
}

impl Search<'_> {
    fn fill(&mut self, from: usize, rest: f64) {
        if rest < self.slack - TOLERANCE {
            self.slack = rest;
            self.best.clone_from(&self.chosen);
        }
        let mut previous = f64::NAN;
        for place in from..self.items.len() {
            if self.visits == 0 || self.slack <= TOLERANCE {
                return;
            }
            let item = self.items[place];
            let size = self.sizes[item];
            // An equal item that was tried at this depth leads to the same sums.
            if size > rest + TOLERANCE || size == previous {
                continue;
            }
            previous = size;
            self.visits -= 1;
            self.chosen.push(item);
            self.fill(place + 1, rest - size);
            self.chosen.pop();
        }
    }
}

/// Tries to do without one bin, the emptiest first: each of its items goes into another bin, if
/// need be in exchange for a smaller item that fits into a third.
fn empty_a_bin(bins: &mut Vec<Vec<usize>>, sizes: &[f64], capacity: f64) -> bool {
    let load = |bin: &[usize]| bin.iter().map(|&i| sizes[i]).sum::<f64>();
    let mut victims: Vec<usize> = (0..bins.len()).collect();
    victims.sort_by(|&a, &b| load(&bins[a]).total_cmp(&load(&bins[b])).then(a.cmp(&b)));
    for victim in victims {
        let mut trial = bins.clone();
        let mut items = trial.remove(victim);
        items.sort_by(|&a, &b| sizes[b].total_cmp(&sizes[a]).then(a.cmp(&b)));
        if items
            .into_iter()
            .all(|item| rehouse(&mut trial, item, sizes, capacity))
        {
            *bins = trial;
            return true;
        }
    }
    false
}

fn rehouse(bins: &mut [Vec<usize>], item: usize, sizes: &[f64], capacity: f64) -> bool {
    let rest: Vec<f64> = bins
        .iter()
        .map(|bin| capacity - bin.iter().map(|&i| sizes[i]).sum::<f64>())
        .collect();
    let tightest = |size: f64, except: usize| {
        (0..rest.len())
            .filter(|&b| b != except && rest[b] >= size - TOLERANCE)
            .min_by(|&a, &b| rest[a].total_cmp(&rest[b]).then(a.cmp(&b)))
    };
    if let Some(bin) = tightest(sizes[item], usize::MAX) {
        bins[bin].push(item);
        return true;
    }
    for from in 0..bins.len() {
        for place in 0..bins[from].len() {
            let other = bins[from][place];
            if sizes[other] < sizes[item]
                && rest[from] + sizes[other] >= sizes[item] - TOLERANCE
                && let Some(to) = tightest(sizes[other], from)
            {
                bins[from][place] = item;
                bins[to].push(other);
                return true;
            }
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_perfect_packing_is_found_where_best_fit_misses_it() {
        // Falkenauer's triplets in small: only bins of three are full.
        let sizes = [
            0.47, 0.27, 0.26, 0.45, 0.29, 0.26, 0.41, 0.33, 0.26, 0.38, 0.35, 0.27,
        ];
        let order = decreasing(&sizes);
        assert_eq!(best_fit_decreasing(&sizes, 1.0, &order).len(), 5);
        assert_eq!(pack(&sizes, 1.0).len(), 4);
        assert_eq!(lower_bound(&sizes, 1.0), 4);
    }

    #[test]
    fn the_bound_counts_items_that_exclude_each_other() {
        assert_eq!(lower_bound(&[0.6, 0.6, 0.6, 0.1], 1.0), 3);
        assert_eq!(lower_bound(&[0.7, 0.6, 0.35, 0.35], 1.0), 3);
        assert_eq!(lower_bound(&[], 1.0), 0);
    }

    proptest! {
        #[test]
        fn every_item_is_packed_once_and_no_bin_overflows(
            sizes in prop::collection::vec(0.05f64..1.0, 0..60)
        ) {
            let bins = pack(&sizes, 1.0);
            let mut seen: Vec<usize> = bins.iter().flatten().copied().collect();
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..sizes.len()).collect::<Vec<_>>());
            for bin in &bins {
                prop_assert!(bin.iter().map(|&i| sizes[i]).sum::<f64>() <= 1.0 + 1e-9);
            }
            let bound = lower_bound(&sizes, 1.0);
            prop_assert!(bins.len() >= bound);
            prop_assert!(bins.len() <= bound + 1 + bound / 20, "{} of {bound}", bins.len());
        }
    }
}
