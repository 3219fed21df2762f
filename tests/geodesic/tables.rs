//! Tables, followed paths and single paths against the exact solver.

use crate::meshes::{Random, all, bipyramid, compact, cylinder, grid, jittered, sphere_cap};
use egg::geodesic::{GeodesicError, Geodesics, Grounds, Known, Reach, Table};
use egg::project::model::Axis;
use egg::surface::{HalfEdge, Mesh, ReadOptions, Side, SubMesh, SurfacePoint, read_obj};

/// Points evenly along the shortest path between two vertices close to places in plan.
fn row(mesh: &Mesh, from: [f64; 2], to: [f64; 2], count: usize) -> Vec<SurfacePoint> {
    let near = |[x, y]: [f64; 2]| {
        let far = |v: &u32| {
            let p = mesh.position(*v);
            (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)
        };
        (0..mesh.vertex_count())
            .min_by(|v, w| far(v).total_cmp(&far(w)))
            .unwrap()
    };
    let ends = [near(from), near(to)].map(SurfacePoint::Vertex);
    let path = Geodesics::new(mesh).shortest(&ends[0], &ends[1]).unwrap();
    let share = |i: usize| i as f64 / (count - 1) as f64;
    (0..count)
        .map(|i| path.point_at(mesh, path.length * share(i)))
        .collect()
}

/// Compares all pairs with the exact solver's, and directions where the path is the same.
fn compare(name: &str, mesh: &Mesh, from: &[SurfacePoint], to: &[SurfacePoint]) -> Table {
    let geodesics = Geodesics::new(mesh);
    let table = geodesics.table(from, to).unwrap();
    let certificate = table.certificate;
    assert_eq!(
        certificate.exact + certificate.proven,
        from.len() * to.len(),
        "{name}"
    );
    for (i, source) in from.iter().enumerate() {
        let field = geodesics.field(source, Reach::Targets(to)).unwrap();
        for (j, target) in to.iter().enumerate() {
            let pair = table.pair(i, j);
            let truth = field.arrival(target).unwrap();
            let error = (pair.length - truth.length).abs() / truth.length;
            assert!(
                error < 1e-12,
                "{name}, {i} to {j} ({:?}): {} for {}",
                table.known(i, j),
                pair.length,
                truth.length
            );
            assert!((pair.start.direction.norm() - 1.0).abs() < 1e-12);
            assert!(source.bary_in(mesh, pair.start.face).is_some());
            assert!(target.bary_in(mesh, pair.end.face).is_some());
        }
    }
    table
}

/// Both tables of a square patch, an eighth inside a surface over [-1, 1]² scaled.
fn patch(name: &str, mesh: &Mesh, half: [f64; 2], count: usize) -> [Table; 2] {
    let [x, y] = half;
    let at = |a: [f64; 2], b: [f64; 2]| row(mesh, a, b, count);
    let (low, high) = (at([-x, -y], [x, -y]), at([-x, y], [x, y]));
    let (left, right) = (at([-x, -y], [-x, y]), at([x, -y], [x, y]));
    [
        compare(name, mesh, &low, &high),
        compare(name, mesh, &left, &right),
    ]
}

#[test]
fn tables_over_a_hill_hold_the_shortest_paths_on_either_side() {
    for seed in 0..3 {
        let hill = |x: f64, y: f64| 0.5 * (-4.0 * (x * x + y * y)).exp();
        let mesh = jittered([30, 30], [2.0, 2.0], 0.3, seed, all, hill);
        for table in patch("hill", &mesh, [0.8, 0.8], 24) {
            // Some pairs have the hill beside them; those that have it between them are solved.
            let certificate = table.certificate;
            assert_eq!(certificate.grounds, Grounds::Compared);
            assert_eq!(table.known(0, 5), Known::Proven);
            assert!(certificate.proven > 0 && certificate.exact > 0);
        }
    }
}

#[test]
fn tables_of_caps_valleys_and_slivers_are_exact() {
    let cap = sphere_cap(30, 2.0, 0.6);
    patch("cap", &cap, [0.8, 0.8], 24);
    let valley = |x: f64, y: f64| 0.3 * (2.0 * x).sin() * (3.0 * y).cos();
    patch(
        "valley",
        &jittered([30, 30], [2.0, 2.0], 0.3, 1, all, valley),
        [0.8, 0.8],
        20,
    );
    let slope = |x: f64, y: f64| 0.3 * x * x + 0.1 * x * y;
    patch(
        "slivers",
        &jittered([100, 8], [2.0, 2.0], 0.2, 2, all, slope),
        [0.8, 0.8],
        20,
    );
}

#[test]
fn tables_on_a_torus_need_no_solve_before_geodesics_focus() {
    // The outside of a torus, where it is curved like a sphere, and its saddle inside.
    let torus = |x: f64, y: f64| {
        let r = (x * x + (y + 1.6) * (y + 1.6)).sqrt() - 1.6;
        (0.9 * 0.9 - r * r).max(0.0).sqrt()
    };
    let mesh = jittered([40, 40], [1.6, 1.6], 0.3, 5, all, torus);
    for table in patch("torus", &mesh, [0.6, 0.6], 24) {
        assert_eq!(table.certificate.solves, 0);
    }
}

