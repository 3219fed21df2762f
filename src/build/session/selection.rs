//! What a request names and the graph does not have.

use super::Session;
use crate::diagnostics::{Code, Diagnostic};
use std::collections::BTreeSet;

/// Up to so many names are listed as a whole.
const LISTED: usize = 8;
/// Of names that are close to a wrong one, so many are shown.
const SHOWN: usize = 3;

impl Session<'_, '_> {
    /// Errors for names of the request that are in vain. Before the graph has unfolded as a whole
    /// nobody can say.
    pub(in crate::build) fn unmatched(&self) -> Vec<Diagnostic> {
        let names_nothing = self.request.is_whole() && !self.graph.nodes.is_empty();
        if names_nothing || !self.graph.unfolds.is_empty() {
            return Vec::new();
        }
        let instances = || self.graph.nodes.iter().map(|declared| &declared.instance);
        let stages: BTreeSet<&str> = instances().map(|one| one.stage.as_str()).collect();
        let targets: BTreeSet<&str> = instances()
            .map(|one| one.target.as_str())
            .chain(self.graph.wholes())
            .filter(|target| !target.is_empty())
            .collect();
        let mut errors = Vec::new();
        for stage in &self.request.stages {
            if !stages.contains(stage.as_str()) {
                errors.push(unknown("stage", stage, &stages));
            }
        }
        for target in &self.request.targets {
            let below = format!("{target}.");
            let matches = |one: &&str| *one == target || one.starts_with(&below);
            if !targets.iter().any(matches) {
                errors.push(unknown("target", target, &targets));
            }
        }
        if errors.is_empty() && !instances().any(|one| self.graph.selects(self.request, one)) {
            let what = "none of the stages is done for any of the targets";
            errors.push(Diagnostic::error(NO_SUCH_STAGE, what));
        }
        errors
    }
}

const NO_SUCH_STAGE: Code = Code::new("E0810");

fn unknown(kind: &str, name: &str, known: &BTreeSet<&str>) -> Diagnostic {
    let error = Diagnostic::error(NO_SUCH_STAGE, format!("there is no {kind} `{name}`"));
    let mut close: Vec<(usize, &str)> = known
        .iter()
        .map(|one| (strsim::damerau_levenshtein(one, name), *one))
        .filter(|(distance, _)| *distance <= (name.chars().count() / 3).max(1))
        .collect();
    close.sort_unstable();
    close.truncate(SHOWN);
    let quoted = |names: &mut dyn Iterator<Item = &str>| {
        let quoted: Vec<String> = names.map(|name| format!("`{name}`")).collect();
        quoted.join(", ")
    };
    if !close.is_empty() {
        let names = quoted(&mut close.iter().map(|(_, name)| *name));
        error.help(format!("did you mean {names}?"))
    } else if known.len() <= LISTED {
        error.help(format!("there are {}", quoted(&mut known.iter().copied())))
    } else {
        error.help("`egg graph` lists all stages and targets")
    }
}
