//! The other shortest lines around a path: on a surface that is curved like a hill, lines on both
//! sides of a vertex are shortest among their neighbours, and none can know from its own shape
//! that another one is shorter.
//!
//! Which vertices matter is a matter of their curvature: two geodesics with common ends enclose as
//! much curvature as the sum of the angles between them (Gauss-Bonnet), so the other one keeps
//! within a lens of that angle around this one. Let a path of length L lie on the x axis, with
//! vertices of curvature κ at (r, h) on one side. Seen from the begin, passing a set S of them on
//! their other sides turns what lies behind each one about it by its κ. The line that passes so is
//! straight in the plane that is turned with it; over the axis it runs at the height
//!
//! ```text
//! y(x) = Σ κ g(x, r),   g(x, r) = min(x, r) (L - max(x, r)) / L,
//! ```
//!
//! so S must be the vertices below y, and the square of its length differs from L² by
//! 2 L Σ κ h - L Σ Σ κ κ' g(r, r'), up to higher powers of κ. The sets that are so consistent are found
//! by iteration from each vertex and from all.

use super::charts::Charts;
use super::funnel::{Bend, Gate, Side};
use super::laid::{Laid, V2, cross, dot, norm, sub};
use super::relax::{EQUAL, Tight};
use crate::surface::{HalfEdge, Mesh};
use std::f64::consts::PI;

/// Curvatures below, radians, change lengths by less than rounding.
const FLAT: f64 = 1e-7;

/// Vertices in a lens that are looked at; more are not told apart by the curvature between them.
const MOST: usize = 24;

/// Iterations of a set; it settles in two or three.
const ROUNDS: usize = 8;

/// Looks for other branches; keeps what it allocates.
#[derive(Default)]
pub(super) struct Lens {
    found: Vec<Corner>,
    promising: Vec<(f64, V2)>,
}

/// A vertex beside a path.
#[derive(Debug, Clone, Copy)]
struct Corner {
    vertex: u32,
    curvature: f64,
    /// Distance from the path, metres.
    height: f64,
    /// Distance from the begin along the path, metres.
    along: f64,
    /// Angle of the lens that reaches the vertex, radians.
    slope: f64,
}

impl Lens {
    /// Where the end of a path would be, seen from its begin, along branches that promise to be
    /// shorter, the best first.
    pub(super) fn shorter(
        &mut self,
        mesh: &Mesh,
        charts: &Charts,
        (faces, gates, bends): (&[Laid], &[Gate], &[Bend]),
        path: &Tight,
    ) -> &[(f64, V2)] {
        let length = path.length;
        let [x, y] = path.ahead.map(|x| x / length);
        let mut promising = std::mem::take(&mut self.promising);
        promising.clear();
        for side in [Side::Left, Side::Right] {
            self.collect(mesh, charts, faces, gates, bends, path, side);
            let hills = (0..self.found.len()).filter(|&i| self.found[i].curvature > 0.0);
            let hills = hills.fold(0_u32, |set, i| set | 1 << i);
            let all = ((1_u64 << self.found.len()) - 1) as u32;
            let mut tried = [0; 4 * MOST];
            let mut count = 0;
            let mut consider = |set: u32| {
                if set == 0 || tried[..count].contains(&set) {
                    return;
                }
                tried[count] = set;
                count += 1;
                let (change, aside, ahead) = self.branch(set, length);
                if change < -EQUAL * length * length {
                    let ahead = length + ahead;
                    let aside = if side == Side::Left { aside } else { -aside };
                    let image = [x * ahead - y * aside, y * ahead + x * aside];
                    promising.push((change, image));
                }
            };
            consider(self.settle(all, length));
            for i in 0..self.found.len() {
                let nearer = (2_u64 << i) as u32;
                consider(self.settle(1 << i, length));
                consider(hills & 1 << i);
                consider(hills & nearer.wrapping_sub(1));
            }
        }
        promising.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        self.promising = promising;
        &self.promising
    }

    /// The vertices below the line that passes a set of vertices on their other sides, again and
    /// again, until they are that set; else none.
    fn settle(&self, mut set: u32, length: f64) -> u32 {
        for _ in 0..ROUNDS {
            let mut below = 0;
            for (i, corner) in self.found.iter().enumerate() {
                if corner.height < self.height_over(corner.along, set, length) {
                    below |= 1 << i;
                }
            }
            if below == set {
                return set;
            }
            set = below;
        }
        0
    }

