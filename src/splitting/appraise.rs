//! Measures the patches of a draft as a build would: sides on the surface, distance maps, coverage
//! of peaks, the search for an angle. What was measured once is kept.
//!
//! Names of anchors come and go while cuts are tried and taken back, so everything is known by what
//! it is: an anchor by its place, a line by its ends, a patch by its pieces of lines.

use super::draft::{Draft, DraftPatch};
use super::split::Cancelled;
use super::{Feasibility, feasibility};
use crate::cladding::{
    AngleChoice, Demands, DistanceTable, Maps, choose_angle, clad, distance_table,
};
use crate::diagnostics::Diagnostic;
use crate::geodesic::GeodesicError;
use crate::layout::{
    Domain, Line, Network, Quad, Side, SideLengths, check_quad, place_anchors, shortest_line,
};
use crate::project::model::{Anchor, Family};
use crate::surface::{Curvature, SurfaceMesh, SurfacePoint};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Limits that a patch is held against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    pub(super) eta_max: f64,
    pub(super) slope: [f64; 2],
    /// The longest side that the designer wants, metres.
    pub(super) max_side: Option<f64>,
}

/// A measured patch.
#[derive(Debug, Clone)]
pub(super) struct Appraisal {
    pub(super) lengths: SideLengths,
    pub(super) feasibility: Feasibility,
    /// The search for an angle; left out where a peak is not covered anyway.
    pub(super) angles: Option<AngleChoice>,
    /// Whether the user's own angle is feasible.
    pub(super) own_angle: bool,
}

impl Appraisal {
    /// Whether both families cover all peaks.
    pub(super) fn covered(&self, limits: &Limits) -> bool {
        self.feasibility
            .eta()
            .iter()
            .all(|eta| *eta <= limits.eta_max)
    }

    /// Whether a build will find it feasible.
    pub(super) fn feasible(&self, limits: &Limits) -> bool {
        let has_plan = self.angles.as_ref().is_some_and(|a| a.taken.is_ok());
        self.covered(limits) && has_plan && self.own_angle
    }

    /// Whether a side is longer than the designer wants.
    pub(super) fn too_large(&self, limits: &Limits) -> bool {
        let longest = self.lengths.longest();
        limits.max_side.is_some_and(|most| longest > most)
    }

    /// Whether nothing is left to do about it.
    pub(super) fn settled(&self, limits: &Limits) -> bool {
        self.feasible(limits) && !self.too_large(limits)
    }

    /// Lengths of the sides AB, BC, DC, AD.
    pub(super) fn side_lengths(&self) -> [f64; 4] {
        let SideLengths { ab, bc, cd, da } = self.lengths;
        [ab, bc, cd, da]
    }
}

/// A measured patch, or why it cannot be measured.
pub(super) type Measured = Result<Arc<Appraisal>, Vec<Diagnostic>>;

/// What does not depend on the number of members.
struct Shape {
    lengths: SideLengths,
    feasibility: Feasibility,
    u: DistanceTable,
    v: DistanceTable,
}

/// An anchor by its place: what was said of it, to the last bit.
type Spot = Vec<u64>;
/// A line by its ends.
type LineKey = [Spot; 2];
/// A patch by its four sides: lines and the shares at which the sides begin and end.
type ShapeKey = Vec<(LineKey, [u64; 2])>;
/// The same with members, the user's angle and the width of lamellae.
type PatchKey = (ShapeKey, [u32; 2], Option<u64>, u64);

/// Measures patches on a surface.
pub(super) struct Appraiser<'a> {
    pub(super) surface: &'a SurfaceMesh,
    pub(super) curvature: &'a Curvature,
    pub(super) limits: Limits,
    anchors: BTreeMap<Spot, SurfacePoint>,
    lines: BTreeMap<LineKey, Result<Side, GeodesicError>>,
    shapes: BTreeMap<ShapeKey, Result<Arc<Shape>, Vec<Diagnostic>>>,
    known: BTreeMap<PatchKey, Measured>,
    cancelled: Cancelled<'a>,
}

