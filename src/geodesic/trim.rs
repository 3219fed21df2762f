//! Lists of windows without overlap: where two windows cover the same points, only the nearer
//! one stays.
//!
//! Two rules. Windows that have crossed faces in a known order obey the rule of crossing paths
//! (`push`): if their straight lines cross on the way, the one that is nearer at the crossing serves
//! both (Qin, Han, Yu, Yu, Zhang, *Fast and exact discrete geodesic computation based on
//! triangle-oriented wavefront propagation*, 2016). Lists that meet on an edge at different times
//! are merged point by point (`merge`), which needs no order.
//!
//! Whatever is cut away is matched by a path that is as short up to rounding; overlap below
//! [`TOUCHING`] is left alone.

use super::window::Window;

/// Overlap below this share of the distance is contact: windows on both sides of a straight line
/// through a vertex share that line up to rounding.
const TOUCHING: f64 = 1e-13;

/// Appends the window that lay right of all others where they last did not overlap.
#[expect(clippy::inline_always, reason = "a window stays in registers")]
#[inline(always)]
pub(super) fn push(list: &mut Vec<Window>, mut new: Window) {
    while let Some(last) = list.last_mut() {
        if new.b0 >= last.b1 - TOUCHING * last.d1 {
            break;
        }
        if new.b1 <= last.b0 {
            // The two have crossed altogether: the one that is nearer where the paths to the
            // facing ends cross is nearer wherever two of their paths cross.
            if nearer_at_crossing(last, &new) {
                return;
            }
            list.pop();
            continue;
        }
        let from = last.b0.max(new.b0);
        let at_from = gap(last, &new, from);
        if at_from >= 0.0 {
            // Beyond `from` every path of the last window crosses the new one's.
            if new.b0 <= last.b0 {
                list.pop();
                continue;
            }
            last.end_at(from);
            break;
        }
        let to = last.b1.min(new.b1);
        let at_to = gap(last, &new, to);
        if at_to <= 0.0 {
            if new.b1 <= last.b1 {
                return;
            }
            new.begin_at(to);
        } else {
            let between = separation(last, &new, [from, to], [at_from, at_to]);
            last.end_at(between);
            new.begin_at(between);
        }
        break;
    }
    if new.b1 > new.b0 {
        list.push(new);
    }
}

/// Of two windows that have changed sides, whether `left` (where they came in) is the nearer one
/// at the crossing of its path to its begin with the other's path to its end.
fn nearer_at_crossing(left: &Window, right: &Window) -> bool {
    let lean = (right.x - right.b1) / right.depth - (left.x - left.b0) / left.depth;
    let below = ((left.b0 - right.b1) / lean).min(left.depth.min(right.depth));
    if below.is_nan() || below < 0.0 {
        return left.d0 <= right.distance(left.b0);
    }
    let at_crossing = |w: &Window, d: f64| d - (d - w.sigma) * (below / w.depth);
    at_crossing(left, left.d0) <= at_crossing(right, right.d1)
}

/// Merges two sorted lists without overlap into one.
pub(super) fn merge(first: &[Window], second: &[Window], out: &mut Vec<Window>) {
    let mut firsts = first.iter().copied();
    let mut seconds = second.iter().copied();
    let mut one = firsts.next();
    let mut two = seconds.next();
    // Where the last piece of either list was put, to extend it when its next piece adjoins.
    let mut out = Pieces { out, last: None };
    while let (Some(mut a), Some(mut b)) = (one, two) {
        if a.b1 <= b.b0 + TOUCHING * a.d1 {
            out.push(a, Side::First);
            one = firsts.next();
            continue;
        }
        if b.b1 <= a.b0 + TOUCHING * b.d1 {
            out.push(b, Side::Second);
            two = seconds.next();
            continue;
        }
        if a.b0 < b.b0 {
            out.push_part(&a, a.b0, b.b0, Side::First);
            a.begin_at(b.b0);
        } else if b.b0 < a.b0 {
            out.push_part(&b, b.b0, a.b0, Side::Second);
            b.begin_at(a.b0);
        }
        let (from, to) = (a.b0, a.b1.min(b.b1));
        out.push_nearer(&a, &b, from, to);
        one = rest(a, to).or_else(|| firsts.next());
        two = rest(b, to).or_else(|| seconds.next());
    }
    while let Some(a) = one {
        out.push(a, Side::First);
        one = firsts.next();
    }
    while let Some(b) = two {
        out.push(b, Side::Second);
        two = seconds.next();
    }
}

