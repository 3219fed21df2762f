//! What holds on every surface: metric axioms, the first variation, paths that are their length.

use crate::meshes::{Random, all, bipyramid, jittered};
use egg::geodesic::{Geodesics, Known, Path, Reach, derivative_along};
use egg::surface::{HalfEdge, Mesh, SurfacePoint, Tangent};
use proptest::prelude::*;

/// Rough height fields with notches and holes, closed fans.
fn surface(seed: u64) -> Mesh {
    let mut random = Random(seed);
    let (a, b, c) = (
        random.unit() * 1.5,
        random.unit() * 6.0,
        random.unit() * 6.0,
    );
    let height = move |x: f64, y: f64| a * (b * x).sin() * (c * y).cos();
    match random.below(4) {
        0 => bipyramid(4 + random.below(20), random.unit(), seed),
        1 => jittered(
            [9, 8],
            [2.0, 2.0],
            0.6,
            seed,
            |i, j| i < 4 || !(2..6).contains(&j),
            height,
        ),
        2 => jittered(
            [8, 8],
            [2.0, 2.0],
            0.6,
            seed,
            |i, j| !(3..6).contains(&i) || !(3..5).contains(&j),
            height,
        ),
        _ => jittered([16, 4], [1.0, 2.0], 0.6, seed, |_, _| true, height),
    }
}

