//! Measures the patches of a draft as a build would: sides on the surface, distance maps, coverage
//! of peaks, the search for an angle. What was measured once is kept: anchors never move, so a
//! patch is known by its corners and its counts.

use super::draft::{Draft, DraftPatch};
use super::split::Cancelled;
use super::{Feasibility, feasibility};
use crate::cladding::{
    AngleChoice, Demands, DistanceTable, Maps, choose_angle, clad, distance_table,
};
use crate::diagnostics::Diagnostic;
use crate::geodesic::{GeodesicError, Geodesics};
use crate::layout::{Domain, Line, Network, Quad, Side, SideLengths, check_quad, place_anchors};
use crate::project::model::{Anchor, Family};
use crate::surface::{Curvature, SurfaceMesh, SurfacePoint};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Limits that a patch is held against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    pub(super) eta_max: f64,
    pub(super) slope: [f64; 2],
}

/// A measured patch.
#[derive(Debug, Clone)]
pub(super) struct Appraisal {
    pub(super) domain: Domain,
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

    /// Lengths of the sides AB, BC, DC, AD.
    pub(super) fn side_lengths(&self) -> [f64; 4] {
        let SideLengths { ab, bc, cd, da } = self.lengths;
        [ab, bc, cd, da]
    }
}

/// A measured patch, or why it cannot be measured.
pub(super) type Measured = Result<Arc<Appraisal>, Vec<Diagnostic>>;

/// Measures patches on a surface.
pub(super) struct Appraiser<'a> {
    pub(super) surface: &'a SurfaceMesh,
    pub(super) curvature: &'a Curvature,
    pub(super) limits: Limits,
    geodesics: Geodesics<'a>,
    anchors: BTreeMap<String, SurfacePoint>,
    lines: BTreeMap<[String; 2], Result<Side, GeodesicError>>,
    known: BTreeMap<Key, Measured>,
    cancelled: Cancelled<'a>,
}

type Key = ([String; 4], [u32; 2]);

fn ends_of(line: &Line) -> [String; 2] {
    line.ends().map(str::to_owned)
}

fn key(patch: &DraftPatch) -> Key {
    (patch.corners.clone(), patch.members)
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
            geodesics: Geodesics::new(&surface.mesh),
            anchors: BTreeMap::new(),
            lines: BTreeMap::new(),
            known: BTreeMap::new(),
        }
    }

    /// Measures all patches of a draft, in its order.
    pub(super) fn appraise(&mut self, draft: &Draft) -> Result<Vec<Measured>, Vec<Diagnostic>> {
        self.place(draft)?;
        let network = draft.network();
        let fresh: Vec<usize> = (0..draft.patches.len())
            .filter(|&i| !self.known.contains_key(&key(&draft.patches[i])))
            .collect();
        for &patch in &fresh {
            for piece in network.sides[patch] {
                self.line(&network, piece.line);
            }
        }
        let measured: Vec<Measured> = fresh
            .par_iter()
            .map(|&patch| self.measure(draft, &network, patch))
            .collect();
        for (patch, measured) in fresh.into_iter().zip(measured) {
            self.known.insert(key(&draft.patches[patch]), measured);
        }
        Ok(draft
            .patches
            .iter()
            .map(|patch| self.known[&key(patch)].clone())
            .collect())
    }

    /// Finds the anchors that have a place of their own.
    fn place(&mut self, draft: &Draft) -> Result<(), Vec<Diagnostic>> {
        let new: Vec<(String, Anchor)> = draft
            .points
            .iter()
            .filter(|p| !self.anchors.contains_key(&p.name))
            .filter(|p| !matches!(p.anchor, Anchor::On { .. }))
            .map(|p| (p.name.clone(), p.anchor.clone()))
            .collect();
        let placed = place_anchors(self.surface, &new)?.value;
        for ((name, _), at) in new.into_iter().zip(placed) {
            self.anchors.extend(at.map(|at| (name, at)));
        }
        Ok(())
    }

    /// Solves a line and the lines that its ends stand on.
    fn line(&mut self, network: &Network, index: usize) {
        let line = &network.lines[index];
        if self.lines.contains_key(&ends_of(line)) {
            return;
        }
        let ends = line.ends().map(|name| self.point(network, name));
        let solved = match ends {
            [Ok(from), Ok(to)] => self
                .geodesics
                .shortest(&from, &to)
                .map(|path| Side::new(&self.surface.mesh, path)),
            [Err(error), _] | [_, Err(error)] => Err(error),
        };
        self.lines.insert(ends_of(line), solved);
    }

    /// The place of an anchor, its own or on a line.
    fn point(&mut self, network: &Network, name: &str) -> Result<SurfacePoint, GeodesicError> {
        if let Some(at) = self.anchors.get(name) {
            return Ok(*at);
        }
        let inside = |line: &Line| {
            let last = line.stations.len() - 1;
            let inner = line.stations[1..last].iter().find(|s| s.name == name)?;
            Some(inner.share)
        };
        let host = network
            .lines
            .iter()
            .enumerate()
            .find_map(|(index, line)| Some((index, inside(line)?)));
        let Some((index, share)) = host else {
            // A checked project names no point that it does not define.
            return Ok(SurfacePoint::Vertex(0));
        };
        self.line(network, index);
        let line = self.lines[&ends_of(&network.lines[index])].clone()?;
        let at = line.at(&self.surface.mesh, share);
        self.anchors.insert(name.to_owned(), at);
        Ok(at)
    }

    fn measure(&self, draft: &Draft, network: &Network, index: usize) -> Measured {
        if (self.cancelled)() {
            return Err(Vec::new());
        }
        let patch = &draft.patches[index];
        let failed = |error: GeodesicError| {
            vec![Diagnostic::error(
                crate::diagnostics::codes::layout::NO_PATH,
                format!("a geodesic of the patch cannot be found: {error}"),
            )]
        };
        let domain = self.domain(network, index).map_err(failed)?;
        let faults = check_quad(&domain);
        if !faults.is_empty() {
            return Err(faults);
        }
        let table = |family| -> Result<DistanceTable, GeodesicError> {
            Ok(distance_table(&domain, family)?.0)
        };
        let (u, v) = rayon::join(|| table(Family::U), || table(Family::V));
        let (u, v) = (u.map_err(failed)?, v.map_err(failed)?);
        let maps = Maps {
            sides: domain.lengths(),
            u: &u,
            v: &v,
        };
        let slope = self.limits.slope;
        let mesh = &self.surface.mesh;
        let feasibility =
            feasibility(mesh, self.curvature, &domain, &maps, slope).map_err(failed)?;
        let covered = feasibility
            .eta()
            .iter()
            .all(|eta| *eta <= self.limits.eta_max);
        let demands = Demands {
            slope,
            members: patch.members,
            width: patch.width,
        };
        let angles = covered.then(|| choose_angle(&maps, &demands));
        let own_angle = patch
            .alpha
            .is_none_or(|alpha| clad(&maps, &demands, alpha).is_ok());
        Ok(Arc::new(Appraisal {
            lengths: domain.lengths(),
            domain,
            feasibility,
            angles,
            own_angle,
        }))
    }

    fn domain(&self, network: &Network, patch: usize) -> Result<Domain, GeodesicError> {
        let mesh = &self.surface.mesh;
        let piece = |i: usize| -> Result<Side, GeodesicError> {
            let piece = network.sides[patch][i];
            let line = &network.lines[piece.line];
            let share = |station: usize| line.stations[station].share;
            let side = self.lines[&ends_of(line)].as_ref().map_err(Clone::clone)?;
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
