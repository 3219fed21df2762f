//! Reading mesh files: what is nasty but sound is read, what is wrong is told with its line.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::format_collect, reason = "large texts are made once")]

use egg::diagnostics::{Diagnostic, Place, Severity};
use egg::project::model::Axis;
use egg::surface::generate::{self, Grid, Pattern};
use egg::surface::{
    HalfEdge, Mesh, NoVertex, Point3, ReadOptions, Side, SurfaceMesh, read_obj, write_obj,
};
use proptest::prelude::*;
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
            Place::Key(key) | Place::Name(key) => format!("key `{key}`"),
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

#[test]
fn the_meshes_of_the_projects_read_without_a_word() {
    for (path, vertices, faces) in [
        ("projects/desktop/desktop.obj", 4036, 7840),
        ("projects/saddle/saddle.obj", 4090, 7942),
        ("projects/sphere-cap/sphere-cap.obj", 4076, 7974),
    ] {
        let read = read_obj(&std::fs::read(root(path)).unwrap(), &METRES).unwrap();
        assert_eq!(read.warnings, [], "{path}");
        let mesh = &read.value.mesh;
        assert_eq!((mesh.vertex_count(), mesh.face_count()), (vertices, faces));
        assert_eq!(read.value.vertex(17), Ok(17), "no vertex is renumbered");
    }
}

/// A mesh with everything that a mesh may have: seams, patterns, a hole's worth of quads.
fn sample() -> Mesh {
    let grid = Grid {
        u: [-1.0, 2.0],
        v: [0.0, 1.5],
        cells: [7, 5],
        pattern: Pattern::Irregular { seed: 11 },
    };
    generate::bump(0.4, 0.6, &grid)
}

fn read(text: &str, options: &ReadOptions) -> SurfaceMesh {
    let read = read_obj(text.as_bytes(), options).unwrap();
    assert_eq!(read.warnings, []);
    read.value
}

#[test]
fn a_written_mesh_reads_back_equal() {
    let mesh = sample();
    let back = read(&write_obj(&mesh, "a bump\nC:\\"), &METRES).mesh;
    assert_eq!(back.faces(), mesh.faces());
    for (p, q) in back.positions().iter().zip(mesh.positions()) {
        assert!((p - q).amax() <= 0.500_001e-9);
    }
    assert_eq!(write_obj(&back, ""), write_obj(&mesh, ""));
}

#[test]
fn comments_names_and_order_of_attributes_do_not_change_the_result() {
    let text = write_obj(&sample(), "");
    let plain = read(&text, &METRES);
    let dressed = format!("\u{feff}# exported today\r\no thing\r\n{text}vn 0 0 1\r\n")
        .replace("f ", "s 1\nf ")
        .replace('\n', "\r\n");
    let dressed = read(&dressed, &METRES);
    assert_eq!(plain, dressed);
    assert_eq!(plain.mesh.fingerprint(), dressed.mesh.fingerprint());
    let moved = read(&text.replacen("0.", "0.1", 1), &METRES);
    assert_ne!(plain.mesh.fingerprint(), moved.mesh.fingerprint());
    let bytes = postcard::to_stdvec(&plain).unwrap();
    assert_eq!(postcard::from_bytes::<SurfaceMesh>(&bytes).unwrap(), plain);
}

#[test]
fn units_and_axes_place_the_surface() {
    let text = "v 100 200 300\nv 101 200 300\nv 100 201 300.5\nf 1 2 3\n";
    let corner = |up| {
        let options = ReadOptions {
            metres_per_unit: 0.001,
            up,
            side: Side::Upper,
        };
        let mesh = read_obj(text.as_bytes(), &options).unwrap().value.mesh;
        (mesh.position(0).coords * 1000.0).map(f64::round).data.0[0]
    };
    assert_eq!(corner(Axis::Z), [100.0, 200.0, 300.0]);
    assert_eq!(corner(Axis::Y), [100.0, -300.0, 200.0]);
    assert_eq!(corner(Axis::X), [-300.0, 200.0, 100.0]);
}

#[test]
fn the_chosen_side_does_not_depend_on_the_rotation_in_the_file() {
    let up = write_obj(&sample(), "");
    let down: String = up
        .lines()
        .map(|line| match line.strip_prefix("f ") {
            Some(corners) => {
                let mut corners: Vec<_> = corners.split(' ').collect();
                corners.reverse();
                format!("f {}\n", corners.join(" "))
            }
            None => format!("{line}\n"),
        })
        .collect();
    for side in [Side::Upper, Side::Lower] {
        let options = ReadOptions { side, ..METRES };
        for text in [&up, &down] {
            let mesh = read(text, &options).mesh;
            let z: f64 = (0..mesh.face_count()).map(|f| mesh.face_cross(f).z).sum();
            assert_eq!(z > 0.0, side == Side::Upper);
        }
    }
    let ball = write_obj(&generate::sphere(1.0, 3), "");
    let read = read_obj(ball.as_bytes(), &METRES).unwrap().value.mesh;
    assert!(
        read.face_cross(0)
            .dot(&read.position(read.faces()[0][0]).coords)
            > 0.0
    );
}

