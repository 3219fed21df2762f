//! Rings that shall close: angles and members together.

use super::cladding::clad_at;
use super::members::no_schedule;
use super::plain;
use crate::build::{Failure, Node, Numerics, Stage};
use crate::cladding::{AngleChoice, Clad, Demands, DistanceTable, Maps};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::grid as codes;
use crate::layout::{Domain, SideLengths};
use crate::members::closing::{CannotClose, Closed, RingPassage, RingPatch, Shortfall, close};
use crate::members::schedule::Schedule;
use crate::members::threads::LinePiece;
use crate::project::model::Family;
use serde::Serialize;

/// Rings that share patches with each other.
#[derive(Debug, Serialize)]
pub(in crate::build) struct ClosingInput {
    pub(in crate::build) patches: Vec<ClosingPatch>,
    pub(in crate::build) rings: Vec<Vec<ClosingPassage>>,
}

/// A patch of rings.
#[derive(Debug, Serialize)]
pub(in crate::build) struct ClosingPatch {
    /// Whether egg chooses its angle.
    pub(in crate::build) free: bool,
}

/// One family of one patch in a ring.
#[derive(Debug, Serialize)]
pub(in crate::build) struct ClosingPassage {
    /// Among the patches of all rings.
    pub(in crate::build) patch: u32,
    pub(in crate::build) family: Family,
    pub(in crate::build) start: LinePiece,
    pub(in crate::build) end: LinePiece,
    pub(in crate::build) count: u32,
    /// Importance of the start and the end side.
    pub(in crate::build) weights: [f64; 2],
}

type ClosingNeeds = (
    Vec<Node<Domain>>,
    Vec<Node<DistanceTable>>,
    Vec<Node<DistanceTable>>,
    Vec<Node<AngleChoice>>,
    Vec<Node<Clad>>,
);

/// Planar angles and members with which rings close.
pub(in crate::build) const CLOSING: Stage<ClosingInput, ClosingNeeds, Closed> = Stage {
    name: "closing",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (domains, us, vs, choices, clads), _| {
        let patches: Vec<RingPatch<'_>> = (0..input.patches.len())
            .map(|i| RingPatch {
                domain: domains[i],
                maps: Maps {
                    sides: domains[i].lengths(),
                    u: us[i],
                    v: vs[i],
                },
                alone: clads[i],
                free: input.patches[i].free.then_some(&choices[i].feasible[..]),
            })
            .collect();
        let passage = |passage: &ClosingPassage| RingPassage {
            patch: passage.patch as usize,
            family: passage.family,
            start: passage.start,
            end: passage.end,
            count: passage.count,
            weights: passage.weights,
        };
        let rings: Vec<Vec<RingPassage>> = input
            .rings
            .iter()
            .map(|ring| ring.iter().map(passage).collect())
            .collect();
        plain(close(&patches, &rings).map_err(|why| cannot_close(input, &why))?)
    },
};

fn cannot_close(input: &ClosingInput, why: &CannotClose) -> Failure {
    match why {
        CannotClose::Threads { ring, fault } => {
            no_schedule(fault, &|passage| format!(".rings[{ring}][{passage}]"))
        }
        CannotClose::Member { ring, error } => {
            super::members::no_member(error, &|passage| format!(".rings[{ring}][{passage}]"))
        }
        CannotClose::Junction { ring } => Diagnostic::error(
            codes::CANNOT_CLOSE,
            "the ring cannot be asked to close: the corner of a patch stands inside one of its sides",
        )
        .at_key(format!(".rings[{ring}][0]"), "around from this patch")
        .note(
            "the member through such a corner begins there and nowhere else, so nothing is left \
             that could bring it back",
        )
        .help("let the patches of the ring share whole sides, or take it out of `closed`")
        .into(),
        CannotClose::Open(shortfall) => open(input, shortfall).into(),
    }
}

fn open(input: &ClosingInput, found: &Shortfall) -> Diagnostic {
    let passages = &input.rings[found.ring];
    let told = Diagnostic::error(
        codes::CANNOT_CLOSE,
        format!(
            "no planar angles close the ring: at best, member {} of {} ends {:.2} mm beside where \
             it began ({:.4} % of the side)",
            found.member + 1,
            passages[0].count,
            1e3 * found.metres,
            1e2 * found.share
        ),
    )
    .at_key(
        format!(".rings[{}][0]", found.ring),
        "around from this patch",
    );
    let angles: Vec<String> = found
        .angles
        .iter()
        .enumerate()
        .map(|(i, angle)| {
            let how = if !found.free.contains(&i) {
                " (given)"
            } else if found.at_limit.contains(&i) {
                " (as far as it goes)"
            } else {
                ""
            };
            format!("{{.patches[{i}]}} {:.2}°{how}", angle.to_degrees())
        })
        .collect();
    let told = told
        .note(format!("with these angles: {}", angles.join(", ")))
        .note(format!(
            "{} inner members have to close, with {} free angles",
            found.members,
            found.free.len()
        ));
    told.help(if found.free.is_empty() {
        "leave `alpha` of patches of the ring to egg, as many as there are inner members; or list \
         the corners of neighbours as mirror images and give both the same `alpha`"
    } else if found.members > found.free.len() {
        "ask for fewer members: as many inner ones as angles are free can close; or lay the ring \
         of patches that are mirror images of each other, on a mesh that is one too"
    } else {
        "ask for fewer members, widen `split.slope`, move corners such that opposite patches \
         become more alike, or take the ring out of `closed`"
    })
}

/// What a plan has to keep, and which patch it is of the closing.
#[derive(Debug, Serialize)]
pub(in crate::build) struct ClosedCladdingInput {
    /// Among the patches of the closing.
    pub(in crate::build) patch: u32,
    pub(in crate::build) slope: [f64; 2],
    pub(in crate::build) members: [u32; 2],
    pub(in crate::build) width: f64,
}

type ClosedTables = (
    Node<SideLengths>,
    Node<DistanceTable>,
    Node<DistanceTable>,
    Node<AngleChoice>,
    Node<Closed>,
);

/// The plan of a patch in a closed ring.
pub(in crate::build) const CLOSED_CLADDING: Stage<ClosedCladdingInput, ClosedTables, Clad> =
    Stage {
        name: "closed-cladding",
        version: 1,
        numerics: Numerics::Portable,
        run: |input, (sides, u, v, choice, closed), _| {
            let Some(&alpha) = closed.angles.get(input.patch as usize) else {
                return Err(Failure::Errors(Vec::new()));
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

/// The members of a closed ring.
pub(in crate::build) const CLOSED_SCHEDULE: Stage<u32, Node<Closed>, Schedule> = Stage {
    name: "closed-schedule",
    version: 1,
    numerics: Numerics::Portable,
    run: |ring, closed, _| match closed.schedules.get(*ring as usize) {
        Some(schedule) => plain(schedule.clone()),
        None => Err(Failure::Errors(Vec::new())),
    },
};
