//! An independent implementation: pygeodesic in a Python environment below `target/`.

use egg::surface::Mesh;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The interpreter of an environment with the packages, made if there is none.
fn python(packages: &[&str]) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/readers");
    let python = root.join(if cfg!(windows) {
        "Scripts/python.exe"
    } else {
        "bin/python"
    });
    if !python.exists() {
        let made = Command::new("python3")
            .args(["-m", "venv"])
            .arg(&root)
            .status();
        assert!(made.expect("python3 is installed").success());
    }
    for package in packages {
        let known = Command::new(&python)
            .args(["-c", &format!("import {package}")])
            .output();
        if !known.is_ok_and(|o| o.status.success()) {
            let got = Command::new(&python)
                .args(["-m", "pip", "install", "-q", package])
                .status();
            assert!(
                got.expect("pip runs").success(),
                "{package} could not be installed"
            );
        }
    }
    python
}

/// Distances from each source vertex to all vertices.
pub(crate) fn pygeodesic(mesh: &Mesh, sources: &[u32]) -> Vec<Vec<f64>> {
    let mut text = format!("{} {}\n", mesh.positions().len(), mesh.faces().len());
    for p in mesh.positions() {
        writeln!(text, "{:?} {:?} {:?}", p.x, p.y, p.z).expect("a string grows");
    }
    for [a, b, c] in mesh.faces() {
        writeln!(text, "{a} {b} {c}").expect("a string grows");
    }
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    std::io::Write::write_all(&mut file, text.as_bytes()).expect("a temporary file");
    let script =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/geodesic/pygeodesic_distances.py");
    let output = Command::new(python(&["numpy", "pygeodesic"]))
        .arg(script)
        .arg(file.path())
        .args(sources.iter().map(u32::to_string))
        .output()
        .expect("the interpreter runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8(output.stdout).expect("numbers");
    text.lines()
        .map(|line| {
            line.split(' ')
                .map(|w| w.parse().expect("a number"))
                .collect()
        })
        .collect()
}
