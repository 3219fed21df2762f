//! Where two curves on a mesh cross.

use crate::surface::{Mesh, SurfacePoint, Vector3};

/// A curve on a mesh that is straight in every face: each two neighbouring points lie in or on a
/// common face.
#[derive(Debug)]
pub struct Curve<'a> {
    mesh: &'a Mesh,
    points: &'a [SurfacePoint],
    /// Arc length from the start to each point, metres.
    lengths: Vec<f64>,
    /// (face, segment), sorted.
    by_face: Vec<(u32, u32)>,
}

/// One crossing of two curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Where.
    pub point: SurfacePoint,
    /// Arc length on the first curve, metres.
    pub on_first: f64,
    /// Arc length on the second curve, metres.
    pub on_second: f64,
    /// Angle between the directions of travel, radians, in (0, pi).
    pub angle: f64,
}

/// Curves meet mesh edges at rounded points; a crossing on an edge may miss both segments by as
/// much, in shares of a segment.
const SLACK: f64 = 1e-9;
/// Hits of one crossing in two faces lie this close on the first curve, in shares of its length.
const SAME: f64 = 1e-8;
/// Directions closer than this (sine of the angle) do not cross but run along each other.
const PARALLEL: f64 = 1e-9;

impl<'a> Curve<'a> {
    /// Prepares a curve for crossing.
    pub fn new(mesh: &'a Mesh, points: &'a [SurfacePoint]) -> Self {
        let mut lengths = Vec::with_capacity(points.len());
        let mut by_face = Vec::new();
        let mut length = 0.0;
        for (i, point) in points.iter().enumerate() {
            if i > 0 {
                length += (point.position(mesh) - points[i - 1].position(mesh)).norm();
                let faces = points[i - 1].faces(mesh);
                for face in point.faces(mesh).into_iter().filter(|f| faces.contains(f)) {
                    by_face.push((face, i as u32 - 1));
                }
            }
            lengths.push(length);
        }
        by_face.sort_unstable();
        Self {
            mesh,
            points,
            lengths,
            by_face,
        }
    }

    /// Arc length, metres.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    fn segments_in(&self, face: u32) -> impl Iterator<Item = usize> + '_ {
        let from = self.by_face.partition_point(|&(f, _)| f < face);
        self.by_face[from..]
            .iter()
            .take_while(move |&&(f, _)| f == face)
            .map(|&(_, s)| s as usize)
    }

    /// Ends of a segment in barycentric coordinates of a face.
    fn segment(&self, face: u32, segment: usize) -> Option<[[f64; 3]; 2]> {
        let a = self.points[segment].bary_in(self.mesh, face)?;
        let b = self.points[segment + 1].bary_in(self.mesh, face)?;
        Some([a, b])
    }

    /// Direction in which the curve passes one of its points.
    fn through(&self, point: usize) -> Vector3 {
        let before = point.saturating_sub(1);
        let after = (point + 1).min(self.points.len() - 1);
        self.points[after].position(self.mesh) - self.points[before].position(self.mesh)
    }

    fn direction(&self, segment: usize) -> Vector3 {
        self.points[segment + 1].position(self.mesh) - self.points[segment].position(self.mesh)
    }
}

/// All crossings of two curves on one mesh, by ascending arc length on the first. Stretches along
/// which the curves coincide count as no crossing.
pub fn crossings(first: &Curve<'_>, second: &Curve<'_>) -> Vec<Hit> {
    let mut hits = Vec::new();
    for &(face, j) in &second.by_face {
        for i in first.segments_in(face) {
            hits.extend(cross_in_face(first, i, second, j as usize, face));
        }
    }
    hits.extend(at_vertices(first, second));
    hits.sort_by(|a, b| a.on_first.total_cmp(&b.on_first));
    let same = SAME * first.length().max(second.length());
    hits.dedup_by(|b, a| {
        (b.on_first - a.on_first).abs() <= same && (b.on_second - a.on_second).abs() <= same
    });
    hits
}

/// Meetings at a vertex: there two curves may have no face in common.
fn at_vertices(first: &Curve<'_>, second: &Curve<'_>) -> Vec<Hit> {
    let vertices = |curve: &Curve<'_>| -> Vec<(u32, usize)> {
        let at = |(i, p): (usize, &SurfacePoint)| match p {
            SurfacePoint::Vertex(v) => Some((*v, i)),
            _ => None,
        };
        curve.points.iter().enumerate().filter_map(at).collect()
    };
    let others = vertices(second);
    let mut hits = Vec::new();
    for (vertex, i) in vertices(first) {
        for &(_, j) in others.iter().filter(|(v, _)| *v == vertex) {
            let (u, v) = (first.through(i), second.through(j));
            if u.cross(&v).norm() > PARALLEL * u.norm() * v.norm() {
                hits.push(Hit {
                    point: SurfacePoint::Vertex(vertex),
                    on_first: first.lengths[i],
                    on_second: second.lengths[j],
                    angle: libm::atan2(u.cross(&v).norm(), u.dot(&v)),
                });
            }
        }
    }
    hits
}

