//! What a comparison costs: two plans of a thousand members, of which a third changed, in every
//! format; and two revisions of a project through the program, compiled before.
//!
//! `cargo bench --bench diff -- 20` makes twenty runs of each instead of seven.

#![expect(clippy::print_stdout, reason = "a benchmark prints")]

use egg::diff::{
    Content, Context, Difference, Look, MARKDOWN_LIMIT, Pictures, between, html, markdown, svg,
    text,
};
use egg::plan::{LamellaRecord, MemberRecord, OpeningRecord, PatchRecord, Plan};
use egg::project::model::Family;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

/// Patches, and members of each family in each.
const PATCHES: usize = 25;
const MEMBERS: usize = 20;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let runs = match arguments.iter().find_map(|argument| argument.parse().ok()) {
        Some(runs) => runs,
        // `cargo test --benches` only wants to know that it works.
        None if arguments.iter().any(|argument| argument == "--test") => 1,
        None => 7,
    };
    let before = structure(0.0);
    let after = structure(0.4e-3);
    println!(
        "{} members, {} openings",
        before.members.len(),
        openings(&before)
    );
    println!("{:40} {:>9} {:>9}", "", "least ms", "median ms");
    let compare = |pictures| {
        let context = Context {
            pictures,
            ..Context::default()
        };
        between(Content::Plan(&before), Content::Plan(&after), context)
    };
    row("compare", runs, || compare(Pictures::Without).changes.len());
    row("compare with drawings", runs, || {
        compare(Pictures::With).drawings.len()
    });
    let difference: Difference = compare(Pictures::With);
    assert!(difference.changes.len() > PATCHES, "a third changed");
    row("text", runs, || text(&difference, Look::Plain).len());
    row("Markdown", runs, || {
        markdown(&difference, MARKDOWN_LIMIT).len()
    });
    row("JSON", runs, || difference.to_json().len());
    row("SVG", runs, || svg(&difference).len());
    row("HTML", runs, || html(&difference).len());
    revisions(runs);
}

/// The program on two revisions of the pavilion, or of the desktop model where there is none.
fn revisions(runs: usize) {
    let projects = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects");
    let name = if projects.join("pavilion").exists() {
        "pavilion"
    } else {
        "desktop"
    };
    let place = tempfile::tempdir().expect("a temporary directory");
    let copy = |file: &str| {
        let from = projects.join(name).join(file);
        std::fs::copy(from, place.path().join(file)).expect("a copy");
    };
    let (project, mesh) = (format!("{name}.toml"), format!("{name}.obj"));
    copy(&project);
    copy(&mesh);
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::new(program)
            .args(arguments)
            .current_dir(place.path())
            .env("EGG_CACHE_DIR", place.path().join("cache"))
            .output()
            .expect("it runs");
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        output.stdout.len()
    };
    let git = |arguments: &[&str]| {
        let who = ["-c", "user.name=Ada", "-c", "user.email=ada@example.org"];
        run("git", &[&who[..], arguments].concat())
    };
    git(&["init", "--quiet"]);
    git(&["add", &project, &mesh]);
    git(&["commit", "--quiet", "--message", "Start"]);
    let path = place.path().join(&project);
    let words = std::fs::read_to_string(&path).expect("a project");
    let wider = words.replacen("width = ", "width = 1", 1);
    std::fs::write(path, wider).expect("a project");
    git(&["commit", "--quiet", "--all", "--message", "Wider"]);
    let egg = env!("CARGO_BIN_EXE_egg");
    run(egg, &["diff", "HEAD~1", "HEAD", &project]);
    for format in ["text", "markdown", "svg", "html", "json"] {
        let what = format!("egg diff HEAD~1 HEAD {project}, {format}");
        let arguments = ["diff", "HEAD~1", "HEAD", &project, "--format", format];
        row(&what, runs, || run(egg, &arguments));
    }
}

