//! Surfaces whose geodesics are known in closed form.

use crate::meshes::{self, Random, all, compact, grid, jittered, sphere_cap};
use egg::geodesic::{Geodesics, Reach};
use egg::surface::{Mesh, Point3, SurfacePoint};
use std::f64::consts::PI;

fn relative(found: f64, truth: f64) -> f64 {
    (found - truth).abs() / truth
}

#[test]
fn in_the_plane_paths_are_straight_segments() {
    for seed in 0..4 {
        let mesh = jittered([12, 9], [4.0, 3.0], 0.6, seed, all, |_, _| 0.5);
        let geodesics = Geodesics::new(&mesh);
        let mut random = Random(seed);
        for _ in 0..10 {
            let source = random.point(&mesh);
            let targets: Vec<_> = (0..20).map(|_| random.point(&mesh)).collect();
            let field = geodesics.field(&source, Reach::Targets(&targets)).unwrap();
            for target in targets.iter().filter(|&t| *t != source) {
                let (a, b) = (source.position(&mesh), target.position(&mesh));
                let truth = (b - a).norm();
                // The jittered rectangle's border dents: pairs behind a dent are not straight.
                let path = field.path_to(target).unwrap();
                assert!(field.distance(target).unwrap() >= truth * (1.0 - 1e-14));
                if path.length - truth > 1e-13 {
                    assert!(
                        path.points
                            .iter()
                            .any(|p| matches!(p, SurfacePoint::Vertex(v)
                        if mesh.is_border_vertex(*v)))
                    );
                    continue;
                }
                let direction = (b - a) / truth;
                assert!((path.start.direction - direction).norm() < 1e-11);
                assert!((path.end.direction - direction).norm() < 1e-11);
                for p in path.polyline(&mesh) {
                    assert!((p - a).cross(&direction).norm() < 1e-11);
                }
            }
        }
    }
}

#[test]
fn on_a_cylinder_paths_are_straight_when_unrolled() {
    let n = 10;
    let mesh = meshes::cylinder(n, 1.5, 4.0, 1.0);
    let columns = 3 * n;
    // The mesh is a prism: flat between its columns.
    let width = 2.0 * 1.5 * (PI / columns as f64).sin();
    let geodesics = Geodesics::new(&mesh);
    let place = |v: usize| {
        (
            (v % columns) as f64 * width,
            (v / columns) as f64 * 4.0 / n as f64,
        )
    };
    for source in [0, 5 * columns + 3, mesh.positions().len() - 1] {
        let field = geodesics
            .field(&SurfacePoint::Vertex(source as u32), Reach::Everywhere)
            .unwrap();
        let (x, y) = place(source);
        for v in (0..mesh.positions().len()).filter(|&v| v != source) {
            let (p, q) = place(v);
            let around = (p - x).abs().min(columns as f64 * width - (p - x).abs());
            let truth = (around * around + (q - y) * (q - y)).sqrt();
            let found = field.vertex_distance(v as u32).unwrap();
            assert!(
                relative(found, truth) < 1e-13,
                "{source} to {v}: {found} for {truth}"
            );
        }
    }
}

/// A cone over a closed or open fan of directions with rings; flat between its spokes. Also the
/// unrolled angle of each spoke, and the total angle.
fn cone(directions: &[[f64; 3]], closed: bool, rings: usize) -> (Mesh, Vec<f64>, f64) {
    let count = directions.len();
    let units: Vec<_> = directions
        .iter()
        .map(|&d| Point3::from(d).coords.normalize())
        .collect();
    let mut positions = vec![Point3::origin()];
    for ring in 1..=rings {
        for unit in &units {
            positions.push(Point3::from(unit * (ring as f64 / rings as f64)));
        }
    }
    let id = |ring: usize, spoke: usize| {
        if ring == 0 {
            0
        } else {
            (1 + (ring - 1) * count + spoke % count) as u32
        }
    };
    let mut faces = Vec::new();
    for spoke in 0..if closed { count } else { count - 1 } {
        faces.push([0, id(1, spoke), id(1, spoke + 1)]);
        for ring in 1..rings {
            let [a, b] = [id(ring, spoke), id(ring, spoke + 1)];
            let [c, d] = [id(ring + 1, spoke + 1), id(ring + 1, spoke)];
            faces.extend([[a, d, c], [a, c, b]]);
        }
    }
    let mut angles = vec![0.0];
    let mut sum = 0.0;
    for i in 0..count {
        let (p, q) = (units[i], units[(i + 1) % count]);
        sum += p.cross(&q).norm().atan2(p.dot(&q));
        angles.push(sum);
    }
    let total = if closed { sum } else { angles[count - 1] };
    (compact(positions, faces), angles, total)
}