/// A path is straight in every face and its pieces add up to its length; its ends are right.
fn check_path(mesh: &Mesh, path: &Path, from: SurfacePoint, to: SurfacePoint) {
    assert_eq!(path.points.len(), path.faces.len() + 1);
    let ends = [from, to].map(|p| p.position(mesh));
    let line = path.polyline(mesh);
    assert!((line[0] - ends[0]).norm() < 1e-11);
    assert!((line[line.len() - 1] - ends[1]).norm() < 1e-11);
    for (pair, &face) in path.points.windows(2).zip(&path.faces) {
        assert!(pair.iter().all(|p| p.bary_in(mesh, face).is_some()));
    }
    let sum = path.arc_lengths(mesh)[path.faces.len()];
    assert!((sum - path.length).abs() <= 1e-10 * path.length);
    for (tangent, piece) in [(path.start, 0), (path.end, path.faces.len() - 1)] {
        let along = line[piece + 1] - line[piece];
        assert!((tangent.direction.norm() - 1.0).abs() < 1e-12);
        if along.norm() > 1e-3 * path.length {
            assert!((along.normalize() - tangent.direction).norm() < 1e-9);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn distance_is_a_metric_and_paths_are_as_long(seed in any::<u64>()) {
        let mesh = surface(seed);
        let geodesics = Geodesics::new(&mesh);
        let mut random = Random(seed ^ 1);
        let points: Vec<_> = (0..6).map(|_| random.point(&mesh)).collect();
        let mut table = Vec::new();
        for (i, source) in points.iter().enumerate() {
            let field = geodesics.field(source, Reach::Targets(&points)).unwrap();
            let whole = geodesics.field(source, Reach::Everywhere).unwrap();
            let row: Vec<f64> = points.iter().map(|p| field.distance(p).unwrap()).collect();
            for (j, target) in points.iter().enumerate() {
                if target != source {
                    check_path(&mesh, &field.path_to(target).unwrap(), *source, *target);
                }
                if i != j {
                    // Early termination and solving anew change nothing.
                    prop_assert!((whole.distance(target).unwrap() - row[j]).abs() < 1e-13);
                }
            }
            table.push(row);
        }
        for i in 0..points.len() {
            prop_assert_eq!(table[i][i], 0.0);
            for j in 0..points.len() {
                prop_assert!((table[i][j] - table[j][i]).abs() <= 1e-12);
                let chord = (points[i].position(&mesh) - points[j].position(&mesh)).norm();
                prop_assert!(table[i][j] >= chord - 1e-12);
                for k in 0..points.len() {
                    prop_assert!(table[i][j] <= table[i][k] + table[k][j] + 1e-12);
                }
            }
        }
    }

    #[test]
    fn the_first_variation_is_the_difference_quotient(seed in any::<u64>()) {
        let mesh = surface(seed);
        let geodesics = Geodesics::new(&mesh);
        let mut random = Random(seed ^ 2);
        let target = random.point(&mesh);
        let field = geodesics.field(&target, Reach::Everywhere).unwrap();
        let face = random.below(mesh.faces().len()) as u32;
        let h = HalfEdge::new(face, random.below(3) as u32);
        let at = 0.2 + 0.6 * random.unit();
        let here = SurfacePoint::Edge { half_edge: h, at };
        let length = mesh.edge_vector(h).norm();
        let moving = Tangent { face, direction: mesh.edge_vector(h) / length };
        let step = 1e-5;
        let [back, middle, on] = [-step, 0.0, step].map(|s| {
            let point = SurfacePoint::Edge { half_edge: h, at: at + s };
            field.distance(&point).unwrap()
        });
        // At a ridge of the distance the path jumps and there is no derivative.
        let [left, right] = [(middle - back), (on - middle)].map(|d| d / (step * length));
        prop_assume!(middle > 1e-3 && (left - right).abs() < 1e-2);
        let path = field.path_to(&here).unwrap().reversed();
        let slope = derivative_along(&mesh, &here, &moving, &path.start).unwrap();
        prop_assert!((slope - 0.5 * (left + right)).abs() < 6e-3, "{} {} {}", slope, left, right);
    }

    #[test]
    fn points_along_a_path_are_at_their_arc_length(seed in any::<u64>()) {
        let mesh = surface(seed);
        let geodesics = Geodesics::new(&mesh);
        let mut random = Random(seed ^ 3);
        let (from, to) = (random.point(&mesh), random.point(&mesh));
        prop_assume!(from != to);
        let path = geodesics.shortest(&from, &to).unwrap();
        let back = path.reversed().reversed();
        prop_assert_eq!(&back, &path);
        for share in [0.0, 0.3, 0.5, 0.9, 1.0] {
            let s = share * path.length;
            let point = path.point_at(&mesh, s);
            let found = geodesics.field(&from, Reach::Targets(&[point])).unwrap();
            prop_assert!((found.distance(&point).unwrap() - s).abs() < 1e-9 * path.length.max(0.1));
            let tangent = path.tangent_at(&mesh, s);
            prop_assert!((tangent.direction.norm() - 1.0).abs() < 1e-12);
            prop_assert!(mesh.face_normal(tangent.face).dot(&tangent.direction).abs() < 1e-6);
        }
    }

    #[test]
    fn tables_between_any_rows_are_exact(seed in any::<u64>()) {
        let mut random = Random(seed);
        let cells = [[12, 12], [24, 24], [40, 10], [60, 6]][random.below(4)];
        let uneven = [0.0, 0.3, 0.6, 0.8][random.below(4)];
        let (rise, wave, hill) = (
            0.6 * random.unit(),
            1.0 + 3.0 * random.unit(),
            [0.0, 0.4][random.below(2)],
        );
        let mesh = jittered(cells, [2.0, 2.0], uneven, seed, all, |x, y| {
            let hill = hill * (-6.0 * (x * x + y * y)).exp();
            rise * (wave * x).sin() * ((wave + 0.7) * y).cos() + hill
        });
        let geodesics = Geodesics::new(&mesh);
        let mut row = || -> Option<Vec<SurfacePoint>> {
            let (from, to) = (random.point(&mesh), random.point(&mesh));
            let path = geodesics.field(&from, Reach::Targets(&[to])).ok()?.path_to(&to).ok()?;
            let at = |i: usize| path.point_at(&mesh, path.length * i as f64 / 11.0);
            Some((0..12).map(at).collect())
        };
        let (Some(from), Some(to)) = (row(), row()) else {
            return Ok(()); // two equal points
        };
        let Ok(table) = geodesics.table(&from, &to) else {
            return Ok(()); // rows that meet
        };
        for (i, source) in from.iter().enumerate() {
            let field = geodesics.field(source, Reach::Targets(&to)).unwrap();
            for (j, target) in to.iter().enumerate() {
                let (found, truth) = (table.pair(i, j).length, field.distance(target).unwrap());
                prop_assert!(
                    (found - truth).abs() <= 1e-11 * truth,
                    "{i} to {j}, {:?}: {found} for {truth}",
                    table.known(i, j)
                );
                prop_assert!(table.known(i, j) != Known::Open);
            }
        }
    }
}