    fn height_over(&self, x: f64, set: u32, length: f64) -> f64 {
        let passed = self.passed(set);
        passed
            .map(|c| c.curvature * green(x, c.along, length))
            .sum()
    }

    fn passed(&self, set: u32) -> impl Iterator<Item = &Corner> {
        let in_set = move |&(i, _): &(usize, &Corner)| set >> i & 1 == 1;
        self.found.iter().enumerate().filter(in_set).map(|(_, c)| c)
    }

    /// Change of the squared length, and where the end moves: aside, towards the vertices, and
    /// ahead.
    fn branch(&self, set: u32, length: f64) -> (f64, f64, f64) {
        let (mut change, mut aside, mut ahead) = (0.0, 0.0, 0.0);
        for c in self.passed(set) {
            let over = self.height_over(c.along, set, length);
            change += length * c.curvature * (2.0 * c.height - over);
            aside += c.curvature * (length - c.along);
            ahead += c.curvature * c.height;
        }
        (change, aside, ahead)
    }

    /// The vertices of a strip and of its neighbouring faces on one side, as far as the curvature of
    /// all of them lets a lens reach, the nearest first.
    #[expect(clippy::too_many_arguments, reason = "a strip has many parts")]
    fn collect(
        &mut self,
        mesh: &Mesh,
        charts: &Charts,
        faces: &[Laid],
        gates: &[Gate],
        bends: &[Bend],
        path: &Tight,
        side: Side,
    ) {
        self.found.clear();
        let mut bends = bends.iter();
        let mut bend = bends.next();
        let (mut at, mut passed) = ([0.0; 2], 0.0);
        let (mut ahead, mut leg) = ([0.0; 2], 0.0);
        let mut previous = u32::MAX;
        for (i, gate) in gates.iter().enumerate() {
            while let Some(b) = bend
                && i > b.gate
            {
                passed += norm(sub(b.at, at));
                at = b.at;
                bend = bends.next();
                leg = 0.0;
            }
            if leg == 0.0 {
                ahead = sub(bend.map_or(path.image, |b| b.at), at);
                leg = norm(ahead);
            }
            let mut add = |vertex: u32, place: V2| {
                let curvature = charts.curvatures[vertex as usize];
                if curvature.abs() < FLAT {
                    return;
                }
                let out = sub(place, at);
                let height = cross(ahead, out).abs() / leg;
                let along = passed + dot(ahead, out) / leg;
                let reach = green(along, along, path.length);
                if reach > 0.0 {
                    self.found.push(Corner {
                        vertex,
                        curvature,
                        height,
                        along,
                        slope: height / reach,
                    });
                }
            };
            let v = gate.vertex(side);
            if v != previous {
                add(v, gate.end(side));
                previous = v;
            }
            // The face beyond the edge that the path does not cross.
            if let (Some(laid), Some(next)) = (faces.get(i), gates.get(i + 1))
                && next.vertex(side) != v
            {
                let beyond = match side {
                    Side::Left => laid.entry.prev(),
                    Side::Right => laid.entry.next(),
                };
                if let Some(outer) = laid.across(mesh, charts, beyond) {
                    add(mesh.origin(HalfEdge::prev(outer.entry)), outer.apex(charts));
                }
            }
        }
        let positive = |found: &[Corner]| found.iter().map(|c| c.curvature.max(0.0)).sum();
        let mut enclosed: f64 = positive(&self.found);
        // The lens of what a lens holds, until it holds no less.
        loop {
            let before = self.found.len();
            self.found.retain(|c| c.slope < lens(enclosed));
            enclosed = positive(&self.found);
            if self.found.len() == before {
                break;
            }
        }
        self.found.sort_unstable_by_key(|c| c.vertex);
        self.found.dedup_by_key(|c| c.vertex);
        let by_slope = |a: &Corner, b: &Corner| a.slope.total_cmp(&b.slope);
        self.found.sort_unstable_by(by_slope);
        self.found.truncate(MOST);
    }
}

/// Height at x of a string of a length that is pulled up at r with the force 1.
fn green(x: f64, r: f64, length: f64) -> f64 {
    x.min(r) * (length - x.max(r)) / length
}

/// At least the slope of a lens whose angles at both ends add up to an angle: its tangent, bounded
/// from above (M. Becker, E. Stark 1978).
fn lens(angle: f64) -> f64 {
    let rest = PI * PI - 4.0 * angle * angle;
    if rest > 0.0 {
        PI * PI * angle / rest
    } else {
        f64::INFINITY
    }
}
