//! Meshes with known geodesics, and meshes made to be difficult.

use egg::surface::{Mesh, Point3, SurfacePoint};
use std::f64::consts::PI;

/// Splitmix64: the same numbers everywhere.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// A point of the mesh: in a face, on an edge or at a vertex.
    pub(crate) fn point(&mut self, mesh: &Mesh) -> SurfacePoint {
        let face = self.below(mesh.faces().len()) as u32;
        let mut bary = [self.unit() + 1e-3, self.unit() + 1e-3, self.unit() + 1e-3];
        match self.below(4) {
            0 => bary[self.below(3)] = 0.0,
            1 => {
                let corner = self.below(3);
                bary = [0.0; 3];
                bary[corner] = 1.0;
            }
            _ => {}
        }
        SurfacePoint::in_face(mesh, face, bary).expect("positive coordinates")
    }
}

/// A map of a grid of nu x nv cells over [0,1]², diagonals alternating; `keep` decides which
/// cells exist, `around` whether u = 1 is u = 0.
pub(crate) fn grid(
    nu: usize,
    nv: usize,
    around: [bool; 2],
    keep: impl Fn(usize, usize) -> bool,
    mut map: impl FnMut(f64, f64) -> [f64; 3],
) -> Mesh {
    let columns = if around[0] { nu } else { nu + 1 };
    let rows = if around[1] { nv } else { nv + 1 };
    let mut positions = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            positions.push(Point3::from(map(
                i as f64 / nu as f64,
                j as f64 / nv as f64,
            )));
        }
    }
    let id = |i: usize, j: usize| (i % columns + (j % rows) * columns) as u32;
    let mut faces = Vec::new();
    for j in 0..nv {
        for i in 0..nu {
            if !keep(i, j) {
                continue;
            }
            let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
            if (i + j) % 2 == 0 {
                faces.extend([[a, b, c], [a, c, d]]);
            } else {
                faces.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    compact(positions, faces)
}

/// Drops unused vertices, keeps the order of the others.
pub(crate) fn compact(positions: Vec<Point3>, mut faces: Vec<[u32; 3]>) -> Mesh {
    let mut ids = vec![u32::MAX; positions.len()];
    for &v in faces.iter().flatten() {
        ids[v as usize] = 0;
    }
    let mut used = Vec::new();
    for (id, position) in ids.iter_mut().zip(positions) {
        if *id == 0 {
            *id = used.len() as u32;
            used.push(position);
        }
    }
    for v in faces.iter_mut().flatten() {
        *v = ids[*v as usize];
    }
    Mesh::new(used, faces).expect("a manifold grid")
}

pub(crate) fn all(_: usize, _: usize) -> bool {
    true
}

/// Moves every vertex of a height field sideways and up at random, by shares of the cell.
pub(crate) fn jittered(
    n: [usize; 2],
    size: [f64; 2],
    share: f64,
    seed: u64,
    keep: impl Fn(usize, usize) -> bool,
    height: impl Fn(f64, f64) -> f64,
) -> Mesh {
    let cell = [size[0] / n[0] as f64, size[1] / n[1] as f64];
    grid(n[0], n[1], [false; 2], keep, |u, v| {
        let mut random = Random(seed ^ ((u * 4096.0) as u64) << 20 ^ (v * 4096.0) as u64);
        let x = (u - 0.5) * size[0] + share * cell[0] * (random.unit() - 0.5);
        let y = (v - 0.5) * size[1] + share * cell[1] * (random.unit() - 0.5);
        [x, y, height(x, y)]
    })
}

pub(crate) fn cylinder(n: usize, radius: f64, height: f64, turn: f64) -> Mesh {
    let around = n * 3;
    grid(around, n, [turn == 1.0, false], all, |u, v| {
        let angle = 2.0 * PI * u * turn;
        [radius * angle.cos(), radius * angle.sin(), height * v]
    })
}

pub(crate) fn sphere_cap(n: usize, radius: f64, half_angle: f64) -> Mesh {
    grid(n, n, [false; 2], all, |u, v| {
        // An even map of the square to a cap that has no bad corners: gnomonic-like angles.
        let (a, b) = ((2.0 * u - 1.0) * half_angle, (2.0 * v - 1.0) * half_angle);
        let (x, y) = (a.tan(), b.tan());
        let norm = (1.0 + x * x + y * y).sqrt();
        [radius * x / norm, radius * y / norm, radius / norm]
    })
}

pub(crate) fn torus(n: usize, major: f64, minor: f64) -> Mesh {
    grid(2 * n, n, [true; 2], all, |u, v| {
        let (a, b) = (2.0 * PI * u, 2.0 * PI * v);
        let ring = major + minor * b.cos();
        [ring * a.cos(), ring * a.sin(), minor * b.sin()]
    })
}

/// A closed pyramid-like surface with a random fan, and needles.
pub(crate) fn bipyramid(sides: usize, height: f64, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let mut positions = vec![
        Point3::new(0.0, 0.0, height),
        Point3::new(0.1, 0.0, -height),
    ];
    for i in 0..sides {
        let angle = 2.0 * PI * i as f64 / sides as f64;
        let radius = 0.4 + random.unit();
        positions.push(Point3::new(
            radius * angle.cos(),
            radius * angle.sin(),
            0.6 * (random.unit() - 0.5),
        ));
    }
    let mut faces = Vec::new();
    for i in 0..sides as u32 {
        let (a, b) = (2 + i, 2 + (i + 1) % sides as u32);
        faces.extend([[0, a, b], [1, b, a]]);
    }
    Mesh::new(positions, faces).expect("a closed fan")
}
