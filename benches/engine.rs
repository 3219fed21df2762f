//! Figures of the incremental engine, on stages that do nothing: what remains is the engine.
//!
//! Whole processes are measured where a user would feel them: this program starts itself with
//! the name of a case, so that start-up, reading the record and looking at the outputs count. The
//! smallest of several runs is the honest figure on a busy machine; the median stands beside it.
//!
//! ```text
//! cargo bench --bench engine
//! ```

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    clippy::exit,
    reason = "a benchmark prints, and stops where something is wrong"
)]

use egg::build::{
    Built, CancelToken, Engine, Files, Graph, How, Node, Numerics, Request, Settings, Stage, canon,
};
use egg::diagnostics::Warned;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The shape of a made-up project.
#[derive(Clone, Copy)]
struct Shape {
    patches: u32,
    /// Stages in the chain of each patch.
    depth: u32,
    /// Published files.
    files: u32,
    /// Bytes of each result.
    bytes: usize,
    /// Input of the first patch, to be edited.
    edited: u32,
}

/// 12 patches with 120 stages and 40 files, results of 40 kB.
const PAVILION: Shape = Shape {
    patches: 12,
    depth: 9,
    files: 40,
    bytes: 40_000,
    edited: 0,
};

const LARGE: Shape = Shape {
    patches: 100,
    depth: 50,
    files: 40,
    bytes: 200,
    edited: 0,
};

const FIRST: Stage<(u32, u32, u64), (), Vec<u8>> = Stage {
    name: "first",
    version: 1,
    numerics: Numerics::Portable,
    run: |(patch, edited, bytes), (), _| Ok(plain(vec![(*patch + *edited) as u8; *bytes as usize])),
};

type Step = (f64, [f64; 3], String);

const NEXT: Stage<Step, Node<Vec<u8>>, Vec<u8>> = Stage {
    name: "next",
    version: 1,
    numerics: Numerics::Portable,
    run: |(step, _, _), before, _| {
        let mut value = before.clone();
        value[0] = value[0].wrapping_add(*step as u8);
        Ok(plain(value))
    },
};

const NAMES: Stage<Vec<String>, (), Vec<String>> = Stage {
    name: "names",
    version: 1,
    numerics: Numerics::Portable,
    run: |names, (), _| Ok(plain(names.clone())),
};

const FILES: Stage<u32, Vec<Node<Vec<u8>>>, Files> = Stage {
    name: "files",
    version: 1,
    numerics: Numerics::Portable,
    run: |count, all, _| {
        let mut files = Files::new();
        for index in 0..*count {
            let from = all[index as usize % all.len()];
            files.push(format!("sheets/{index:02}.dxf"), from.clone());
        }
        Ok(plain(files))
    },
};

fn plain<T>(value: T) -> Warned<T> {
    Warned {
        value,
        warnings: Vec::new(),
    }
}

fn declare(shape: Shape, g: &mut Graph<'_>) {
    let names = (0..shape.patches)
        .map(|index| format!("p{index}"))
        .collect();
    let names = g.add(&NAMES, "", names, ());
    g.unfold(names, move |g, names: &Vec<String>| {
        let last = names.iter().enumerate().map(|(index, name)| {
            let edited = if index == 0 { shape.edited } else { 0 };
            let input = (index as u32, edited, shape.bytes as u64);
            let mut node = g.add(&FIRST, name, input, ());
            for step in 1..shape.depth {
                let input = (f64::from(step), [0.5; 3], name.clone());
                node = g.add(&NEXT, format!("{name}.{step}"), input, node);
                g.origin(node, "[0]", "patches.step");
            }
            node
        });
        let last: Vec<_> = last.collect();
        let files = g.add(&FILES, "", shape.files, last);
        g.publish(files);
    });
}

fn build(directory: &Path, shape: Shape, jobs: usize) -> Built {
    let mut settings = Settings::new(directory.join("cache"), directory.join("out"));
    settings.jobs = jobs;
    Engine::open(settings).build(
        &Request::default(),
        &|g| declare(shape, g),
        &CancelToken::default(),
        &mut |_| {},
    )
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, case, directory] = &arguments[..]
        && let Some(shape) = shape(case)
    {
        let built = build(Path::new(directory), shape, 2);
        std::process::exit(i32::from(built.count(How::Ran) > 0));
    }
    println!("case                                         min ms   median ms");
    idle(
        "nothing to do, 12 patches, 110 stages",
        "pavilion",
        PAVILION,
    );
    idle("nothing to do, 5 002 stages", "large", LARGE);
    edit();
    overhead();
    let mut times = cargo();
    report("cargo build, nothing to do, one empty crate", &mut times);
    hashing();
}

