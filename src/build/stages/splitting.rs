//! The stage from which the graph unfolds when patches are themselves a result.

use crate::build::passages::strip_groups;
use crate::build::{Context, Failure, Node, Numerics, Stage};
use crate::cladding::Clad;
use crate::diagnostics::Warned;
use crate::layout::Network;
use crate::members::threads::{Passage, lanes};
use crate::project::model::Distribution;
use crate::splitting::{Draft, NoSplit, SplitLimits, split};
use crate::surface::{Curvature, SurfaceMesh};
use serde::Serialize;

/// Patches of the project and how far they are split.
#[derive(Debug, Serialize)]
pub(in crate::build) struct SplitInput {
    pub(in crate::build) draft: Draft,
    pub(in crate::build) limits: SplitLimits,
}

/// The points and patches that are built.
pub(in crate::build) const SPLIT: Stage<SplitInput, (Node<SurfaceMesh>, Node<Curvature>), Draft> =
    Stage {
        name: "split",
        version: 5,
        numerics: Numerics::Portable,
        run: |input, (surface, curvature), context| {
            let SplitInput { draft, limits } = input;
            let cancelled = || context.check().is_err();
            match split(surface, curvature, draft, limits, &weaves, &cancelled) {
                Ok((value, warnings)) => Ok(Warned { value, warnings }),
                Err(NoSplit::Cancelled) => Err(stopped(context)),
                // What is wrong with these patches is told where each of them is measured.
                Err(NoSplit::Unmeasured) => Ok(Warned {
                    value: draft.clone(),
                    warnings: Vec::new(),
                }),
            }
        },
    };

fn stopped(_: &Context) -> Failure {
    Failure::Cancelled
}

/// Whether members can be laid through all patches in order.
fn weaves(draft: &Draft, clads: &[&Clad]) -> bool {
    let patches = draft.as_patches();
    let network = Network::new(&draft.points, &patches);
    let distribution = Distribution {
        weights: Vec::new(),
        closed: Vec::new(),
    };
    strip_groups(&distribution, &patches, &network)
        .iter()
        .all(|group| {
            let passages: Vec<Passage<'_>> = group
                .passages
                .iter()
                .zip(&group.input.passages)
                .map(|(&(patch, family), passage)| Passage {
                    start: passage.start,
                    end: passage.end,
                    function: clads[patch].function(family),
                    count: Some(passage.count),
                })
                .collect();
            lanes(&passages).is_ok()
        })
}
