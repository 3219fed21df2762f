//! Splices: lamellae that are longer than the stock, in pieces that are joined.
//!
//! A joint is the weakest place of a lamella, so it stands where least is asked of it. Breaks are
//! chosen by dynamic programming ([`breaks`]): the fewest pieces, and of these ways the one with
//! the least cost. No joint comes closer to an opening than a web of one and a half bolts, which
//! washers need too, and no plate lies in the way of a crossing lamella. Within that, a joint
//! costs
//!
//! - the square of the lamella's curvature there, and half that of its twist, both in shares of
//!   the largest on the lamella ([`Curve`]): bending stress grows with curvature;
//! - ten, and ten times the square of the share that is missing, if its middle is nearer to an
//!   opening than twice the width or 30 mm;
//! - nearness in space to the joints of other lamellae, up to one and a half cells of the grid:
//!   two joints side by side make a hinge. Where patches meet, the boundary lamellae of both are
//!   staggered in this way as well.
//!
//! Lamellae are taken in the order of their ids, so equal plans give equal splices. Metres.

mod breaks;
mod joint;
pub mod shopping;

use super::curve::Curve;
use super::index::PlanIndex;
use super::names::listed;
use super::part::{contact_reach, net_area, opening_extent};
use super::units::MM;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::plan::{JointRecord, LamellaRecord, PieceRecord, Plan};
use crate::project::model::SpliceKind;
use breaks::{Limits, breaks};
use joint::{Joint, JointSection};
use nalgebra::Point3;
use serde::{Deserialize, Serialize};

/// What splicing depends on besides the lamellae.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rules {
    /// How pieces are joined.
    pub kind: SpliceKind,
    /// Diameter of the bolts, metres.
    pub bolt: f64,
    /// Their play, metres.
    pub clearance: f64,
    /// What is there to cut from.
    pub stock: Vec<Stock>,
}

/// A material and the parts that it gives.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stock {
    /// Name of the material.
    pub material: String,
    /// Longest part, metres.
    pub longest: f64,
    /// Along the lamella, Pa.
    pub elastic_modulus: f64,
    /// Pa.
    pub bending_strength: f64,
}

/// A lamella that is spliced.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spliced {
    /// Its id.
    pub lamella: String,
    /// Its pieces, at least two.
    pub pieces: Vec<PieceRecord>,
}

impl Spliced {
    /// Gives a lamella its pieces; the holes for their screws take of its mass.
    pub fn put_into(&self, lamella: &mut LamellaRecord) {
        let whole = net_area(lamella);
        lamella.pieces.clone_from(&self.pieces);
        lamella.mass *= net_area(lamella) / whole;
    }
}

/// Wood between a joint and an opening in bolt diameters, as between two openings.
const WEB_IN_BOLTS: f64 = 1.5;
/// Nearness to openings counts up to so many widths, and up to so many metres.
const NEAR_IN_WIDTHS: f64 = 2.0;
const NEAR: f64 = 0.03;
/// Nearness to other joints counts up to so many cells of the grid.
const STAGGER_IN_CELLS: f64 = 1.5;
/// Least distance of two joints of a lamella in widths.
const APART_IN_WIDTHS: f64 = 4.0;
/// What nearness to an opening counts against the largest bending: as good as a ban, where there
/// is another place. What twist and joints side by side count.
const CROSSING: f64 = 10.0;
const TWIST: f64 = 0.5;
const STAGGER: f64 = 2.0;

