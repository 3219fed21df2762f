//! Windows: intervals of an edge that straight lines from one (pseudo-)source reach through one
//! sequence of faces (Mitchell, Mount, Papadimitriou, *The discrete geodesic problem*, 1987).

use super::charts::Chart;

/// The root of windows that come straight from the source itself.
pub(super) const SOURCE: u32 = u32::MAX;

/// An interval of a half-edge A→B and where its straight lines come from, in the chart of that
/// half-edge. The face above is the one they enter. One cache line.
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
    /// Distance of the begin from the source through this window, metres.
    pub(super) d0: f64,
    /// Distance of the end, metres.
    pub(super) d1: f64,
    /// The vertex where the straight lines start, or `SOURCE`.
    pub(super) root: u32,
}

impl Window {
    /// A window with the distances of its ends computed.
    pub(super) fn new(b: [f64; 2], x: f64, depth: f64, sigma: f64, root: u32) -> Self {
        let mut window = Self {
            b0: b[0],
            b1: b[1],
            x,
            depth,
            sigma,
            d0: 0.0,
            d1: 0.0,
            root,
        };
        window.d0 = window.distance(b[0]);
        window.d1 = window.distance(b[1]);
        window
    }

    /// Distance of a point of the edge from the source through this window's root, metres.
    #[inline]
    pub(super) fn distance(&self, b: f64) -> f64 {
        let dx = b - self.x;
        self.sigma + (dx * dx + self.depth * self.depth).sqrt()
    }

    /// Distance of the closest point of the interval, metres.
    #[inline]
    pub(super) fn nearest(&self) -> f64 {
        if self.x > self.b0 && self.x < self.b1 {
            self.sigma + self.depth
        } else {
            self.d0.min(self.d1)
        }
    }

    /// Cuts the interval at a new begin.
    #[inline]
    pub(super) fn begin_at(&mut self, b: f64) {
        self.b0 = b;
        self.d0 = self.distance(b);
    }

    /// Cuts the interval at a new end.
    #[inline]
    pub(super) fn end_at(&mut self, b: f64) {
        self.b1 = b;
        self.d1 = self.distance(b);
    }

    /// Where the straight line to a point of the chart crosses the edge.
    #[inline]
    pub(super) fn crossing(&self, point: [f64; 2]) -> f64 {
        self.x + (point[0] - self.x) * (self.depth / (point[1] + self.depth))
    }

    /// The part of the window from `begin` to `end`, or to the line through C, seen from the
    /// edge A→C.
    ///
    /// With s = sin of the angle at A and δ the depth below A→C, the line through (b, 0) meets
    /// A→C at b·depth / (δ - b·s) from A.
    #[inline]
    pub(super) fn through_left(&self, chart: &Chart, begin: f64, end: Option<f64>) -> Option<Self> {
        let [ux, uy] = chart.left;
        let x = self.x * ux - self.depth * uy;
        let depth = self.x * uy + self.depth * ux;
        let exit = |b: f64| meet(b, self.depth, depth, uy, chart.left_length);
        let end = end.map_or(chart.left_length, exit);
        child([exit(begin), end], x, depth, self)
    }

    /// The part of the window from `begin`, or from the line through C, to `end`, seen from the
    /// edge C→B: the mirror image of `through_left`.
    #[inline]
    pub(super) fn through_right(
        &self,
        chart: &Chart,
        begin: Option<f64>,
        end: f64,
    ) -> Option<Self> {
        let [ux, uy] = [chart.right[0], -chart.right[1]];
        let mirrored = chart.length - self.x;
        let x = chart.right_length - (mirrored * ux - self.depth * uy);
        let depth = mirrored * uy + self.depth * ux;
        let exit = |b: f64| {
            let from_b = meet(chart.length - b, self.depth, depth, uy, chart.right_length);
            chart.right_length - from_b
        };
        let begin = begin.map_or(0.0, exit);
        child([begin, exit(end)], x, depth, self)
    }
}

/// Where the line through (b, 0) meets the other edge at the corner, measured from the corner.
#[inline]
fn meet(b: f64, depth: f64, exit_depth: f64, sine: f64, length: f64) -> f64 {
    let rest = exit_depth - b * sine;
    if rest > 0.0 {
        (b * depth / rest).min(length)
    } else {
        length
    }
}

/// A root closer to the line of an edge than this share of the edge sees it as a point.
const GRAZING: f64 = 1e-15;

#[inline]
fn child(b: [f64; 2], x: f64, depth: f64, parent: &Window) -> Option<Window> {
    (b[1] > b[0] && depth > GRAZING * (b[1] + x.abs()))
        .then(|| Window::new(b, x, depth, parent.sigma, parent.root))
}
