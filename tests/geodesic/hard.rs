//! What makes other implementations fail: each case gives the right answer or an error value.

use crate::brute;
use crate::meshes::{Random, all, bipyramid, compact, cylinder, grid, jittered};
use egg::geodesic::{GeodesicError, Geodesics, Reach};
use egg::surface::generate::{Grid, Pattern};
use egg::surface::{HalfEdge, Mesh, Point3, SurfacePoint};

fn mesh(points: &[[f64; 3]], faces: &[[u32; 3]]) -> Mesh {
    compact(points.iter().map(|&p| p.into()).collect(), faces.to_vec())
}

fn distance(mesh: &Mesh, from: SurfacePoint, to: SurfacePoint) -> f64 {
    let geodesics = Geodesics::new(mesh);
    let field = geodesics.field(&from, Reach::Targets(&[to])).unwrap();
    let distance = field.distance(&to).unwrap();
    if distance > 0.0 {
        let path = field.path_to(&to).unwrap();
        assert!((path.length - distance).abs() <= 1e-10 * distance + 1e-15);
        let sum = *path.arc_lengths(mesh).last().unwrap();
        assert!((sum - distance).abs() <= 1e-10 * distance + 1e-15);
    }
    distance
}

#[test]
fn a_source_on_a_border_edge_sees_the_whole_face() {
    let mesh = jittered([6, 6], [3.0, 3.0], 0.0, 0, all, |_, _| 0.0);
    for at in [1e-9, 0.25, 0.5, 1.0 - 1e-9] {
        for h in (0..3 * mesh.faces().len() as u32).map(HalfEdge) {
            if mesh.twin(h).is_none() {
                let source = SurfacePoint::Edge { half_edge: h, at };
                let geodesics = Geodesics::new(&mesh);
                let field = geodesics.field(&source, Reach::Everywhere).unwrap();
                for v in 0..mesh.positions().len() as u32 {
                    let truth = (mesh.position(v) - source.position(&mesh)).norm();
                    assert!((field.vertex_distance(v).unwrap() - truth).abs() < 1e-14);
                }
            }
        }
    }
}

#[test]
fn points_within_rounding_of_vertices_and_edges_are_these() {
    let mesh = jittered([5, 5], [2.0, 2.0], 0.5, 7, all, |x, y| (x * y).sin());
    let face = 20;
    let corner = SurfacePoint::Vertex(mesh.faces()[face as usize][0]);
    let far = SurfacePoint::Vertex(mesh.positions().len() as u32 - 1);
    let exact = distance(&mesh, corner, far);
    for off in [0.0, 5e-17, 1e-15, 1e-13, 1e-12, 1e-11, 1e-9] {
        let near = SurfacePoint::Face {
            face,
            bary: [1.0 - 2.0 * off, off, off],
        };
        let along = SurfacePoint::Edge {
            half_edge: HalfEdge::new(face, 0),
            at: off,
        };
        for point in [near, along] {
            assert!((distance(&mesh, point, far) - exact).abs() < 1e-13 + off);
            assert!((distance(&mesh, far, point) - exact).abs() < 1e-13 + off);
            assert!(distance(&mesh, point, corner) <= 2.0 * off);
        }
        let beside = SurfacePoint::Face {
            face,
            bary: [0.5 - off, 0.5, off],
        };
        let on = SurfacePoint::Edge {
            half_edge: HalfEdge::new(face, 0),
            at: 0.5,
        };
        let difference = distance(&mesh, beside, far) - distance(&mesh, on, far);
        assert!(difference.abs() < 1e-13 + off);
    }
    let negative = SurfacePoint::Face {
        face,
        bary: [-5.6e-17, 1.0, 0.0],
    };
    assert!(distance(&mesh, negative, far) > 0.0);
}

#[test]
fn flat_regions_with_vertices_in_line_are_crossed_straight() {
    let mesh = grid(20, 20, [false; 2], all, |u, v| [u, v, 0.0]);
    let geodesics = Geodesics::new(&mesh);
    for source in [0, 10, 210, 220, 440] {
        let field = geodesics
            .field(&SurfacePoint::Vertex(source), Reach::Everywhere)
            .unwrap();
        for v in (0..441).filter(|&v| v != source) {
            let truth = (mesh.position(v) - mesh.position(source)).norm();
            let path = field.path_to(&SurfacePoint::Vertex(v)).unwrap();
            assert!((path.length - truth).abs() < 1e-14);
        }
    }
}