/// Pieces of every lamella that is longer than a part may be. Errors name lamellae that cannot
/// be divided; warnings, joints that stand close to a crossing or are bent too far.
pub fn splice(plan: &Plan, rules: &Rules) -> Checked<Vec<Spliced>> {
    let index = PlanIndex::new(plan);
    let mut found: Vec<Spliced> = Vec::new();
    let mut joints: Vec<Point3<f64>> = Vec::new();
    let (mut stuck, mut close, mut bent) = (Vec::new(), Vec::new(), Vec::new());
    for lamella in &plan.lamellae {
        let stock = rules.stock.iter().find(|s| s.material == lamella.material);
        let is_short = |s: &&Stock| s.longest > 0.0 && lamella.length > s.longest;
        let Some(stock) = stock.filter(is_short) else {
            continue;
        };
        let joint = Joint::new(
            rules.kind,
            JointSection {
                width: lamella.width,
                thickness: lamella.thickness,
                bolt: rules.bolt,
                clearance: rules.clearance,
            },
        );
        let Some(site) = Site::new(lamella, &index, &joint, rules.bolt) else {
            continue;
        };
        let limits = Limits {
            length: lamella.length,
            longest: stock.longest,
            shortest: (APART_IN_WIDTHS * lamella.width).max(joint.length),
            reach: joint.reach(),
        };
        match breaks(&limits, |x| site.cost(x, &joints)) {
            Some(at) => {
                joints.extend(at.iter().map(|x| site.place(*x)));
                close.extend(at.iter().filter_map(|x| site.closeness(*x)));
                bent.extend(at.iter().filter_map(|x| site.overstress(*x, &joint, stock)));
                found.push(Spliced {
                    lamella: lamella.id.clone(),
                    pieces: pieces(lamella, &at, &joint),
                });
            }
            None => stuck.push(Stuck {
                lamella,
                room: site.room(),
                longest: stock.longest,
                joint,
            }),
        }
    }
    match impossible(&stuck) {
        Some(error) => Err(vec![error]),
        None => Ok(Warned {
            value: found,
            warnings: near_crossings(close)
                .into_iter()
                .chain(overstressed(bent))
                .collect(),
        }),
    }
}

/// A lamella with everything that a joint has to keep away from.
struct Site<'a> {
    lamella: &'a LamellaRecord,
    curve: Curve,
    /// Half a joint.
    half: f64,
    /// Chords of this length tell curvature.
    chord: f64,
    /// Openings, from the start of the lamella.
    openings: Vec<[f64; 2]>,
    /// Where no part of a joint may be.
    forbidden: Vec<[f64; 2]>,
    near: f64,
    stagger: f64,
    bend_max: f64,
    twist_max: f64,
}

impl<'a> Site<'a> {
    fn new(
        lamella: &'a LamellaRecord,
        index: &PlanIndex<'_>,
        joint: &Joint,
        bolt: f64,
    ) -> Option<Self> {
        let neighbours = index.neighbours(lamella)?;
        let crossings = neighbours.crossings.iter().map(|(crossing, _)| *crossing);
        let curve = Curve::new(neighbours.member, crossings);
        let web = WEB_IN_BOLTS * bolt;
        let (mut openings, mut forbidden) = (Vec::new(), Vec::new());
        for opening in &lamella.openings {
            let ([from, to], diameter) = opening_extent(lamella, opening);
            let radius = 0.5 * diameter;
            openings.push([(from - radius) / MM, (to + radius) / MM]);
            let mut around = radius / MM + web;
            if joint.kind == SpliceKind::Plate {
                let other = neighbours
                    .crossings
                    .iter()
                    .find(|(crossing, _)| crossing.id == opening.crossing());
                if let Some((crossing, other)) = other {
                    around = around.max(contact_reach(lamella.width, other.width, crossing));
                }
            }
            forbidden.push([from / MM - around, to / MM + around]);
        }
        let cells = openings.len().saturating_sub(1).max(1) as f64;
        let half = 0.5 * joint.length;
        let chord = joint.length.max(2.0 * lamella.width);
        let samples = |f: &dyn Fn(f64) -> f64| {
            let at = |i: u32| curve.length() * f64::from(i) / 64.0;
            (0..=64).map(|i| f(at(i))).fold(0.0, f64::max).max(1e-9)
        };
        let bend_max = samples(&|s| curve.bend(s, chord));
        let twist_max = samples(&|s| curve.twist(s));
        Some(Self {
            half,
            chord,
            openings,
            forbidden,
            near: NEAR.max(NEAR_IN_WIDTHS * lamella.width),
            stagger: STAGGER_IN_CELLS * lamella.length / cells,
            bend_max,
            twist_max,
            lamella,
            curve,
        })
    }

    /// Arc length of a place of the lamella on its member.
    fn on_member(&self, x: f64) -> f64 {
        x - self.lamella.end_margin
    }

    fn place(&self, x: f64) -> Point3<f64> {
        self.curve.at(self.on_member(x))
    }

