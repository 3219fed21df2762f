//! Meshes of textbook surfaces: what `egg init` starts from and what tests measure against.
//!
//! A rectangle or a disc of parameters is cut into triangles and mapped into space. The
//! parametrisations of plane, cylinder and cone are isometric, so their geodesic distances are
//! straight distances of parameters.

use super::{Mesh, Point3};
use std::f64::consts::TAU;

/// A rectangle of parameters, cut into cells and these into triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Range of the first parameter.
    pub u: [f64; 2],
    /// Range of the second parameter.
    pub v: [f64; 2],
    /// Cells along both, at least one.
    pub cells: [u32; 2],
    /// How they are cut.
    pub pattern: Pattern,
}

/// How a grid is cut into triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern {
    /// Even cells, diagonals in one direction.
    Regular,
    /// Even cells, diagonals in a herringbone.
    Alternating,
    /// Inner vertices moved by up to a third of a cell and diagonals at random, both from a seed.
    Irregular {
        /// The seed; equal seeds give equal meshes.
        seed: u64,
    },
    /// Every second row and column of cells squeezed to this share of its width.
    Slivers {
        /// Share, positive.
        share: f64,
    },
}

impl Grid {
    /// Triangles over parameters; `point` maps parameters into space. Faces are counter-clockwise
    /// seen from the side to which the cross product of the partial derivatives points.
    pub fn mesh(&self, point: impl Fn(f64, f64) -> Point3) -> Mesh {
        let [columns, rows] = self.cells.map(|n| n.max(1));
        let mut random = match self.pattern {
            Pattern::Irregular { seed } => Some(Random(seed)),
            _ => None,
        };
        let mut positions = Vec::new();
        for j in 0..=rows {
            for i in 0..=columns {
                let (mut s, mut t) = (self.share(i, columns), self.share(j, rows));
                if let Some(random) = &mut random {
                    // Drawn at border vertices too, which move along the border only.
                    let shift = [random.signed(), random.signed()].map(|x| x / 3.0);
                    if i != 0 && i != columns {
                        s += shift[0] / f64::from(columns);
                    }
                    if j != 0 && j != rows {
                        t += shift[1] / f64::from(rows);
                    }
                }
                positions.push(point(mix(self.u, s), mix(self.v, t)));
            }
        }
        let mut faces = Vec::new();
        for j in 0..rows {
            for i in 0..columns {
                let a = j * (columns + 1) + i;
                let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
                let rising = match (self.pattern, &mut random) {
                    (Pattern::Alternating, _) => (i + j) % 2 == 0,
                    (_, Some(random)) => random.signed() < 0.0,
                    _ => true,
                };
                faces.extend(if rising {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                });
            }
        }
        build(positions, faces)
    }

    /// Where a line of vertices stands, as a share of the range.
    fn share(&self, i: u32, n: u32) -> f64 {
        let Pattern::Slivers { share } = self.pattern else {
            return f64::from(i) / f64::from(n);
        };
        let width = |i: u32| f64::from(i.div_ceil(2)) + share * f64::from(i / 2);
        width(i) / width(n)
    }
}

/// A plane at z = 0; parameters are x and y.
pub fn plane(grid: &Grid) -> Mesh {
    graph(grid, |_, _| 0.0)
}

/// The graph of a height function; parameters are x and y.
pub fn graph(grid: &Grid, height: impl Fn(f64, f64) -> f64) -> Mesh {
    grid.mesh(|x, y| Point3::new(x, y, height(x, y)))
}

/// The saddle z = (x² - y²) / (2 r), with principal curvatures 1/r and -1/r at the origin.
pub fn saddle(radius: f64, grid: &Grid) -> Mesh {
    graph(grid, |x, y| (x * x - y * y) / (2.0 * radius))
}

/// The bump z = h exp(-(x² + y²) / (2 s²)).
pub fn bump(height: f64, spread: f64, grid: &Grid) -> Mesh {
    graph(grid, |x, y| {
        height * libm::exp(-(x * x + y * y) / (2.0 * spread * spread))
    })
}

/// A cylinder around the x axis, seen from outside; parameters are x and the arc length from the
/// top, an isometry.
pub fn cylinder(radius: f64, grid: &Grid) -> Mesh {
    grid.mesh(|x, arc| {
        let (sin, cos) = libm::sincos(arc / radius);
        Point3::new(x, radius * sin, radius * cos)
    })
}

