//! A side of a patch: a piece of a shortest geodesic, parametrised by shares of its length.

use crate::geodesic::Path;
use crate::surface::{Mesh, SubMesh, SurfacePoint, Tangent};
use serde::{Deserialize, Serialize};

/// A shortest geodesic that is walked at constant speed: a coordinate in [0, 1] is a share of arc
/// length (paper, section 3.2), the same on the surface and in the plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Side {
    path: Path,
    /// Arc length from the start to each point of the path, metres.
    lengths: Vec<f64>,
}

impl Side {
    /// A whole path as a side.
    pub fn new(mesh: &Mesh, path: Path) -> Self {
        let lengths = path.arc_lengths(mesh);
        Self { path, lengths }
    }

    /// The piece of this side between two shares, walked from `from` to `to`, which may be the
    /// smaller one. The whole side keeps its points to the last bit.
    #[must_use]
    pub fn piece(&self, mesh: &Mesh, from: f64, to: f64) -> Self {
        if from > to {
            return self.piece(mesh, to, from).reversed(mesh);
        }
        if (from, to) == (0.0, 1.0) {
            return self.clone();
        }
        let [s0, s1] = [from, to].map(|share| share * self.length());
        let mut points = vec![self.at(mesh, from)];
        let mut faces = Vec::new();
        for (i, &face) in self.path.faces.iter().enumerate() {
            let next = self.lengths[i + 1];
            if next <= s0 || self.lengths[i] >= s1 {
                continue;
            }
            let point = if next >= s1 {
                self.at(mesh, to)
            } else {
                self.path.points[i + 1]
            };
            if points.last() != Some(&point) {
                points.push(point);
                faces.push(face);
            }
        }
        let path = Path {
            points,
            faces,
            length: s1 - s0,
            start: self.tangent(mesh, from),
            end: self.tangent(mesh, to),
        };
        Self::new(mesh, path)
    }

    /// The same side walked from its end.
    #[must_use]
    pub fn reversed(&self, mesh: &Mesh) -> Self {
        Self::new(mesh, self.path.reversed())
    }

    /// The same side on a part of its mesh; `None` if some of it is not there.
    pub fn on_part(&self, parent: &Mesh, part: &SubMesh) -> Option<Self> {
        let point = |p: &SurfacePoint| part.point_from_parent(parent, p);
        let face = |f: &u32| part.face_from_parent(*f);
        let tangent = |t: &Tangent| {
            Some(Tangent {
                face: part.face_from_parent(t.face)?,
                direction: t.direction,
            })
        };
        let path = Path {
            points: self.path.points.iter().map(point).collect::<Option<_>>()?,
            faces: self.path.faces.iter().map(face).collect::<Option<_>>()?,
            length: self.path.length,
            start: tangent(&self.path.start)?,
            end: tangent(&self.path.end)?,
        };
        Some(Self {
            path,
            lengths: self.lengths.clone(),
        })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Metres.
    pub fn length(&self) -> f64 {
        self.path.length
    }

    /// The point at a share of the length.
    pub fn at(&self, mesh: &Mesh, share: f64) -> SurfacePoint {
        let points = &self.path.points;
        if share <= 0.0 {
            return points[0];
        }
        if share >= 1.0 {
            return points[points.len() - 1];
        }
        let total = self.lengths[self.lengths.len() - 1];
        let s = share * total;
        let i = self
            .lengths
            .partition_point(|&l| l <= s)
            .clamp(1, points.len() - 1)
            - 1;
        let piece = self.lengths[i + 1] - self.lengths[i];
        let t = if piece > 0.0 {
            (s - self.lengths[i]) / piece
        } else {
            0.0
        };
        between(mesh, &points[i], &points[i + 1], self.path.faces[i], t)
    }

    /// Direction of travel at a share of the length.
    pub fn tangent(&self, mesh: &Mesh, share: f64) -> Tangent {
        self.path.tangent_at(mesh, share * self.length())
    }

    /// The share of the point of this side that is closest in space to a point on it.
    pub fn share_of(&self, mesh: &Mesh, point: &SurfacePoint) -> f64 {
        let p = point.position(mesh);
        let mut best = (f64::INFINITY, 0.0);
        for (i, pair) in self.path.points.windows(2).enumerate() {
            let (a, b) = (pair[0].position(mesh), pair[1].position(mesh));
            let along = b - a;
            let t = ((p - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            let distance = (a + along * t - p).norm();
            if distance < best.0 {
                best = (
                    distance,
                    self.lengths[i] + t * (self.lengths[i + 1] - self.lengths[i]),
                );
            }
        }
        (best.1 / self.length()).clamp(0.0, 1.0)
    }
}

/// The point at the share `t` of the straight piece between two points of a face.
fn between(mesh: &Mesh, from: &SurfacePoint, to: &SurfacePoint, face: u32, t: f64) -> SurfacePoint {
    let bary = from.bary_in(mesh, face).zip(to.bary_in(mesh, face));
    bary.and_then(|(a, b)| {
        SurfacePoint::in_face(
            mesh,
            face,
            std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t),
        )
    })
    .unwrap_or(*from)
}