    /// The widest stretch that takes joints, or would if they were shorter; metres.
    fn room(&self) -> f64 {
        let mut taken = self.forbidden.clone();
        taken.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let (mut widest, mut free_from) = (0.0, 0.0);
        for [from, to] in taken {
            widest = f64::max(widest, from - free_from);
            free_from = f64::max(free_from, to);
        }
        f64::max(widest, self.lamella.length - free_from)
    }

    /// Distance of the middle of a joint from the nearest opening.
    fn clear(&self, x: f64) -> f64 {
        let gap = |[from, to]: &[f64; 2]| (from - x).max(x - to);
        self.openings.iter().map(gap).fold(f64::INFINITY, f64::min)
    }

    fn cost(&self, x: f64, joints: &[Point3<f64>]) -> Option<f64> {
        let [from, to] = [x - self.half, x + self.half];
        if self.forbidden.iter().any(|f| from < f[1] && to > f[0]) {
            return None;
        }
        let square = |x: f64| x * x;
        let s = self.on_member(x);
        let bend = square(self.curve.bend(s, self.chord) / self.bend_max);
        let twist = TWIST * square(self.curve.twist(s) / self.twist_max);
        let near = match 1.0 - self.clear(x) / self.near {
            short if short > 0.0 => CROSSING * (1.0 + square(short)),
            _ => 0.0,
        };
        let place = self.place(x);
        let beside: f64 = joints
            .iter()
            .map(|joint| (1.0 - (joint - place).norm() / self.stagger).max(0.0))
            .map(square)
            .sum();
        Some(bend + twist + near + STAGGER * beside)
    }

    /// A joint in which bending into the surface takes more stress than the material bears:
    /// E κ t / 2 of the section that is left.
    fn overstress(&self, x: f64, joint: &Joint, stock: &'a Stock) -> Option<Bent<'a>> {
        let bend = self.curve.bend(self.on_member(x), self.chord);
        let share = joint.carrying(self.lamella.width);
        let stress = 0.5 * stock.elastic_modulus * bend * self.lamella.thickness / share;
        (stress > stock.bending_strength).then_some(Bent {
            lamella: &self.lamella.id,
            material: &stock.material,
            stress,
            strength: stock.bending_strength,
            share,
        })
    }

    /// A joint that is nearer to an opening than is usual: how near, and how near is usual.
    fn closeness(&self, x: f64) -> Option<Close<'a>> {
        let clear = self.clear(x);
        (clear < self.near).then_some(Close {
            lamella: &self.lamella.id,
            clear,
            usual: self.near,
        })
    }
}

/// A lamella that cannot be divided.
struct Stuck<'a> {
    lamella: &'a LamellaRecord,
    joint: Joint,
    /// What there is between its crossings, metres.
    room: f64,
    /// Longest piece, metres.
    longest: f64,
}

/// A joint that is bent further than it bears.
struct Bent<'a> {
    lamella: &'a str,
    material: &'a str,
    /// Pa.
    stress: f64,
    strength: f64,
    share: f64,
}

struct Close<'a> {
    lamella: &'a str,
    clear: f64,
    usual: f64,
}

fn pieces(lamella: &LamellaRecord, at: &[f64], joint: &Joint) -> Vec<PieceRecord> {
    let starts = std::iter::once(0.0).chain(at.iter().copied());
    let ends = at.iter().copied().map(Some).chain([None]);
    starts
        .zip(ends)
        .enumerate()
        .map(|(i, (from, to))| PieceRecord {
            id: format!("{}{}", lamella.id, letters(i)),
            from,
            to: to.unwrap_or(lamella.length),
            joint: to.map(|middle| JointRecord {
                kind: joint.kind,
                length: joint.length,
                fingers: joint.fingers,
                screws: joint.screws.iter().map(|x| middle + x).collect(),
                hole: joint.hole,
            }),
        })
        .collect()
}

/// a, b, ... z, aa, ab, ...
fn letters(mut number: usize) -> String {
    let mut text = String::new();
    loop {
        text.insert(0, char::from(b'a' + (number % 26) as u8));
        match (number / 26).checked_sub(1) {
            Some(rest) => number = rest,
            None => return text,
        }
    }
}

