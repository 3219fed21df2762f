//! Bytes as a small rough surface with holes, and points on it: distances are the same both ways,
//! single paths and tables agree with them, and what has no distance is an error.

#![no_main]

use egg::geodesic::{GeodesicError, Geodesics, Reach};
use egg::surface::{Mesh, Point3, SurfacePoint};
use libfuzzer_sys::fuzz_target;

/// Cells along both sides.
const CELLS: usize = 6;

fuzz_target!(|bytes: &[u8]| {
    let mut bytes = bytes.iter().copied();
    let Some(mesh) = surface(&mut bytes) else {
        return;
    };
    let geodesics = Geodesics::new(&mesh);
    let mut point = || -> Option<SurfacePoint> {
        let face = u32::from(bytes.next()?) % mesh.face_count();
        let bary = [bytes.next()?, bytes.next()?, bytes.next()?].map(|b| f64::from(b / 32));
        SurfacePoint::in_face(&mesh, face, bary)
    };
    let mut points = Vec::new();
    while let (Some(next), true) = (point(), points.len() < 8) {
        points.push(next);
    }
    for from in &points {
        let Ok(field) = geodesics.field(from, Reach::Everywhere) else {
            return; // a face without directions
        };
        for to in &points {
            match (field.distance(to), geodesics.shortest(from, to)) {
                (Ok(distance), Ok(path)) => {
                    assert!((path.length - distance).abs() <= 1e-10 * distance + 1e-13);
                    let back = geodesics.field(to, Reach::Targets(&[*from]));
                    let back = back.and_then(|field| field.distance(from));
                    assert!(back.is_ok_and(|b| (b - distance).abs() <= 1e-10 * distance + 1e-13));
                }
                (Ok(distance), Err(GeodesicError::Coincident { .. })) => assert!(distance < 1e-9),
                (Err(one), Err(other)) => assert_eq!(one, other),
                (Ok(_), Err(GeodesicError::Untraceable { .. })) => {}
                (one, other) => panic!("{one:?} but {other:?}"),
            }
        }
    }
    let (from, to) = points.split_at(points.len() / 2);
    if let Ok(table) = geodesics.table(from, to) {
        for (i, source) in from.iter().enumerate() {
            let field = geodesics.field(source, Reach::Targets(to)).expect("a row of the table");
            for (j, target) in to.iter().enumerate() {
                let truth = field.distance(target).expect("a pair of the table");
                let found = table.pair(i, j).length;
                assert!((found - truth).abs() <= 1e-10 * truth);
            }
        }
    }
});

/// A grid of heights; cells with the height 255 are missing.
fn surface(bytes: &mut impl Iterator<Item = u8>) -> Option<Mesh> {
    let row = CELLS + 1;
    let mut positions = Vec::new();
    for i in 0..row * row {
        let (x, y) = ((i % row) as f64, (i / row) as f64);
        positions.push(Point3::new(x, y, f64::from(bytes.next()?) / 64.0));
    }
    let mut faces = Vec::new();
    for i in 0..CELLS * CELLS {
        let kind = bytes.next()?;
        if kind == 255 {
            continue;
        }
        let a = (i % CELLS + i / CELLS * row) as u32;
        let (b, c, d) = (a + 1, a + row as u32 + 1, a + row as u32);
        faces.extend(if kind % 2 == 0 {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, b, d], [b, c, d]]
        });
    }
    let mut ids = vec![u32::MAX; positions.len()];
    let mut used = Vec::new();
    for v in faces.iter_mut().flatten() {
        let id = &mut ids[*v as usize];
        if *id == u32::MAX {
            *id = used.len() as u32;
            used.push(positions[*v as usize]);
        }
        *v = *id;
    }
    Mesh::new(used, faces).ok().filter(|mesh| mesh.face_count() > 0)
}
