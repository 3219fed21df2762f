//! Against pygeodesic.

use crate::meshes::{all, bipyramid, cylinder, jittered, sphere_cap, torus};
use crate::python::pygeodesic;
use egg::geodesic::{Geodesics, Reach};
use egg::surface::{Mesh, SurfacePoint};

fn compare(name: &str, mesh: &Mesh) {
    let count = mesh.positions().len() as u32;
    let sources = [0, count / 3, count / 2 + 7, count - 1];
    let geodesics = Geodesics::new(mesh);
    let reference = pygeodesic(mesh, &sources);
    for (&source, distances) in sources.iter().zip(&reference) {
        let field = geodesics
            .field(&SurfacePoint::Vertex(source), Reach::Everywhere)
            .unwrap();
        let mut worst: f64 = 0.0;
        for (v, &d) in distances.iter().enumerate() {
            let found = field.vertex_distance(v as u32).unwrap();
            worst = worst.max((found - d).abs() / d.max(1e-9));
        }
        assert!(worst < 1e-12, "{name}, source {source}: {worst:e}");
    }
}

#[test]
fn distances_equal_pygeodesic() {
    let bump = |x: f64, y: f64| 3.0 * (-(x * x + y * y) / 18.0).exp();
    compare("bump", &jittered([80, 60], [24.0, 18.0], 0.3, 1, all, bump));
    compare(
        "saddle",
        &jittered([60, 60], [16.0, 16.0], 0.3, 2, all, |x, y| {
            (x * x - y * y) / 25.0
        }),
    );
    compare(
        "slivers",
        &jittered([200, 10], [10.0, 10.0], 0.6, 3, all, |x, y| {
            (x * y).sin() * 0.3
        }),
    );
    compare(
        "rough",
        &jittered([40, 40], [10.0, 10.0], 0.6, 4, all, |x, y| {
            2.0 * (3.0 * x).sin() * (4.0 * y).cos()
        }),
    );
    compare(
        "holes",
        &jittered(
            [50, 50],
            [10.0, 10.0],
            0.4,
            5,
            |i, j| !((i / 5) % 2 == 1 && (j / 5) % 2 == 1),
            |x, y| (x * y / 20.0).sin(),
        ),
    );
    compare(
        "flat",
        &jittered(
            [40, 40],
            [10.0, 10.0],
            0.0,
            5,
            |i, j| !(i > 10 && i < 30 && j > 20),
            |_, _| 0.0,
        ),
    );
    compare("cylinder", &cylinder(20, 1.0, 4.0, 1.0));
    compare("torus", &torus(30, 3.0, 1.0));
    compare("cap", &sphere_cap(40, 2.0, 0.9));
    compare("bipyramid", &bipyramid(200, 0.3, 9));
}