#[test]
fn anchors_find_their_vertex_by_its_record() {
    // Records 0 and 4 weld, record 1 is unused, record 5 is the second position of a seam.
    let text = "v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 3 4\nf 6 7 4\nf 5 5 6\n";
    let surface = read_obj(text.as_bytes(), &METRES).unwrap().value;
    assert_eq!(surface.mesh.vertex_count(), 4);
    let found: Vec<_> = (0..8).map(|record| surface.vertex(record)).collect();
    let unused = Err(NoVertex::Unused);
    let beyond = Err(NoVertex::OutOfRange { records: 7 });
    assert_eq!(
        found,
        [Ok(0), unused, Ok(1), Ok(2), Ok(0), Ok(1), Ok(3), beyond]
    );
}

#[test]
fn large_hostile_files_end_soon() {
    // One polygon of 1e6 corners; a fan of 3e5 faces on one edge; 2e5 faces that share nothing.
    let points: String = (0..1000).map(|i| format!("v {i} {} 0\n", i * i)).collect();
    let polygon = format!("{points}f{}\n", " 1 2 3 4 5".repeat(200_000));
    let fan = format!("{points}{}", "f 1 2 3\nf 2 1 4\nf 1 2 5\n".repeat(100_000));
    let crumbs: String = (0..200_000)
        .map(|i| format!("v {i} 0 0\nv {i} 1 0\nv {i} 0 1\nf -3 -2 -1\n"))
        .collect();
    let crowd: String = (0..100_000)
        .map(|i| format!("v 0 0 {i}e-12\nv 1 0 {i}e-12\nv 0 1 {i}e-12\nf -3 -2 -1\n"))
        .collect();
    let huge = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967295\nf 1 2 -4294967295\n".to_owned();
    for text in [polygon, fan, crumbs, crowd, huge] {
        let start = std::time::Instant::now();
        assert!(read_obj(text.as_bytes(), &METRES).is_err());
        // Linear work takes well under a second; quadratic work would take minutes.
        assert!(start.elapsed().as_secs() < 10);
    }
}

