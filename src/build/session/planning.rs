//! A pass that stops before anything runs, as a plan.

use super::super::declare::Instance;
use super::super::plan::{Plan, PlannedStage, State};
use super::{Session, Status};
use crate::diagnostics::Diagnostic;

impl Session<'_, '_> {
    /// What building would do now, on `jobs` threads.
    pub(in crate::build) fn plan(&self, jobs: usize) -> Plan {
        let wanted = (0..self.entries.len()).filter(|&index| self.entries[index].wanted);
        let mut stages: Vec<PlannedStage> = wanted.map(|index| self.planned(index)).collect();
        let name = |index: usize| (*self.declared(index).instance).clone();
        let open: Vec<Instance> = self
            .graph
            .unfolds
            .iter()
            .map(|(root, _)| name(*root))
            .collect();
        if !open.is_empty() && self.request.is_whole() {
            stages.extend(self.expected(&open));
        }
        Plan {
            stages,
            open,
            remaining: self.tally(jobs, &[]).remaining,
            diagnostics: self.diagnostics(),
        }
    }

    fn planned(&self, index: usize) -> PlannedStage {
        let entry = &self.entries[index];
        let declared = self.declared(index);
        let name = |index: usize| (*self.declared(index).instance).clone();
        let mut reasons = entry.reasons.clone();
        let state = match entry.status {
            Status::Cached | Status::Ran => State::Cached,
            Status::Due | Status::Running => State::Run,
            Status::Failed => State::Failed,
            Status::Skipped { .. } => State::Skipped,
            Status::Waiting | Status::Stopped => {
                reasons = self.why_anyhow(index);
                if reasons.is_empty() {
                    State::Maybe {
                        after: self.pending(index).map(name).collect(),
                    }
                } else {
                    State::Run
                }
            }
        };
        if matches!(state, State::Cached) && self.has_moved(index) {
            reasons = self.why(index);
        }
        PlannedStage {
            instance: (*declared.instance).clone(),
            state,
            reasons,
            needs: entry.needs.iter().map(|&need| name(need)).collect(),
            publishes: declared.publishes,
            key: entry.key,
            result: entry.head.as_ref().and_then(|head| head.digest()),
            estimate: entry.estimate,
        }
    }

    /// Whether the instance has another key than in the last build.
    pub(super) fn has_moved(&self, index: usize) -> bool {
        self.entries[index].record.map(|record| record.key) != self.entries[index].key
    }

    /// What may follow where the graph is not unfolded yet, going by the last build.
    fn expected(&self, open: &[Instance]) -> Vec<PlannedStage> {
        self.undeclared()
            .map(|record| PlannedStage {
                instance: record.instance.clone(),
                state: State::Maybe {
                    after: open.to_vec(),
                },
                reasons: Vec::new(),
                needs: Vec::new(),
                publishes: false,
                key: None,
                result: None,
                estimate: Some(record.head.duration()),
            })
            .collect()
    }

    /// Everything there is to tell, in the order of the graph.
    pub(in crate::build) fn diagnostics(&self) -> Vec<Diagnostic> {
        let mut diagnostics = self.notices.clone();
        for (entry, declared) in self.entries.iter().zip(&self.graph.nodes) {
            if !entry.wanted {
                continue;
            }
            let kept = entry.head.iter().flat_map(|head| &head.diagnostics);
            diagnostics.extend(
                kept.chain(&entry.told)
                    .map(|diagnostic| declared.localised(diagnostic)),
            );
        }
        diagnostics
    }
}