#[test]
fn paths_go_round_a_reentrant_corner_and_a_hole() {
    // An L: bent at its inner corner. Cells of size 1.
    let corner = grid(
        8,
        8,
        [false; 2],
        |i, j| i < 4 || j < 4,
        |u, v| [8.0 * u, 8.0 * v, 0.0],
    );
    let at = |m: &Mesh, x: f64, y: f64| {
        let p = Point3::new(x, y, 0.0);
        let v = m.positions().iter().position(|q| (q - p).norm() < 1e-12);
        SurfacePoint::Vertex(v.unwrap() as u32)
    };
    let found = distance(&corner, at(&corner, 8.0, 0.0), at(&corner, 0.0, 8.0));
    assert!((found - 2.0 * 32.0_f64.sqrt()).abs() < 1e-13);
    let found = distance(&corner, at(&corner, 8.0, 3.0), at(&corner, 3.0, 8.0));
    assert!((found - 2.0 * 17.0_f64.sqrt()).abs() < 1e-13);
    // Along the border, through all its vertices.
    let found = distance(&corner, at(&corner, 8.0, 4.0), at(&corner, 4.0, 4.0));
    assert!((found - 4.0).abs() < 1e-14);
    let hole = grid(
        9,
        9,
        [false; 2],
        |i, j| !((3..6).contains(&i) && (3..6).contains(&j)),
        |u, v| [9.0 * u, 9.0 * v, 0.0],
    );
    let found = distance(&hole, at(&hole, 0.0, 4.0), at(&hole, 9.0, 4.0));
    assert!((found - (2.0 * 10.0_f64.sqrt() + 3.0)).abs() < 1e-13);
}

#[test]
fn needles_and_caps_are_no_obstacle() {
    // A flat square triangulated with angles down to 1e-7.
    for thin in [1e-2, 1e-4, 1e-7] {
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.5, thin, 0.0],
            [0.5, 1.0 - thin, 0.0],
            [0.5, 0.5, 0.0],
            [0.5 + thin, 0.5, 0.0],
        ];
        let faces = [
            [0, 1, 4],
            [2, 3, 5],
            [0, 4, 6],
            [4, 7, 6],
            [4, 1, 7],
            [1, 2, 7],
            [7, 2, 5],
            [7, 5, 6],
            [6, 5, 3],
            [0, 6, 3],
        ];
        let square = mesh(&points, &faces);
        let mut random = Random(3);
        for _ in 0..200 {
            let (from, to) = (random.point(&square), random.point(&square));
            let truth = (from.position(&square) - to.position(&square)).norm();
            let found = distance(&square, from, to);
            assert!(
                (found - truth).abs() < 1e-12,
                "{thin}: {from:?} {to:?} {found} {truth}"
            );
        }
    }
}

#[test]
fn rough_needles_agree_with_the_exhaustive_search() {
    for seed in 0..20 {
        let mesh = jittered([10, 1], [0.4, 3.0], 0.6, seed, all, |x, y| {
            (9.0 * x + y).sin()
        });
        let geodesics = Geodesics::new(&mesh);
        let mut random = Random(seed);
        let source = random.point(&mesh);
        let targets: Vec<_> = (0..10).map(|_| random.point(&mesh)).collect();
        let field = geodesics.field(&source, Reach::Targets(&targets)).unwrap();
        let truth = brute::distances(&mesh, &source, &targets);
        for (target, truth) in targets.iter().zip(truth) {
            assert!((field.distance(target).unwrap() - truth).abs() < 1e-12);
        }
    }
}

#[test]
fn equal_branches_give_either_path() {
    // Opposite columns of a cylinder: both ways round are as long.
    let mesh = cylinder(8, 1.0, 2.0, 1.0);
    for (from, to) in [(0, 12), (24, 12), (0, 12 + 5 * 24), (30, 42)] {
        let (from, to) = (SurfacePoint::Vertex(from), SurfacePoint::Vertex(to));
        let there = distance(&mesh, from, to);
        let back = distance(&mesh, to, from);
        assert!((there - back).abs() < 1e-14);
    }
    // The poles of a bipyramid with equal sides: many branches.
    let mut points = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    points.extend([
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
    ]);
    let faces = [
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 2],
        [1, 3, 2],
        [1, 4, 3],
        [1, 5, 4],
        [1, 2, 5],
    ];
    let octahedron = mesh_of(&points, &faces);
    let found = distance(
        &octahedron,
        SurfacePoint::Vertex(0),
        SurfacePoint::Vertex(1),
    );
    assert!((found - 6.0_f64.sqrt()).abs() < 1e-14);
}

