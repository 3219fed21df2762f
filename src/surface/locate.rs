//! Finds surface points: the closest to a point in space, and the topmost over a point of the
//! plan.
//!
//! Boxes around faces stand in a bounding volume hierarchy. The vertical query is watertight: a
//! point over the surface is never lost between two faces, on an edge or at a vertex.

use super::segment::closest_on_segment;
use super::{Mesh, Point3, SurfacePoint};
use bvh::aabb::{Aabb, Bounded, IntersectsAabb};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::point_query::PointDistance;
use nalgebra::{Point2, Vector2};

/// A miss by less than this share of the surface's diagonal is rounding (150 mm and 0.15 m are
/// different numbers) and counts as a hit of the border.
const ROUNDING: f64 = 1e-9;

/// Answers where points are on a mesh.
#[derive(Debug)]
pub struct Locator<'m> {
    mesh: &'m Mesh,
    faces: Vec<Face>,
    tree: Bvh<f64, 3>,
}

/// The closest point of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// The point.
    pub point: SurfacePoint,
    /// Its distance, metres.
    pub distance: f64,
}

/// There is no surface over a point of the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// The surface point that is nearest seen from above.
    pub nearest: SurfacePoint,
    /// Its horizontal distance, metres; infinite for coordinates that are not finite.
    pub distance: f64,
}

impl<'m> Locator<'m> {
    /// Sorts the faces of a mesh into a hierarchy.
    pub fn new(mesh: &'m Mesh) -> Self {
        let mut faces: Vec<Face> = (0..mesh.face_count())
            .map(|id| Face {
                id,
                corners: mesh.corners(id),
                node: 0,
            })
            .collect();
        let tree = Bvh::build(&mut faces);
        Self { mesh, faces, tree }
    }

    /// The point of the surface that is closest to a point in space; `None` if a coordinate is not
    /// finite or the mesh has no face.
    pub fn closest(&self, to: &Point3) -> Option<Closest> {
        if !to.iter().all(|c| c.is_finite()) {
            return None;
        }
        let (face, _) = self.tree.nearest_to(*to, &self.faces)?;
        let (bary, _) = face.closest(to);
        let point = SurfacePoint::in_face(self.mesh, face.id, bary)?;
        Some(Closest {
            point,
            distance: (point.position(self.mesh) - to).norm(),
        })
    }

    /// The topmost point of the surface over a point of the plan.
    ///
    /// # Errors
    /// There is none; a miss by rounding is a hit of the border.
    pub fn topmost(&self, plan: [f64; 2]) -> Result<SurfacePoint, Miss> {
        let line = VerticalLine(plan.into());
        let highest = self
            .tree
            .traverse(&line, &self.faces)
            .into_iter()
            .filter_map(|face| {
                let (bary, z) = face.over(&line.0)?;
                Some((z, face.id, bary))
            })
            .max_by(|p, q| p.0.total_cmp(&q.0).then(q.1.cmp(&p.1)));
        if let Some(point) =
            highest.and_then(|(_, face, bary)| SurfacePoint::in_face(self.mesh, face, bary))
        {
            return Ok(point);
        }
        let miss = self.nearest_in_plan(&line.0);
        let (low, high) = self.mesh.bounding_box();
        if miss.distance <= ROUNDING * (high - low).norm() {
            Ok(miss.nearest)
        } else {
            Err(miss)
        }
    }

    /// The nearest point in plan of a point that no face covers: it lies on an edge. Looks at all
    /// edges, since it answers mistakes.
    fn nearest_in_plan(&self, to: &Point2<f64>) -> Miss {
        let mut nearest = (f64::INFINITY, f64::NEG_INFINITY, SurfacePoint::Vertex(0));
        for h in self.mesh.edges() {
            let [a, b] = [self.mesh.origin(h), self.mesh.target(h)].map(|v| self.mesh.position(v));
            let (share, offset) = closest_on_segment(a.xy() - to, b.xy() - to);
            let (distance, z) = (offset.norm(), a.z + (b.z - a.z) * share);
            if distance < nearest.0 || distance == nearest.0 && z > nearest.1 {
                let point = SurfacePoint::on_half_edge(self.mesh, h, share);
                nearest = (distance, z, point);
            }
        }
        Miss {
            nearest: nearest.2,
            distance: nearest.0,
        }
    }
}

/// A face in the hierarchy.
#[derive(Debug)]
struct Face {
    id: u32,
    corners: [Point3; 3],
    node: usize,
}

