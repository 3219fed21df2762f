//! The definition of a shortest path, computed without any pruning: every sequence of faces is
//! unfolded as long as a straight line passes through it, and straight pieces are joined at
//! vertices. Exponential in the number of faces.

use egg::surface::{HalfEdge, Mesh, SurfacePoint};

type V2 = [f64; 2];

fn sub(a: V2, b: V2) -> V2 {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: V2, b: V2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn norm(a: V2) -> f64 {
    (a[0] * a[0] + a[1] * a[1]).sqrt()
}

/// Third corner of a triangle over the segment p→q, left of it.
fn third(p: V2, q: V2, from_p: f64, from_q: f64) -> V2 {
    let e = sub(q, p);
    let l = norm(e);
    let x = (l * l + from_p * from_p - from_q * from_q) / (2.0 * l);
    let y = (from_p * from_p - x * x).max(0.0).sqrt();
    [
        p[0] + (e[0] * x - e[1] * y) / l,
        p[1] + (e[1] * x + e[0] * y) / l,
    ]
}

fn flat(mesh: &Mesh, face: u32) -> [V2; 3] {
    let [a, b, c] = mesh.corners(face);
    let l = (b - a).norm();
    let (p, q) = ([0.0, 0.0], [l, 0.0]);
    [p, q, third(p, q, (c - a).norm(), (c - b).norm())]
}

fn place(corners: &[V2; 3], bary: [f64; 3]) -> V2 {
    let mut sum = [0.0; 2];
    for (corner, b) in corners.iter().zip(bary) {
        sum[0] += b * corner[0];
        sum[1] += b * corner[1];
    }
    sum
}

struct Straight<'a> {
    mesh: &'a Mesh,
    targets: &'a [SurfacePoint],
    best: Vec<f64>,
    visited: Vec<bool>,
}

impl Straight<'_> {
    /// The face beyond the half-edge's twin, seen from `eye` between the rays through `low` and
    /// `high` (clockwise-most and counter-clockwise-most).
    fn enter(&mut self, h: HalfEdge, p: V2, q: V2, eye: V2, low: V2, high: V2) {
        let face = h.face();
        if self.visited[face as usize] {
            return;
        }
        self.visited[face as usize] = true;
        let mesh = self.mesh;
        let corners3 = mesh.corners(face);
        let [a, b, c] = [0, 1, 2].map(|i| corners3[(h.corner() + i) % 3]);
        let apex = third(p, q, (c - a).norm(), (c - b).norm());
        let mut corners = [[0.0; 2]; 3];
        corners[h.corner()] = p;
        corners[h.next().corner()] = q;
        corners[h.prev().corner()] = apex;
        let eps = 1e-12;
        for (target, best) in self.targets.iter().zip(&mut self.best) {
            if let Some(bary) = target.bary_in(mesh, face) {
                let t = sub(place(&corners, bary), eye);
                if cross(low, t) >= -eps && cross(t, high) >= -eps {
                    *best = best.min(norm(t));
                }
            }
        }
        // Seen from the eye below p→q: q is clockwise-most, p counter-clockwise-most.
        for (out, from, to) in [(h.next(), q, apex), (h.prev(), apex, p)] {
            let (begin, end) = (sub(from, eye), sub(to, eye));
            let new_low = if cross(low, begin) > 0.0 { begin } else { low };
            let new_high = if cross(end, high) > 0.0 { end } else { high };
            if cross(new_low, new_high) <= 0.0 {
                continue;
            }
            if let Some(twin) = mesh.twin(out) {
                self.enter(twin, to, from, eye, new_low, new_high);
            }
        }
        self.visited[face as usize] = false;
    }
}

/// Shortest straight lines from a point to the targets, infinite where there is none.
fn straight(mesh: &Mesh, from: &SurfacePoint, targets: &[SurfacePoint]) -> Vec<f64> {
    let mut search = Straight {
        mesh,
        targets,
        best: vec![f64::INFINITY; targets.len()],
        visited: vec![false; mesh.faces().len()],
    };
    for face in from.faces(mesh) {
        let corners = flat(mesh, face);
        let bary = from.bary_in(mesh, face).expect("its own face");
        let eye = place(&corners, bary);
        for (target, best) in targets.iter().zip(&mut search.best) {
            if let Some(bary) = target.bary_in(mesh, face) {
                *best = best.min(norm(sub(place(&corners, bary), eye)));
            }
        }
        search.visited[face as usize] = true;
        for corner in 0..3 {
            let h = HalfEdge::new(face, corner as u32);
            let (p, q) = (corners[corner], corners[(corner + 1) % 3]);
            let (low, high) = (sub(p, eye), sub(q, eye));
            if cross(low, high) <= 1e-14 {
                continue;
            }
            if let Some(twin) = mesh.twin(h) {
                search.enter(twin, q, p, eye, low, high);
            }
        }
        search.visited[face as usize] = false;
    }
    search.best
}

/// Exact distances from a source to the targets.
pub(crate) fn distances(mesh: &Mesh, source: &SurfacePoint, targets: &[SurfacePoint]) -> Vec<f64> {
    let vertices: Vec<_> = (0..mesh.positions().len() as u32)
        .map(SurfacePoint::Vertex)
        .collect();
    let between: Vec<_> = vertices
        .iter()
        .map(|v| straight(mesh, v, &vertices))
        .collect();
    let mut known = straight(mesh, source, &vertices);
    let mut done = vec![false; known.len()];
    while let Some(v) = (0..known.len())
        .filter(|&v| !done[v] && known[v].is_finite())
        .min_by(|&a, &b| known[a].total_cmp(&known[b]))
    {
        done[v] = true;
        for w in 0..known.len() {
            known[w] = known[w].min(known[v] + between[v][w]);
        }
    }
    let mut best = straight(mesh, source, targets);
    for (v, &d) in vertices.iter().zip(&known) {
        for (best, rest) in best.iter_mut().zip(straight(mesh, v, targets)) {
            *best = best.min(d + rest);
        }
    }
    best
}
