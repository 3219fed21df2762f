//! How long splitting takes, and into how many patches it splits: `projects/peak` and coarse layouts
//! of the three buildings, in both workflows.
//!
//! The measure is the paper's: its authors split these surfaces by hand into 4, 16 and 16 patches, in
//! "some hours each".
//!
//! `cargo bench --bench splitting -- peak` measures one of them.

#![expect(clippy::print_stdout, reason = "a benchmark prints")]

use egg::build::graph::{Design, Extent, declare, split_of};
use egg::build::{CancelToken, Engine, Request, Settings};
use egg::project::model::Workflow;
use egg::project::{Notation, load};
use std::path::Path;
use std::time::Instant;

/// Project files, and the paper's number of patches.
const PROJECTS: [(&str, Option<usize>); 4] = [
    ("projects/peak/peak.toml", None),
    ("projects/great-court/coarse.toml", Some(4)),
    ("projects/lilium-tower/coarse.toml", Some(16)),
    ("projects/yas-hotel/coarse.toml", Some(16)),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let testing = arguments.iter().any(|argument| argument == "--test");
    let asked = |file: &str| {
        let mut names = arguments.iter().filter(|a| !a.starts_with('-'));
        names.clone().next().is_none() || names.any(|name| file.contains(name.as_str()))
    };
    println!(
        "{:<34} {:<10} {:>8} {:>6} {:>10} {:>9}",
        "project", "workflow", "patches", "paper", "infeasible", "seconds"
    );
    for (file, paper) in PROJECTS {
        // `cargo test --benches` only wants to know that it works.
        if !asked(file) || testing && paper.is_some() {
            continue;
        }
        for workflow in [Workflow::Automatic, Workflow::Informed] {
            let (patches, left, seconds) = split(file, workflow);
            println!(
                "{file:<34} {:<10} {patches:>8} {:>6} {left:>10} {seconds:>9.1}",
                format!("{workflow:?}"),
                paper.map_or_else(|| "-".to_owned(), |n| n.to_string()),
            );
        }
    }
}

/// Numbers of patches and of infeasible ones among them, and the seconds from a cold start.
fn split(file: &str, workflow: Workflow) -> (usize, usize, f64) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = std::fs::read_to_string(&path).expect("the project file");
    let loaded = load(&text, Notation::Toml, "coarse");
    let mut project = loaded.project.expect("a right project");
    project.split.workflow = workflow;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let begin = Instant::now();
    let settings = Settings::new(folder.path().join("cache"), folder.path().join("out"));
    let mut engine = Engine::open(settings);
    let mesh = engine.source(&path.with_file_name(&project.surface.mesh));
    let mesh = mesh.expect("the mesh");
    let design = Design {
        project: &project,
        spans: &loaded.spans,
        mesh: &mesh,
    };
    let request = Request {
        stages: vec!["split".to_owned()],
        ..Request::default()
    };
    let built = engine.build(
        &request,
        &|graph| declare(graph, design, Extent::Plan),
        &CancelToken::default(),
        &mut |_| {},
    );
    let seconds = begin.elapsed().as_secs_f64();
    let draft = split_of(&built).expect("a layout");
    let left = built
        .diagnostics
        .iter()
        .filter(|d| d.code.as_str() == "W0351");
    (draft.patches.len(), left.count(), seconds)
}
