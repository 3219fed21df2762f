//! Windows: intervals of an edge that straight lines from one (pseudo-)source reach through one
//! sequence of faces (Mitchell, Mount, Papadimitriou, *The discrete geodesic problem*, 1987).

/// The root of windows that come straight from the source itself.
pub(super) const SOURCE: u32 = u32::MAX;

/// An interval of an edge A→B and where its straight lines come from, in coordinates along and
/// across that edge. The lines go up, from below it. One cache line.
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
    #[inline]
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
}
