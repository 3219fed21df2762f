//! All geodesics from a point to another that leave within a range of directions: rays are followed
//! over the faces and parted at every vertex that they meet (J. Chen, Y. Han, *Shortest paths on a
//! polyhedron*, 1990). Made for narrow ranges, where there are few.

use super::charts::Charts;
use super::laid::{Laid, V2, apex, cross, dot, norm, sub, turned};
use super::unrolled::Strip;
use crate::surface::{HalfEdge, Mesh, SurfacePoint};
use std::f64::consts::PI;

/// Faces that are entered before the range counts as too wide.
const MOST_FACES: usize = 6000;

/// A path that is longer by this share is none of interest.
const LONGER: f64 = 1.0 - 1e-13;

/// A point that misses a cone by this angle is in it.
const TOUCHING: f64 = 1e-12;

/// Follows rays; keeps what it allocates.
#[derive(Default)]
pub(super) struct Rays {
    faces: Vec<Entered>,
    bends: Vec<Bend>,
}

/// A vertex that rays have met and where paths may bend.
#[derive(Debug, Clone, Copy)]
struct Bend {
    vertex: u32,
    at: V2,
    /// A face with the vertex through which the rays came, and its place among those entered.
    laid: Laid,
    index: u32,
    /// Where the rays come from, and how far that is from the begin, metres.
    root: V2,
    sigma: f64,
}

/// A face that rays have entered.
#[derive(Debug, Clone, Copy)]
struct Entered {
    laid: Laid,
    /// Where the rays come from, and how far that is from the begin, metres.
    root: V2,
    sigma: f64,
    /// The outermost rays.
    low: V2,
    high: V2,
    /// The half-edge that was left to enter, and the face before; none for a first face.
    exit: HalfEdge,
    before: u32,
    /// Whether rays do not go on from here: a face around a saddle.
    ends: bool,
}

const NONE: u32 = u32::MAX;

/// What rays join.
pub(super) struct Ends<'a> {
    pub(super) from: &'a SurfacePoint,
    /// The faces around the begin, with it at the origin of their plane.
    pub(super) around: &'a [Laid],
    pub(super) to: &'a SurfacePoint,
}

/// What the rays found.
pub(super) enum Found {
    /// No shorter path.
    Nothing,
    /// A strip of faces that holds a shorter one.
    Shorter(Strip),
    /// There were too many ways to look at.
    Unknown,
}

impl Rays {
    /// Looks for a path shorter than a length that leaves its begin within angles, radians, on the left
    /// and right of a direction.
    pub(super) fn shorter(
        &mut self,
        (mesh, charts): (&Mesh, &Charts),
        ends: &Ends<'_>,
        direction: V2,
        [left, right]: [f64; 2],
        length: f64,
    ) -> Found {
        if left.max(right) > 1.0 {
            return Found::Unknown;
        }
        let low = turned(direction, -right - TOUCHING);
        let high = turned(direction, left + TOUCHING);
        self.faces.clear();
        self.bends.clear();
        let mut best = length * LONGER;
        let mut found = None;
        for laid in ends.around {
            let corners = laid.corners(charts);
            for (h, at) in corners {
                let vertex = mesh.origin(h);
                if *ends.from != SurfacePoint::Vertex(vertex) && dot(direction, at) > 0.0 {
                    self.bends.push(Bend {
                        vertex,
                        at,
                        laid: *laid,
                        index: NONE,
                        root: [0.0; 2],
                        sigma: 0.0,
                    });
                    self.keep_bend(charts, (low, high), best);
                }
            }
            for k in 0..3 {
                let (exit, at) = corners[k];
                let (_, next) = corners[(k + 1) % 3];
                // Leaving over `exit`, its target is on the left.
                self.part(
                    mesh,
                    NONE,
                    exit,
                    (next, at),
                    ([0.0; 2], 0.0),
                    (low, high),
                    direction,
                );
            }
        }
        let goal = ends.to.faces(mesh);
        let mut at = 0;
        loop {
            if self.faces.len() > MOST_FACES {
                return Found::Unknown;
            }
            while let Some(bend) = self.bends.pop() {
                if self.bend(mesh, charts, &bend, best).is_none() {
                    return Found::Unknown;
                }
            }
            if at == self.faces.len() {
                break;
            }
            let here = self.faces[at];
            let index = at as u32;
            at += 1;
            let Entered {
                laid,
                root,
                sigma,
                low,
                high,
                ends: done,
                ..
            } = here;
            if goal.contains(&laid.entry.face())
                && let Some(image) = laid.image(mesh, charts, ends.to)
            {
                let ray = sub(image, root);
                let way = norm(ray);
                let wide = TOUCHING * way;
                if cross(low, ray) >= -wide * norm(low)
                    && cross(ray, high) >= -wide * norm(high)
                    && sigma + way < best
                {
                    best = sigma + way;
                    found = Some(index);
                }
            }
            if done || sigma + distance(root, laid.right, laid.left, low, high) >= best {
                continue;
            }
            let corner = apex(laid.left, laid.right, &charts.steps[laid.entry.0 as usize]);
            let vertex = mesh.origin(laid.entry.prev());
            self.bends.push(Bend {
                vertex,
                at: corner,
                laid,
                index,
                root,
                sigma,
            });
            self.keep_bend(charts, (low, high), best);
            let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
            let (next, prev) = (laid.entry.next(), laid.entry.prev());
            self.part(
                mesh,
                index,
                next,
                (corner, laid.right),
                (root, sigma),
                (low, high),
                middle,
            );
            self.part(
                mesh,
                index,
                prev,
                (laid.left, corner),
                (root, sigma),
                (low, high),
                middle,
            );
        }
        match found {
            None => Found::Nothing,
            Some(index) => Found::Shorter(self.strip(index)),
        }
    }

