//! Geodesics: one-to-all solves, certified tables, followed and cold paths, with the bars that they
//! are held to.
//!
//! `cargo bench --bench geodesic` measures meshes of 5,000 and 20,000 faces, `-- full` of 100,000
//! too. Where the tests have made the environment of pygeodesic, it solves from the same vertex in
//! the same run; its time for a table is that of its sources. One thread throughout.

#![expect(clippy::print_stdout, reason = "a benchmark prints")]

use egg::geodesic::{Geodesics, Reach, Table};
use egg::surface::generate::{Grid, Pattern};
use egg::surface::{Mesh, Point3, SurfacePoint};
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Points of a side.
const SIDE: usize = 64;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| arguments.iter().any(|a| a == word);
    let sizes: &[u32] = match (has("--test"), has("full")) {
        (true, _) => &[500],
        (false, false) => &[5_000, 20_000],
        (false, true) => &[5_000, 20_000, 100_000],
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .expect("the first pool of the process");
    println!("{}, one thread", machine());
    println!(
        "{:<8} {:>7} {:>9} {:>9} {:>9} {:>10} {:>6} {:>7} {:>9} {:>9}",
        "surface",
        "faces",
        "to all ms",
        "py ms",
        "py/ours",
        "2 tables",
        "py/x",
        "solves",
        "100 paths",
        "cold path"
    );
    for &faces in sizes {
        for surface in ["saddle", "cap", "torus", "bump", "sliver"] {
            row(surface, faces);
        }
    }
    println!(
        "bars     {:>7} {:>9} {:>9} {:>9} {:>10} {:>6}",
        "20000", "", "", ">= 10", "<= 400", ">= 500"
    );
    if let Some(peak) = peak_memory() {
        println!("peak of the whole run {peak:.0} MB (100,000 faces: <= 100)");
    }
}

fn row(surface: &str, faces: u32) {
    let mesh = mesh(surface, faces);
    let geodesics = Geodesics::new(&mesh);
    let source = mesh.vertex_count() / 3;
    let runs = if faces > 50_000 { 2 } else { 5 };
    let all = least(runs, || {
        let field = geodesics.field(&SurfacePoint::Vertex(source), Reach::Everywhere);
        assert!(field.is_ok(), "every vertex of a disc is reached");
    });
    let theirs = (faces <= 20_000)
        .then(|| pygeodesic(&mesh, source))
        .flatten();
    let sides = sides(&mesh, &geodesics);
    let mut tables: Vec<Table> = Vec::new();
    let both = least(runs.min(3), || {
        tables = sides
            .iter()
            .map(|[from, to]| geodesics.table(from, to).expect("sides apart"))
            .collect();
    });
    let solves: usize = tables.iter().map(|t| t.certificate.solves).sum();
    let [from, to] = &sides[0];
    let first = geodesics
        .shortest(&from[SIDE / 2], &to[0])
        .expect("two points of a disc");
    let along: Vec<SurfacePoint> = {
        let side = geodesics.shortest(&to[0], &to[SIDE - 1]).expect("a side");
        (0..100)
            .map(|i| side.point_at(&mesh, side.length * f64::from(i) / 99.0))
            .collect()
    };
    let followed = least(runs, || {
        let mut branch = geodesics.follow(&first).expect("a path of the mesh");
        for point in &along {
            assert!(branch.to(point).is_some(), "neighbours are close");
        }
    });
    let cold = least(1, || {
        for i in (0..SIDE).step_by(7) {
            let path = geodesics.shortest(&from[i], &to[SIDE - 1 - i]);
            assert!(path.is_ok(), "two points of a disc");
        }
    }) / SIDE.div_ceil(7) as f64;
    let (py, ratio, tables_ratio) = theirs.map_or(("-".into(), "-".into(), "-".into()), |t| {
        (
            format!("{t:.0}"),
            format!("{:.1}", t / all),
            format!("{:.0}", 2.0 * SIDE as f64 * t / both),
        )
    });
    println!(
        "{surface:<8} {:>7} {all:>9.1} {py:>9} {ratio:>9} {both:>10.1} {tables_ratio:>6} {solves:>7} {followed:>9.2} {cold:>9.2}",
        mesh.face_count(),
    );
}