/// A cone with its apex at the origin and its axis downwards, seen from outside; parameters are
/// polar coordinates of the unrolled plane (distance from the apex, angle), an isometry.
pub fn cone(half_angle: f64, grid: &Grid) -> Mesh {
    let (wide, deep) = libm::sincos(half_angle);
    grid.mesh(|slant, angle| {
        let (sin, cos) = libm::sincos(angle / wide);
        Point3::new(slant * wide * cos, slant * wide * sin, -slant * deep)
    })
}

/// A torus around the z axis, seen from outside; parameters are the angle around the axis and the
/// angle around the tube, 0 being outermost.
pub fn torus(major: f64, minor: f64, grid: &Grid) -> Mesh {
    grid.mesh(|around, tube| {
        let (sin_a, cos_a) = libm::sincos(around);
        let (sin_t, cos_t) = libm::sincos(tube);
        let r = major + minor * cos_t;
        Point3::new(r * cos_a, r * sin_a, minor * sin_t)
    })
}

/// A cap of a sphere, standing on z = 0, seen from outside, up to a polar angle: rings of 6, 12,
/// 18 ... vertices around the top.
pub fn sphere_cap(radius: f64, polar: f64, rings: u32) -> Mesh {
    let rim = radius * libm::cos(polar);
    disc(rings, |share, angle| {
        let (sin_p, cos_p) = libm::sincos(share * polar);
        let (sin_a, cos_a) = libm::sincos(angle);
        Point3::new(
            radius * sin_p * cos_a,
            radius * sin_p * sin_a,
            radius * cos_p - rim,
        )
    })
}

/// A disc of rings of 6, 12, 18 ... vertices; `point` maps a share of the radius and an angle.
pub fn disc(rings: u32, point: impl Fn(f64, f64) -> Point3) -> Mesh {
    let mut positions = vec![point(0.0, 0.0)];
    let mut faces = Vec::new();
    // The first vertex of a ring; ring 0 is the centre.
    let first = |ring: u32| {
        if ring == 0 {
            0
        } else {
            1 + 3 * ring * (ring - 1)
        }
    };
    let vertex = |ring: u32, k: u32| first(ring) + if ring == 0 { 0 } else { k % (6 * ring) };
    for ring in 1..=rings.max(1) {
        let share = f64::from(ring) / f64::from(rings.max(1));
        for k in 0..6 * ring {
            positions.push(point(share, TAU * f64::from(k) / f64::from(6 * ring)));
        }
        // Each of six sectors has `ring` triangles that point inwards and one less outwards.
        for sector in 0..6 {
            for i in 0..ring {
                let (outer, inner) = (sector * ring + i, sector * (ring - 1) + i);
                let [a, b] = [vertex(ring, outer), vertex(ring, outer + 1)];
                let c = vertex(ring - 1, inner);
                faces.push([a, b, c]);
                if i + 1 < ring {
                    faces.push([c, b, vertex(ring - 1, inner + 1)]);
                }
            }
        }
    }
    build(positions, faces)
}

/// A closed sphere around the origin, seen from outside: an octahedron with `n` edges a side.
pub fn sphere(radius: f64, n: u32) -> Mesh {
    let n = n.max(1);
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    // Rows of latitude from the north pole: row j has 4 j vertices, down to the equator and back.
    let length = |j: u32| if j <= n { j } else { 2 * n - j };
    let mut first = Vec::new();
    for j in 0..=2 * n {
        first.push(positions.len() as u32);
        let polar = TAU / 4.0 * f64::from(j) / f64::from(n);
        let (sin_p, cos_p) = libm::sincos(polar);
        let count = (4 * length(j)).max(1);
        for k in 0..count {
            let (sin_a, cos_a) = libm::sincos(TAU * f64::from(k) / f64::from(count));
            positions.push(Point3::from(
                [sin_p * cos_a, sin_p * sin_a, cos_p].map(|c| radius * c),
            ));
        }
    }
    let vertex = |j: u32, k: u32| first[j as usize] + k % (4 * length(j)).max(1);
    for j in 0..2 * n {
        let (upper, lower) = (length(j), length(j + 1));
        let longer = upper.max(lower);
        for sector in 0..4 {
            for i in 0..longer {
                let up = |i| vertex(j, sector * upper + i);
                let down = |i| vertex(j + 1, sector * lower + i);
                if upper < lower {
                    faces.push([up(i), down(i), down(i + 1)]);
                    if i < upper {
                        faces.push([up(i), down(i + 1), up(i + 1)]);
                    }
                } else {
                    faces.push([up(i), down(i), up(i + 1)]);
                    if i < lower {
                        faces.push([up(i + 1), down(i), down(i + 1)]);
                    }
                }
            }
        }
    }
    build(positions, faces)
}

