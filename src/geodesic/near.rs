//! Which vertices another geodesic with the same ends can have on its other side: those below its
//! bound, found from the path outward.

use super::certificate::NO_CURVATURE;
use super::charts::Charts;
use super::heights::{Heights, widening};
use super::laid::{Laid, Side, Turn};
use super::trail::PLACES;
use super::unrolled::{Leg, Unrolled};
use crate::surface::{HalfEdge, Mesh};

/// More vertices near a path are not told apart.
const MOST: usize = 96;

/// Unfolded over several faces, heights are known to this share of the bound.
const SLACK: f64 = 1.05;

/// And so much worse, as a share, for each radian below the bound.
const LEAN: f64 = 2.0;

/// Under so much curvature, radians, nothing is unfolded truly.
const WIDEST: f64 = 0.5;

/// Faces that are higher than the bound by this factor do not fit below it.
const HIGH: f64 = 1.25;

/// Finds vertices near paths; keeps what it allocates.
#[derive(Default)]
pub(super) struct Near {
    /// On the left and on the right.
    found: [Vec<Corner>; 2],
    seen: Seen,
}

/// Bounds of heights by places along a path.
struct Limits {
    /// Metres.
    at: [f64; PLACES],
    /// By metre.
    places: f64,
    /// For what is not known better.
    slack: f64,
}

impl Limits {
    fn new(heights: &Heights, length: f64) -> Self {
        let slack = SLACK + LEAN * heights.turn.min(WIDEST);
        Self {
            at: heights.limits(slack),
            places: PLACES as f64 / length,
            slack,
        }
    }

    /// The bound about a place, metres; before the begin and beyond the end the outermost ones hold.
    #[inline]
    fn about(&self, along: f64) -> f64 {
        let place = (along * self.places) as usize;
        self.at[place.min(PLACES - 1)]
    }

    /// Whether a place beside the path is below.
    #[inline]
    fn are_above(&self, height: f64, along: f64) -> bool {
        height < self.about(along)
    }
}

/// The vertices that were looked at.
#[derive(Default)]
struct Seen {
    /// Per vertex the search that saw it last.
    by: Vec<u32>,
    search: u32,
}

impl Seen {
    fn begin(&mut self, vertices: usize) {
        if self.by.len() != vertices || self.search == u32::MAX {
            *self = Self {
                by: vec![0; vertices],
                search: 0,
            };
        }
        self.search += 1;
    }

    /// Whether this is the first time.
    fn note(&mut self, vertex: u32) -> bool {
        let by = &mut self.by[vertex as usize];
        std::mem::replace(by, self.search) != self.search
    }
}

/// A vertex beside a path.
#[derive(Debug, Clone, Copy)]
struct Corner {
    vertex: u32,
    curvature: f64,
    /// Metres.
    height: f64,
    /// Arc length of the foot, metres.
    along: f64,
    /// A face around it in the plane of the strip, and the leg of the path below.
    laid: Laid,
    leg: Leg,
}

impl Near {
    /// The positive curvature, radians, that another geodesic may enclose with a path of a length
    /// on its left and right; zero if there is none. `None` where that cannot be said.
    pub(super) fn turns(
        &mut self,
        surface: (&Mesh, &Charts),
        path: &Unrolled,
        length: f64,
        heights: &[Heights; 2],
    ) -> [Option<f64>; 2] {
        let limits = heights
            .each_ref()
            .map(|heights| Limits::new(heights, length));
        self.look(surface, path, &limits);
        Side::BOTH.map(|side| {
            let (heights, limits) = (&heights[side as usize], &limits[side as usize]);
            if heights.turn <= NO_CURVATURE {
                return Some(0.0);
            }
            if heights.turn > WIDEST {
                return None;
            }
            self.spread(surface, side, limits)?;
            Some(settle(&mut self.found[side as usize], length, limits.slack))
        })
    }

