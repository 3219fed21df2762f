//! Exact members of a strip: threads followed from patch to patch, each member starting exactly
//! where the one before it ends.

use super::schedule::{Schedule, Seam};
use super::threads::{End, LinePiece, Thread};
use super::{Between, Given, Member, RefineError, boundary_member, refine};
use crate::cladding::Clad;
use crate::geodesic::Geodesics;
use crate::layout::Domain;
use crate::project::model::Family;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// One family of one patch with its geometry.
#[derive(Debug, Clone, Copy)]
pub struct Ground<'a> {
    /// Mesh and sides.
    pub domain: &'a Domain,
    /// The flat patch.
    pub clad: &'a Clad,
    /// The family.
    pub family: Family,
    /// Its start side on its line.
    pub start: LinePiece,
    /// Its end side on its line.
    pub end: LinePiece,
}

impl Ground<'_> {
    fn between(&self) -> Between<'_> {
        Between {
            family: self.family,
            start: self.domain.start(self.family),
            end: self.domain.end(self.family),
            quad: &self.clad.quad,
        }
    }
}

/// The members of a strip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Woven {
    /// Members of each passage, by ascending share of its start side; the first and the last are
    /// sides of the patch.
    pub members: Vec<Vec<Member>>,
    /// Of a ring: how far beside its beginning a member ends at most.
    pub drift: Option<Drift>,
}

/// How far the members of a ring miss their own beginnings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// At most, metres.
    pub metres: f64,
    /// The same as a share of the side where they meet.
    pub share: f64,
    /// The passage on whose start side they meet.
    pub passage: usize,
}

/// A member that could not be made.
#[derive(Debug, Clone, PartialEq)]
pub struct WeaveError {
    /// The passage.
    pub passage: usize,
    /// Share of the side from which it was sought.
    pub share: f64,
    /// Which side that is.
    pub given: Given,
    /// Why.
    pub why: RefineError,
}

/// All members of a strip.
///
/// # Errors
/// The first member, in the order of threads, that could not be made.
pub fn weave(grounds: &[Ground<'_>], schedule: &Schedule) -> Result<Woven, WeaveError> {
    let geodesics: Vec<Geodesics<'_>> = grounds
        .iter()
        .map(|g| Geodesics::new(g.domain.mesh()))
        .collect();
    let woven: Vec<Vec<(usize, Member)>> = schedule
        .threads
        .par_iter()
        .map(|thread| follow(grounds, &geodesics, thread))
        .collect::<Result<_, _>>()?;
    let mut members: Vec<Vec<Member>> = grounds.iter().map(sides).collect();
    for (passage, member) in woven.into_iter().flatten() {
        members[passage].push(member);
    }
    for list in &mut members {
        list.sort_by(|a, b| a.start.total_cmp(&b.start));
        for (index, member) in list.iter_mut().enumerate() {
            member.index = index as u32;
        }
    }
    let drifts = schedule
        .seams
        .iter()
        .map(|seam| drift(grounds, &members, *seam));
    let drift = drifts.max_by(|a, b| a.metres.total_cmp(&b.metres));
    Ok(Woven { members, drift })
}

/// Where exact members end that run once around a ring: shares of the line where they come back, in
/// the order of threads.
pub fn come_back(grounds: &[Ground<'_>], schedule: &Schedule) -> Result<Vec<f64>, WeaveError> {
    let geodesics: Vec<Geodesics<'_>> = grounds
        .iter()
        .map(|g| Geodesics::new(g.domain.mesh()))
        .collect();
    let threads = schedule.threads.par_iter();
    let ends = threads.map(|thread| {
        let members = follow(grounds, &geodesics, thread)?;
        let hop = thread.walks.first().and_then(|walk| walk.last());
        Ok(match (hop, members.last()) {
            (Some(hop), Some((_, member))) if hop.enter == End::Start => {
                grounds[hop.passage].end.line_share(member.end)
            }
            (Some(hop), Some((_, member))) => grounds[hop.passage].start.line_share(member.start),
            _ => thread.at,
        })
    });
    ends.collect()
}

/// How far members that come back at a seam miss those that begin there.
fn drift(grounds: &[Ground<'_>], members: &[Vec<Member>], seam: Seam) -> Drift {
    let begin = &grounds[seam.first];
    let back = &grounds[seam.last];
    let begins = members[seam.first]
        .iter()
        .map(|m| begin.start.line_share(m.start));
    let returns = members[seam.last].iter().map(|m| match seam.leave {
        End::Start => back.start.line_share(m.start),
        End::End => back.end.line_share(m.end),
    });
    let mut places: [Vec<f64>; 2] = [begins.collect(), returns.collect()];
    for list in &mut places {
        list.sort_by(f64::total_cmp);
    }
    let [begins, returns] = &places;
    let missed = begins.iter().zip(returns).map(|(a, b)| (a - b).abs());
    let on_line = missed.fold(0.0, f64::max);
    let share = on_line / (begin.start.to - begin.start.from).abs();
    Drift {
        metres: share * begin.domain.start(begin.family).length(),
        share,
        passage: seam.first,
    }
}

/// The two boundary members.
fn sides(ground: &Ground<'_>) -> Vec<Member> {
    let between = ground.between();
    let [first, last] = ground.domain.boundary_members(ground.family);
    vec![
        boundary_member(&between, 0.0, first.path().clone()),
        boundary_member(&between, 1.0, last.path().clone()),
    ]
}

fn follow(
    grounds: &[Ground<'_>],
    geodesics: &[Geodesics<'_>],
    thread: &Thread,
) -> Result<Vec<(usize, Member)>, WeaveError> {
    let mut members = Vec::new();
    for walk in &thread.walks {
        let mut at = thread.at;
        for hop in walk {
            let ground = &grounds[hop.passage];
            let function = ground.clad.function(ground.family);
            let (enter, leave, given) = match hop.enter {
                End::Start => (ground.start, ground.end, Given::Start),
                End::End => (ground.end, ground.start, Given::End),
            };
            let share = enter.side_share(at);
            let guess = match given {
                Given::Start => function.at(share).0,
                Given::End => function.inverse_at(share).0,
            };
            let member = refine(
                &geodesics[hop.passage],
                &ground.between(),
                given,
                share,
                guess,
            )
            .map_err(|why| WeaveError {
                passage: hop.passage,
                share,
                given,
                why,
            })?;
            at = leave.line_share(match given {
                Given::Start => member.end,
                Given::End => member.start,
            });
            members.push((hop.passage, member));
        }
    }
    Ok(members)
}
