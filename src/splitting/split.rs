//! Splitting: patches in, patches out, with an account of what was done and what is left.

use super::account::account;
use super::appraise::{Appraiser, Limits, Measured};
use super::cut::{Refusal, Rules};
use super::draft::Draft;
use super::{Proposal, automatic, informed};
use crate::cladding::Clad;
use crate::diagnostics::Diagnostic;
use crate::layout::Domain;
use crate::project::model::Workflow;
use crate::surface::{Curvature, SurfaceMesh};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// How far splitting goes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SplitLimits {
    /// Which workflow; off splits nothing.
    pub workflow: Workflow,
    /// Largest feasible η.
    pub eta_max: f64,
    /// Bounds of the slopes of cladding functions.
    pub slope: [f64; 2],
    /// Shortest side that may be made, metres.
    pub min_side: Option<f64>,
    /// Most patches that may be made.
    pub max_patches: Option<u32>,
    /// Longest side that patches are left with, metres.
    pub max_side: Option<f64>,
}

/// Where the project sets no limit: far more than any structure that was built, and a bound on the
/// time.
const MOST_PATCHES: usize = 200;
/// New anchors have coordinates of so many digits below the size of the surface.
const DIGITS: f64 = 5.0;

/// A part of an original patch that is still infeasible, and why it was not split further.
pub(super) type Stuck = BTreeMap<String, Refusal>;

/// What all workflows work with.
pub(super) struct Workshop<'a> {
    pub(super) appraiser: Appraiser<'a>,
    pub(super) draft: Draft,
    pub(super) rules: Rules,
    /// Names of patches that cannot be cut, with the reason.
    pub(super) stuck: Stuck,
    /// Names of the points of the project.
    pub(super) given: BTreeSet<String>,
    /// Whether members can run on through a network.
    weaves: Weaves<'a>,
    cancelled: Cancelled<'a>,
}

/// Tells whether members of all families can be laid through patches in order.
pub type Weaves<'a> = &'a (dyn Fn(&Draft, &[&Clad]) -> bool + Sync);
/// Tells whether the user asked to stop.
pub type Cancelled<'a> = &'a (dyn Fn() -> bool + Sync);

/// Why there is no result.
#[derive(Debug)]
pub enum NoSplit {
    /// Patches of the project cannot be measured as they are.
    Unmeasured,
    /// The user asked to stop.
    Cancelled,
}