#[test]
fn tables_of_a_quarter_of_the_great_court_are_exact() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/projects/great-court/great-court.obj"
    );
    let options = ReadOptions {
        metres_per_unit: 1.0,
        up: Axis::Z,
        side: Side::Upper,
    };
    let read = read_obj(&std::fs::read(file).unwrap(), &options).unwrap();
    let surface = read.value.mesh;
    // A disc: the ring is cut open.
    let south = |face: &u32| surface.corners(*face).iter().all(|p| p.y < -1.0);
    let faces: Vec<u32> = (0..surface.face_count()).filter(south).collect();
    let part = SubMesh::new(&surface, &faces);
    let mesh = part.mesh();
    for side in [-1.0, 1.0] {
        let low = row(mesh, [side * 6.0, -46.0], [side * 30.0, -46.0], 9);
        let high = row(mesh, [side * 12.0, -26.0], [side * 30.0, -16.0], 9);
        let table = compare("Great Court", mesh, &low, &high);
        assert_eq!(table.certificate.grounds, Grounds::Compared);
    }
}

#[test]
fn tables_between_borders_and_around_holes_are_exact() {
    let wave = |x: f64, y: f64| 0.2 * (2.0 * x + y).sin();
    let mesh = jittered([20, 20], [2.0, 2.0], 0.3, 3, all, wave);
    patch("borders", &mesh, [1.0, 1.0], 16);
    let hole = |i: usize, j: usize| !((8..12).contains(&i) && (7..13).contains(&j));
    let mesh = jittered([20, 20], [2.0, 2.0], 0.3, 4, hole, wave);
    patch("hole", &mesh, [0.8, 0.8], 16);
    let tube = cylinder(10, 1.0, 2.0, 1.0);
    let ring = |first: u32| -> Vec<SurfacePoint> {
        (first..first + 16).map(SurfacePoint::Vertex).collect()
    };
    let below = 10 * 30;
    compare("tube", &tube, &ring(0), &ring(below));
}

#[test]
fn on_a_saddle_no_solve_is_needed_because_geodesics_are_unique() {
    let mesh = grid(24, 24, [false; 2], all, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        [x, y, 0.5 * (x * x - y * y)]
    });
    for table in patch("saddle", &mesh, [0.8, 0.8], 24) {
        let certificate = table.certificate;
        assert_eq!(certificate.grounds, Grounds::Unique);
        assert_eq!((certificate.solves, certificate.exact), (0, 0));
    }
    // A hole lets geodesics pass on both sides.
    let holed = grid(
        24,
        24,
        [false; 2],
        |i, j| !((10..14).contains(&i) && (10..14).contains(&j)),
        |u, v| {
            let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
            [x, y, 0.5 * (x * x - y * y)]
        },
    );
    let [table, _] = patch("holed saddle", &holed, [0.8, 0.8], 16);
    assert_eq!(table.certificate.grounds, Grounds::Solved);
    assert_eq!(table.certificate.solves, 16);
}

#[test]
fn single_paths_are_those_of_the_exact_solver() {
    for seed in 0..40_u64 {
        let rough = |x: f64, y: f64| 0.4 * (4.0 * x).sin() * (3.0 * y).cos();
        let mesh = match seed % 4 {
            0 => bipyramid(5 + seed as usize, 0.4, seed),
            1 => jittered(
                [12, 12],
                [2.0, 2.0],
                0.6,
                seed,
                |i, j| !((4..8).contains(&i) && j > 3),
                rough,
            ),
            2 => jittered([30, 4], [1.0, 2.0], 0.6, seed, all, rough),
            _ => jittered([12, 12], [2.0, 2.0], 0.5, seed, all, rough),
        };
        let geodesics = Geodesics::new(&mesh);
        let mut random = Random(seed);
        for _ in 0..25 {
            let (from, to) = (random.point(&mesh), random.point(&mesh));
            if from == to {
                continue;
            }
            let field = geodesics.field(&from, Reach::Targets(&[to])).unwrap();
            let truth = field.distance(&to).unwrap();
            let path = geodesics.shortest(&from, &to).unwrap();
            let sum = *path.arc_lengths(&mesh).last().unwrap();
            assert!(
                (path.length - truth).abs() <= 1e-11 * truth && (sum - truth).abs() <= 1e-9 * truth,
                "seed {seed}: {from:?} to {to:?}: {} for {truth}, points {sum}",
                path.length
            );
        }
    }
}