fn build(positions: Vec<Point3>, faces: Vec<[u32; 3]>) -> Mesh {
    Mesh::new(positions, faces).expect("grids, discs and spheres are manifolds")
}

fn mix([from, to]: [f64; 2], share: f64) -> f64 {
    from * (1.0 - share) + to * share
}

/// `SplitMix64` (Steele, Lea, Flood 2014): enough for moving vertices about.
struct Random(u64);

impl Random {
    /// Evenly in [-1, 1).
    fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(cells: u32, pattern: Pattern) -> Grid {
        Grid {
            u: [-1.0, 2.0],
            v: [0.0, 1.0],
            cells: [cells; 2],
            pattern,
        }
    }

    const PATTERNS: [Pattern; 4] = [
        Pattern::Regular,
        Pattern::Alternating,
        Pattern::Irregular { seed: 7 },
        Pattern::Slivers { share: 1e-4 },
    ];

    #[test]
    fn patterns_cover_the_rectangle_with_upward_faces() {
        for pattern in PATTERNS {
            let mesh = plane(&grid(6, pattern));
            assert!((mesh.area() - 3.0).abs() < 1e-12, "{pattern:?}");
            assert!((0..mesh.face_count()).all(|f| mesh.face_cross(f).z > 0.0));
            let (low, high) = mesh.bounding_box();
            assert_eq!(
                (low, high),
                ([-1.0, 0.0, 0.0].into(), [2.0, 1.0, 0.0].into())
            );
        }
    }

    #[test]
    fn areas_converge_to_the_surfaces() {
        let pi = std::f64::consts::PI;
        let near = |mesh: &Mesh, area: f64| (mesh.area() / area - 1.0).abs() < 1e-3;
        let fine = |u, v| Grid {
            u,
            v,
            cells: [80, 80],
            pattern: Pattern::Irregular { seed: 3 },
        };
        assert!(near(&cylinder(2.0, &fine([0.0, 1.0], [-3.0, 3.0])), 6.0));
        assert!(near(&cone(0.4, &fine([1.0, 2.0], [0.0, 1.0])), 1.5));
        let round = [0.0, 0.5 * pi];
        // Pappus: a quarter turn of the outer quarter of the tube.
        let torus_area = 0.5 * pi * (3.0 * 0.5 * pi + 1.0);
        assert!(near(&torus(3.0, 1.0, &fine(round, round)), torus_area));
        assert!(near(
            &sphere_cap(2.0, 1.0, 40),
            8.0 * pi * (1.0 - libm::cos(1.0))
        ));
        assert!(near(&sphere(2.0, 40), 16.0 * pi));
    }

    #[test]
    fn faces_are_seen_from_outside() {
        let around = sphere(1.0, 5);
        assert!(
            (0..around.half_edges().count() as u32)
                .all(|h| around.twin(super::super::HalfEdge(h)).is_some())
        );
        let range = Grid {
            u: [0.5, 1.0],
            v: [-1.0, 1.0],
            cells: [9, 9],
            pattern: Pattern::Regular,
        };
        let outward = |mesh: &Mesh, centre: fn(&Point3) -> Point3| {
            (0..mesh.face_count()).all(|f| {
                let p = nalgebra::center(&mesh.corners(f)[0], &mesh.corners(f)[1]);
                mesh.face_cross(f).dot(&(p - centre(&p))) > 0.0
            })
        };
        assert!(outward(&around, |_| Point3::origin()));
        assert!(outward(&sphere_cap(2.0, 1.0, 4), |_| Point3::new(
            0., 0., -2.0
        )));
        assert!(outward(&cylinder(2.0, &range), |p| Point3::new(
            p.x, 0., 0.
        )));
        assert!(outward(&cone(0.4, &range), |p| Point3::new(0., 0., p.z)));
        assert!(outward(&torus(3.0, 1.0, &range), |p| {
            let d = libm::hypot(p.x, p.y) / 3.0;
            Point3::new(p.x / d, p.y / d, 0.)
        }));
    }
}
