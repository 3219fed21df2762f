//! Schedules of strips, members, crossings and lamellae.

use super::cladding::no_geodesic_in;
use super::{judged, plain};
use crate::build::{Failure, Node, Numerics, Stage};
use crate::cladding::Clad;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::grid as codes;
use crate::grid::{
    Crossing, Lamella, Miscrossing, Section, check_flat_state, crossings_of, lamella,
};
use crate::layout::Domain;
use crate::members::schedule::{Schedule, schedule};
use crate::members::threads::{End, LinePiece, Passage, ThreadFault};
use crate::members::{
    Drift, Given, Ground, Member, RefineError, WeaveError, Woven, crossing_label, weave,
};
use crate::plan::{Plan, StripNames, strip_chapter};
use crate::project::model::Family;
use serde::Serialize;

/// Families that members run through, by the lines that they cross.
#[derive(Debug, Clone, Serialize)]
pub(in crate::build) struct StripInput {
    pub(in crate::build) passages: Vec<PassageInput>,
    /// Whether the members of a ring shall end where they began.
    pub(in crate::build) closed: bool,
}

/// One family of one patch.
#[derive(Debug, Clone, Serialize)]
pub(in crate::build) struct PassageInput {
    pub(in crate::build) family: Family,
    pub(in crate::build) start: LinePiece,
    pub(in crate::build) end: LinePiece,
    pub(in crate::build) count: u32,
    /// Importance of the start and the end side.
    pub(in crate::build) weights: [f64; 2],
}

/// Where the members of a strip begin and through which patches they run.
pub(in crate::build) const SCHEDULE: Stage<StripInput, Vec<Node<Clad>>, Schedule> = Stage {
    name: "schedule",
    version: 2,
    numerics: Numerics::Portable,
    run: |input, clads, _| {
        let passages: Vec<Passage<'_>> = input
            .passages
            .iter()
            .zip(clads)
            .map(|(passage, clad)| Passage {
                start: passage.start,
                end: passage.end,
                function: clad.function(passage.family),
                count: Some(passage.count),
            })
            .collect();
        let weight = |passage: usize, end: End| input.passages[passage].weights[end as usize];
        plain(schedule(&passages, &weight).map_err(|fault| no_schedule(&fault, &of_strip))?)
    },
};

/// The field of the input of a strip that stands for a passage.
fn of_strip(passage: usize) -> String {
    format!(".passages[{passage}]")
}

/// `field` tells the field of the input that stands for a passage.
pub(super) fn no_schedule(fault: &ThreadFault, field: &dyn Fn(usize) -> String) -> Failure {
    match fault {
        ThreadFault::Spiral { passage } => Diagnostic::error(
            codes::SPIRAL,
            "members through the corners of neighbouring patches run round and round",
        )
        .at_key(field(*passage), "through this patch")
        .help("let corners of neighbouring patches meet, instead of standing inside sides"),
        ThreadFault::Counts {
            passage,
            own,
            others,
        } => Diagnostic::error(
            codes::COUNTS,
            format!(
                "the patch has {own} members, but the members of its neighbours and those through \
                 corners need {others}"
            ),
        )
        .at_key(format!("{}.count", field(*passage)), "this count")
        .help(format!("give it {others} members, or its neighbours fewer")),
        ThreadFault::Uncounted { passage } => Diagnostic::error(
            codes::COUNTS,
            "nothing says how many members run through the patch",
        )
        .at_key(format!("{}.count", field(*passage)), "here")
        .help("give `members` of this patch"),
    }
    .into()
}

type StripNeeds = (Vec<Node<Domain>>, Vec<Node<Clad>>, Node<Schedule>);

/// Exact members of all families of a strip.
pub(in crate::build) const STRIP: Stage<StripInput, StripNeeds, Woven> = Stage {
    name: "strip",
    version: 7,
    numerics: Numerics::Portable,
    run: |input, (domains, clads, schedule), _| {
        let grounds: Vec<Ground<'_>> = input
            .passages
            .iter()
            .zip(domains.into_iter().zip(clads))
            .map(|(passage, (domain, clad))| Ground {
                domain,
                clad,
                family: passage.family,
                start: passage.start,
                end: passage.end,
            })
            .collect();
        let woven = weave(&grounds, schedule).map_err(|error| no_member(&error, &of_strip))?;
        let open = woven.drift.filter(|drift| drift.share > CLOSES);
        let told = open.map(|drift| open_ring(&drift, input.closed));
        judged(woven, told.into_iter().collect())
    },
};

