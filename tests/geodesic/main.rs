//! Shortest geodesics against analytic truth, the definition, and another implementation.
#![allow(
    clippy::disallowed_methods,
    reason = "truths are compared within tolerances"
)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod analytic;
mod brute;
mod hard;
mod meshes;
mod properties;
mod python;
mod reference;
mod tables;

use egg::geodesic::{Geodesics, Reach};
use egg::surface::SurfacePoint;
use meshes::{Random, all, bipyramid, jittered};

#[test]
fn distances_equal_the_exhaustive_search_on_small_meshes() {
    let mut worst: f64 = 0.0;
    for seed in 0..240_u64 {
        let amplitude = 0.6 * (seed % 5) as f64;
        let mesh = match seed % 3 {
            0 => jittered([3, 3], [1.0, 1.0], 0.7, seed, all, |x, y| {
                amplitude * ((7.0 * x + seed as f64).sin() * (5.0 * y).cos())
            }),
            1 => bipyramid(5 + (seed % 4) as usize, 0.2 + amplitude, seed),
            _ => jittered(
                [4, 3],
                [1.0, 1.0],
                0.5,
                seed,
                |i, j| !(i == 1 + (seed as usize / 3) % 2 && j >= 1),
                |x, y| 0.5 * amplitude * (x * x - y * y),
            ),
        };
        let geodesics = Geodesics::new(&mesh);
        let mut random = Random(seed);
        for _ in 0..4 {
            let source = random.point(&mesh);
            let targets: Vec<_> = (0..12)
                .map(|_| random.point(&mesh))
                .chain((0..mesh.positions().len() as u32).map(SurfacePoint::Vertex))
                .collect();
            let truth = brute::distances(&mesh, &source, &targets);
            let field = geodesics.field(&source, Reach::Targets(&targets)).unwrap();
            for (target, truth) in targets.iter().zip(truth) {
                let found = field.distance(target).unwrap();
                let error = (found - truth).abs() / truth.max(1e-3);
                assert!(
                    error < 1e-11,
                    "seed {seed}: {source:?} to {target:?}: {found} instead of {truth}"
                );
                worst = worst.max(error);
                if found > 0.0 {
                    let path = field
                        .path_to(target)
                        .unwrap_or_else(|e| panic!("seed {seed} {source:?} {target:?} {e}"));
                    let sum = *path.arc_lengths(&mesh).last().unwrap();
                    assert!(
                        (path.length - found).abs() <= 1e-11 * found,
                        "length {} {found}",
                        path.length
                    );
                    assert!((sum - found).abs() <= 1e-10 * found, "points {sum} {found}");
                    let single = geodesics.shortest(&source, target).unwrap();
                    assert!(
                        (single.length - truth).abs() <= 1e-11 * truth,
                        "seed {seed}: {source:?} to {target:?}: {} for {truth}",
                        single.length
                    );
                }
            }
        }
    }
    println!("worst relative error {worst:e}");
}