fn shape(case: &str) -> Option<Shape> {
    match case {
        "pavilion" => Some(PAVILION),
        "large" => Some(LARGE),
        _ => None,
    }
}

/// Whole processes that find nothing to do.
fn idle(title: &str, case: &str, shape: Shape) {
    let directory = tempfile::tempdir().unwrap();
    build(directory.path(), shape, 2);
    let program = std::env::current_exe().unwrap();
    let mut times = repeat(40, || {
        let mut command = Command::new(&program);
        let status = command.arg(case).arg(directory.path()).status().unwrap();
        assert!(status.success(), "something ran");
    });
    report(title, &mut times);
    let record = directory.path().join("cache/v1/worktrees");
    let file = std::fs::read_dir(record).unwrap().next().unwrap().unwrap();
    println!(
        "  record of the last build: {} kB",
        file.metadata().unwrap().len() / 1000
    );
}

/// One patch of twelve edited: a chain of nine stages and the files.
fn edit() {
    let directory = tempfile::tempdir().unwrap();
    let mut shape = PAVILION;
    build(directory.path(), shape, 2);
    let mut times = repeat(20, || {
        shape.edited += 1;
        let built = build(directory.path(), shape, 2);
        assert_eq!(built.count(How::Ran), 10);
    });
    report("one patch of twelve edited, 10 stages run", &mut times);
}

/// A cold build of stages that do nothing, by stage.
fn overhead() {
    for (title, bytes) in [("records only", 200), ("results of 40 kB", 40_000)] {
        let shape = Shape {
            bytes,
            patches: 50,
            depth: 20,
            ..PAVILION
        };
        let mut times = repeat(5, || {
            let directory = tempfile::tempdir().unwrap();
            let built = build(directory.path(), shape, 2);
            assert_eq!(built.count(How::Ran), 1002);
        });
        for time in &mut times {
            *time /= 1002;
        }
        report(&format!("overhead by executed stage, {title}"), &mut times);
    }
}

fn cargo() -> Vec<Duration> {
    let directory = tempfile::tempdir().unwrap();
    let manifest = "[package]\nname = \"empty\"\nversion = \"0.1.0\"\nedition = \"2024\"\n";
    std::fs::write(directory.path().join("Cargo.toml"), manifest).unwrap();
    std::fs::create_dir(directory.path().join("src")).unwrap();
    std::fs::write(directory.path().join("src/lib.rs"), "").unwrap();
    let run = || {
        let mut command = Command::new(env!("CARGO"));
        command.args(["build", "--offline", "--quiet"]);
        command
            .current_dir(directory.path())
            .env_remove("CARGO_TARGET_DIR");
        let status = command.stderr(Stdio::null()).status().unwrap();
        assert!(status.success());
    };
    run();
    repeat(20, run)
}

/// How fast an input becomes a key.
fn hashing() {
    let input: Vec<[f64; 3]> = (0..1_000_000).map(|i| [f64::from(i); 3]).collect();
    let mut out = Vec::new();
    let times = repeat(5, || {
        out.clear();
        canon::encode(&input, &mut out).unwrap();
        std::hint::black_box(egg::build::Digest::of(&out));
    });
    let best = times.iter().min().unwrap().as_secs_f64();
    let megabytes = 24.0;
    println!("input to key: {:.2} GB/s of f64", megabytes / best / 1000.0);
    let times = repeat(5, || {
        std::hint::black_box(egg::build::Digest::of(&out));
    });
    let best = times.iter().min().unwrap().as_secs_f64();
    println!("digest: {:.2} GB/s", out.len() as f64 / best / 1e9);
}

fn repeat(count: usize, mut run: impl FnMut()) -> Vec<Duration> {
    (0..count)
        .map(|_| {
            let begin = Instant::now();
            run();
            begin.elapsed()
        })
        .collect()
}

fn report(title: &str, times: &mut [Duration]) {
    times.sort();
    let ms = |time: Duration| time.as_secs_f64() * 1000.0;
    let (min, median) = (ms(times[0]), ms(times[times.len() / 2]));
    println!("{title:<43} {min:8.2} {median:9.2}");
}