    /// Lets the rays that pass an edge enter the face beyond.
    #[expect(clippy::too_many_arguments, reason = "a ray has many parts")]
    fn part(
        &mut self,
        mesh: &Mesh,
        before: u32,
        exit: HalfEdge,
        (left, right): (V2, V2),
        (root, sigma): (V2, f64),
        (low, high): (V2, V2),
        middle: V2,
    ) {
        let (to_left, to_right) = (sub(left, root), sub(right, root));
        // The edge is seen from its inner side.
        if cross(to_right, to_left) <= 0.0 {
            return;
        }
        let low = if cross(low, to_right) > 0.0 {
            to_right
        } else {
            low
        };
        let high = if cross(to_left, high) > 0.0 {
            to_left
        } else {
            high
        };
        if cross(low, high) <= 0.0 || dot(middle, low) <= 0.0 || dot(middle, high) <= 0.0 {
            return;
        }
        let Some(entry) = mesh.twin(exit) else {
            return;
        };
        self.faces.push(Entered {
            laid: Laid { entry, left, right },
            root,
            sigma,
            low,
            high,
            exit,
            before,
            ends: false,
        });
    }

    /// Drops the last bend if the rays do not meet its vertex, or straight paths pass it.
    fn keep_bend(&mut self, charts: &Charts, (low, high): (V2, V2), best: f64) {
        let Some(bend) = self.bends.last() else {
            return;
        };
        let ray = sub(bend.at, bend.root);
        let met = cross(low, ray) >= 0.0 && cross(ray, high) >= 0.0;
        if !(met && charts.bends[bend.vertex as usize] && bend.sigma + norm(ray) < best) {
            self.bends.pop();
        }
    }

    /// Lets the rays of a saddle go on in its shadow. `None` at the border.
    fn bend(&mut self, mesh: &Mesh, charts: &Charts, bend: &Bend, best: f64) -> Option<()> {
        let Bend { vertex, at, .. } = *bend;
        if mesh.is_border_vertex(vertex) {
            return None;
        }
        let ahead = sub(at, bend.root);
        let excess = charts.total_angles[vertex as usize] - 2.0 * PI;
        // Seen over the faces on the left of the vertex: from straight on to the right.
        let high = ahead;
        let low = turned(ahead, -excess);
        let sigma = bend.sigma + norm(ahead);
        let mut laid = bend.laid;
        let mut index = bend.index;
        let mut exit = laid.spoke(mesh, vertex)?;
        let faces = mesh.outgoing(vertex).count();
        for _ in 0..faces {
            // Over the half-edge that leaves the vertex, clockwise around it.
            laid = laid.across(mesh, charts, exit)?;
            let corners = laid.corners(charts);
            let own = corners
                .iter()
                .position(|&(h, _)| mesh.origin(h) == vertex)?;
            let [(outgoing, _), (opposite, right), (_, left)] =
                [0, 1, 2].map(|k| corners[(own + k) % 3]);
            self.faces.push(Entered {
                laid,
                root: at,
                sigma,
                low,
                high,
                exit,
                before: index,
                ends: true,
            });
            index = self.faces.len() as u32 - 1;
            self.part(
                mesh,
                index,
                opposite,
                (left, right),
                (at, sigma),
                (low, high),
                ahead,
            );
            self.bends.push(Bend {
                vertex: mesh.origin(opposite),
                at: right,
                laid,
                index,
                root: at,
                sigma,
            });
            self.keep_bend(charts, (low, high), best);
            // Past the last direction of the shadow.
            if cross(sub(right, at), low) >= 0.0 && dot(sub(right, at), low) > 0.0 {
                break;
            }
            exit = outgoing;
        }
        Some(())
    }

    fn strip(&self, index: u32) -> Strip {
        let mut through = Vec::new();
        let mut at = index;
        while at != NONE {
            let entered = &self.faces[at as usize];
            through.push(entered.exit);
            at = entered.before;
        }
        through.reverse();
        let face = through[0].face();
        Strip { through, face }
    }
}

/// Distance of a root from the part of an edge between two rays.
fn distance(root: V2, right: V2, left: V2, low: V2, high: V2) -> f64 {
    let along = sub(left, right);
    let out = sub(right, root);
    let meet = |ray: V2| {
        // right + along t on the ray from the root
        let below = cross(ray, along);
        let t = if below > 0.0 {
            cross(out, ray) / below
        } else {
            0.0
        };
        t.clamp(0.0, 1.0)
    };
    let (from, to) = (meet(low), meet(high));
    let foot = -dot(out, along) / dot(along, along);
    let t = foot.clamp(from.min(to), to.max(from));
    norm([out[0] + along[0] * t, out[1] + along[1] * t])
}