/// A draft with its network, and its anchors by their places.
struct Laid<'d> {
    draft: &'d Draft,
    network: Network,
    spots: BTreeMap<&'d str, Spot>,
}

impl<'d> Laid<'d> {
    fn new(draft: &'d Draft) -> Self {
        let network = draft.network();
        let mut laid = Self {
            draft,
            network,
            spots: BTreeMap::new(),
        };
        for point in &draft.points {
            let spot = laid.find(&point.name, 0);
            laid.spots.insert(&point.name, spot);
        }
        laid
    }

    /// What a point is. `depth` bounds the recursion: no anchor of a checked project stands on
    /// itself.
    fn find(&self, name: &str, depth: usize) -> Spot {
        if let Some(spot) = self.spots.get(name) {
            return spot.clone();
        }
        let bits = |tag: u64, all: &[f64]| -> Spot {
            std::iter::once(tag)
                .chain(all.iter().map(|x| x.to_bits()))
                .collect()
        };
        let point = self.draft.points.iter().find(|p| p.name == name);
        match point.map(|p| &p.anchor) {
            Some(Anchor::Above(at)) => bits(1, at),
            Some(Anchor::Near(at)) => bits(2, at),
            Some(Anchor::Vertex(vertex)) => vec![3, u64::from(*vertex)],
            Some(Anchor::On { .. }) if depth <= self.draft.points.len() => {
                let Some((line, share)) = self.host(name) else {
                    return vec![0];
                };
                let mut spot = bits(4, &[share]);
                for end in self.network.lines[line].ends() {
                    spot.extend(self.find(end, depth + 1));
                }
                spot
            }
            // A checked project names no point that it does not define.
            _ => vec![0],
        }
    }

    /// The line that an anchor stands on, between its ends, and where.
    fn host(&self, name: &str) -> Option<(usize, f64)> {
        let inside = |line: &Line| {
            let last = line.stations.len() - 1;
            let inner = line.stations[1..last].iter().find(|s| s.name == name)?;
            Some(inner.share)
        };
        let mut lines = self.network.lines.iter().enumerate();
        lines.find_map(|(index, line)| Some((index, inside(line)?)))
    }

    fn spot(&self, name: &str) -> Spot {
        self.find(name, 0)
    }

    fn line_key(&self, line: usize) -> LineKey {
        self.network.lines[line].ends().map(|end| self.spot(end))
    }

    fn shape_key(&self, patch: usize) -> ShapeKey {
        let pieces = self.network.sides[patch].iter();
        pieces
            .map(|piece| {
                let stations = &self.network.lines[piece.line].stations;
                let shares = [piece.from, piece.to].map(|i| stations[i].share.to_bits());
                (self.line_key(piece.line), shares)
            })
            .collect()
    }

    fn patch_key(&self, patch: usize) -> PatchKey {
        let DraftPatch {
            members,
            alpha,
            width,
            ..
        } = &self.draft.patches[patch];
        let alpha = alpha.map(f64::to_bits);
        (self.shape_key(patch), *members, alpha, width.to_bits())
    }
}

impl<'a> Appraiser<'a> {
    pub(super) fn new(
        surface: &'a SurfaceMesh,
        curvature: &'a Curvature,
        limits: Limits,
        cancelled: Cancelled<'a>,
    ) -> Self {
        Self {
            cancelled,
            surface,
            curvature,
            limits,
            anchors: BTreeMap::new(),
            lines: BTreeMap::new(),
            shapes: BTreeMap::new(),
            known: BTreeMap::new(),
        }
    }

    /// Measures all patches of a draft, in its order.
    pub(super) fn appraise(&mut self, draft: &Draft) -> Result<Vec<Measured>, Vec<Diagnostic>> {
        let all: Vec<usize> = (0..draft.patches.len()).collect();
        self.appraise_some(draft, &all)
    }

