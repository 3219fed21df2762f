//! Any bytes as a mesh file: a surface that everything can be asked of, or reasons that lie in
//! the file.

#![no_main]

use egg::diagnostics::{Diagnostic, Place};
use egg::project::model::Axis;
use egg::surface::{Curvature, Locator, ReadOptions, Side, read_obj, write_obj};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let options = ReadOptions {
        metres_per_unit: 1.0,
        up: Axis::Z,
        side: Side::Upper,
    };
    match read_obj(bytes, &options) {
        Ok(read) => {
            in_file(&read.warnings, bytes.len());
            let mesh = &read.value.mesh;
            let _ = Curvature::estimate(mesh);
            let locator = Locator::new(mesh);
            let _ = locator.closest(&mesh.positions()[0]);
            // What egg writes, egg reads, and finds nothing to repair in it.
            let again = read_obj(write_obj(mesh, "").as_bytes(), &options).expect("a written mesh");
            assert_eq!(again.value.mesh.face_count(), mesh.face_count());
        }
        Err(told) => {
            assert!(!told.is_empty());
            in_file(&told, bytes.len());
        }
    }
});

fn in_file(told: &[Diagnostic], length: usize) {
    for label in told.iter().flat_map(|diagnostic| &diagnostic.labels) {
        if let Place::Bytes { range, .. } = &label.place {
            assert!(range.start <= range.end && range.end <= length);
        }
    }
}
