//! Member counts: one a strip, given at least once, consistent across T-junctions.

use super::patches::Patches;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::reader::{Field, Sink};
use crate::project::file::{MemberCount, ProjectFile};
use crate::project::model::Family;
use crate::project::strips::{Junction, Network, Passage, Side, Strip, Strips};

/// Counts of every patch of the file.
pub(super) struct Counts {
    /// By the patch's index in the file.
    counts: Vec<(Option<u32>, Option<u32>)>,
}

impl Counts {
    pub(super) fn u(&self, patch: usize) -> Option<u32> {
        self.counts.get(patch)?.0
    }

    pub(super) fn v(&self, patch: usize) -> Option<u32> {
        self.counts.get(patch)?.1
    }
}

/// Most members of a family.
const MOST: u32 = 1000;

/// What is known of a strip's count.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Known {
    /// Nobody says it.
    No,
    /// Said by this passage, or computed from a T-junction.
    Yes(u32),
    /// Said wrongly, and reported.
    Bad,
}

pub(super) fn check(
    file: &ProjectFile,
    patches: &Patches<'_>,
    network: &Network<'_>,
    strips: &Strips,
    sink: &mut Sink,
) -> Counts {
    let scope = Scope {
        file,
        names: patches
            .good()
            .map(|(index, _)| (index, patches.all[index].name))
            .collect(),
        network,
    };
    crowds(&scope, strips, sink);
    let mut known: Vec<Known> = strips
        .strips
        .iter()
        .map(|strip| agreed(&scope, strip, sink))
        .collect();
    junctions(&scope, strips, &mut known, sink);
    // A patch that is out of the network, or a strip that is cut off at a crowd, might have been
    // the one to give a count.
    if patches.complete() && strips.crowds.is_empty() {
        for (strip, known) in strips.strips.iter().zip(&known) {
            if *known == Known::No {
                missing(&scope, strip, sink);
            }
        }
    }
    let mut counts = vec![(None, None); patches.all.len()];
    for (position, (index, _)) in scope.names.iter().enumerate() {
        let count = |family| {
            let strip = strips.of(Passage {
                patch: position,
                family,
            })?;
            match known[strip] {
                Known::Yes(count) => Some(count),
                _ => None,
            }
        };
        counts[*index] = (count(Family::U), count(Family::V));
    }
    Counts { counts }
}

struct Scope<'f, 'n> {
    file: &'f ProjectFile,
    /// Of each patch of the network, its index in the file and its name.
    names: Vec<(usize, &'f str)>,
    network: &'n Network<'n>,
}

impl Scope<'_, '_> {
    fn given(&self, passage: Passage) -> Option<Field<MemberCount>> {
        let (index, _) = self.names[passage.patch];
        let patch = self.file.patches.good()?.entries.get(index)?.1.good()?;
        match patch.members.as_ref()? {
            Field::Bad => Some(Field::Bad),
            Field::Good(members) => match passage.family {
                Family::U => members.u,
                Family::V => members.v,
            },
        }
    }

    fn id(&self, passage: Passage) -> String {
        format!("{}.{}", self.names[passage.patch].1, letter(passage.family))
    }

    fn place(&self, passage: Passage) -> String {
        KeyPath::of(["patches", self.names[passage.patch].1, "members"])
            .key(letter(passage.family))
            .into()
    }

    fn chain(&self, strip: &Strip) -> String {
        const SHOWN: usize = 12;
        let ids = strip
            .passages
            .iter()
            .take(SHOWN)
            .map(|&passage| self.id(passage));
        let mut ids: Vec<String> = ids.map(|id| format!("`{id}`")).collect();
        if strip.passages.len() > SHOWN {
            ids.push(format!("… ({} in all)", strip.passages.len()));
        }
        ids.join(", ")
    }

    fn side(&self, side: Side) -> String {
        let [a, b] = side.ends(self.network);
        format!("{a}-{b}")
    }
}

fn letter(family: Family) -> &'static str {
    match family {
        Family::U => "u",
        Family::V => "v",
    }
}