/// The point over a place in plan.
fn above(mesh: &Mesh, [x, y]: [f64; 2]) -> SurfacePoint {
    let face = (0..mesh.face_count()).find_map(|face| {
        let [a, b, c] = mesh.corners(face);
        let area = |p: [f64; 2], q: [f64; 2]| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x);
        let [a, b, c] = [a, b, c].map(|p| [p.x, p.y]);
        let bary = [area(b, c), area(c, a), area(a, b)];
        let whole: f64 = bary.iter().sum();
        let bary = bary.map(|part| part / whole);
        (bary.iter().all(|&part| part >= 0.0)).then(|| SurfacePoint::in_face(mesh, face, bary))
    });
    face.flatten().expect("a face below")
}

#[test]
fn the_other_side_of_a_vertex_is_never_missed() {
    for seed in 0..12 {
        let mut random = Random(seed);
        let cells = 8 + (seed % 3) as usize;
        let mesh = grid(cells, cells, [false; 2], all, |u, v| {
            [2.0 * u, 2.0 * v, 0.05 * random.unit()]
        });
        // Short and long ways that pass a vertex on both sides, closely.
        for vertex in (0..mesh.vertex_count()).filter(|&v| !mesh.is_border_vertex(v)) {
            let at = mesh.position(vertex);
            let [behind, ahead] = [0, 1].map(|_| 0.005 + 0.2 * random.unit() * random.unit());
            let aside = 0.2 * random.unit() * behind * ahead / (behind + ahead);
            let across = |x: f64| -> Vec<SurfacePoint> {
                let place = |i: u32| aside * (f64::from(i) / 3.5 - 1.0);
                (0..8).map(|i| above(&mesh, [x, at.y + place(i)])).collect()
            };
            let (from, to) = (across(at.x - behind), across(at.x + ahead));
            compare("beside a vertex", &mesh, &from, &to);
            let geodesics = Geodesics::new(&mesh);
            for (p, q) in from.iter().zip(&to) {
                let truth = geodesics.field(p, Reach::Targets(&[*q])).unwrap();
                let truth = truth.distance(q).unwrap();
                let found = geodesics.shortest(p, q).unwrap().length;
                assert!((found - truth).abs() < 1e-12 * truth, "{found} for {truth}");
            }
        }
    }
}

#[test]
fn a_followed_path_stays_the_shortest_where_it_is_the_only_one() {
    let mesh = jittered([24, 24], [2.0, 2.0], 0.0, 0, all, |x, y| x * y);
    let geodesics = Geodesics::new(&mesh);
    let ends = row(&mesh, [-0.8, 0.9], [0.8, 0.9], 60);
    let source = row(&mesh, [-0.8, -0.9], [0.8, -0.9], 3)[1];
    let first = geodesics.shortest(&source, &ends[0]).unwrap();
    let mut branch = geodesics.follow(&first).unwrap();
    for end in &ends[1..] {
        let truth = geodesics.shortest(&source, end).unwrap();
        let found = branch.to(end).unwrap();
        assert!((found.length - truth.length).abs() < 1e-12);
        assert!((found.start.direction - truth.start.direction).norm() < 1e-9);
        assert!((found.end.direction - truth.end.direction).norm() < 1e-9);
    }
}

#[test]
fn tables_that_cannot_be_are_errors() {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [5.0, 0.0, 0.0],
        [6.0, 0.0, 0.0],
        [5.0, 1.0, 0.0],
    ];
    let faces = vec![[0, 1, 2], [3, 4, 5]];
    let two = compact(points.iter().map(|&p| p.into()).collect(), faces);
    let geodesics = Geodesics::new(&two);
    let [here, there, beyond] = [0, 1, 4].map(SurfacePoint::Vertex);
    let error = |from: &[SurfacePoint], to: &[SurfacePoint]| geodesics.table(from, to).unwrap_err();
    assert_eq!(
        error(&[here], &[there, beyond]),
        GeodesicError::Unreachable { target: beyond }
    );
    assert_eq!(
        error(&[here, there], &[there]),
        GeodesicError::Coincident { point: there }
    );
    // On a rough surface a loop may be shortest among its neighbours.
    let rough = jittered([6, 6], [6.0, 6.0], 0.2, 3, all, |x, y| 3.0 * (x * y).sin());
    let middles = [30, 31, 32].map(|face| SurfacePoint::Face {
        face,
        bary: [1.0 / 3.0; 3],
    });
    assert_eq!(
        Geodesics::new(&rough)
            .table(&middles[..2], &middles[1..])
            .unwrap_err(),
        GeodesicError::Coincident { point: middles[1] }
    );
    let nowhere = SurfacePoint::Edge {
        half_edge: HalfEdge(99),
        at: 0.5,
    };
    assert_eq!(
        error(&[nowhere], &[there]),
        GeodesicError::InvalidPoint { point: nowhere }
    );
    assert!(
        geodesics
            .table(&[], &[there])
            .is_ok_and(|t| t.certificate.exact == 0)
    );
    assert_eq!(
        geodesics.shortest(&here, &beyond).unwrap_err(),
        GeodesicError::Unreachable { target: beyond }
    );
    assert_eq!(
        geodesics.shortest(&here, &here).unwrap_err(),
        GeodesicError::Coincident { point: here }
    );
}
