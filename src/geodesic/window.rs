//! Windows: intervals of an edge that straight lines from one (pseudo-)source reach through one
//! sequence of faces (Mitchell, Mount, Papadimitriou, *The discrete geodesic problem*, 1987).

use super::charts::Chart;

/// The root of windows that come straight from the source itself.
pub(super) const SOURCE: u32 = u32::MAX;

/// An interval of a half-edge A→B and where its straight lines come from, in the chart of that
/// half-edge. The face above is the one they enter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    /// Begin of the interval from A, metres.
    pub(super) b0: f64,
    /// End of the interval from A, metres.
    pub(super) b1: f64,
    /// The unfolded root: position along the edge from A, metres.
    pub(super) x: f64,
    /// The unfolded root: depth below the edge, metres, positive.
    pub(super) depth: f64,
    /// Distance of the root from the source, metres.
    pub(super) sigma: f64,
    /// The vertex where the straight lines start, or `SOURCE`.
    pub(super) root: u32,
}

impl Window {
    /// Distance of a point of the edge from the source through this window's root, metres.
    #[inline]
    pub(super) fn distance(&self, b: f64) -> f64 {
        let dx = b - self.x;
        self.sigma + (dx * dx + self.depth * self.depth).sqrt()
    }

    /// Distance of the closest point of the interval, metres.
    #[inline]
    pub(super) fn nearest(&self) -> f64 {
        self.distance(self.x.clamp(self.b0, self.b1))
    }

    /// Where the straight line to a point of the chart crosses the edge.
    #[inline]
    pub(super) fn crossing(&self, point: [f64; 2]) -> f64 {
        self.x + (point[0] - self.x) * (self.depth / (point[1] + self.depth))
    }

    /// The part of the window from `b0` to `b1`, or to the line through C, seen from the edge
    /// A→C.
    ///
    /// With s = sin of the angle at A and δ the depth below A→C, the line through (b, 0) meets
    /// A→C at b·depth / (δ - b·s) from A.
    #[inline(always)]
    pub(super) fn through_left(&self, chart: &Chart, to_corner: Clip) -> Self {
        let [ux, uy] = chart.left;
        let depth = self.x * uy + self.depth * ux;
        let exit = |b: f64| meet(b, self.depth, depth, uy, chart.left_length);
        Self {
            b0: exit(self.b0),
            b1: match to_corner {
                Clip::AtCorner => chart.left_length,
                Clip::Whole => exit(self.b1),
            },
            x: self.x * ux - self.depth * uy,
            depth,
            sigma: self.sigma,
            root: self.root,
        }
    }

    /// The part of the window from `b0`, or from the line through C, to `b1`, seen from the edge
    /// C→B: the mirror image of `through_left`.
    #[inline(always)]
    pub(super) fn through_right(&self, chart: &Chart, from_corner: Clip) -> Self {
        let [ux, uy] = [chart.right[0], -chart.right[1]];
        let mirrored = chart.length - self.x;
        let depth = mirrored * uy + self.depth * ux;
        let exit = |b: f64| {
            let from_b = meet(chart.length - b, self.depth, depth, uy, chart.right_length);
            chart.right_length - from_b
        };
        Self {
            b0: match from_corner {
                Clip::AtCorner => 0.0,
                Clip::Whole => exit(self.b0),
            },
            b1: exit(self.b1),
            x: chart.right_length - (mirrored * ux - self.depth * uy),
            depth,
            sigma: self.sigma,
            root: self.root,
        }
    }

    /// Whether the window covers anything and sees the edge from its side.
    #[inline(always)]
    pub(super) fn is_open(&self) -> bool {
        self.b1 > self.b0 && self.depth > GRAZING * (self.b1 + self.x.abs())
    }
}

/// Which part of a window crosses to an edge.
#[derive(Clone, Copy)]
pub(super) enum Clip {
    Whole,
    AtCorner,
}

/// Where the line through (b, 0) meets the other edge at the corner, measured from the corner.
#[inline(always)]
fn meet(b: f64, depth: f64, exit_depth: f64, sine: f64, length: f64) -> f64 {
    let rest = exit_depth - b * sine;
    let at = b * depth / rest;
    // A line that meets the edge beyond its end, or is parallel to it, does so by rounding.
    if at >= 0.0 && at <= length { at } else { length }
}

/// A root closer to the line of an edge than this share of the edge sees it as a point.
const GRAZING: f64 = 1e-15;