    /// Notes the vertices of the path's own faces that are below the bounds.
    fn look(&mut self, (mesh, charts): (&Mesh, &Charts), path: &Unrolled, limits: &[Limits; 2]) {
        for found in &mut self.found {
            found.clear();
        }
        let mut before = &path.first;
        for (leg, crossed) in path.legs() {
            for i in crossed {
                let laid = &path.faces[i];
                for side in Side::BOTH {
                    let (at, limits) = (laid.end(side), &limits[side as usize]);
                    // From face to face one of the ends stays where it is.
                    if i > 0 && at == before.end(side) {
                        continue;
                    }
                    let (height, along) = leg.see(at, side);
                    if limits.are_above(height, along) {
                        let vertex = laid.vertex(mesh, side);
                        self.found[side as usize].push(Corner {
                            vertex,
                            curvature: charts.curvatures[vertex as usize],
                            height: height.max(0.0),
                            along,
                            laid: *before,
                            leg,
                        });
                    }
                }
                before = laid;
            }
        }
    }

    /// Vertices below the bound in the faces around those that are, and so on.
    fn spread(
        &mut self,
        (mesh, charts): (&Mesh, &Charts),
        side: Side,
        limits: &Limits,
    ) -> Option<()> {
        let found = &mut self.found[side as usize];
        // A side of a face with both ends below the bound, and the face so high: then its third
        // corner is on the other side of the path, which passes through it, and both were seen.
        let low = |corner: &Corner| {
            let least = charts.least_heights[corner.vertex as usize];
            least <= HIGH * limits.about(corner.along)
        };
        let Some(mut next) = found.iter().position(low) else {
            return Some(());
        };
        self.seen.begin(mesh.positions().len());
        for corner in found.iter() {
            self.seen.note(corner.vertex);
        }
        while let Some(&corner) = found.get(next) {
            next += 1;
            if !low(&corner) {
                continue;
            }
            // All the way around, or to the border on both sides.
            let begin = corner.laid.entry.face();
            let mut turn = Turn::Right;
            let mut laid = corner.laid;
            for _ in 0..mesh.faces().len() {
                match (laid.beside(mesh, charts, corner.vertex, turn), turn) {
                    (Some(next), _) if next.entry.face() == begin => break,
                    (Some(next), _) => laid = next,
                    (None, Turn::Right) => {
                        turn = Turn::Left;
                        laid = corner.laid;
                        continue;
                    }
                    (None, Turn::Left) => break,
                }
                // Its other corners were seen from the face before.
                let vertex = mesh.origin(HalfEdge::prev(laid.entry));
                if !self.seen.note(vertex) {
                    continue;
                }
                let (height, along) = corner.leg.see(laid.apex(charts), side);
                if height < 0.0 || !limits.are_above(height, along) {
                    continue;
                }
                if found.len() >= MOST {
                    return None;
                }
                found.push(Corner {
                    vertex,
                    curvature: charts.curvatures[vertex as usize],
                    height,
                    along,
                    laid,
                    leg: corner.leg,
                });
            }
        }
        Some(())
    }
}

/// Lowers the bound to what the vertices below it allow, again and again.
fn settle(found: &mut Vec<Corner>, length: f64, slack: f64) -> f64 {
    found.retain(|c| c.along > 0.0 && c.along < length);
    found.sort_unstable_by(|a, b| a.along.total_cmp(&b.along).then(a.vertex.cmp(&b.vertex)));
    loop {
        let (mut turn, mut rest) = (0.0, 0.0);
        for corner in found.iter() {
            let pull = corner.curvature.max(0.0);
            turn += pull;
            rest += pull * (length - corner.along);
        }
        if turn <= NO_CURVATURE {
            return 0.0;
        }
        // Σ κ g(x, r), over those before x and those behind.
        let factor = slack * widening(turn) / length;
        let mut passed = 0.0;
        let before = found.len();
        found.retain(|corner| {
            let (x, pull) = (corner.along, corner.curvature.max(0.0));
            passed += pull * x;
            rest -= pull * (length - x);
            corner.height < factor * (passed * (length - x) + rest.max(0.0) * x)
        });
        if found.len() == before {
            return turn;
        }
    }
}
