//! Reading, building and measuring meshes of 8,000 and 40,000 faces.

use criterion::{Criterion, criterion_group, criterion_main};
use egg::project::model::Axis;
use egg::surface::generate::{self, Grid, Pattern};
use egg::surface::{
    Curvature, Locator, Mesh, Point3, ReadOptions, Side, SubMesh, read_obj, write_obj,
};
use std::hint::black_box;

fn mesh(cells: u32) -> Mesh {
    let grid = Grid {
        u: [-1.0, 1.0],
        v: [-1.0, 1.0],
        cells: [cells; 2],
        pattern: Pattern::Irregular { seed: 1 },
    };
    generate::bump(0.5, 0.4, &grid)
}

fn surface(c: &mut Criterion) {
    let options = ReadOptions {
        metres_per_unit: 1.0,
        up: Axis::Z,
        side: Side::Upper,
    };
    for cells in [63, 141] {
        let mesh = mesh(cells);
        let text = write_obj(&mesh, "");
        let mut group = c.benchmark_group(format!("surface/{}", mesh.face_count()));
        group.sample_size(20);
        group.bench_function("read_obj", |b| {
            b.iter(|| read_obj(black_box(text.as_bytes()), &options));
        });
        group.bench_function("mesh", |b| {
            b.iter(|| Mesh::new(mesh.positions().to_vec(), mesh.faces().to_vec()));
        });
        group.bench_function("curvature", |b| b.iter(|| Curvature::estimate(&mesh)));
        group.bench_function("locator", |b| b.iter(|| Locator::new(&mesh)));
        let locator = Locator::new(&mesh);
        group.bench_function("closest_and_topmost_1000", |b| {
            b.iter(|| {
                for i in 0..1000 {
                    let x = 1e-3 * f64::from(i) - 0.5;
                    black_box(locator.closest(&Point3::new(x, 0.3 * x, 0.2)));
                    black_box(locator.topmost([x, -0.7 * x]).ok());
                }
            });
        });
        let half: Vec<u32> = (0..mesh.face_count() / 2).collect();
        group.bench_function("submesh", |b| b.iter(|| SubMesh::new(&mesh, &half)));
        group.finish();
    }
}

criterion_group!(benches, surface);
criterion_main!(benches);