impl Workshop<'_> {
    pub(super) fn limits(&self) -> Limits {
        self.appraiser.limits
    }

    /// Measures all patches of the draft.
    pub(super) fn appraise(&mut self) -> Result<Vec<Measured>, NoSplit> {
        if (self.cancelled)() {
            return Err(NoSplit::Cancelled);
        }
        let measured = self.appraiser.appraise(&self.draft);
        // What was measured since may be half done.
        if (self.cancelled)() {
            return Err(NoSplit::Cancelled);
        }
        measured.map_err(|_| NoSplit::Unmeasured)
    }

    /// Measures some patches of a draft that is tried.
    pub(super) fn measure(
        &mut self,
        draft: &Draft,
        patches: &[usize],
    ) -> Result<Vec<Measured>, NoSplit> {
        let measured = self.appraiser.appraise_some(draft, patches);
        if (self.cancelled)() {
            return Err(NoSplit::Cancelled);
        }
        measured.map_err(|_| NoSplit::Unmeasured)
    }

    /// Lengths of the sides AB, BC, DC, AD of a patch of a draft that is tried.
    pub(super) fn sides(&mut self, draft: &Draft, patch: usize) -> Option<[f64; 4]> {
        self.appraiser.sides(draft, patch)
    }

    /// The domain of a patch of the draft.
    pub(super) fn domain(&mut self, patch: usize) -> Option<Domain> {
        self.appraiser.domain(&self.draft, patch)
    }

    /// Where a patch stands in the draft.
    pub(super) fn index(&self, name: &str) -> Option<usize> {
        self.draft.patches.iter().position(|p| p.name == name)
    }

    /// Takes a patch as it is: nothing that is known helps it.
    pub(super) fn give_up(&mut self, name: &str) {
        self.stuck.insert(name.to_owned(), Refusal::NoHelp);
    }

    /// Whether members can be laid through the draft, all of whose patches have plans.
    pub(super) fn weaves(&self, measured: &[Measured]) -> bool {
        let clads: Option<Vec<&Clad>> = measured.iter().map(|m| plan(m)).collect();
        clads.is_none_or(|clads| (self.weaves)(&self.draft, &clads))
    }

    /// Applies cuts, given by the names of patches. A cut whose parts are no quadrilaterals is
    /// taken back, and its patch is stuck. Returns whether any cut stands.
    pub(super) fn cut(&mut self, cuts: &[(String, Proposal)]) -> Result<bool, NoSplit> {
        let before = self.draft.clone();
        let lengths: BTreeMap<String, [f64; 4]> = self
            .appraise()?
            .iter()
            .zip(&before.patches)
            .filter_map(|(m, patch)| Some((patch.name.clone(), m.as_ref().ok()?.side_lengths())))
            .collect();
        let mut cuts: Vec<&(String, Proposal)> = cuts.iter().collect();
        loop {
            let mut children: BTreeMap<String, String> = BTreeMap::new();
            for (name, proposal) in &cuts {
                let position = self.draft.patches.iter().position(|p| p.name == *name);
                let Some((index, sides)) = position.zip(lengths.get(name)) else {
                    continue;
                };
                match self.draft.cut(index, proposal, *sides, &self.rules) {
                    Ok(()) => {
                        let parts = match proposal {
                            Proposal::Edge { .. } => 2,
                            Proposal::Corner { .. } => 4,
                        };
                        for part in &self.draft.patches[index..index + parts] {
                            children.insert(part.name.clone(), name.clone());
                        }
                    }
                    Err(refusal) => {
                        self.stuck.insert(name.clone(), refusal);
                    }
                }
            }
            let measured = self.appraise()?;
            let folded: BTreeSet<String> = measured
                .iter()
                .zip(&self.draft.patches)
                .filter(|(m, _)| m.is_err())
                .filter_map(|(_, patch)| children.get(&patch.name).cloned())
                .collect();
            if folded.is_empty() {
                return Ok(!children.is_empty());
            }
            self.draft = before.clone();
            cuts.retain(|(name, _)| !folded.contains(name));
            let stuck = folded.into_iter().map(|name| (name, Refusal::Folded));
            self.stuck.extend(stuck);
        }
    }
}

fn plan(measured: &Measured) -> Option<&Clad> {
    let appraisal = measured.as_ref().ok()?;
    appraisal.angles.as_ref()?.taken.as_ref().ok()
}

/// Splits patches until all are feasible or nothing more can be done. Deterministic, whatever the
/// number of threads.
pub fn split(
    surface: &SurfaceMesh,
    curvature: &Curvature,
    draft: &Draft,
    limits: &SplitLimits,
    weaves: Weaves<'_>,
    cancelled: Cancelled<'_>,
) -> Result<(Draft, Vec<Diagnostic>), NoSplit> {
    let (low, high) = surface.mesh.bounding_box();
    let digits = DIGITS - libm::floor(libm::log10((high - low).norm()));
    let mut workshop = Workshop {
        appraiser: Appraiser::new(
            surface,
            curvature,
            Limits {
                eta_max: limits.eta_max,
                slope: limits.slope,
                max_side: limits.max_side.filter(|_| limits.workflow != Workflow::Off),
            },
            cancelled,
        ),
        draft: draft.clone(),
        rules: Rules {
            min_side: limits.min_side.unwrap_or(0.0),
            max_patches: limits.max_patches.map_or(MOST_PATCHES, |n| n as usize),
            decimals: digits.clamp(0.0, 9.0) as usize,
            centre: true,
        },
        stuck: Stuck::new(),
        given: draft.points.iter().map(|p| p.name.clone()).collect(),
        weaves,
        cancelled,
    };
    let start = workshop.appraise()?;
    if start.iter().any(Result::is_err) {
        return Err(NoSplit::Unmeasured);
    }
    match limits.workflow {
        Workflow::Off => {}
        Workflow::Automatic => automatic::run(&mut workshop)?,
        Workflow::Informed => informed::run(&mut workshop)?,
    }
    let end = workshop.appraise()?;
    let weaves = workshop.weaves(&end);
    let told = account(&workshop, draft, &start, &end, weaves);
    Ok((workshop.draft, told))
}
