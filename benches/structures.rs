//! How building structures grows with the number of patches, at equal patches.
//!
//! The surface is a crate of shallow hills and hollows over squares of one metre; every square is
//! a patch with straight sides. Structures of 4, 16 and 64 patches are built from nothing; the time
//! of a patch should stay the same. Beside them the Great Court, as its project says.
//!
//! `cargo bench --bench structures -- 5` makes five runs of each instead of three.

#![expect(clippy::print_stdout, reason = "a benchmark prints")]

use egg::build::graph::{Design, Extent, declare};
use egg::build::{Built, CancelToken, Engine, Graph, Request, Settings};
use egg::project::{Notation, load};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::time::{Duration, Instant};

const COURT: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/projects/great-court/great-court.toml"
);
/// Squares of the mesh along a side of a patch.
const CELLS: u32 = 24;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let runs = match arguments.iter().find_map(|argument| argument.parse().ok()) {
        Some(runs) => runs,
        // `cargo test --benches` only wants to know that it works.
        None if arguments.iter().any(|argument| argument == "--test") => 1,
        None => 3,
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    println!(
        "{:<28} {:>9} {:>12}",
        "from nothing", "least ms", "ms a patch"
    );
    for across in [2, 4, 8] {
        let patches = across * across;
        let mesh = folder.path().join(format!("crate-{patches}.obj"));
        std::fs::write(&mesh, crate_mesh(across)).expect("a mesh");
        let text = crate_project(across, &format!("crate-{patches}.obj"));
        let all: Vec<(Built, Duration)> = (0..runs).map(|_| build(&text, &mesh)).collect();
        row(&format!("{patches} patches"), patches, &all);
    }
    let text = std::fs::read_to_string(COURT).expect("the project file");
    let mesh = Path::new(COURT).with_file_name("great-court.obj");
    let all: Vec<(Built, Duration)> = (0..runs).map(|_| build(&text, &mesh)).collect();
    row("great-court", 4, &all);
    stages(&all[0].0);
}

fn row(what: &str, patches: u32, all: &[(Built, Duration)]) {
    let least = all.iter().map(|(_, took)| took).min().expect("a run");
    let least = 1e3 * least.as_secs_f64();
    println!(
        "{what:<28} {least:>9.0} {:>12.1}",
        least / f64::from(patches)
    );
}

/// Where the time of one build went: own times of stages, instances added up.
fn stages(built: &Built) {
    let mut times: BTreeMap<&str, Duration> = BTreeMap::new();
    for stage in &built.stages {
        *times.entry(stage.instance.stage.as_str()).or_default() += stage.duration;
    }
    let mut sorted: Vec<_> = times.into_iter().collect();
    sorted.sort_by_key(|(_, time)| std::cmp::Reverse(*time));
    for (stage, time) in sorted.into_iter().take(10) {
        println!("  {stage:<26} {:>9.0}", 1e3 * time.as_secs_f64());
    }
}

/// Builds a project in an empty cache on all processors.
fn build(text: &str, mesh: &Path) -> (Built, Duration) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let begin = Instant::now();
    let loaded = load(text, Notation::Toml, "structure");
    let project = loaded.project.expect("a right project");
    let place = |name: &str| folder.path().join(name);
    let mut engine = Engine::open(Settings::new(place("cache"), place("out")));
    let mesh = engine.source(mesh).expect("the mesh");
    let design = Design {
        project: &project,
        spans: &loaded.spans,
        mesh: &mesh,
    };
    let built = engine.build(
        &Request::default(),
        &|graph: &mut Graph<'_>| declare(graph, design, Extent::Files),
        &CancelToken::default(),
        &mut |_| {},
    );
    assert!(built.succeeded(), "{:?}", built.diagnostics);
    (built, begin.elapsed())
}

/// Hills and hollows over `across` times `across` squares.
fn crate_mesh(across: u32) -> String {
    use std::f64::consts::PI;
    let n = across * CELLS;
    let mut text = String::new();
    for j in 0..=n {
        for i in 0..=n {
            let [x, y] = [i, j].map(|k| f64::from(k) / f64::from(CELLS));
            let z = 0.06 * libm::sin(PI * x) * libm::sin(PI * y);
            let _ = writeln!(text, "v {x:.9} {y:.9} {z:.9}");
        }
    }
    let at = |i: u32, j: u32| j * (n + 1) + i + 1;
    for j in 0..n {
        for i in 0..n {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if (i + j) % 2 == 0 {
                let _ = writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}");
            } else {
                let _ = writeln!(text, "f {a} {b} {d}\nf {b} {c} {d}");
            }
        }
    }
    text
}

/// A patch on every square.
fn crate_project(across: u32, mesh: &str) -> String {
    let mut text =
        format!("[project]\nformat = 1\nunits = \"m\"\n[surface]\nmesh = \"{mesh}\"\n[points]\n");
    for j in 0..=across {
        for i in 0..=across {
            let vertex = j * CELLS * (across * CELLS + 1) + i * CELLS;
            let _ = writeln!(text, "p{i}_{j} = {{ vertex = {vertex} }}");
        }
    }
    for j in 0..across {
        for i in 0..across {
            let (right, up) = (i + 1, j + 1);
            let _ = writeln!(
                text,
                "[patches.q{i}_{j}]\ncorners = [\"p{i}_{j}\", \"p{right}_{j}\", \"p{right}_{up}\", \
                 \"p{i}_{up}\"]\nmembers = {{ u = 7, v = 7 }}"
            );
        }
    }
    text.push_str("[lamella]\nwidth = 0.02\nthickness = 0.002\nmaterial = \"limewood\"\n");
    text
}