/// Bytes of a corpus file, damaged.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let files: Vec<Vec<u8>> = {
        let mut paths: Vec<_> = std::fs::read_dir(root("tests/corpus/meshes"))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        paths.sort();
        paths
            .iter()
            .map(|path| std::fs::read(path).unwrap())
            .collect()
    };
    let pieces = prop::sample::select(vec![
        "f 1 2 3\n",
        "f 1 3 4 5 6\n",
        "v 0 0 0\n",
        "v 1 1 1e-300\n",
        "v 1e300 0 0\n",
        "v nan 0 0\n",
        "f -1 -2 -3\n",
        "\\\n",
        "#",
        "/",
        "\r",
        "-",
        "1e8",
        "\0",
        "\u{feff}",
        " 0 ",
        "f 4 3 2 1\n",
    ]);
    let edits = prop::collection::vec(
        (
            any::<prop::sample::Index>(),
            0..6_usize,
            pieces,
            any::<u8>(),
        ),
        1..12,
    );
    (prop::sample::select(files), edits).prop_map(|(mut bytes, edits)| {
        for (at, kind, piece, byte) in edits {
            let i = at.index(bytes.len() + 1);
            let rest = bytes.len() - i;
            match kind {
                0 => drop(bytes.splice(i..i, piece.bytes())),
                1 if rest > 0 => bytes[i] = byte,
                2 if rest > 0 => drop(bytes.remove(i)),
                3 => bytes.truncate(i),
                4 => drop(bytes.splice(i..i + rest.min(9), piece.bytes())),
                _ => {
                    let tail = bytes[i..].to_vec();
                    bytes.extend(tail);
                }
            }
            bytes.truncate(20_000);
        }
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 4000, ..Default::default() })]

    #[test]
    fn damaged_files_give_a_sound_mesh_or_errors_with_places(bytes in damaged()) {
        match read_obj(&bytes, &METRES) {
            Ok(read) => {
                let mesh = &read.value.mesh;
                prop_assert!(mesh.face_count() > 0);
                prop_assert!(mesh.positions().iter().all(|p| p.iter().all(|c| c.abs() <= 1e8)));
                for f in 0..mesh.face_count() {
                    prop_assert!(mesh.face_cross(f).norm() > 0.0);
                }
                prop_assert!(read.warnings.iter().all(|w| w.severity != Severity::Error));
            }
            Err(errors) => {
                prop_assert!(errors.iter().any(|e| e.severity == Severity::Error));
                prop_assert!(errors.len() < 60);
                for place in errors.iter().flat_map(|e| &e.labels).map(|label| &label.place) {
                    if let Place::Bytes { range, .. } = place {
                        prop_assert!(range.start <= range.end && range.end <= bytes.len());
                    }
                }
            }
        }
    }

    #[test]
    fn the_order_of_faces_and_vertices_changes_numbers_only(seed in any::<u64>()) {
        let mesh = sample();
        let n = mesh.vertex_count() as usize;
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by_key(|&v| (v as u64 + 1).wrapping_mul(seed | 1));
        let mut place = vec![0; n];
        for (new, &old) in order.iter().enumerate() {
            place[old] = new + 1;
        }
        let mut text = String::new();
        for &v in &order {
            let p = mesh.positions()[v];
            writeln!(text, "v {} {} {}", p.x, p.y, p.z).unwrap();
        }
        for (i, face) in mesh.faces().iter().enumerate().rev() {
            let turn = (i as u64).wrapping_mul(seed) as usize % 3;
            let mut corners = face.map(|v| place[v as usize]);
            corners.rotate_left(turn);
            writeln!(text, "f {} {} {}", corners[0], corners[1], corners[2]).unwrap();
        }
        let back = read(&text, &METRES);
        prop_assert!((back.mesh.area() - mesh.area()).abs() < 1e-14 * mesh.area());
        for (old, &new) in place.iter().enumerate() {
            let vertex = back.vertex(new as u32 - 1).unwrap();
            prop_assert_eq!(back.mesh.position(vertex), mesh.positions()[old]);
            prop_assert_eq!(
                back.mesh.outgoing(vertex).count(),
                mesh.outgoing(old as u32).count()
            );
        }
    }

    #[test]
    fn turned_faces_are_turned_back(picks in prop::collection::vec(any::<prop::sample::Index>(), 1..25)) {
        let mesh = sample();
        let mut faces = mesh.faces().to_vec();
        let mut picks: Vec<_> = picks.iter().map(|pick| pick.index(faces.len())).collect();
        picks.sort_unstable();
        picks.dedup();
        for &pick in &picks {
            faces[pick].swap(1, 2);
        }
        let read = read_obj(obj(mesh.positions(), &faces).as_bytes(), &METRES).unwrap();
        prop_assert_eq!(read.value.mesh, mesh);
        prop_assert_eq!(read.warnings.len(), 1);
        let count = format!("{} face", picks.len());
        prop_assert!(read.warnings[0].message.starts_with(&count));
    }

    #[test]
    fn caps_are_taken_out_without_leaving_a_slit(
        picks in prop::collection::vec((any::<prop::sample::Index>(), 0.1..0.9_f64), 1..12),
    ) {
        // On some edges one of the two faces gets another vertex, and a face without area fills
        // the gap, as meshers do where they meet finer patches.
        let mesh = sample();
        let mut positions = mesh.positions().to_vec();
        let mut faces = mesh.faces().to_vec();
        let edges: Vec<HalfEdge> = mesh.edges().collect();
        let mut split = vec![false; faces.len()];
        for (pick, share) in picks {
            let h = edges[pick.index(edges.len())];
            if std::mem::replace(&mut split[h.face() as usize], true) {
                continue;
            }
            let [a, b, c] = [h, h.next(), h.prev()].map(|h| mesh.origin(h));
            let m = positions.len() as u32;
            positions.push(positions[a as usize] + mesh.edge_vector(h) * share);
            faces[h.face() as usize] = [a, m, c];
            faces.push([m, b, c]);
            faces.push([a, b, m]);
        }
        let read = read_obj(obj(&positions, &faces).as_bytes(), &METRES).unwrap();
        let back = &read.value.mesh;
        prop_assert!((back.area() - mesh.area()).abs() < 1e-12);
        prop_assert!((0..back.face_count()).all(|f| back.face_cross(f).norm() > 1e-6));
        // A slit would add to the border, whose length stays.
        let border = |mesh: &Mesh| -> f64 {
            let outer = mesh.half_edges().filter(|&h| mesh.twin(h).is_none());
            outer.map(|h| mesh.edge_vector(h).norm()).sum()
        };
        prop_assert!((border(back) - border(&mesh)).abs() < 1e-12);
        prop_assert!(read.warnings.iter().all(|w| w.code.as_str() == "W0303"));
    }
}

/// OBJ text with all digits.
fn obj(positions: &[Point3], faces: &[[u32; 3]]) -> String {
    let vertices = positions
        .iter()
        .map(|p| format!("v {} {} {}\n", p.x, p.y, p.z));
    let faces = faces
        .iter()
        .map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    vertices.chain(faces).collect()
}
