//! Distance maps, the plan of a patch, and how far it is feasible.

use super::{judged, plain};
use crate::build::{Failure, Node, Numerics, Stage};
use crate::cladding::{
    AngleChoice, Clad, Demands, DistanceTable, Maps, SAMPLES, choose_angle, clad, distance_table,
    explain,
};
use crate::diagnostics::codes::cladding as codes;
use crate::diagnostics::{Code, Diagnostic};
use crate::geodesic::GeodesicError;
use crate::layout::{Domain, SideLengths};
use crate::project::model::Family;
use crate::splitting::{Feasibility, feasibility, judge};
use crate::surface::{Curvature, SurfaceMesh};
use serde::Serialize;

/// The distance map of a family.
pub(in crate::build) const DISTANCES: Stage<Family, Node<Domain>, DistanceTable> = Stage {
    name: "distances",
    version: 1,
    numerics: Numerics::Portable,
    run: |family, domain, _| {
        let (table, unproved) =
            distance_table(domain, *family).map_err(|error| no_geodesic(&error))?;
        judged(table, unproved_pairs(unproved).into_iter().collect())
    },
};

fn unproved_pairs(unproved: usize) -> Option<Diagnostic> {
    let message = format!(
        "{unproved} of {} geodesics across the patch are not proved to be shortest: a way around \
         the patch may be shorter",
        SAMPLES * SAMPLES
    );
    (unproved > 0).then(|| {
        Diagnostic::warning(codes::UNPROVED, message)
            .at_key(".", "this patch")
            .help("make the patch smaller, so that ways around it are long")
    })
}

/// Lengths of the sides of a patch: all that its plan needs to know of the domain.
pub(in crate::build) const SIDES: Stage<(), Node<Domain>, SideLengths> = Stage {
    name: "sides",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), domain, _| plain(domain.lengths()),
};

/// What a project demands of a plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct CladdingInput {
    /// Radians; chosen where unsaid.
    pub(in crate::build) alpha: Option<f64>,
    pub(in crate::build) slope: [f64; 2],
    pub(in crate::build) members: [u32; 2],
    pub(in crate::build) width: f64,
}

/// The plan of a patch with its cladding functions.
pub(in crate::build) const CLADDING: Stage<
    CladdingInput,
    (Node<SideLengths>, Node<DistanceTable>, Node<DistanceTable>),
    Clad,
> = Stage {
    name: "cladding",
    version: 2,
    numerics: Numerics::Portable,
    run: |input, (sides, u, v), _| {
        let maps = Maps {
            sides: *sides,
            u,
            v,
        };
        let demands = Demands {
            slope: input.slope,
            members: input.members,
            width: input.width,
        };
        let refused =
            |choice: &AngleChoice, why, given| Err(Failure::from(explain(choice, &why, given)));
        match input.alpha {
            None => {
                let choice = choose_angle(&maps, &demands);
                match choice.taken.clone() {
                    Ok(clad) => plain(clad),
                    Err(why) => refused(&choice, why, false),
                }
            }
            Some(alpha) => match clad(&maps, &demands, alpha) {
                Ok(clad) => plain(clad),
                Err(obstacle) => {
                    let choice = choose_angle(&maps, &demands);
                    refused(
                        &choice,
                        crate::cladding::Infeasible { alpha, obstacle },
                        true,
                    )
                }
            },
        }
    },
};

/// Limits of feasibility.
#[derive(Debug, Serialize)]
pub(in crate::build) struct FeasibilityInput {
    pub(in crate::build) eta_max: f64,
}

/// Curvature, coverage of peaks and diagonals of a patch.
pub(in crate::build) const FEASIBILITY: Stage<
    (),
    (Node<SurfaceMesh>, Node<Curvature>, Node<Domain>),
    Feasibility,
> = Stage {
    name: "feasibility",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), (surface, curvature, domain), _| {
        plain(feasibility(&surface.mesh, curvature, domain).map_err(|e| no_geodesic(&e))?)
    },
};

/// Judges a patch by its feasibility and its plan.
pub(in crate::build) const JUDGEMENT: Stage<
    FeasibilityInput,
    (Node<Feasibility>, Node<Clad>),
    bool,
> = Stage {
    name: "judgement",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (feasibility, clad), _| {
        let found = judge(feasibility, clad, input.eta_max);
        judged(found.is_empty(), found)
    },
};

/// A geodesic failed inside the patch of a stage, whose sides were found: the mesh is at fault.
pub(super) fn no_geodesic(error: &GeodesicError) -> Failure {
    no_geodesic_in(".", error)
}

/// The same with the field of the input that stands for the patch.
pub(super) fn no_geodesic_in(patch: &str, error: &GeodesicError) -> Failure {
    let code: Code = crate::diagnostics::codes::layout::NO_PATH;
    Diagnostic::error(
        code,
        format!("a geodesic of the patch cannot be found: {error}"),
    )
    .at_key(patch, "in this patch")
    .help("check the mesh for faces without area")
    .into()
}