/// The count of a strip; all that are given must agree with the first.
fn agreed(scope: &Scope<'_, '_>, strip: &Strip, sink: &mut Sink) -> Known {
    let mut first: Option<(u32, Passage)> = None;
    let mut bad = false;
    for &passage in &strip.passages {
        match (scope.given(passage), first) {
            (Some(Field::Bad), _) => bad = true,
            (Some(Field::Good(count)), None) => first = Some((count.0, passage)),
            (Some(Field::Good(count)), Some((agreed, giver))) if count.0 != agreed => {
                bad = true;
                sink.error(|| {
                    Diagnostic::error(
                        Code::new("E0206"),
                        format!(
                            "`{}` has {} members and `{}` has {agreed}, but they are one strip",
                            scope.id(passage),
                            count.0,
                            scope.id(giver)
                        ),
                    )
                    .at_key(scope.place(passage), format!("{} here", count.0))
                    .at_key(scope.place(giver), format!("{agreed} here"))
                    .about(scope.id(passage))
                    .note(format!("the strip is {}", scope.chain(strip)))
                    .help("members run on across shared sides: give the count of a strip once")
                });
            }
            (None, _) | (Some(Field::Good(_)), Some(_)) => {}
        }
    }
    match first {
        _ if bad => Known::Bad,
        Some((count, _)) => Known::Yes(count),
        None => Known::No,
    }
}

fn missing(scope: &Scope<'_, '_>, strip: &Strip, sink: &mut Sink) {
    let first = strip.passages[0];
    sink.error(|| {
        let id = scope.id(first);
        let (message, fix) = if strip.passages.len() == 1 {
            (
                format!("the number of members of `{id}` is missing"),
                "add it".to_owned(),
            )
        } else {
            (
                format!("the number of members of the strip through `{id}` is missing"),
                "add it to one of the strip's patches".to_owned(),
            )
        };
        let diagnostic = Diagnostic::error(Code::new("E0207"), message)
            .at_key(scope.place(first), "belongs here")
            .about(id)
            .help(format!(
                "{fix}, for example: members = {{ {} = 7 }}",
                letter(first.family)
            ));
        if strip.passages.len() == 1 {
            diagnostic
        } else {
            diagnostic.note(format!("the strip is {}", scope.chain(strip)))
        }
    });
}

/// Computes counts across complete T-junctions and checks those that are all given.
fn junctions(scope: &Scope<'_, '_>, strips: &Strips, known: &mut [Known], sink: &mut Sink) {
    let complete: Vec<&Junction> = strips.junctions.iter().filter(|j| j.complete).collect();
    loop {
        let mut news = false;
        for junction in &complete {
            let Some((strip, count)) = infer(junction, strips, known) else {
                continue;
            };
            news = true;
            known[strip] = if let Ok(count @ 2..=MOST) = u32::try_from(count) {
                Known::Yes(count)
            } else {
                sink.error(|| impossible(scope, junction, &strips.strips[strip], count));
                Known::Bad
            };
        }
        if !news {
            break;
        }
    }
    for junction in complete {
        let sides = std::iter::once(&junction.long).chain(&junction.parts);
        let counts = sides.map(|side| strip_of(*side, strips).map(|strip| known[strip]));
        let counts: Option<Vec<u32>> = counts
            .map(|known| match known {
                Some(Known::Yes(count)) => Some(count),
                _ => None,
            })
            .collect();
        let Some((long, parts)) = counts.as_deref().and_then(<[u32]>::split_first) else {
            continue;
        };
        let needed = spans(parts) + 1;
        if i64::from(*long) != needed {
            sink.error(|| unequal(scope, junction, *long, parts, needed));
        }
    }
}

fn strip_of(side: Side, strips: &Strips) -> Option<usize> {
    strips.of(side.passage())
}

