//! What a build of `projects/desktop` spends its time on.
//!
//! Builds from nothing on one thread give each stage's own time; builds on all processors, builds
//! with nothing to do and builds after an edit give what a user waits for. Least times tell what
//! the program needs, medians what the machine gives.
//!
//! `cargo bench --bench stages -- 9` makes nine runs of each instead of five.

#![expect(clippy::print_stdout, reason = "a benchmark prints")]

use egg::build::graph::{Design, Extent, declare};
use egg::build::{Built, CancelToken, Engine, How, Request, Settings};
use egg::project::{Notation, load};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const PROJECT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/projects/desktop/desktop.toml");

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let runs = match arguments.iter().find_map(|argument| argument.parse().ok()) {
        Some(runs) => runs,
        // `cargo test --benches` only wants to know that it works.
        None if arguments.iter().any(|argument| argument == "--test") => 1,
        None => 5,
    };
    let text = std::fs::read_to_string(PROJECT).expect("the project file");
    let processors = std::thread::available_parallelism().map_or(1, Into::into);

    let cold: Vec<Run> = (0..runs)
        .map(|_| Workplace::new().build(&text, 1, Extent::Files))
        .collect();
    stages(&cold);

    println!("\nwhole builds{:>35} {:>9}", "least ms", "median ms");
    row("from nothing, one thread", &cold);
    let parallel: Vec<Run> = (0..runs)
        .map(|_| Workplace::new().build(&text, processors, Extent::Files))
        .collect();
    row(&format!("from nothing, {processors} threads"), &parallel);
    let checks: Vec<Run> = (0..runs)
        .map(|_| Workplace::new().build(&text, processors, Extent::Plan))
        .collect();
    row("`egg check` from nothing", &checks);

    let place = Workplace::new();
    place.build(&text, processors, Extent::Files);
    let idle: Vec<Run> = (0..runs)
        .map(|_| place.build(&text, processors, Extent::Files))
        .collect();
    assert!(
        idle.iter().all(|run| run.built.count(How::Ran) == 0),
        "nothing changed"
    );
    row("nothing changed", &idle);
    for (what, key, values) in [
        ("another stock", "length = 1000", "length = "),
        ("another thickness", "thickness = 1", "thickness = 1."),
        ("more members", "u = 9", "u = "),
    ] {
        let edited: Vec<Run> = (0..runs)
            .map(|i| {
                let value = match key {
                    "length = 1000" => format!("{values}{}", 1001 + i),
                    "thickness = 1" => format!("{values}{}", 1 + i % 9),
                    _ => format!("{values}{}", 3 + i % 6),
                };
                let text = text.replacen(key, &value, 1);
                place.build(&text, processors, Extent::Files)
            })
            .collect();
        row(&format!("after an edit: {what}"), &edited);
    }
}

/// One build.
struct Run {
    built: Built,
    /// From the project's text to published files.
    took: Duration,
}

/// A cache and an output folder of its own.
struct Workplace(tempfile::TempDir);

impl Workplace {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    fn build(&self, text: &str, jobs: usize, extent: Extent) -> Run {
        let begin = Instant::now();
        let loaded = load(text, Notation::Toml, "desktop");
        let project = loaded.project.expect("a right project");
        let folder: PathBuf = self.0.path().to_owned();
        let mut settings = Settings::new(folder.join("cache"), folder.join("out"));
        settings.jobs = jobs;
        let mut engine = Engine::open(settings);
        let mesh = Path::new(PROJECT).with_file_name(&project.surface.mesh);
        let mesh = engine.source(&mesh).expect("the mesh");
        let design = Design {
            project: &project,
            spans: &loaded.spans,
            mesh: &mesh,
        };
        let built = engine.build(
            &Request::default(),
            &|graph| declare(graph, design, extent),
            &CancelToken::default(),
            &mut |_| {},
        );
        assert!(built.succeeded(), "{:?}", built.diagnostics);
        Run {
            built,
            took: begin.elapsed(),
        }
    }
}

/// Own times of stages, instances added up, the longest first.
fn stages(runs: &[Run]) {
    let mut times: BTreeMap<&str, Vec<Duration>> = BTreeMap::new();
    let mut instances: BTreeMap<&str, usize> = BTreeMap::new();
    for (i, run) in runs.iter().enumerate() {
        for stage in &run.built.stages {
            let name = stage.instance.stage.as_str();
            let of_stage = times
                .entry(name)
                .or_insert_with(|| vec![Duration::ZERO; runs.len()]);
            of_stage[i] += stage.duration;
            if i == 0 {
                *instances.entry(name).or_default() += 1;
            }
        }
    }
    let least = |name: &str| times[name].iter().min().copied().unwrap_or_default();
    let sum: Duration = times.keys().map(|name| least(name)).sum();
    let mut names: Vec<&str> = times.keys().copied().collect();
    names.sort_by_key(|name| std::cmp::Reverse(least(name)));
    println!(
        "{:<18} {:>9} {:>9} {:>9} {:>7}",
        "stage", "instances", "least ms", "median ms", "share"
    );
    for name in names {
        println!(
            "{name:<18} {:>9} {:>9.2} {:>9.2} {:>6.1}%",
            instances[name],
            milliseconds(least(name)),
            milliseconds(median(&times[name])),
            100.0 * least(name).as_secs_f64() / sum.as_secs_f64()
        );
    }
    println!("{:<28} {:>9.2}", "all stages", milliseconds(sum));
}

fn row(what: &str, runs: &[Run]) {
    let times: Vec<Duration> = runs.iter().map(|run| run.took).collect();
    let least = times.iter().min().copied().unwrap_or_default();
    println!(
        "{what:<37} {:>9.1} {:>9.1}",
        milliseconds(least),
        milliseconds(median(&times))
    );
}

fn median(times: &[Duration]) -> Duration {
    let mut sorted = times.to_vec();
    sorted.sort();
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

fn milliseconds(time: Duration) -> f64 {
    1e3 * time.as_secs_f64()
}