fn cross_in_face(
    first: &Curve<'_>,
    i: usize,
    second: &Curve<'_>,
    j: usize,
    face: u32,
) -> Option<Hit> {
    let [a, b] = first.segment(face, i)?;
    let [c, d] = second.segment(face, j)?;
    // Two barycentric coordinates are an affine frame of the face.
    let along = [b[0] - a[0], b[1] - a[1]];
    let other = [d[0] - c[0], d[1] - c[1]];
    let between = [c[0] - a[0], c[1] - a[1]];
    let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let det = cross(along, other);
    let (u, v) = (first.direction(i), second.direction(j));
    let (lu, lv) = (u.norm(), v.norm());
    let sine = u.cross(&v).norm() / (lu * lv);
    if det == 0.0 || sine.is_nan() || sine <= PARALLEL {
        return None;
    }
    let (s, t) = (cross(between, other) / det, cross(between, along) / det);
    let inside = |x: f64| (-SLACK..=1.0 + SLACK).contains(&x);
    if !(inside(s) && inside(t)) {
        return None;
    }
    let (s, t) = (s.clamp(0.0, 1.0), t.clamp(0.0, 1.0));
    let bary = std::array::from_fn(|k| a[k] + s * (b[k] - a[k]));
    Some(Hit {
        point: SurfacePoint::in_face(first.mesh, face, bary)?,
        on_first: first.lengths[i] + s * (first.lengths[i + 1] - first.lengths[i]),
        on_second: second.lengths[j] + t * (second.lengths[j + 1] - second.lengths[j]),
        angle: libm::atan2(u.cross(&v).norm(), u.dot(&v)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::HalfEdge;

    /// n x n squares over the unit square, each cut along its rising diagonal.
    fn plane(n: u32) -> Mesh {
        let at = |i: u32, j: u32| j * (n + 1) + i;
        let step = 1.0 / f64::from(n);
        let positions = (0..=n)
            .flat_map(|j| {
                (0..=n).map(move |i| [f64::from(i) * step, f64::from(j) * step, 0.0].into())
            })
            .collect();
        let faces = (0..n)
            .flat_map(|j| {
                (0..n).flat_map(move |i| {
                    [
                        [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
                        [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
                    ]
                })
            })
            .collect();
        Mesh::new(positions, faces).unwrap()
    }

    /// The straight line between two points of the plane as a curve over the faces.
    fn straight(mesh: &Mesh, a: [f64; 2], b: [f64; 2]) -> Vec<SurfacePoint> {
        let mut cuts: Vec<(f64, SurfacePoint)> = Vec::new();
        for face in 0..mesh.faces().len() as u32 {
            for corner in 0..3 {
                let h = HalfEdge::new(face, corner);
                let (p, e) = (mesh.position(mesh.origin(h)), mesh.edge_vector(h));
                let det = (b[0] - a[0]) * e.y - (b[1] - a[1]) * e.x;
                if det == 0.0 {
                    continue;
                }
                let (dx, dy) = (p.x - a[0], p.y - a[1]);
                let t = (dx * e.y - dy * e.x) / det;
                let s = (dx * (b[1] - a[1]) - dy * (b[0] - a[0])) / det;
                if (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&s) {
                    cuts.push((t, SurfacePoint::on_half_edge(mesh, h, s)));
                }
            }
        }
        cuts.sort_by(|x, y| x.0.total_cmp(&y.0));
        cuts.dedup_by(|x, y| (x.0 - y.0).abs() < 1e-12);
        cuts.into_iter().map(|(_, p)| p).collect()
    }

    #[test]
    fn two_lines_cross_once_where_they_should() {
        let mesh = plane(7);
        let first = straight(&mesh, [0.0, 0.21], [1.0, 0.77]);
        let second = straight(&mesh, [0.33, 0.0], [0.61, 1.0]);
        let (first, second) = (Curve::new(&mesh, &first), Curve::new(&mesh, &second));
        let hits = crossings(&first, &second);
        assert_eq!(hits.len(), 1);
        let p = hits[0].point.position(&mesh);
        let x = (0.33 + 0.28 * 0.21) / (1.0 - 0.28 * 0.56);
        assert!((p.x - x).abs() < 1e-12 && (p.y - (0.21 + 0.56 * x)).abs() < 1e-12);
        assert!((hits[0].on_first - libm::hypot(x, p.y - 0.21)).abs() < 1e-12);
        assert!((hits[0].on_second - libm::hypot(x - 0.33, p.y)).abs() < 1e-12);
        let angle = libm::atan2(1.0, 0.28) - libm::atan2(0.56, 1.0);
        assert!((hits[0].angle - angle).abs() < 1e-12);
    }

    #[test]
    fn a_crossing_on_an_edge_or_a_vertex_counts_once() {
        let mesh = plane(4);
        let rising = straight(&mesh, [0.0, 0.0], [1.0, 1.0]);
        for (a, b) in [
            ([0.0, 1.0], [1.0, 0.0]),
            ([0.5, 0.0], [0.5, 1.0]),
            ([0.3, 0.0], [0.3, 1.0]),
        ] {
            let other = straight(&mesh, a, b);
            let hits = crossings(&Curve::new(&mesh, &rising), &Curve::new(&mesh, &other));
            assert_eq!(hits.len(), 1, "{a:?} {b:?}");
        }
    }

    #[test]
    fn lines_beside_and_along_each_other_do_not_cross() {
        let mesh = plane(4);
        let line = straight(&mesh, [0.0, 0.5], [1.0, 0.5]);
        let beside = straight(&mesh, [0.0, 0.6], [1.0, 0.6]);
        let at = |points: &[SurfacePoint]| {
            crossings(&Curve::new(&mesh, &line), &Curve::new(&mesh, points))
        };
        assert_eq!(at(&beside), []);
        assert_eq!(at(&line), []);
    }
}
