//! Questions to a mesh: curvature against textbook surfaces, points against brute force, parts
//! against the whole.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use egg::project::model::Axis;
use egg::surface::curvature::{PeakOptions, peaks};
use egg::surface::generate::{self, Grid, Pattern};
use egg::surface::{
    Clearance, Curvature, HalfEdge, Locator, Mesh, Point3, ReadOptions, Side, SubMesh,
    SurfacePoint, Vector3, grow, read_obj,
};
use proptest::prelude::*;

const PATTERNS: [Pattern; 4] = [
    Pattern::Regular,
    Pattern::Alternating,
    Pattern::Irregular { seed: 5 },
    Pattern::Slivers { share: 0.1 },
];

fn grid(cells: u32, pattern: Pattern) -> Grid {
    Grid {
        u: [-1.0, 1.0],
        v: [-1.0, 1.0],
        cells: [cells; 2],
        pattern,
    }
}

mod curvature {
    use super::*;

    /// A surface and its exact Gaussian and mean curvature (normals up or outward).
    struct Truth {
        name: &'static str,
        mesh: fn(u32, Pattern) -> Mesh,
        exact: fn(&Point3) -> [f64; 2],
    }

    const TRUTHS: [Truth; 4] = [
        Truth {
            name: "sphere",
            mesh: |cells, pattern| {
                grid(cells, pattern).mesh(|x, y| {
                    let p = Vector3::new(0.8 * x, 0.8 * y, 1.0).normalize();
                    Point3::from(2.0 * p)
                })
            },
            exact: |_| [0.25, -0.5],
        },
        Truth {
            name: "torus",
            mesh: |cells, pattern| {
                let range = Grid {
                    u: [-0.3, 0.3],
                    ..grid(cells, pattern)
                };
                generate::torus(3.0, 1.0, &range)
            },
            exact: |p| {
                let r = libm::hypot(p.x, p.y);
                let k = (r - 3.0) / r;
                [k, -0.5 * (1.0 + k)]
            },
        },
        Truth {
            name: "saddle",
            mesh: |cells, pattern| generate::saddle(1.0, &grid(cells, pattern)),
            exact: |p| {
                let w = 1.0 + p.x * p.x + p.y * p.y;
                let mean = (p.y * p.y - p.x * p.x) / (2.0 * w * w.sqrt());
                [-1.0 / (w * w), mean]
            },
        },
        Truth {
            name: "bump",
            mesh: |cells, pattern| generate::bump(0.3, 0.6, &grid(cells, pattern)),
            exact: |p| {
                // z = h exp(-r²/2s²): a surface of revolution with the profile slope z' = -r z/s².
                let (r, s2) = (libm::hypot(p.x, p.y), 0.36);
                let z = 0.3 * libm::exp(-r * r / (2.0 * s2));
                let slope = -r * z / s2;
                let w = 1.0 + slope * slope;
                let along = z * (r * r / s2 - 1.0) / s2 / (w * w.sqrt());
                let around = -z / s2 / w.sqrt();
                [along * around, 0.5 * (along + around)]
            },
        },
    ];

    /// Largest error of K and H, inside and within two rings of the border, over the largest value.
    fn errors(truth: &Truth, cells: u32, pattern: Pattern) -> [f64; 2] {
        let mesh = (truth.mesh)(cells, pattern);
        let curvature = Curvature::estimate(&mesh);
        let rings = mesh.rings_from_border(2);
        let (mut errors, mut scale) = ([0.0_f64; 2], [0.0_f64; 2]);
        let mut each = [[0.0_f64; 2]; 2];
        for v in 0..mesh.vertex_count() {
            let found = curvature.vertex(v);
            let exact = (truth.exact)(&mesh.position(v));
            let place = usize::from(rings[v as usize] <= 2);
            for (i, found) in [found.gaussian(), found.mean()].into_iter().enumerate() {
                each[place][i] = each[place][i].max((found - exact[i]).abs());
                scale[i] = scale[i].max(exact[i].abs());
            }
        }
        for place in 0..2 {
            errors[place] = f64::max(each[place][0] / scale[0], each[place][1] / scale[1]);
        }
        errors
    }