    /// Measures some patches of a draft, in the order given.
    pub(super) fn appraise_some(
        &mut self,
        draft: &Draft,
        patches: &[usize],
    ) -> Result<Vec<Measured>, Vec<Diagnostic>> {
        let laid = Laid::new(draft);
        self.place(&laid)?;
        let keys: Vec<PatchKey> = patches.iter().map(|&i| laid.patch_key(i)).collect();
        let fresh: BTreeMap<&PatchKey, usize> = keys
            .iter()
            .zip(patches.iter().copied())
            .filter(|(key, _)| !self.known.contains_key(*key))
            .collect();
        let unshaped: BTreeMap<ShapeKey, usize> = fresh
            .iter()
            .filter(|((shape, ..), _)| !self.shapes.contains_key(shape))
            .map(|((shape, ..), &patch)| (shape.clone(), patch))
            .collect();
        self.lay(&laid, unshaped.values().copied());
        let shapes: Vec<_> = unshaped
            .into_par_iter()
            .map(|(key, patch)| (key, self.shape(&laid, patch).map(Arc::new)))
            .collect();
        self.shapes.extend(shapes);
        let measured: Vec<(PatchKey, Measured)> = fresh
            .into_par_iter()
            .map(|(key, patch)| {
                let shape = self.shapes[&key.0].clone();
                let measured = shape.map(|shape| self.angles(&shape, &draft.patches[patch]));
                (key.clone(), measured.map(Arc::new))
            })
            .collect();
        self.known.extend(measured);
        Ok(keys.iter().map(|key| self.known[key].clone()).collect())
    }

    /// Lengths of the sides AB, BC, DC, AD of a patch; none where a side cannot be found.
    pub(super) fn sides(&mut self, draft: &Draft, patch: usize) -> Option<[f64; 4]> {
        let laid = Laid::new(draft);
        self.place(&laid).ok()?;
        self.lay(&laid, [patch]);
        let mut lengths = [0.0; 4];
        for (length, piece) in lengths.iter_mut().zip(laid.network.sides[patch]) {
            let share = |i: usize| laid.network.lines[piece.line].stations[i].share;
            let line = self.lines[&laid.line_key(piece.line)].as_ref().ok()?;
            *length = line.length() * (share(piece.to) - share(piece.from)).abs();
        }
        Some(lengths)
    }

    /// The domain of a patch; none where it has none.
    pub(super) fn domain(&mut self, draft: &Draft, patch: usize) -> Option<Domain> {
        let laid = Laid::new(draft);
        self.place(&laid).ok()?;
        self.lay(&laid, [patch]);
        self.around(&laid, patch).ok()
    }

    /// Finds the anchors that have a place of their own.
    fn place(&mut self, laid: &Laid<'_>) -> Result<(), Vec<Diagnostic>> {
        let new: BTreeMap<&Spot, (String, Anchor)> = laid
            .draft
            .points
            .iter()
            .filter(|p| !matches!(p.anchor, Anchor::On { .. }))
            .map(|p| {
                let known = (p.name.clone(), p.anchor.clone());
                (&laid.spots[p.name.as_str()], known)
            })
            .filter(|(spot, _)| !self.anchors.contains_key(*spot))
            .collect();
        let (spots, new): (Vec<&Spot>, Vec<(String, Anchor)>) = new.into_iter().unzip();
        if new.is_empty() {
            // Looking anchors up takes a tree of all faces.
            return Ok(());
        }
        let placed = place_anchors(self.surface, &new)?.value;
        for (spot, at) in spots.into_iter().zip(placed) {
            self.anchors.extend(at.map(|at| (spot.clone(), at)));
        }
        Ok(())
    }

    /// Solves the lines of patches.
    fn lay(&mut self, laid: &Laid<'_>, patches: impl IntoIterator<Item = usize>) {
        let pieces = patches.into_iter().flat_map(|i| laid.network.sides[i]);
        let lines: BTreeSet<usize> = pieces.map(|piece| piece.line).collect();
        let mut open = Vec::new();
        for line in lines {
            let ends = laid.network.lines[line].ends();
            let ends = ends.map(|name| self.point(laid, name));
            let key = laid.line_key(line);
            if !self.lines.contains_key(&key) {
                open.push((key, ends));
            }
        }
        let solved: Vec<(LineKey, Result<Side, GeodesicError>)> = open
            .into_par_iter()
            .map(|(key, ends)| (key, self.solve(ends)))
            .collect();
        self.lines.extend(solved);
    }

