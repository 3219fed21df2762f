//! The graph for other programs: Graphviz and JSON.

use super::declare::Instance;
use super::key::Digest;
use super::plan::{Plan, State};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The graph in Graphviz's language, from dependencies to what needs them.
pub fn dot(plan: &Plan) -> String {
    let mut text = String::from(
        "digraph egg {\n  rankdir=LR;\n  node [shape=box, style=filled, fontname=\"sans-serif\"];\n",
    );
    let ids: BTreeMap<&Instance, usize> = plan
        .stages
        .iter()
        .enumerate()
        .map(|(index, stage)| (&stage.instance, index))
        .collect();
    for (index, stage) in plan.stages.iter().enumerate() {
        let label = match stage.instance.target.as_str() {
            "" => escape(&stage.instance.stage),
            target => format!("{}\\n{}", escape(&stage.instance.stage), escape(target)),
        };
        let fill = match stage.state {
            State::Cached => "#e8f1e4",
            State::Run => "#f6c58f",
            State::Maybe { .. } => "#fbe9c8",
            State::Failed => "#eeaaaa",
            State::Skipped => "#e6e6e6",
        };
        writeln!(
            text,
            "  n{index} [label=\"{label}\", fillcolor=\"{fill}\"];"
        )
        .expect("a string takes all text");
        for need in &stage.needs {
            if let Some(from) = ids.get(need) {
                writeln!(text, "  n{from} -> n{index};").expect("a string takes all text");
            }
        }
    }
    text.push_str("}\n");
    text
}

/// The graph as JSON: one record a stage, with the names of what it needs.
pub fn json(plan: &Plan) -> String {
    let stages: Vec<_> = plan
        .stages
        .iter()
        .map(|stage| {
            let needs: Vec<String> = stage.needs.iter().map(ToString::to_string).collect();
            let reasons: Vec<String> = stage.reasons.iter().map(ToString::to_string).collect();
            json!({
                "name": stage.instance.to_string(),
                "stage": stage.instance.stage,
                "target": stage.instance.target,
                "state": stage.state.word(),
                "reasons": reasons,
                "needs": needs,
                "publishes": stage.publishes,
                "key": stage.key.map(Digest::to_hex),
                "result": stage.result.map(Digest::to_hex),
                "seconds": stage.estimate.map(|estimate| estimate.as_secs_f64()),
            })
        })
        .collect();
    let open: Vec<String> = plan.open.iter().map(ToString::to_string).collect();
    let mut text = json!({ "format": 1, "stages": stages, "open": open }).to_string();
    text.push('\n');
    text
}

fn escape(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}