    #[test]
    fn converges_with_second_order_on_every_kind_of_mesh() {
        for truth in &TRUTHS {
            for pattern in PATTERNS {
                let coarse = errors(truth, 24, pattern);
                let fine = errors(truth, 96, pattern);
                // Over two halvings; the largest error over random triangles scatters.
                let order = [0, 1].map(|i| libm::log2(coarse[i] / fine[i]) / 2.0);
                let name = truth.name;
                assert!(order[0] > 1.5, "{name} {pattern:?}: {coarse:?} {fine:?}");
                assert!(order[1] > 1.5, "{name} {pattern:?}: {coarse:?} {fine:?}");
                assert!(fine[0] < 0.015, "{name} {pattern:?}: {fine:?}");
                assert!(fine[1] < 0.025, "{name} {pattern:?}: {fine:?}");
            }
        }
    }

    #[test]
    fn developable_surfaces_have_none() {
        let range = Grid {
            u: [0.5, 1.5],
            v: [-0.5, 0.5],
            cells: [40; 2],
            pattern: Pattern::Irregular { seed: 2 },
        };
        for mesh in [
            generate::plane(&range),
            generate::cylinder(1.0, &range),
            generate::cone(0.5, &range),
        ] {
            let curvature = Curvature::estimate(&mesh);
            // The cone's other curvature is up to 4/m: what counts is a share of its square.
            let bent = (0..mesh.vertex_count())
                .map(|v| curvature.vertex(v).principal[1].powi(2))
                .fold(0.1, f64::max);
            let [low, high] = curvature.gaussian_range(&mesh);
            assert!(
                low > -2e-3 * bent && high < 2e-3 * bent,
                "{low} {high} {bent}"
            );
        }
    }