/// What a window still covers beyond `to`.
fn rest(mut window: Window, to: f64) -> Option<Window> {
    if window.b1 - to <= TOUCHING * window.b1 {
        return None;
    }
    window.begin_at(to);
    Some(window)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    First,
    Second,
}

struct Pieces<'a> {
    out: &'a mut Vec<Window>,
    last: Option<Side>,
}

impl Pieces<'_> {
    fn push(&mut self, window: Window, side: Side) {
        if let (Some(last), true) = (self.out.last_mut(), self.last == Some(side)) {
            let same = last.x == window.x && last.depth == window.depth && last.root == window.root;
            if same && last.b1 == window.b0 && last.sigma == window.sigma {
                last.b1 = window.b1;
                last.d1 = window.d1;
                return;
            }
        }
        if window.b1 > window.b0 {
            self.out.push(window);
            self.last = Some(side);
        }
    }

    fn push_part(&mut self, window: &Window, from: f64, to: f64, side: Side) {
        let mut part = *window;
        part.begin_at(from);
        part.end_at(to);
        self.push(part, side);
    }

    /// Divides an interval that both windows cover.
    fn push_nearer(&mut self, a: &Window, b: &Window, from: f64, to: f64) {
        let gaps = [from, to].map(|at| gap(a, b, at));
        let sides = gaps.map(|gap| {
            if gap <= 0.0 {
                Side::First
            } else {
                Side::Second
            }
        });
        if sides[0] != sides[1] {
            let between = separation(a, b, [from, to], gaps);
            let (near, far) = if sides[0] == Side::First {
                (a, b)
            } else {
                (b, a)
            };
            self.push_part(near, from, between, sides[0]);
            self.push_part(far, between, to, sides[1]);
            return;
        }
        // The difference of two distances is monotone on either side of the point that lies in
        // line with both roots; only there can the other window be nearer in between.
        let (winner, loser, other) = match sides[0] {
            Side::First => (a, b, Side::Second),
            Side::Second => (b, a, Side::First),
        };
        let aligned = (a.x * b.depth - b.x * a.depth) / (b.depth - a.depth);
        let aligned_gap = gap(winner, loser, aligned);
        if aligned > from && aligned < to && aligned_gap > 0.0 {
            let ends = [from, to].map(|at| gap(winner, loser, at));
            let left = separation(winner, loser, [from, aligned], [ends[0], aligned_gap]);
            let right = separation(winner, loser, [aligned, to], [aligned_gap, ends[1]]);
            self.push_part(winner, from, left, sides[0]);
            self.push_part(loser, left, right, other);
            self.push_part(winner, right, to, sides[0]);
        } else {
            self.push_part(winner, from, to, sides[0]);
        }
    }
}

/// How much farther a point of the edge is through `a` than through `b`: metres, or square metres
/// where both start at the same distance, which takes no root and is linear along the edge.
#[inline]
fn gap(a: &Window, b: &Window, at: f64) -> f64 {
    if a.sigma == b.sigma {
        let (to_a, to_b) = (at - a.x, at - b.x);
        (to_a - to_b) * (to_a + to_b) + (a.depth - b.depth) * (a.depth + b.depth)
    } else {
        a.distance(at) - b.distance(at)
    }
}

/// Steps after which bisection alone has reached the spacing of numbers.
const MAX_STEPS: u32 = 60;

/// The point where two windows are equally near, between two points where different ones are
/// nearer, from their gaps there. Where the gap is linear, the chord meets zero there; otherwise
/// Newton's steps, always bracketed.
fn separation(a: &Window, b: &Window, [mut low, mut high]: [f64; 2], gaps: [f64; 2]) -> f64 {
    let chord = gaps[0] / (gaps[0] - gaps[1]);
    let mut at = low + (high - low) * chord;
    // A tie at one end, not in the middle: half of the interval would go to the farther window.
    if a.sigma == b.sigma || at <= low || at >= high {
        return at.clamp(low, high);
    }
    for _ in 0..MAX_STEPS {
        let (to_a, to_b) = (at - a.x, at - b.x);
        let far_a = (to_a * to_a + a.depth * a.depth).sqrt();
        let far_b = (to_b * to_b + b.depth * b.depth).sqrt();
        let gap = (a.sigma - b.sigma) + (far_a - far_b);
        if gap.abs() <= 4.0 * f64::EPSILON * (a.sigma + far_a) {
            break;
        }
        if (gap > 0.0) == (gaps[0] > 0.0) {
            low = at;
        } else {
            high = at;
        }
        let newton = at - gap / (to_a / far_a - to_b / far_b);
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if next == at {
            break;
        }
        at = next;
    }
    at
}
