//! From a result back to what caused it.

use super::super::explain::{Cause, Explanation, Influence};
use super::super::plan::{Plan, State};
use super::super::reason::Reason;
use super::Session;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

impl Session<'_, '_> {
    /// Walks from the instance at `subject` of `plan` back to causes from outside: those of the
    /// build that is due, or if none is, those of the build in which the result last changed.
    pub(in crate::build) fn explain(&self, plan: &Plan, subject: usize) -> Explanation {
        let stage = &plan.stages[subject];
        let by_name: BTreeMap<_, usize> = plan
            .stages
            .iter()
            .enumerate()
            .map(|(index, stage)| (&stage.instance, index))
            .collect();
        let mut causes: Vec<Cause> = Vec::new();
        let mut came_from: BTreeMap<usize, usize> = BTreeMap::new();
        let mut queue = VecDeque::from([subject]);
        let mut seen = BTreeSet::from([subject]);
        while let Some(index) = queue.pop_front() {
            let stage = &plan.stages[index];
            let mut back = Vec::new();
            for reason in self.reasons_for(plan, index) {
                match reason {
                    Reason::DependencyChanged { instance, .. }
                        if by_name.contains_key(&instance) =>
                    {
                        back.push(instance);
                    }
                    reason => causes.push(Cause {
                        reason,
                        path: path(plan, &came_from, index),
                    }),
                }
            }
            if let State::Maybe { after } = &stage.state {
                back.extend(after.iter().cloned());
            }
            for instance in back {
                if let Some(&next) = by_name.get(&instance)
                    && seen.insert(next)
                {
                    came_from.insert(next, index);
                    queue.push_back(next);
                }
            }
        }
        Explanation {
            instance: stage.instance.clone(),
            state: stage.state.clone(),
            pending: !matches!(stage.state, State::Cached) || !stage.reasons.is_empty(),
            causes,
            influences: self.influences(plan, subject, &by_name),
        }
    }

    fn reasons_for(&self, plan: &Plan, index: usize) -> Vec<Reason> {
        let stage = &plan.stages[index];
        let recorded = || {
            let record = self.worktree.instance(&stage.instance);
            record.map_or_else(Vec::new, |record| record.changed_by.clone())
        };
        match stage.state {
            State::Cached | State::Failed if stage.reasons.is_empty() => recorded(),
            _ => stage.reasons.clone(),
        }
    }

    /// Fields of the inputs of everything that the subject is made from.
    fn influences(
        &self,
        plan: &Plan,
        subject: usize,
        by_name: &BTreeMap<&super::super::declare::Instance, usize>,
    ) -> Vec<Influence> {
        let mut needed = BTreeSet::from([subject]);
        let mut queue = vec![subject];
        while let Some(index) = queue.pop() {
            for need in &plan.stages[index].needs {
                if let Some(&next) = by_name.get(need)
                    && needed.insert(next)
                {
                    queue.push(next);
                }
            }
        }
        let mut influences = Vec::new();
        for index in needed {
            let instance = &plan.stages[index].instance;
            let Some(&node) = self.names.get(instance) else {
                continue;
            };
            for field in self.recipe(node).fields {
                influences.push(Influence {
                    instance: instance.clone(),
                    key: self.declared(node).key_of(&field.path),
                    field: field.path,
                    value: field.value,
                });
            }
        }
        influences
    }
}

/// The way from the cause to the subject.
fn path(
    plan: &Plan,
    came_from: &BTreeMap<usize, usize>,
    mut index: usize,
) -> Vec<super::super::declare::Instance> {
    let mut path = vec![plan.stages[index].instance.clone()];
    while let Some(&next) = came_from.get(&index) {
        path.push(plan.stages[next].instance.clone());
        index = next;
    }
    path
}