fn mesh_of(points: &[[f64; 3]], faces: &[[u32; 3]]) -> Mesh {
    mesh(points, faces)
}

#[test]
fn another_component_is_unreachable_and_no_sentinel_leaks() {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [5.0, 0.0, 0.0],
        [6.0, 0.0, 0.0],
        [5.0, 1.0, 0.0],
    ];
    let two = mesh(&points, &[[0, 1, 2], [3, 4, 5]]);
    let geodesics = Geodesics::new(&two);
    let here = SurfacePoint::Vertex(0);
    let inside = SurfacePoint::Face {
        face: 1,
        bary: [0.2, 0.3, 0.5],
    };
    for there in [SurfacePoint::Vertex(4), inside] {
        let error = GeodesicError::Unreachable { target: there };
        assert_eq!(geodesics.shortest(&here, &there).unwrap_err(), error);
        let everywhere = geodesics.field(&here, Reach::Everywhere).unwrap();
        assert_eq!(everywhere.distance(&there).unwrap_err(), error);
    }
    let everywhere = geodesics.field(&here, Reach::Everywhere).unwrap();
    assert_eq!(everywhere.vertex_distance(4), None);
    assert_eq!(everywhere.vertex_distance(99), None);
}

#[test]
fn beyond_the_reach_nothing_is_said() {
    let mesh = jittered([10, 10], [4.0, 4.0], 0.4, 1, all, |x, y| {
        0.3 * (x * y).sin()
    });
    let geodesics = Geodesics::new(&mesh);
    let source = SurfacePoint::Vertex(60);
    let all = geodesics.field(&source, Reach::Everywhere).unwrap();
    let near = geodesics.field(&source, Reach::Radius(1.0)).unwrap();
    for v in 0..mesh.positions().len() as u32 {
        let truth = all.vertex_distance(v).unwrap();
        let expected = (truth <= 1.0).then_some(truth);
        assert_eq!(near.vertex_distance(v), expected);
        let target = SurfacePoint::Vertex(v);
        match near.distance(&target) {
            Ok(d) => assert_eq!(d, truth),
            Err(e) => assert_eq!(e, GeodesicError::BeyondReach { target }),
        }
    }
    let far = SurfacePoint::Face {
        face: 0,
        bary: [0.3, 0.3, 0.4],
    };
    assert_eq!(
        near.distance(&far).unwrap_err(),
        GeodesicError::BeyondReach { target: far }
    );
    for radius in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            geodesics.field(&source, Reach::Radius(radius)),
            Err(GeodesicError::InvalidRadius { .. })
        ));
    }
}

#[test]
fn what_is_no_point_of_the_mesh_is_refused() {
    let mesh = bipyramid(6, 0.5, 1);
    let geodesics = Geodesics::new(&mesh);
    let edge = |h: u32, at: f64| SurfacePoint::Edge {
        half_edge: HalfEdge(h),
        at,
    };
    let face = |face: u32, bary: [f64; 3]| SurfacePoint::Face { face, bary };
    for wrong in [
        SurfacePoint::Vertex(8),
        SurfacePoint::Vertex(u32::MAX),
        edge(36, 0.5),
        edge(u32::MAX, 0.5),
        edge(0, f64::NAN),
        edge(0, -0.1),
        edge(0, 1.1),
        face(12, [0.3, 0.3, 0.4]),
        face(0, [f64::NAN, 0.5, 0.5]),
        face(0, [f64::INFINITY, 0.5, 0.5]),
        face(0, [-0.1, 0.6, 0.5]),
        face(0, [0.5, 0.6, 0.5]),
        face(0, [0.0; 3]),
    ] {
        let refused = |e: GeodesicError| matches!(e, GeodesicError::InvalidPoint { .. });
        let right = SurfacePoint::Vertex(0);
        assert!(refused(
            geodesics
                .field(&wrong, Reach::Everywhere)
                .map(|_| ())
                .unwrap_err()
        ));
        assert!(refused(geodesics.shortest(&right, &wrong).unwrap_err()));
        let field = geodesics.field(&right, Reach::Everywhere).unwrap();
        assert!(refused(field.distance(&wrong).unwrap_err()));
    }
}