impl Face {
    /// Barycentric coordinates and squared distance of the closest point: the best of the foot of
    /// the perpendicular, if it lies inside, and the closest points of the sides. Measuring the
    /// candidates themselves keeps slivers honest, whose perpendicular is mostly rounding.
    fn closest(&self, to: &Point3) -> ([f64; 3], f64) {
        let [a, b, c] = self.corners.map(|p| p - to);
        let mut best = ([1.0, 0.0, 0.0], a.norm_squared());
        for corner in 0..3 {
            let next = (corner + 1) % 3;
            let ends = [a, b, c];
            let (share, offset) = closest_on_segment(ends[corner], ends[next]);
            if offset.norm_squared() < best.1 {
                let mut bary = [0.0; 3];
                bary[corner] = 1.0 - share;
                bary[next] = share;
                best = (bary, offset.norm_squared());
            }
        }
        let normal = (b - a).cross(&(c - a));
        let square = normal.norm_squared();
        // Gradients of the barycentric coordinates. On a sliver the first answer is off along it
        // by rounding over its height; the second round measures what is left of that.
        let gradients = [c - b, a - c, b - a].map(|side| normal.cross(&side));
        let mut bary = [1.0, 0.0, 0.0];
        for _ in 0..2 {
            let offset = a * bary[0] + b * bary[1] + c * bary[2];
            for (share, gradient) in bary.iter_mut().zip(&gradients) {
                *share -= gradient.dot(&offset) / square;
            }
        }
        let offset = a * bary[0] + b * bary[1] + c * bary[2];
        if bary.iter().all(|&share| share > 0.0) && offset.norm_squared() < best.1 {
            best = (bary, offset.norm_squared());
        }
        best
    }

    /// Barycentric coordinates and height of the topmost point over a point of the plan.
    ///
    /// Corners are moved such that the plan point is the origin, each corner by the same rounding
    /// in all its faces; the sign of a difference of two rounded products is never the opposite of
    /// the true one (Woop, Benthin, Wald 2013), and zero counts as inside for the faces on both
    /// sides of an edge. So no point between two faces is lost.
    fn over(&self, plan: &Point2<f64>) -> Option<([f64; 3], f64)> {
        let [a, b, c] = self.corners.map(|p| p.xy() - plan);
        let turns = [turn(&b, &c), turn(&c, &a), turn(&a, &b)];
        let sum = turns[0] + turns[1] + turns[2];
        let inside = turns.iter().all(|&t| t >= 0.0) || turns.iter().all(|&t| t <= 0.0);
        if inside && sum != 0.0 {
            let bary = turns.map(|t| t / sum);
            return Some((bary, self.height(bary)));
        }
        // Seen edge-on: the top of the cut through the face lies on a side.
        (0..3)
            .filter(|_| inside)
            .filter_map(|corner| {
                let next = (corner + 1) % 3;
                let (p, q) = ([a, b, c][corner], [a, b, c][next]);
                if p.dot(&q) > 0.0 {
                    return None;
                }
                let along = q - p;
                let axis = along.iamax();
                let share = if along[axis] != 0.0 {
                    (-p[axis] / along[axis]).clamp(0.0, 1.0)
                } else if self.corners[next].z > self.corners[corner].z {
                    1.0
                } else {
                    0.0
                };
                let mut bary = [0.0; 3];
                bary[corner] = 1.0 - share;
                bary[next] = share;
                Some((bary, self.height(bary)))
            })
            .max_by(|p, q| p.1.total_cmp(&q.1))
    }

    fn height(&self, bary: [f64; 3]) -> f64 {
        let [a, b, c] = self.corners;
        a.z * bary[0] + b.z * bary[1] + c.z * bary[2]
    }
}

/// Twice the signed area of the triangle of the origin and two points.
fn turn(p: &Vector2<f64>, q: &Vector2<f64>) -> f64 {
    p.x * q.y - p.y * q.x
}

impl Bounded<f64, 3> for Face {
    fn aabb(&self) -> Aabb<f64, 3> {
        let [a, b, c] = &self.corners;
        Aabb::with_bounds(a.inf(b).inf(c), a.sup(b).sup(c))
    }
}

impl BHShape<f64, 3> for Face {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl PointDistance<f64, 3> for Face {
    fn distance_squared(&self, to: Point3) -> f64 {
        self.closest(&to).1
    }
}

/// All points over a point of the plan.
struct VerticalLine(Point2<f64>);

impl IntersectsAabb<f64, 3> for VerticalLine {
    fn intersects_aabb(&self, aabb: &Aabb<f64, 3>) -> bool {
        (0..2).all(|i| aabb.min[i] <= self.0[i] && self.0[i] <= aabb.max[i])
    }
}