#[test]
fn on_a_cone_paths_are_straight_when_unrolled_and_pass_the_tip_of_a_saddle() {
    let fan = |count: usize, slope: f64, wave: f64, turn: f64| -> Vec<[f64; 3]> {
        (0..count)
            .map(|i| {
                let a = 2.0 * PI * turn * i as f64 / count as f64;
                [
                    a.cos(),
                    a.sin(),
                    slope + if i % 2 == 0 { wave } else { -wave },
                ]
            })
            .collect()
    };
    // Convex cones (steep and nearly flat), a plane, saddles, and cut ones.
    let fans = [
        (fan(14, 1.0, 0.0, 1.0), true),
        (fan(14, 1e-3, 0.0, 1.0), true),
        (fan(12, 0.0, 0.0, 1.0), true),
        (fan(14, 0.0, 1e-3, 1.0), true),
        (fan(14, 0.0, 0.7, 1.0), true),
        (fan(20, 0.2, 0.5, 0.8), false),
        (fan(10, 0.0, 0.0, 0.7), false),
    ];
    for (directions, closed) in &fans {
        let (mesh, angles, total) = cone(directions, *closed, 5);
        let count = directions.len();
        let geodesics = Geodesics::new(&mesh);
        let unrolled = |v: usize| match v {
            0 => (0.0, 0.0),
            _ => (((v - 1) / count + 1) as f64 / 5.0, angles[(v - 1) % count]),
        };
        let vertices = mesh.positions().len();
        for source in 0..vertices {
            let field = geodesics
                .field(&SurfacePoint::Vertex(source as u32), Reach::Everywhere)
                .unwrap();
            let (r, a) = unrolled(source);
            for v in 0..vertices {
                let (s, b) = unrolled(v);
                let mut between = (a - b).abs();
                if *closed {
                    between = between.min(total - between);
                }
                let truth = if r == 0.0 || s == 0.0 || between >= PI {
                    r + s
                } else {
                    (r * r + s * s - 2.0 * r * s * between.cos())
                        .max(0.0)
                        .sqrt()
                };
                let found = field.vertex_distance(v as u32).unwrap();
                assert!(
                    (found - truth).abs() < 1e-12,
                    "{source} to {v}: {found} for {truth}"
                );
            }
        }
    }
}

/// Mean relative error over pairs of vertices that exist at every refinement.
fn error(mesh: &Mesh, pairs: &[(u32, u32)], truth: impl Fn(&Point3, &Point3) -> f64) -> f64 {
    let geodesics = Geodesics::new(mesh);
    let mut sum = 0.0;
    for &(a, b) in pairs {
        let path = geodesics
            .shortest(&SurfacePoint::Vertex(a), &SurfacePoint::Vertex(b))
            .unwrap();
        let truth = truth(&mesh.position(a), &mesh.position(b));
        sum += relative(path.length, truth);
    }
    sum / pairs.len() as f64
}

/// The vertex at a position.
fn vertex_at(mesh: &Mesh, at: Point3) -> u32 {
    let found = mesh.positions().iter().position(|p| (p - at).norm() < 1e-9);
    found.expect("a vertex of every refinement") as u32
}

fn order(errors: [f64; 3]) -> f64 {
    (errors[0] / errors[2]).log2() / 2.0
}