    #[test]
    fn principal_directions_lie_along_and_across_a_cylinder() {
        for pattern in PATTERNS {
            let mesh = generate::cylinder(2.0, &grid(24, pattern));
            let curvature = Curvature::estimate(&mesh);
            for v in 0..mesh.vertex_count() {
                let at = curvature.vertex(v);
                // Bent away from the outer normal: 0 along x, -1/R around.
                assert!((at.principal[0]).abs() < 0.01 && (at.principal[1] + 0.5).abs() < 0.02);
                assert!(
                    at.directions[0].x > 0.9995,
                    "{pattern:?} {:?}",
                    at.directions
                );
                let p = mesh.position(v);
                let normal = Vector3::new(0.0, p.y, p.z) / 2.0;
                assert!((at.normal - normal).norm() < 2e-3);
                let [a, b] = at.directions;
                assert!((a.cross(&b) - at.normal).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn a_mesh_turned_over_changes_only_signs() {
        let mesh = generate::bump(0.3, 0.6, &grid(12, Pattern::Irregular { seed: 9 }));
        let faces = mesh.faces().iter().map(|&[a, b, c]| [a, c, b]).collect();
        let over = Mesh::new(mesh.positions().to_vec(), faces).unwrap();
        let (up, down) = (Curvature::estimate(&mesh), Curvature::estimate(&over));
        for v in 0..mesh.vertex_count() {
            let (up, down) = (up.vertex(v), down.vertex(v));
            assert!((up.gaussian() - down.gaussian()).abs() < 1e-6);
            assert!((up.mean() + down.mean()).abs() < 1e-6);
            assert!((up.normal + down.normal).norm() < 1e-6);
        }
    }

    #[test]
    fn it_scales_and_survives_rounding_in_files() {
        let mesh = generate::bump(0.3, 0.6, &grid(40, Pattern::Irregular { seed: 9 }));
        let exact = Curvature::estimate(&mesh);
        // Seven decimals, as written by modelling programs, far from the origin.
        let positions = mesh.positions().iter().map(|p| {
            let far = p.coords + Vector3::new(1000.0, -2000.0, 50.0);
            Point3::from((far * 1e7).map(f64::round) / 1e7)
        });
        let rounded = Mesh::new(positions.collect(), mesh.faces().to_vec()).unwrap();
        let scaled = mesh.positions().iter().map(|p| p * 1000.0).collect();
        let scaled = Mesh::new(scaled, mesh.faces().to_vec()).unwrap();
        let (rounded, scaled) = (Curvature::estimate(&rounded), Curvature::estimate(&scaled));
        for v in 0..mesh.vertex_count() {
            let k = exact.vertex(v).gaussian();
            assert!((rounded.vertex(v).gaussian() - k).abs() < 3e-4);
            assert!((scaled.vertex(v).gaussian() * 1e6 - k).abs() < 1e-9);
        }
    }

    #[test]
    fn tiny_meshes_have_finite_curvature() {
        for cells in 1..5 {
            for pattern in PATTERNS {
                for mesh in [
                    generate::saddle(1.0, &grid(cells, pattern)),
                    generate::sphere(1.0, cells),
                    generate::plane(&Grid {
                        v: [0.0, 1e-7],
                        ..grid(cells, pattern)
                    }),
                ] {
                    let curvature = Curvature::estimate(&mesh);
                    for v in 0..mesh.vertex_count() {
                        let at = curvature.vertex(v);
                        assert!(at.principal.iter().all(|k| k.is_finite()));
                        assert!((at.normal.norm() - 1.0).abs() < 1e-12);
                        assert!((at.directions[0].norm() - 1.0).abs() < 1e-12);
                        let p = SurfacePoint::Vertex(v);
                        assert_eq!(curvature.gaussian_at(&mesh, &p), at.gaussian());
                    }
                    let [low, high] = curvature.gaussian_range(&mesh);
                    assert!(low <= high);
                }
            }
        }
    }

    fn two_bumps() -> Mesh {
        let bump = |x: f64, y: f64, s: f64| libm::exp(-(x * x + y * y) / (2.0 * s * s));
        generate::graph(&grid(60, Pattern::Irregular { seed: 4 }), |x, y| {
            0.3 * bump(x - 0.4, y - 0.3, 0.2) + 0.2 * bump(x + 0.5, y + 0.2, 0.2)
        })
    }

    #[test]
    fn peaks_are_the_tops_of_the_domes_and_nothing_else() {
        let mesh = two_bumps();
        let curvature = Curvature::estimate(&mesh);
        let all: Vec<u32> = (0..mesh.vertex_count()).collect();
        let found = peaks(&mesh, &curvature, &all, PeakOptions::default());
        assert_eq!(found.len(), 2, "{found:?}");
        for (peak, top) in found.iter().zip([[0.4, 0.3], [-0.5, -0.2]]) {
            let p = mesh.position(peak.vertex);
            assert!(libm::hypot(p.x - top[0], p.y - top[1]) < 0.04);
            assert!(!peak.on_rim && peak.prominence == peak.gaussian);
        }
        // One side of the plan, whose rim cuts the other dome off.
        let left: Vec<u32> = (0..mesh.vertex_count())
            .filter(|&v| mesh.position(v).x < 0.35)
            .collect();
        let found = peaks(&mesh, &curvature, &left, PeakOptions::default());
        assert_eq!(found.len(), 2);
        assert!(found[0].on_rim && !found[1].on_rim);
        assert_eq!(peaks(&mesh, &curvature, &[], PeakOptions::default()), []);
    }

    #[test]
    fn the_desktop_model_has_two_domes() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/projects/desktop/desktop.obj");
        let options = ReadOptions {
            metres_per_unit: 1.0,
            up: Axis::Z,
            side: Side::Upper,
        };
        let mesh = read_obj(&std::fs::read(path).unwrap(), &options)
            .unwrap()
            .value
            .mesh;
        let all: Vec<u32> = (0..mesh.vertex_count()).collect();
        let found = peaks(
            &mesh,
            &Curvature::estimate(&mesh),
            &all,
            PeakOptions::default(),
        );
        let places: Vec<_> = found.iter().map(|p| mesh.position(p.vertex).y).collect();
        assert_eq!(found.len(), 2, "{places:?}");
    }

    #[test]
    fn saddles_and_gentle_surfaces_have_no_peak_and_even_domes_one() {
        let none = [
            generate::saddle(1.0, &grid(30, Pattern::Irregular { seed: 1 })),
            generate::cylinder(1.0, &grid(30, Pattern::Irregular { seed: 1 })),
            generate::bump(0.01, 0.5, &grid(30, Pattern::Irregular { seed: 1 })),
        ];
        let count = |mesh: &Mesh| {
            let all: Vec<u32> = (0..mesh.vertex_count()).collect();
            let curvature = Curvature::estimate(mesh);
            peaks(mesh, &curvature, &all, PeakOptions::default()).len()
        };
        assert_eq!(none.map(|mesh| count(&mesh)), [0, 0, 0]);
        assert_eq!(count(&generate::sphere_cap(1.0, 1.2, 20)), 1);
    }
}

mod points {
    use super::*;

    fn zoo() -> Vec<Mesh> {
        let irregular = grid(9, Pattern::Irregular { seed: 3 });
        vec![
            generate::plane(&irregular),
            generate::bump(1.0, 0.3, &irregular),
            generate::torus(
                2.0,
                0.7,
                &Grid {
                    u: [0.0, 5.0],
                    v: [-2.5, 2.5],
                    ..irregular
                },
            ),
            generate::sphere(1.3, 4),
            generate::saddle(0.5, &grid(8, Pattern::Slivers { share: 1e-5 })),
            // Walls: a cylinder whose ends are cut by vertical planes, and an upright plane.
            generate::cylinder(
                1.0,
                &Grid {
                    v: [-2.0, 2.0],
                    ..grid(8, Pattern::Regular)
                },
            ),
            grid(5, Pattern::Alternating).mesh(|x, z| Point3::new(x, 0.25 * x, z)),
        ]
    }

    /// Distance from a triangle by cases of its Voronoi regions (Ericson, *Real-Time Collision
    /// Detection*, 5.1.5).
    fn distance_from_triangle(p: &Point3, [a, b, c]: [Point3; 3]) -> f64 {
        let segment = |a: Point3, b: Point3| {
            let t = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            (p - (a + (b - a) * t)).norm()
        };
        let sides = segment(a, b).min(segment(b, c)).min(segment(c, a));
        let normal = (b - a).cross(&(c - a));
        let beside = |a: Point3, b: Point3| normal.cross(&(b - a)).dot(&(p - a)) < 0.0;
        if beside(a, b) || beside(b, c) || beside(c, a) {
            sides
        } else {
            sides.min((p - a).dot(&normal.normalize()).abs())
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 400, ..Default::default() })]

        #[test]
        fn the_closest_point_is_as_close_as_brute_force_finds(
            to in prop::array::uniform3(-3.0..3.0_f64),
        ) {
            for mesh in zoo() {
                let to = Point3::from(to);
                let closest = Locator::new(&mesh).closest(&to).unwrap();
                let brute = (0..mesh.face_count())
                    .map(|f| distance_from_triangle(&to, mesh.corners(f)))
                    .fold(f64::INFINITY, f64::min);
                prop_assert!((closest.distance - brute).abs() < 1e-12);
                prop_assert_eq!((closest.point.position(&mesh) - to).norm(), closest.distance);
            }
        }

        #[test]
        fn a_point_of_the_surface_is_its_own_closest_point(
            pick in any::<prop::sample::Index>(),
            share in prop::array::uniform3(0.0..1.0_f64),
            zeros in 0..4_usize,
        ) {
            for mesh in zoo() {
                let mut share = share;
                // Inside, on an edge, on another, at a vertex.
                for zero in &mut share[..zeros.saturating_sub(1)] {
                    *zero = 0.0;
                }
                let face = pick.index(mesh.face_count() as usize) as u32;
                let Some(point) = SurfacePoint::in_face(&mesh, face, share) else {
                    return Ok(());
                };
                let found = Locator::new(&mesh).closest(&point.position(&mesh)).unwrap();
                // Points within 1e-10 of a side's length count as on the side.
                prop_assert!(found.distance < 1e-10, "{}", found.distance);
                if let SurfacePoint::Vertex(_) = point {
                    prop_assert_eq!(found.point, point);
                }
            }
        }

        #[test]
        fn every_face_at_a_point_agrees_on_its_position(
            pick in any::<prop::sample::Index>(),
            share in prop::array::uniform3(0.0..1.0_f64),
            zeros in 0..3_usize,
        ) {
            for mesh in zoo() {
                let mut share = share;
                share[..zeros].fill(0.0);
                let face = pick.index(mesh.face_count() as usize) as u32;
                let Some(point) = SurfacePoint::in_face(&mesh, face, share) else {
                    return Ok(());
                };
                let expected = match point {
                    SurfacePoint::Vertex(_) => 2,
                    SurfacePoint::Edge { .. } => 1,
                    SurfacePoint::Face { .. } => 0,
                };
                prop_assert_eq!(expected, zeros);
                let at = point.position(&mesh);
                let faces = point.faces(&mesh);
                prop_assert!(faces.contains(&face));
                for &face in &faces {
                    let bary = point.bary_in(&mesh, face).unwrap();
                    let corners = mesh.corners(face);
                    let there: Vector3 = (0..3).map(|i| corners[i].coords * bary[i]).sum();
                    prop_assert!((there - at.coords).norm() < 1e-14);
                }
                let outside = (0..mesh.face_count()).find(|face| !faces.contains(face));
                prop_assert_eq!(point.bary_in(&mesh, outside.unwrap()), None);
                prop_assert!((point.normal(&mesh).norm() - 1.0).abs() < 1e-12);
            }
        }

        #[test]
        fn the_topmost_point_is_the_highest_that_brute_force_finds(
            x in -3.0..3.0_f64, y in -3.0..3.0_f64,
        ) {
            for mesh in zoo() {
                let highest = (0..mesh.face_count())
                    .filter_map(|f| {
                        let [a, b, c] = mesh.corners(f);
                        let side = |a: Point3, b: Point3| {
                            (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)
                        };
                        let w = [side(b, c), side(c, a), side(a, b)];
                        let sum: f64 = w.iter().sum();
                        let z = (a.z * w[0] + b.z * w[1] + c.z * w[2]) / sum;
                        w.iter().all(|w| w / sum > 1e-9).then_some(z)
                    })
                    .fold(f64::NEG_INFINITY, f64::max);
                match Locator::new(&mesh).topmost([x, y]) {
                    Ok(point) => {
                        let p = point.position(&mesh);
                        prop_assert!((p.x - x).abs() < 1e-9 && (p.y - y).abs() < 1e-9);
                        prop_assert!(p.z > highest - 1e-9);
                    }
                    Err(miss) => {
                        prop_assert!(highest == f64::NEG_INFINITY);
                        let p = miss.nearest.position(&mesh);
                        let distance = libm::hypot(p.x - x, p.y - y);
                        prop_assert!((distance - miss.distance).abs() < 1e-12);
                        let nearer = mesh.positions().iter().any(|p| {
                            libm::hypot(p.x - x, p.y - y) < miss.distance - 1e-12
                        });
                        prop_assert!(!nearer);
                    }
                }
            }
        }

        #[test]
        fn no_point_between_faces_is_lost(
            seed in any::<u64>(),
            from in any::<prop::sample::Index>(),
            to in any::<prop::sample::Index>(),
            share in 0.0..1.0_f64,
            offset in prop::sample::select(vec![0.0, 1.0 / 3.0, 1e3, 4.5e6]),
        ) {
            // Points on edges, at vertices and on lines through vertices, where rounding decides
            // about the side, on a mesh without holes and far from the origin.
            let rectangle = Grid {
                u: [offset, offset + 0.9],
                v: [-offset, -offset + 1.1],
                cells: [6, 7],
                pattern: Pattern::Irregular { seed },
            };
            let mesh = generate::graph(&rectangle, |x, y| 0.1 * (x - offset) * (y + offset));
            let locator = Locator::new(&mesh);
            let edges: Vec<HalfEdge> = mesh.edges().collect();
            let edge = edges[from.index(edges.len())];
            let [a, b] = [mesh.origin(edge), mesh.target(edge)].map(|v| mesh.position(v));
            let c = mesh.positions()[to.index(mesh.positions().len())];
            for (p, q, t) in [(a, b, share), (a, b, 0.0), (a, b, 0.5), (a, c, share)] {
                let p = p + (q - p) * t;
                let found = locator.topmost([p.x, p.y]).unwrap().position(&mesh);
                prop_assert!((found - p).xy().norm() <= 1e-9 * (1.0 + offset));
            }
        }
    }

    #[test]
    fn a_vertical_ray_through_a_vertex_finds_the_vertex() {
        for mesh in [
            generate::bump(1.0, 0.3, &grid(9, Pattern::Irregular { seed: 3 })),
            generate::sphere_cap(2.0, 1.0, 6),
        ] {
            let locator = Locator::new(&mesh);
            for v in 0..mesh.vertex_count() {
                let p = mesh.position(v);
                assert_eq!(locator.topmost([p.x, p.y]), Ok(SurfacePoint::Vertex(v)));
            }
        }
    }

    #[test]
    fn the_topmost_of_several_sheets_is_found() {
        let ball = generate::sphere(1.0, 8);
        let top = Locator::new(&ball).topmost([0.1, 0.2]).unwrap();
        assert!(top.position(&ball).z > 0.9);
        // On an upright wall the top is on its upper border.
        let wall = grid(5, Pattern::Alternating).mesh(|x, z| Point3::new(x, 0.25 * x, z));
        let top = Locator::new(&wall).topmost([0.5, 0.125]).unwrap();
        assert_eq!(top.position(&wall).z, 1.0);
    }

    #[test]
    fn misses_tell_how_far_and_rounding_is_no_miss() {
        let mesh = generate::plane(&grid(4, Pattern::Regular));
        let locator = Locator::new(&mesh);
        let miss = locator.topmost([1.25, 0.1]).unwrap_err();
        assert_eq!(miss.distance, 0.25);
        assert_eq!(miss.nearest.position(&mesh), Point3::new(1.0, 0.1, 0.0));
        let corner = locator.topmost([1.0 + 1e-12, -1.0 - 1e-12]).unwrap();
        assert_eq!(corner.position(&mesh), Point3::new(1.0, -1.0, 0.0));
        assert_eq!(
            locator.topmost([f64::NAN, 0.0]).unwrap_err().distance,
            f64::INFINITY
        );
        assert_eq!(locator.closest(&Point3::new(0.0, f64::NAN, 0.0)), None);
    }
}

mod parts {
    use super::*;

