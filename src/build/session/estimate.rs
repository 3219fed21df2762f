//! How long things will take, going by earlier runs: which ready stage runs first, and the time
//! that is left. Nothing here touches a result.

use super::super::event::Tally;
use super::super::store::worktree::InstanceRecord;
use super::{Session, Status};
use std::collections::BTreeMap;
use std::time::Duration;

/// Where no run of the stage is on record, it counts as this much for the order.
const UNKNOWN: Duration = Duration::from_millis(1);

/// Running totals over the wanted instances.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Progress {
    finished: usize,
    known: usize,
    /// Sum of the estimates of what is not finished, with what the last build had unfolded.
    left: Duration,
    /// Number of those without an estimate.
    unestimated: usize,
}

impl Session<'_, '_> {
    /// Estimates every instance and the longest path from it, after the graph has grown. A stage
    /// that has no record for this target is taken to be as long as for others.
    pub(super) fn weigh(&mut self) {
        let mut sums: BTreeMap<&str, (Duration, u32)> = BTreeMap::new();
        for (index, entry) in self.entries.iter().enumerate() {
            if let Some(estimate) = entry.estimate {
                let sum = sums
                    .entry(self.graph.nodes[index].work.stage())
                    .or_default();
                *sum = (sum.0 + estimate, sum.1 + 1);
            }
        }
        for (index, entry) in self.entries.iter_mut().enumerate() {
            if entry.estimate.is_none() {
                entry.estimate = sums
                    .get(self.graph.nodes[index].work.stage())
                    .map(|&(sum, count)| sum / count);
            }
        }
        self.progress = Progress::default();
        for index in (0..self.entries.len()).rev() {
            let entry = &self.entries[index];
            let after = entry
                .dependents
                .iter()
                .map(|&dependent| self.entries[dependent].urgency)
                .max();
            let own = entry.estimate.unwrap_or(UNKNOWN);
            self.entries[index].urgency = own + after.unwrap_or_default();
            let entry = &self.entries[index];
            if entry.wanted {
                self.progress.known += 1;
                if entry.status.is_final() {
                    self.progress.finished += 1;
                } else {
                    self.progress.add(entry.estimate);
                }
            }
        }
        if !self.graph.unfolds.is_empty() && self.request.is_whole() {
            let undeclared = self.undeclared().map(|record| record.head.duration());
            self.progress.left += undeclared.sum::<Duration>();
        }
    }

    /// Instances of the last build that are not declared as long as the graph is not unfolded.
    pub(super) fn undeclared(&self) -> impl Iterator<Item = &InstanceRecord> {
        let records = self.worktree.instances.iter();
        records.filter(|record| !self.names.contains_key(&record.instance))
    }

    /// Counts the instance as finished.
    pub(super) fn count_finished(&mut self, index: usize) {
        self.progress.finished += 1;
        match self.entries[index].estimate {
            Some(estimate) => self.progress.left = self.progress.left.saturating_sub(estimate),
            None => self.progress.unestimated = self.progress.unestimated.saturating_sub(1),
        }
    }

    /// Takes [`count_finished`](Self::count_finished) back.
    pub(super) fn count_unfinished(&mut self, index: usize) {
        self.progress.finished -= 1;
        self.progress.add(self.entries[index].estimate);
    }

    /// How things stand with `jobs` threads: at best they share what is left evenly, and no
    /// faster than the longest chain that has begun.
    pub(in crate::build) fn tally(&self, jobs: usize, running: &[usize]) -> Tally {
        let longest = running
            .iter()
            .filter(|&&index| self.entries[index].status == Status::Running)
            .map(|&index| self.entries[index].urgency)
            .max()
            .unwrap_or_default();
        let shared = self.progress.left / u32::try_from(jobs.max(1)).unwrap_or(1);
        Tally {
            finished: self.progress.finished,
            known: self.progress.known,
            remaining: (self.progress.unestimated == 0).then(|| shared.max(longest)),
        }
    }
}

impl Progress {
    fn add(&mut self, estimate: Option<Duration>) {
        match estimate {
            Some(estimate) => self.left += estimate,
            None => self.unestimated += 1,
        }
    }
}
