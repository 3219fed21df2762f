//! Distribution, members, crossings and lamellae.

use super::cladding::no_geodesic;
use super::{judged, plain};
use crate::build::{Failure, Node, Numerics, Stage};
use crate::cladding::Clad;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::grid as codes;
use crate::grid::{
    Crossing, Lamella, Miscrossing, Section, check_flat_state, check_lamellae, crossings_of,
    lamella,
};
use crate::layout::Domain;
use crate::members::distribution::{Crossed, Step, distribute};
use crate::members::{MakeError, Member, RefineError, crossing_label, make_members, member_label};
use crate::project::model::Family;
use serde::Serialize;

/// A family of one patch: how many members, and the weights of its start and end side.
#[derive(Debug, Serialize)]
pub(in crate::build) struct DistributionInput {
    pub(in crate::build) family: Family,
    pub(in crate::build) count: u32,
    pub(in crate::build) weights: [f64; 2],
}

/// Shares of the start side of a family at which members start.
pub(in crate::build) const DISTRIBUTION: Stage<DistributionInput, Node<Clad>, Vec<f64>> = Stage {
    name: "distribution",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, clad, _| {
        let sides = [
            Crossed {
                weight: input.weights[0],
                steps: Vec::new(),
            },
            Crossed {
                weight: input.weights[1],
                steps: vec![Step::Forward(clad.function(input.family))],
            },
        ];
        plain(distribute(&sides, (0.0, 1.0), input.count))
    },
};

/// Exact members of a family.
pub(in crate::build) const MEMBERS: Stage<
    Family,
    (Node<Domain>, Node<Clad>, Node<Vec<f64>>),
    Vec<Member>,
> = Stage {
    name: "members",
    version: 1,
    numerics: Numerics::Portable,
    run: |family, (domain, clad, shares), _| {
        let members = make_members(domain, clad, *family, shares);
        plain(members.map_err(|error| no_member(*family, &error))?)
    },
};

fn no_member(family: Family, error: &MakeError) -> Failure {
    let label = member_label(family, error.index);
    match &error.why {
        RefineError::Geodesic(error) => no_geodesic(error),
        RefineError::NoEqualLength {
            given,
            closest,
            difference,
        } => Diagnostic::error(
            codes::NO_MEMBER,
            format!(
                "member `{label}` has no end point of equal length: from {:.1} % of its side, the \
                 surface is {:.3} mm longer than the plane at the best end, {:.1} %",
                100.0 * given,
                1000.0 * difference,
                100.0 * closest
            ),
        )
        .at_key("", "in this patch")
        .help("split the patch over its peak of curvature, or choose another `alpha`")
        .into(),
    }
}

type GridNeeds = (Node<Domain>, Node<Vec<Member>>, Node<Vec<Member>>);

/// Crossings of both families.
pub(in crate::build) const GRID: Stage<(), GridNeeds, Vec<Crossing>> = Stage {
    name: "grid",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), (domain, u, v), _| {
        plain(crossings_of(&domain.mesh, u, v).map_err(|wrong| miscrossings(&wrong))?)
    },
};

fn miscrossings(wrong: &[Miscrossing]) -> Failure {
    let first = &wrong[0];
    let times = |n: u32| match n {
        0 => "do not meet".to_owned(),
        1 => "meet once".to_owned(),
        n => format!("meet {n} times"),
    };
    let others = wrong.len() - 1;
    let mut error = Diagnostic::error(
        codes::MISCROSSING,
        format!(
            "members `{}` {} on the surface and {} in the plane",
            crossing_label(first.u, first.v),
            times(first.on_surface),
            times(first.in_plane)
        ),
    )
    .at_key("", "in this patch")
    .help("split the patch over its peak of curvature, or choose another `alpha`");
    if others > 0 {
        error = error.note(format!("{others} more pairs do not cross exactly once"));
    }
    error.into()
}

type LamellaNeeds = (Node<Vec<Member>>, Node<Vec<Member>>, Node<Vec<Crossing>>);

/// Lamellae of a patch, u-family first.
pub(in crate::build) const LAMELLAE: Stage<Section, LamellaNeeds, Vec<Lamella>> = Stage {
    name: "lamellae",
    version: 1,
    numerics: Numerics::Portable,
    run: |section, (u, v, crossings), _| {
        let lamellae: Vec<Lamella> = u
            .iter()
            .chain(v)
            .map(|member| lamella(member, crossings, section))
            .collect();
        let mut found = check_lamellae(&lamellae, section);
        found.extend(check_flat_state(u, section));
        found.extend(check_flat_state(v, section));
        judged(lamellae, found)
    },
};