    /// Distances along edges from a vertex.
    fn along_edges(mesh: &Mesh, from: u32) -> Vec<f64> {
        let mut distance = vec![f64::INFINITY; mesh.positions().len()];
        distance[from as usize] = 0.0;
        // Bellman and Ford: slow and plain.
        loop {
            let mut changed = false;
            for h in mesh.edges() {
                let (a, b) = (mesh.origin(h) as usize, mesh.target(h) as usize);
                let step = mesh.edge_vector(h).norm();
                for (a, b) in [(a, b), (b, a)] {
                    if distance[a] + step < distance[b] {
                        distance[b] = distance[a] + step;
                        changed = true;
                    }
                }
            }
            if !changed {
                return distance;
            }
        }
    }

    fn mesh() -> Mesh {
        generate::bump(0.6, 0.3, &grid(10, Pattern::Irregular { seed: 8 }))
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 200, ..Default::default() })]

        #[test]
        fn any_faces_make_a_part_whose_points_go_there_and_back(
            picks in prop::collection::vec(any::<prop::sample::Index>(), 0..120),
            bary in prop::array::uniform3(0.0..1.0_f64),
        ) {
            let whole = mesh();
            let faces: Vec<u32> = picks
                .iter()
                .map(|pick| pick.index(whole.faces().len()) as u32)
                .collect();
            let part = SubMesh::new(&whole, &faces);
            for &face in &faces {
                prop_assert!(part.face_from_parent(face).is_some());
            }
            for face in 0..part.mesh().face_count() {
                let parent = part.face_to_parent(face);
                prop_assert_eq!(part.mesh().corners(face), whole.corners(parent));
                prop_assert_eq!(part.face_from_parent(parent), Some(face));
                let Some(point) = SurfacePoint::in_face(part.mesh(), face, bary) else {
                    continue;
                };
                let up = part.point_to_parent(&point);
                prop_assert_eq!(up.position(&whole), point.position(part.mesh()));
                prop_assert_eq!(part.point_from_parent(&whole, &up), Some(point));
            }
            for v in 0..part.mesh().vertex_count() {
                let parent = part.vertex_to_parent(v);
                prop_assert_eq!(part.mesh().position(v), whole.position(parent));
                prop_assert_eq!(part.vertex_from_parent(parent), Some(v));
            }
            for h in part.mesh().half_edges() {
                let up = part.half_edge_to_parent(h);
                prop_assert_eq!(part.half_edge_from_parent(up), Some(h));
                let inner = whole.twin(up).is_some() && part.mesh().twin(h).is_none();
                prop_assert_eq!(part.cut().contains(&h), inner);
                // An edge that the part has on its other side only.
                if let Some(twin) = whole.twin(up).filter(|_| inner) {
                    let seen = SurfacePoint::Edge { half_edge: twin, at: 0.25 };
                    let own = SurfacePoint::Edge { half_edge: h, at: 0.75 };
                    prop_assert_eq!(part.point_from_parent(&whole, &seen), Some(own));
                }
            }
        }

        #[test]
        fn paths_that_clear_the_cut_are_as_long_as_in_the_whole(
            from in any::<prop::sample::Index>(), to in any::<prop::sample::Index>(),
            margin in 0.1..0.8_f64,
        ) {
            let whole = mesh();
            let vertices = whole.positions().len();
            let [from, to] = [from, to].map(|pick| pick.index(vertices) as u32);
            let seeds = [SurfacePoint::Vertex(from), SurfacePoint::Vertex(to)];
            let part = SubMesh::new(&whole, &grow(&whole, &seeds, margin));
            let clearance = part.clearance();
            let far = |v: u32| clearance.distances(&whole.position(v));
            let bound = Clearance::detour(&far(from), &far(to));
            prop_assert!(bound >= clearance.distance(&whole.position(from)));
            let [own_from, own_to] = [from, to].map(|v| part.vertex_from_parent(v).unwrap());
            let inside = along_edges(part.mesh(), own_from)[own_to as usize];
            let anywhere = along_edges(&whole, from)[to as usize];
            prop_assert!(anywhere <= inside);
            if inside <= bound {
                prop_assert_eq!(inside, anywhere);
            }
            // A path that leaves is longer than the bound: the shortest over each cut vertex.
            let [here, there] = [from, to].map(|v| along_edges(&whole, v));
            for &h in part.cut() {
                let v = part.vertex_to_parent(part.mesh().origin(h)) as usize;
                prop_assert!(here[v] + there[v] >= bound - 1e-12);
            }
        }

        #[test]
        fn growing_reaches_the_margin_along_edges(
            pick in any::<prop::sample::Index>(), margin in 0.0..1.5_f64,
        ) {
            let whole = mesh();
            let seed = pick.index(whole.positions().len()) as u32;
            let faces = grow(&whole, &[SurfacePoint::Vertex(seed)], margin);
            let distance = along_edges(&whole, seed);
            for face in 0..whole.face_count() {
                let corners = whole.faces()[face as usize];
                let near = corners.iter().any(|&v| distance[v as usize] <= margin);
                prop_assert_eq!(faces.binary_search(&face).is_ok(), near);
            }
        }
    }

    #[test]
    fn a_split_fan_is_closed_and_the_whole_has_no_cut() {
        let whole = generate::plane(&grid(4, Pattern::Regular));
        let centre = 12;
        let around: Vec<u32> = whole.outgoing(centre).map(HalfEdge::face).collect();
        let part = SubMesh::new(&whole, &[around[0], around[3]]);
        assert_eq!(part.mesh().face_count(), 6);
        assert!(
            !part
                .mesh()
                .is_border_vertex(part.vertex_from_parent(centre).unwrap())
        );
        let all: Vec<u32> = (0..whole.face_count()).collect();
        let part = SubMesh::new(&whole, &all);
        assert_eq!(part.mesh(), &whole);
        assert!(part.cut().is_empty());
        let p = whole.position(centre);
        assert_eq!(part.clearance().distance(&p), f64::INFINITY);
        let nothing = SubMesh::new(&whole, &[]);
        assert_eq!(nothing.mesh().face_count(), 0);
    }
}