#[test]
fn a_point_is_at_distance_zero_from_itself_and_has_no_path_there() {
    let mesh = bipyramid(6, 0.5, 1);
    let geodesics = Geodesics::new(&mesh);
    let mut random = Random(5);
    for _ in 0..20 {
        let point = random.point(&mesh);
        let field = geodesics.field(&point, Reach::Targets(&[point])).unwrap();
        assert_eq!(field.distance(&point), Ok(0.0));
        assert!(matches!(
            field.path_to(&point),
            Err(GeodesicError::Coincident { .. })
        ));
    }
}

#[test]
fn a_face_without_directions_is_an_error() {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let double = mesh(&points, &[[0, 1, 2], [0, 2, 3]]);
    let error = Geodesics::new(&double)
        .shortest(&SurfacePoint::Vertex(0), &SurfacePoint::Vertex(1))
        .unwrap_err();
    assert_eq!(error, GeodesicError::DegenerateFace { face: 1 });
    let nan = mesh(
        &[[0.0, 0.0, 0.0], [1.0, f64::NAN, 0.0], [0.0, 1.0, 0.0]],
        &[[0, 1, 2]],
    );
    assert!(
        Geodesics::new(&nan)
            .field(&SurfacePoint::Vertex(0), Reach::Everywhere)
            .is_err()
    );
}

#[test]
fn a_face_of_no_area_is_crossed() {
    // A T-junction closed by a cap: the vertex lies on the long side.
    let points = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, -1.0, 0.0],
    ];
    let faces = [[0, 1, 2], [0, 3, 1], [0, 4, 3], [3, 4, 1]];
    let cap = mesh(&points, &faces);
    let mut random = Random(11);
    for _ in 0..100 {
        let (from, to) = (random.point(&cap), random.point(&cap));
        let truth = (from.position(&cap) - to.position(&cap)).norm();
        assert!(
            (distance(&cap, from, to) - truth).abs() < 1e-12,
            "{from:?} {to:?}"
        );
    }
}

#[test]
fn two_ways_that_tie_at_a_vertex_leave_the_points_beyond_to_the_nearer_one() {
    // A flat grid full of holes, where ways on both sides of a hole are as long to the bit.
    let hole = |i: usize, j: usize| (i * 7 + j * 13 + 506).is_multiple_of(9) && i > 0 && j > 0;
    let mesh = jittered(
        [40, 10],
        [2.0, 2.0],
        0.0,
        506,
        |i, j| !hole(i, j),
        |_, _| 0.0,
    );
    let geodesics = Geodesics::new(&mesh);
    let [from, to] = [192, 403].map(SurfacePoint::Vertex);
    // Round the corner at (0.45, 0.2).
    let truth = 0.05_f64.hypot(0.4) + 0.25_f64.hypot(0.6);
    for (from, to) in [(from, to), (to, from)] {
        let field = geodesics.field(&from, Reach::Everywhere).unwrap();
        let found = field.distance(&to).unwrap();
        assert!((found - truth).abs() < 1e-13, "{found} instead of {truth}");
    }
}

#[test]
fn behind_rows_of_saddles_as_flat_as_rounding_every_vertex_is_reached() {
    // A hill runs out: along its axis the excess of the saddles falls through all orders.
    let grid = Grid {
        u: [-22.0, 22.0],
        v: [-3.5, 3.5],
        cells: [88, 14],
        pattern: Pattern::Alternating,
    };
    let mesh = grid.mesh(|x, y| {
        let square = (x + 9.0) * (x + 9.0) + y * y;
        Point3::new(x, y, 3.2 * (-square / 18.0).exp())
    });
    let geodesics = Geodesics::new(&mesh);
    let axis: Vec<u32> = (0..mesh.vertex_count())
        .filter(|&v| mesh.position(v).y == 0.0)
        .collect();
    let distances = |from: u32| -> Vec<f64> {
        let field = geodesics
            .field(&SurfacePoint::Vertex(from), Reach::Everywhere)
            .unwrap();
        let all = (0..mesh.vertex_count()).map(|v| field.vertex_distance(v));
        all.map(|distance| distance.expect("reached")).collect()
    };
    let rows: Vec<Vec<f64>> = axis.iter().map(|&v| distances(v)).collect();
    for (i, &v) in axis.iter().enumerate() {
        for (j, &w) in axis.iter().enumerate() {
            let (there, back) = (rows[i][w as usize], rows[j][v as usize]);
            assert!((there - back).abs() <= 1e-12 * there, "{v} {w}");
        }
    }
}