/// A ring closes where its members come back this exactly, in shares of the side.
const CLOSES: f64 = 1e-6;

fn open_ring(drift: &Drift, closed: bool) -> Diagnostic {
    let by = format!(
        "members of the ring end up to {:.2} mm beside where they began ({:.4} % of the side)",
        1e3 * drift.metres,
        1e2 * drift.share
    );
    let (told, help) = if closed {
        (
            Diagnostic::error(codes::CANNOT_CLOSE, by),
            "ask for fewer members, or take the ring out of `distribution.closed`",
        )
    } else {
        (
            Diagnostic::warning(codes::OPEN_RING, by),
            "name this family in `distribution.closed`: planar angles are then chosen such that \
             its members end where they began; or let the ring begin where it does not show",
        )
    };
    let key = format!(".passages[{}]", drift.passage);
    told.at_key(key, "around from this patch").help(help)
}

/// `passage` tells the field of the input that stands for a passage.
pub(super) fn no_member(error: &WeaveError, passage: &dyn Fn(usize) -> String) -> Failure {
    let patch = passage(error.passage);
    let (given, closest, difference) = match error.why {
        RefineError::Geodesic(why) => return no_geodesic_in(&patch, &why),
        RefineError::NoEqualLength {
            given,
            closest,
            difference,
        } => (given, closest, difference),
    };
    let side = match error.given {
        Given::Start => "start",
        Given::End => "end",
    };
    Diagnostic::error(
        codes::NO_MEMBER,
        format!(
            "the member at {:.1} % of its {side} side has no other end of equal length: the best \
             one, at {:.1} %, leaves the surface {:.3} mm longer than the plane",
            100.0 * given,
            100.0 * closest,
            1000.0 * difference
        ),
    )
    .at_key(patch, "in this patch")
    .help("split the patch over its peak of curvature, or choose another `alpha`")
    .into()
}

/// Members of one family of one patch, out of its strip.
pub(in crate::build) const MEMBERS: Stage<u32, Node<Woven>, Vec<Member>> = Stage {
    name: "members",
    version: 1,
    numerics: Numerics::Portable,
    run: |passage, strip, _| match strip.members.get(*passage as usize) {
        Some(members) => plain(members.clone()),
        None => Err(Failure::Errors(Vec::new())),
    },
};

/// What the families of a strip are called.
#[derive(Debug, Serialize)]
pub(in crate::build) struct StripChapterInput {
    pub(in crate::build) families: Vec<String>,
    pub(in crate::build) closed: bool,
}

/// The record of a strip.
pub(in crate::build) const STRIP_CHAPTER: Stage<
    StripChapterInput,
    (Node<Schedule>, Node<Woven>),
    Plan,
> = Stage {
    name: "strip-chapter",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (schedule, woven), _| {
        let names = StripNames {
            families: &input.families,
            closed: input.closed,
        };
        plain(strip_chapter(&names, schedule, woven.drift))
    },
};

type GridNeeds = (Node<Domain>, Node<Vec<Member>>, Node<Vec<Member>>);

/// Crossings of both families.
pub(in crate::build) const GRID: Stage<(), GridNeeds, Vec<Crossing>> = Stage {
    name: "grid",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), (domain, u, v), _| {
        plain(crossings_of(domain.mesh(), u, v).map_err(|wrong| miscrossings(&wrong))?)
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
    .at_key(".", "in this patch")
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
    version: 3,
    numerics: Numerics::Portable,
    run: |section, (u, v, crossings), _| {
        let lamellae: Vec<Lamella> = u
            .iter()
            .chain(v)
            .map(|member| lamella(member, crossings, section))
            .collect();
        let found = [u, v].into_iter();
        let found = found.filter_map(|members| check_flat_state(members, section));
        judged(lamellae, found.collect())
    },
};