/// Least time of some runs, milliseconds.
fn least(runs: usize, mut run: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..runs {
        let begin = Instant::now();
        run();
        least = least.min(1e3 * begin.elapsed().as_secs_f64());
    }
    least
}

/// A rectangle of nearly even faces, three tenths of a cell out of line.
fn mesh(surface: &str, faces: u32) -> Mesh {
    let ratio = if surface == "sliver" { 12.0 } else { 1.0 };
    let cells = [ratio, 1.0 / ratio].map(|r: f64| (f64::from(faces) * 0.5 * r).sqrt() as u32);
    let step = cells.map(|n| 1.6 / f64::from(n));
    let grid = Grid {
        u: [-0.8, 0.8],
        v: [-0.8, 0.8],
        cells,
        pattern: Pattern::Alternating,
    };
    grid.mesh(|u, v| {
        let inner = u.abs() < 0.8 && v.abs() < 0.8;
        let off = |salt: f64| {
            let wave = libm::sin(u * 12_989.8 + v * 78_233.1 + salt) * 43_758.5;
            if inner {
                0.3 * (wave - wave.floor() - 0.5)
            } else {
                0.0
            }
        };
        let (x, y) = (u + off(0.0) * step[0], v + off(1.0) * step[1]);
        let z = match surface {
            "saddle" => 0.5 * (x * x - y * y),
            "cap" => (4.0 - x * x - y * y).sqrt(),
            "torus" => {
                let aside = (x * x + (y + 1.6) * (y + 1.6)).sqrt() - 1.6;
                (1.0 - aside * aside).sqrt()
            }
            "bump" => 0.25 * libm::exp(-8.0 * (x * x + y * y)),
            _ => 0.3 * x * x + 0.1 * x * y,
        };
        Point3::new(x, y, z)
    })
}

/// Both pairs of opposite sides of a patch an eighth inside the border.
fn sides(mesh: &Mesh, geodesics: &Geodesics<'_>) -> [[Vec<SurfacePoint>; 2]; 2] {
    let corner = |x: f64, y: f64| {
        let far = |v: &u32| {
            let p = mesh.position(*v);
            (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)
        };
        let nearest = (0..mesh.vertex_count()).min_by(|v, w| far(v).total_cmp(&far(w)));
        SurfacePoint::Vertex(nearest.expect("a mesh has vertices"))
    };
    let [a, b, c, d] =
        [[-0.6, -0.6], [0.6, -0.6], [0.6, 0.6], [-0.6, 0.6]].map(|[x, y]| corner(x, y));
    let side = |from: &SurfacePoint, to: &SurfacePoint| -> Vec<SurfacePoint> {
        let path = geodesics.shortest(from, to).expect("corners of a disc");
        let share = |i: usize| i as f64 / (SIDE - 1) as f64;
        (0..SIDE)
            .map(|i| path.point_at(mesh, path.length * share(i)))
            .collect()
    };
    [[side(&a, &b), side(&d, &c)], [side(&a, &d), side(&b, &c)]]
}

/// Milliseconds of pygeodesic from a vertex to all, if its environment is there.
fn pygeodesic(mesh: &Mesh, source: u32) -> Option<f64> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python = root.join("target/readers/bin/python");
    if !python.exists() {
        return None;
    }
    let mut text = format!("{} {}\n", mesh.vertex_count(), mesh.face_count());
    for p in mesh.positions() {
        writeln!(text, "{:?} {:?} {:?}", p.x, p.y, p.z).ok()?;
    }
    for [a, b, c] in mesh.faces() {
        writeln!(text, "{a} {b} {c}").ok()?;
    }
    let file = tempfile::NamedTempFile::new().ok()?;
    std::fs::write(file.path(), text).ok()?;
    let output = Command::new(python)
        .arg(root.join("tests/geodesic/pygeodesic_distances.py"))
        .arg("--time")
        .arg(file.path())
        .arg(source.to_string())
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(1e3 * text.trim().parse::<f64>().ok()?)
}

fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find(|line| line.starts_with("model name"));
    let name = model.and_then(|line| line.split(": ").nth(1));
    name.unwrap_or("an unnamed processor").to_owned()
}

/// The most memory that this process has had, megabytes.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}
