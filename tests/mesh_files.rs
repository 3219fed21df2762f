//! Reading mesh files: what is nasty but sound is read, what is wrong is told with its line.

use egg::diagnostics::{Diagnostic, Place, Severity};
use egg::project::model::Axis;
use egg::surface::{Mesh, ReadOptions, Side, read_obj};
use std::fmt::Write;
use std::path::{Path, PathBuf};

const METRES: ReadOptions = ReadOptions {
    metres_per_unit: 1.0,
    up: Axis::Z,
    side: Side::Upper,
};

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// A whole report as text.
fn render(bytes: &[u8]) -> String {
    let (mut text, diagnostics) = match read_obj(bytes, &METRES) {
        Ok(read) => (describe(&read.value.mesh), read.warnings),
        Err(errors) => ("refused\n".to_owned(), errors),
    };
    for diagnostic in &diagnostics {
        render_diagnostic(&mut text, bytes, diagnostic);
    }
    text
}

fn describe(mesh: &Mesh) -> String {
    let (low, high) = mesh.bounding_box();
    let size = high - low;
    format!(
        "{} vertices, {} faces, {:.6} m², {} x {} x {} m\n",
        mesh.vertex_count(),
        mesh.face_count(),
        mesh.area(),
        size.x,
        size.y,
        size.z
    )
}

fn render_diagnostic(text: &mut String, bytes: &[u8], diagnostic: &Diagnostic) {
    let severity = match diagnostic.severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let name = diagnostic.code.info().expect("a registered code").name;
    let Diagnostic { code, message, .. } = diagnostic;
    writeln!(text, "{severity}[{code} {name}]: {message}").unwrap();
    for label in &diagnostic.labels {
        let place = match &label.place {
            Place::Key(key) => format!("key `{key}`"),
            Place::Bytes { range, .. } => {
                let quoted = String::from_utf8_lossy(&bytes[range.clone()]).into_owned();
                let cut: String = quoted.chars().take(40).collect();
                format!("bytes {}..{} {cut:?}", range.start, range.end)
            }
        };
        writeln!(text, "  at {place}: {}", label.text).unwrap();
    }
    for note in &diagnostic.notes {
        writeln!(text, "  note: {note}").unwrap();
    }
    if let Some(help) = &diagnostic.help {
        writeln!(text, "  help: {help}").unwrap();
    }
}

#[test]
fn every_file_of_the_corpus_gives_its_recorded_report() {
    let mut files: Vec<PathBuf> = std::fs::read_dir(root("tests/corpus/meshes"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "obj"))
        .collect();
    files.sort();
    assert!(files.len() >= 60, "the corpus is there");
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root("tests/golden/meshes"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for file in files {
            let name = file.file_stem().unwrap().to_str().unwrap();
            insta::assert_snapshot!(name, render(&std::fs::read(&file).unwrap()));
        }
    });
}