#[test]
fn on_a_sphere_distances_converge_to_great_circles_with_second_order() {
    let errors = [8, 16, 32].map(|n| {
        let mesh = sphere_cap(n, 2.0, 0.9);
        let coarse = sphere_cap(4, 2.0, 0.9);
        let mut pairs = Vec::new();
        for p in coarse.positions() {
            for q in coarse.positions() {
                if (p - q).norm() > 0.5 {
                    pairs.push((vertex_at(&mesh, *p), vertex_at(&mesh, *q)));
                }
            }
        }
        error(&mesh, &pairs, |p, q| 2.0 * p.coords.angle(&q.coords))
    });
    println!("sphere: {errors:?}, order {:.2}", order(errors));
    assert!(order(errors) > 1.9 && errors[2] < 1e-3);
}

#[test]
fn on_a_torus_meridians_and_the_outer_equator_converge_with_second_order() {
    let on = |a: f64, b: f64| {
        let ring = 3.0 + b.cos();
        Point3::new(ring * a.cos(), ring * a.sin(), b.sin())
    };
    // Meridians are shortest up to half a turn, the outer equator up to its conjugate point
    // after pi sqrt(r / (R + r)) of the angle.
    let quarter = PI / 4.0;
    let meridian = [8, 16, 32].map(|n| {
        let mesh = meshes::torus(n, 3.0, 1.0);
        let pairs = [[0.0, 1.0], [0.0, 3.0], [-1.0, 2.0], [2.0, 4.0]]
            .map(|[b, c]| [b, c].map(|b| vertex_at(&mesh, on(quarter, b * quarter))))
            .map(|[a, b]| (a, b));
        error(&mesh, &pairs, |p, q| {
            let angle = |p: &Point3| (p.z).atan2((p.x * p.x + p.y * p.y).sqrt() - 3.0);
            let between = (angle(p) - angle(q)).abs();
            between.min(2.0 * PI - between)
        })
    });
    let equator = [8, 16, 32].map(|n| {
        let mesh = meshes::torus(n, 3.0, 1.0);
        let pairs = [1.0, 2.0, 3.0].map(|turn| {
            let [a, b] = [0.0, turn * PI / 8.0].map(|a| vertex_at(&mesh, on(a, 0.0)));
            (a, b)
        });
        error(&mesh, &pairs, |p, q| 4.0 * p.coords.angle(&q.coords))
    });
    println!("torus: {meridian:?} {equator:?}");
    assert!(order(meridian) > 1.9 && order(equator) > 1.9);
}

#[test]
fn a_wave_in_one_direction_is_as_flat_as_a_plane() {
    // A cylinder over a polyline: distances are those of the unrolled strip.
    let n = 24;
    let wave = |u: f64| (9.0 * u).sin() * 0.3;
    let mesh = grid(n, n, [false; 2], all, |u, v| [2.0 * u, v, wave(u)]);
    let geodesics = Geodesics::new(&mesh);
    let mut unrolled = vec![0.0];
    for i in 0..n {
        let [u, w] = [i, i + 1].map(|i| i as f64 / n as f64);
        let (dx, dz) = (2.0 * (w - u), wave(w) - wave(u));
        unrolled.push(unrolled[i] + (dx * dx + dz * dz).sqrt());
    }
    let at: Vec<_> = mesh
        .positions()
        .iter()
        .map(|p| (unrolled[(p.x / 2.0 * n as f64).round() as usize], p.y))
        .collect();
    for source in [0, 100, 333] {
        let field = geodesics
            .field(&SurfacePoint::Vertex(source), Reach::Everywhere)
            .unwrap();
        for (v, &(x, y)) in at.iter().enumerate() {
            let (dx, dy) = (x - at[source as usize].0, y - at[source as usize].1);
            let found = field.vertex_distance(v as u32).unwrap();
            assert!((found - (dx * dx + dy * dy).sqrt()).abs() < 1e-13);
        }
    }
}