fn row(what: &str, runs: usize, mut f: impl FnMut() -> usize) {
    let mut times: Vec<Duration> = (0..runs)
        .map(|_| {
            let begin = Instant::now();
            assert!(f() > 0, "{what}");
            begin.elapsed()
        })
        .collect();
    times.sort();
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "{what:40} {:>9.1} {:>9.1}",
        ms(times[0]),
        ms(times[runs / 2])
    );
}

fn openings(plan: &Plan) -> usize {
    plan.lamellae
        .iter()
        .map(|lamella| lamella.openings.len())
        .sum()
}

/// Square patches of a metre beside each other; every third is longer by so much.
fn structure(longer: f64) -> Plan {
    let mut plan = Plan {
        name: "large".to_owned(),
        ..Plan::default()
    };
    plan.surface.bounding_box = [[0.0; 3], [PATCHES as f64, 1.0, 0.5]];
    for patch in 0..PATCHES {
        let name = format!("p{patch:02}");
        let x = patch as f64;
        let length = 1.0 + if patch % 3 == 0 { longer } else { 0.0 };
        plan.patches.push(square(&name, length));
        for (family, letter) in [(Family::U, 'u'), (Family::V, 'v')] {
            for index in 1..=MEMBERS {
                let share = (index - 1) as f64 / (MEMBERS - 1) as f64;
                let id = format!("{name}.{letter}{index:02}");
                plan.members
                    .push(member(&id, &name, family, index, [x, share, length]));
                let openings = (1..=MEMBERS).map(|crossed| {
                    let at = length * (crossed - 1) as f64 / (MEMBERS - 1) as f64;
                    let [u, v] = if letter == 'u' {
                        [index, crossed]
                    } else {
                        [crossed, index]
                    };
                    OpeningRecord::Notch {
                        from: at,
                        to: at + 0.01,
                        diameter: 0.0052,
                        crossing: format!("{name}.u{u:02}-v{v:02}"),
                    }
                });
                plan.lamellae.push(LamellaRecord {
                    id: id.clone(),
                    member: id,
                    material: "ash".to_owned(),
                    length: length + 0.03,
                    end_margin: 0.015,
                    width: 0.03,
                    thickness: 0.003,
                    mass: 0.06,
                    openings: openings.collect(),
                    pieces: Vec::new(),
                });
            }
        }
    }
    plan
}

fn member(
    id: &str,
    patch: &str,
    family: Family,
    index: usize,
    [x, share, length]: [f64; 3],
) -> MemberRecord {
    let place = |t: f64| match family {
        Family::U => [x + share, t],
        Family::V => [x + t, share],
    };
    let polyline = (0..=30).map(|k| {
        let t = length * f64::from(k) / 30.0;
        let [x, y] = place(t);
        [x, y, 0.3 * t * (length - t)]
    });
    MemberRecord {
        id: id.to_owned(),
        patch: patch.to_owned(),
        family,
        index: index as u32,
        start: share,
        end: share,
        boundary: index == 1 || index == MEMBERS,
        length_surface: length,
        length_planar: length,
        polyline: polyline.collect(),
        planar: [place(0.0), place(length)],
    }
}

fn square(name: &str, length: f64) -> PatchRecord {
    let side = &serde_json::json!({ "edges": [], "length": length });
    let json = serde_json::json!({
        "id": name,
        "corners": ["a", "b", "c", "d"],
        "sides": [side, side, side, side],
        "alpha_surface": 90.0,
        "alpha_planar": 60.0,
        "planar_corners": [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        "diagonals": { "e": 1.4, "f": 1.4, "e_planar": 1.6, "f_planar": 1.2 },
        "eta": { "u": 1.0, "v": 1.0 },
        "curvature": {
            "max": 0.1, "peak": [0.0, 0.0, 0.0], "injectivity_bound": null, "longest_geodesic": 1.4
        },
        "cladding": {
            "u": { "samples": [[0.0, 0.0], [1.0, 1.0]], "slope_min": 1.0, "slope_max": 1.0 },
            "v": { "samples": [[0.0, 0.0], [1.0, 1.0]], "slope_min": 1.0, "slope_max": 1.0 }
        },
        "feasible": true
    });
    serde_json::from_value(json).expect("a patch")
}
