//! Distance maps, the plan of a patch, and how far it is feasible.

use super::{judged, plain};
use crate::build::{Attempt, Failure, Node, Numerics, Stage};
use crate::cladding::{
    AngleChoice, Clad, Demands, DistanceTable, Infeasible, Maps, SAMPLES, choose_angle, clad,
    distance_table, explain,
};
use crate::diagnostics::codes::cladding as codes;
use crate::diagnostics::{Code, Diagnostic, Warned};
use crate::geodesic::GeodesicError;
use crate::layout::{Domain, SideLengths};
use crate::project::model::Family;
use crate::splitting::{Criteria, Feasibility, Findings, PatchCheck, check, feasibility, judge};
use crate::surface::{Curvature, SurfaceMesh};
use serde::Serialize;

/// The distance map of a family.
pub(in crate::build) const DISTANCES: Stage<Family, Node<Domain>, DistanceTable> = Stage {
    name: "distances",
    version: 5,
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

type Tables = (Node<SideLengths>, Node<DistanceTable>, Node<DistanceTable>);

/// Demands on a plan whatever its angle.
#[derive(Debug, Clone, Serialize)]
pub(in crate::build) struct AnglesInput {
    pub(in crate::build) slope: [f64; 2],
    pub(in crate::build) members: [u32; 2],
    pub(in crate::build) width: f64,
}

/// The feasible angles of a patch and the plan of the best one.
pub(in crate::build) const ANGLES: Stage<AnglesInput, Tables, AngleChoice> = Stage {
    name: "angles",
    version: 1,
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
        plain(choose_angle(&maps, &demands))
    },
};

/// The plan of a patch with its cladding functions.
pub(in crate::build) const CLADDING: Stage<CladdingInput, (Tables, Node<AngleChoice>), Clad> =
    Stage {
        name: "cladding",
        version: 3,
        numerics: Numerics::Portable,
        run: |input, ((sides, u, v), choice), _| {
            let Some(alpha) = input.alpha else {
                return match &choice.taken {
                    Ok(clad) => plain(clad.clone()),
                    Err(why) => Err(Failure::from(explain(choice, why, false))),
                };
            };
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
            clad_at(choice, &maps, &demands, alpha)
        },
    };

/// The plan with a given angle, radians, or why there is none.
pub(super) fn clad_at(
    choice: &AngleChoice,
    maps: &Maps<'_>,
    demands: &Demands,
    alpha: f64,
) -> Result<Warned<Clad>, Failure> {
    match clad(maps, demands, alpha) {
        Ok(clad) => plain(clad),
        Err(obstacle) => {
            let why = Infeasible { alpha, obstacle };
            Err(Failure::from(explain(choice, &why, true)))
        }
    }
}

type Measured = (
    Node<SurfaceMesh>,
    Node<Curvature>,
    Node<Domain>,
    Node<DistanceTable>,
    Node<DistanceTable>,
);

/// Between which places of opposite sides members may run.
#[derive(Debug, Serialize)]
pub(in crate::build) struct FeasibilityInput {
    pub(in crate::build) slope: [f64; 2],
}

/// Curvature, coverage of peaks and diagonals of a patch.
pub(in crate::build) const FEASIBILITY: Stage<FeasibilityInput, Measured, Feasibility> = Stage {
    name: "feasibility",
    version: 4,
    numerics: Numerics::Portable,
    run: |input, (surface, curvature, domain, u, v), _| {
        let maps = Maps {
            sides: domain.lengths(),
            u,
            v,
        };
        let measured = feasibility(&surface.mesh, curvature, domain, &maps, input.slope);
        plain(measured.map_err(|e| no_geodesic(&e))?)
    },
};

/// Judges a patch by its feasibility and its plan, if it has one.
pub(in crate::build) const JUDGEMENT: Stage<
    Criteria,
    (Node<Feasibility>, Node<AngleChoice>, Attempt<Clad>),
    bool,
> = Stage {
    name: "judgement",
    version: 2,
    numerics: Numerics::Portable,
    run: |criteria, (feasibility, angles, clad), _| {
        let found = judge(feasibility, angles, clad, criteria);
        judged(found.is_empty() && clad.is_some(), found)
    },
};

/// What a patch is held against in the table of `egg check`.
#[derive(Debug, Serialize)]
pub(in crate::build) struct CheckInput {
    pub(in crate::build) criteria: Criteria,
    pub(in crate::build) members: [u32; 2],
}

type Checked = (
    Attempt<Domain>,
    Attempt<Feasibility>,
    Attempt<AngleChoice>,
    Attempt<Clad>,
);

/// All criteria of a patch, as far as it could be measured.
pub(in crate::build) const CHECK: Stage<CheckInput, Checked, PatchCheck> = Stage {
    name: "check",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (domain, feasibility, angles, clad), _| {
        let findings = Findings {
            domain,
            feasibility,
            angles,
            clad,
        };
        plain(check(&findings, &input.criteria, input.members))
    },
};

/// The criteria of all patches.
pub(in crate::build) const CHECKS: Stage<(), Vec<Node<PatchCheck>>, Vec<PatchCheck>> = Stage {
    name: "checks",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), checks, _| plain(checks.into_iter().cloned().collect()),
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
