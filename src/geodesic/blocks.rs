//! Blocks of a table: neighbouring rows and columns, whose paths lie so close together that one bound
//! of other geodesics serves them all.

use super::draft::{Draft, End};
use super::heights::Heights;
use super::trail::Trail;
use super::unrolled::Tight;
use super::walk::Walk;
use crate::surface::SurfacePoint;
use std::cell::OnceCell;
use std::ops::Range;

/// Rows and columns of a block whose paths share one bound.
pub(super) const BLOCK: usize = 4;

/// Paths of a block keep within this share of the distance of their ends from the middle one's.
const TUBE: f64 = 1.15;

/// Blocks that are wider than this share of their paths are no neighbours.
const WIDEST: f64 = 0.06;

/// The blocks of some rows, bounded when the first of them is asked for.
pub(super) struct Blocks<'d, 'a> {
    draft: &'d Draft<'a>,
    rows: Range<usize>,
    bounds: OnceCell<Vec<Option<Bound>>>,
}

impl<'d, 'a> Blocks<'d, 'a> {
    pub(super) fn new(draft: &'d Draft<'a>, rows: Range<usize>) -> Self {
        Self {
            draft,
            rows,
            bounds: OnceCell::new(),
        }
    }

    /// The bound around a column, if there is one.
    pub(super) fn of(&self, column: usize) -> Option<&Bound> {
        let bounds = self.bounds.get_or_init(|| self.draft.bounds(&self.rows));
        bounds[column / BLOCK].as_ref()
    }
}

/// Bounds of other geodesics that hold near a trail.
#[derive(Debug, Clone)]
pub(super) struct Bound {
    trail: Trail,
    /// Metres.
    within: f64,
    pub(super) heights: [Heights; 2],
    /// The only fine cells with curvature that another geodesic can enclose, if that is known.
    pub(super) parts: Option<Vec<usize>>,
}

impl Bound {
    /// Whether it holds for the path that was found last.
    pub(super) fn holds(&self, walk: &Walk<'_>, path: &Tight) -> bool {
        let longer = (path.length - self.trail.length).abs();
        longer <= 2.0 * self.within && walk.strays(path, &self.trail) <= self.within
    }
}

impl Draft<'_> {
    /// Per block of columns bounds of other geodesics beside the paths of some rows, and the trail near
    /// which these have to keep.
    fn bounds(&self, rows: &Range<usize>) -> Vec<Option<Bound>> {
        let (first, last) = (rows.start, rows.end);
        let blocks = self.to.len().div_ceil(BLOCK);
        let mut bounds = vec![None; blocks];
        let masses = self.geodesics.masses();
        let mesh = self.geodesics.mesh;
        let middle = usize::midpoint(first, last);
        let Some((mut walk, mut here)) = self.begins(End::First)[middle]
            .as_ref()
            .and_then(|begin| self.walk_to(middle, 0, begin))
        else {
            return bounds;
        };
        let far = |points: &[SurfacePoint], from: usize, to: usize, middle: usize| {
            let at = points[middle].position(mesh);
            let far = points[from..to]
                .iter()
                .map(|p| (p.position(mesh) - at).norm());
            far.fold(0.0, f64::max)
        };
        for (block, bound) in bounds.iter_mut().enumerate() {
            let begin = block * BLOCK;
            let end = (begin + BLOCK).min(self.to.len());
            let centre = usize::midpoint(begin, end);
            let mut path = None;
            for j in begin..=centre {
                path = walk.step(&here, &self.to[j]);
                if let Some(tight) = &path {
                    here = tight.last;
                }
            }
            let Some(trail) = path.map(|path| walk.trail(&path, &self.to[centre])) else {
                continue;
            };
            let within = 1e-3 * trail.length
                + TUBE * far(self.from, first, last, middle).max(far(self.to, begin, end, centre));
            if within > WIDEST * trail.length {
                continue;
            }
            let Some(heights) = walk.bounds.around(&trail, within, masses) else {
                continue;
            };
            *bound = Some(Bound {
                trail,
                within,
                heights,
                parts: walk.bounds.parts(),
            });
        }
        bounds
    }
}