    fn solve(&self, ends: [Result<SurfacePoint, GeodesicError>; 2]) -> Result<Side, GeodesicError> {
        let [from, to] = ends;
        let path = shortest_line(&self.surface.mesh, &from?, &to?)?;
        Ok(Side::new(&self.surface.mesh, path))
    }

    /// The place of an anchor, its own or on a line.
    fn point(&mut self, laid: &Laid<'_>, name: &str) -> Result<SurfacePoint, GeodesicError> {
        let spot = laid.spot(name);
        if let Some(at) = self.anchors.get(&spot) {
            return Ok(*at);
        }
        let Some((index, share)) = laid.host(name) else {
            // A checked project names no point that it does not define.
            return Ok(SurfacePoint::Vertex(0));
        };
        let key = laid.line_key(index);
        if !self.lines.contains_key(&key) {
            let ends = laid.network.lines[index].ends();
            let ends = ends.map(|end| self.point(laid, end));
            let solved = self.solve(ends);
            self.lines.insert(key.clone(), solved);
        }
        let line = self.lines[&key].clone()?;
        let at = line.at(&self.surface.mesh, share);
        self.anchors.insert(spot, at);
        Ok(at)
    }

    fn shape(&self, laid: &Laid<'_>, patch: usize) -> Result<Shape, Vec<Diagnostic>> {
        if (self.cancelled)() {
            return Err(Vec::new());
        }
        let failed = |error: GeodesicError| {
            vec![Diagnostic::error(
                crate::diagnostics::codes::layout::NO_PATH,
                format!("a geodesic of the patch cannot be found: {error}"),
            )]
        };
        let domain = self.around(laid, patch).map_err(failed)?;
        let faults = check_quad(&domain);
        if !faults.is_empty() {
            return Err(faults);
        }
        let table = |family| -> Result<DistanceTable, GeodesicError> {
            Ok(distance_table(&domain, family)?.0)
        };
        let (u, v) = rayon::join(|| table(Family::U), || table(Family::V));
        let (u, v) = (u.map_err(failed)?, v.map_err(failed)?);
        let lengths = domain.lengths();
        let maps = Maps {
            sides: lengths,
            u: &u,
            v: &v,
        };
        let mesh = &self.surface.mesh;
        let feasibility = feasibility(mesh, self.curvature, &domain, &maps, self.limits.slope);
        Ok(Shape {
            lengths,
            feasibility: feasibility.map_err(failed)?,
            u,
            v,
        })
    }

    fn angles(&self, shape: &Shape, patch: &DraftPatch) -> Appraisal {
        let maps = Maps {
            sides: shape.lengths,
            u: &shape.u,
            v: &shape.v,
        };
        let demands = Demands {
            slope: self.limits.slope,
            members: patch.members,
            width: patch.width,
        };
        let feasible = |alpha: f64| clad(&maps, &demands, alpha).is_ok();
        let mut appraisal = Appraisal {
            lengths: shape.lengths,
            feasibility: shape.feasibility.clone(),
            angles: None,
            own_angle: patch.alpha.is_none_or(feasible),
        };
        if appraisal.covered(&self.limits) {
            appraisal.angles = Some(choose_angle(&maps, &demands));
        }
        appraisal
    }

    fn around(&self, laid: &Laid<'_>, patch: usize) -> Result<Domain, GeodesicError> {
        let mesh = &self.surface.mesh;
        let piece = |i: usize| -> Result<Side, GeodesicError> {
            let piece = laid.network.sides[patch][i];
            let share = |i: usize| laid.network.lines[piece.line].stations[i].share;
            let key = laid.line_key(piece.line);
            let side = self.lines[&key].as_ref().map_err(Clone::clone)?;
            Ok(side.piece(mesh, share(piece.from), share(piece.to)))
        };
        let quad = Quad {
            ab: piece(0)?,
            bc: piece(1)?,
            dc: piece(2)?.reversed(mesh),
            ad: piece(3)?.reversed(mesh),
        };
        Domain::around(mesh, quad)
    }
}