/// The lamella with the least room for a joint, and which others cannot be divided either.
fn impossible(stuck: &[Stuck<'_>]) -> Option<Diagnostic> {
    let worst = stuck.iter().min_by(|a, b| a.room.total_cmp(&b.room))?;
    let Stuck {
        lamella,
        joint,
        room,
        longest,
    } = worst;
    let (name, way_out) = match joint.kind {
        SpliceKind::Finger => (
            "fingers",
            "fewer members across, thinner lamellae, a thinner bolt, or longer stock",
        ),
        SpliceKind::Scarf => (
            "scarfs",
            "`splice = \"finger\"` is shorter; fewer members across, thinner lamellae, a thinner \
             bolt, or longer stock make room",
        ),
        SpliceKind::Plate => (
            "plates",
            "`splice = \"finger\"` and `\"scarf\"` are shorter; a planar angle (`alpha`) nearer \
             to 90 degrees, narrower lamellae (`width`), a thinner bolt, fewer members across, or \
             longer stock make room",
        ),
    };
    let length = joint.length * MM;
    let why = if *room <= 0.0 {
        format!("its crossings leave no stretch free, a joint takes {length:.1} mm")
    } else if *room < joint.length {
        format!(
            "the widest stretch between its crossings is {:.1} mm long, a joint takes {length:.1} mm",
            room * MM
        )
    } else {
        "the stretches that take a joint are too far apart for such pieces".to_owned()
    };
    let mut diagnostic = Diagnostic::error(
        codes::NO_PLACE_FOR_SPLICE,
        format!(
            "lamella `{}` of {:.1} mm cannot be divided into pieces of at most {:.1} mm whose \
             joints keep clear of crossings",
            lamella.id,
            lamella.length * MM,
            longest * MM
        ),
    )
    .at_key("fabrication.splice", format!("{name} of {length:.1} mm"))
    .note(why);
    let others: Vec<&str> = stuck.iter().map(|other| &*other.lamella.id).collect();
    let others: Vec<&str> = others.into_iter().filter(|id| *id != lamella.id).collect();
    if !others.is_empty() {
        let names = listed(others.into_iter());
        diagnostic = diagnostic.note(format!("cannot be divided either: {names}"));
    }
    Some(diagnostic.help(way_out).about(&lamella.id))
}

/// The worst of the joints that stand close to an opening, and how many do.
fn near_crossings(close: Vec<Close<'_>>) -> Option<Diagnostic> {
    let count = close.len();
    let worst = close
        .into_iter()
        .min_by(|a, b| a.clear.total_cmp(&b.clear))?;
    let others = match count {
        1 => String::new(),
        2 => ", and another is close as well".to_owned(),
        n => format!(", and {} others are close as well", n - 1),
    };
    let message = format!(
        "the middle of a joint of `{}` is {:.1} mm from an opening{others}",
        worst.lamella,
        worst.clear * MM
    );
    Some(
        Diagnostic::warning(codes::SPLICE_NEAR_CROSSING, message)
            .at_key("fabrication.splice", "joints are asked for here")
            .note(format!(
                "twice the width of the lamella, and 30 mm, are usual: {:.0} mm",
                worst.usual * MM
            ))
            .help("longer stock, or fewer members across, make room")
            .about(worst.lamella),
    )
}

/// The worst of the joints that are bent too far, and how many are.
fn overstressed(bent: Vec<Bent<'_>>) -> Option<Diagnostic> {
    let count = bent.len();
    let worst = bent
        .into_iter()
        .max_by(|a, b| a.stress.total_cmp(&b.stress))?;
    let others = match count {
        1 => String::new(),
        n => format!(" ({n} joints are bent too far)"),
    };
    let message = format!(
        "the joint of `{}` is bent to {:.0} MPa, `{}` bears {:.0} MPa{others}",
        worst.lamella,
        worst.stress * 1e-6,
        worst.material,
        worst.strength * 1e-6
    );
    Some(
        Diagnostic::warning(codes::SPLICE_OVERSTRESSED, message)
            .at_key("fabrication.splice", "joints are asked for here")
            .note(format!(
                "{:.0} % of the section carry in the joint",
                worst.share * 100.0
            ))
            .help("thinner lamellae, scarfs, or longer stock")
            .about(worst.lamella),
    )
}

#[cfg(test)]
mod tests {
    use super::letters;

    #[test]
    fn pieces_are_lettered_like_columns_of_a_table() {
        let named: Vec<String> = [0, 1, 25, 26, 27, 701, 702].map(letters).into();
        assert_eq!(named, ["a", "b", "z", "aa", "ab", "zz", "aaa"]);
    }
}