/// Gaps between members: one less than the members of each part.
fn spans(parts: &[u32]) -> i64 {
    parts.iter().map(|count| i64::from(*count) - 1).sum()
}

/// The one unknown strip of a junction and the count that it must have.
fn infer(junction: &Junction, strips: &Strips, known: &[Known]) -> Option<(usize, i64)> {
    let mut unknown = None;
    // gaps of the long side - sum of gaps of the parts = 0
    let mut rest = 0_i64;
    let sides = std::iter::once(&junction.long).chain(&junction.parts);
    for (position, side) in sides.enumerate() {
        let sign = if position == 0 { 1 } else { -1 };
        let strip = strip_of(*side, strips)?;
        match known[strip] {
            Known::Yes(count) => rest += sign * (i64::from(count) - 1),
            Known::No if unknown.is_none() => unknown = Some((strip, sign)),
            _ => return None,
        }
    }
    let (strip, sign) = unknown?;
    Some((strip, 1 - sign * rest))
}

fn impossible(scope: &Scope<'_, '_>, junction: &Junction, strip: &Strip, count: i64) -> Diagnostic {
    let side = scope.side(junction.long);
    let id = scope.id(strip.passages[0]);
    let mut diagnostic = Diagnostic::error(
        Code::new("E0218"),
        format!("the other counts along the side `{side}` leave a count of {count} for `{id}`"),
    )
    .at_key(scope.place(strip.passages[0]), format!("2 to {MOST} are possible"))
    .about(id)
    .note("members run on across a T-junction, and neighbouring parts share the member at the anchor between them")
    .help("change the other counts, or move the anchor");
    for side in std::iter::once(&junction.long).chain(&junction.parts) {
        let place = scope.place(side.passage());
        if scope.given(side.passage()).is_some() {
            diagnostic = diagnostic.at_key(place, "one of the other counts");
        }
    }
    diagnostic
}

fn unequal(
    scope: &Scope<'_, '_>,
    junction: &Junction,
    long: u32,
    parts: &[u32],
    needed: i64,
) -> Diagnostic {
    let id = scope.id(junction.long.passage());
    let side = scope.side(junction.long);
    let sum: Vec<String> = junction
        .parts
        .iter()
        .zip(parts)
        .map(|(part, count)| format!("{count} on `{}`", scope.side(*part)))
        .collect();
    let mut diagnostic = Diagnostic::error(
        Code::new("E0218"),
        format!("`{id}` has {long} members on the side `{side}`, but its parts make {needed}"),
    )
    .at_key(scope.place(junction.long.passage()), format!("{long} here"))
    .about(id)
    .note(format!(
        "the parts have {}; neighbours share the member at the anchor between them",
        sum.join(", ")
    ))
    .help("members run on across a T-junction: leave one of the counts out and it is computed");
    for part in &junction.parts {
        diagnostic = diagnostic.at_key(scope.place(part.passage()), "a part");
    }
    diagnostic
}

fn crowds(scope: &Scope<'_, '_>, strips: &Strips, sink: &mut Sink) {
    for crowd in &strips.crowds {
        sink.error(|| {
            let name = |side: &Side| scope.names[side.patch].1;
            let names: Vec<&str> = crowd.sides.iter().map(name).collect();
            let last = crowd.sides[crowd.sides.len() - 1];
            let mut diagnostic = Diagnostic::error(
                Code::new("E0208"),
                format!(
                    "{} all lie along the side `{}`",
                    crate::project::suggest::all_of(&names),
                    scope.side(last)
                ),
            )
            .about(name(&last))
            .help("on a surface a side has a patch on its left and one on its right; correct a corner");
            for side in crowd.sides.iter().rev() {
                let path = KeyPath::of(["patches", name(side), "corners"]);
                diagnostic =
                    diagnostic.at_key(path.as_str(), format!("side `{}`", scope.side(*side)));
            }
            diagnostic
        });
    }
}
