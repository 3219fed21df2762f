//! Whether members are distributed as the method says: no inner member can move without making the
//! sum of squared distances larger (paper, Problem 3).

use egg::plan::{CladdingFunction, Plan};
use egg::project::model::Family;

/// Asserts that the members of two patches that both end on their common side are stationary.
pub(crate) fn is_stationary(plan: &Plan, [first, second]: [&str; 2], family: Family) {
    let [near, common] = shares(plan, first, family);
    let [far, same] = shares(plan, second, family);
    for (a, b) in common.iter().zip(&same) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    let [to_near, to_far] = [first, second].map(|patch| cladding(plan, patch, family));
    for j in 1..common.len() - 1 {
        // By the share of the common side; each side follows by its cladding function.
        let terms = [
            (&common, 1.0),
            (&near, 1.0 / slope_at(to_near, near[j])),
            (&far, 1.0 / slope_at(to_far, far[j])),
        ]
        .map(|(side, rate)| (2.0 * side[j] - side[j - 1] - side[j + 1]) * rate);
        let gradient: f64 = terms.iter().sum();
        let size: f64 = terms.iter().map(|term| term.abs()).sum();
        // Members are exact where the functions are interpolated: some 1e-5 of the side.
        assert!(gradient.abs() < 0.01 * size + 4e-5, "{j}: {terms:?}");
    }
    // The sides are not even by themselves: there was something to balance.
    let second_differences = near.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs());
    assert!(second_differences.fold(0.0, f64::max) > 1e-3);
}

/// Shares of a family's members on their start and end side.
fn shares(plan: &Plan, patch: &str, family: Family) -> [Vec<f64>; 2] {
    let members = plan.members.iter();
    let own = members.filter(|m| m.patch == patch && m.family == family);
    let (starts, ends): (Vec<f64>, Vec<f64>) = own.map(|m| (m.start, m.end)).unzip();
    [starts, ends]
}

fn cladding<'a>(plan: &'a Plan, patch: &str, family: Family) -> &'a CladdingFunction {
    let found = plan.patches.iter().find(|record| record.id == patch);
    let cladding = &found.expect("a patch").cladding;
    match family {
        Family::U => &cladding.u,
        Family::V => &cladding.v,
    }
}

/// Slope of a sampled function: between the samples before and behind the ones around.
fn slope_at(function: &CladdingFunction, share: f64) -> f64 {
    let samples = &function.samples;
    let i = samples
        .partition_point(|sample| sample[0] <= share)
        .clamp(2, samples.len() - 2);
    let [a, b] = [samples[i - 2], samples[i + 1]];
    (b[1] - a[1]) / (b[0] - a[0])
}
