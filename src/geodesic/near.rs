//! Which vertices another geodesic with the same ends can have on its other side: those below its
//! bound, found from the path outward.

use super::certificate::NO_CURVATURE;
use super::charts::Charts;
use super::heights::{Heights, widening};
use super::laid::{Laid, Side, Turn};
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

/// Faces that are higher than the bound by this factor have their third corner on the other side
/// of the path.
const HIGH: f64 = 2.2;

/// Finds vertices near paths; keeps what it allocates.
#[derive(Default)]
pub(super) struct Near {
    found: Vec<Corner>,
    seen: Seen,
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
    /// on one side; zero if there is none. `None` if that cannot be said.
    pub(super) fn turn(
        &mut self,
        (mesh, charts): (&Mesh, &Charts),
        path: &Unrolled,
        length: f64,
        side: Side,
        heights: &Heights,
    ) -> Option<f64> {
        if heights.turn <= NO_CURVATURE {
            return Some(0.0);
        }
        if heights.turn > WIDEST {
            return None;
        }
        let slack = SLACK + LEAN * heights.turn;
        let limits = heights.limits(slack);
        let places = limits.len() as f64 / length;
        let below = |height: f64, along: f64| {
            // Before the begin and beyond the end the outermost limits hold.
            let place = (along * places) as usize;
            height < limits[place.min(limits.len() - 1)]
        };
        self.found.clear();
        self.seen.begin(mesh.positions().len());
        let mut last = u32::MAX;
        let mut before = &path.first;
        for (leg, crossed) in path.legs() {
            for laid in &path.faces[crossed] {
                let vertex = laid.vertex(mesh, side);
                if vertex != last {
                    last = vertex;
                    let (height, along) = leg.see(laid.end(side), side);
                    if below(height, along) {
                        self.seen.note(vertex);
                        self.found.push(Corner {
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
        self.spread(mesh, charts, side, slack * heights.highest(), &below)?;
        Some(self.settle(length, slack))
    }

    /// Vertices below the bound in the faces around those that are, and so on.
    fn spread(
        &mut self,
        mesh: &Mesh,
        charts: &Charts,
        side: Side,
        highest: f64,
        below: &impl Fn(f64, f64) -> bool,
    ) -> Option<()> {
        let mut next = 0;
        while let Some(&corner) = self.found.get(next) {
            next += 1;
            // Two ends of a side below the bound, with a face on the path's side that is so high: the
            // path passes through it, so both were seen.
            if charts.least_heights[corner.vertex as usize] > HIGH * highest {
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
                if height < 0.0 || !below(height, along) {
                    continue;
                }
                if self.found.len() >= MOST {
                    return None;
                }
                self.found.push(Corner {
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

    /// Lowers the bound to what the vertices below it allow, again and again.
    fn settle(&mut self, length: f64, slack: f64) -> f64 {
        let found = &mut self.found;
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
}
