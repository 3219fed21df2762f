//! A block: what grows around a peak inside an outline (paper, Algorithm 2). It is the part of a
//! patch between two lines of each family, as one patch, as two with a side over the peak, or as
//! four with a corner on it. Where it reaches the outline, its sides are pieces of the outline's;
//! elsewhere they are cuts from side to side, and what lies beyond is a patch of its own.

use super::Proposal;
use super::cut::{Refusal, Rules};
use super::draft::Draft;
use super::split::Workshop;
use crate::project::model::Family;
use crate::surface::Point3;

/// What a block consists of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shape {
    /// One patch, the peak inside.
    One,
    /// Two patches and the side between them, which runs like a member of the family.
    Two(Family),
    /// Four patches that share a corner on the peak.
    Four,
}

impl Shape {
    /// How many patches.
    pub(super) fn parts(self) -> usize {
        match self {
            Self::One => 1,
            Self::Two(_) => 2,
            Self::Four => 4,
        }
    }
}

/// Around what a block grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Site {
    /// The peak, or the place that stands for it.
    pub(super) at: Point3,
    /// Where ways from there arrive: shares of the sides AB, BC, DC, AD.
    pub(super) feet: [f64; 4],
    /// How long they are, metres.
    pub(super) arms: [f64; 4],
}

/// How far a block reaches towards the sides AB, BC, DC, AD: 0 at the peak, 1 at the side.
pub(super) type Extent = [f64; 4];

/// A block that reaches the outline everywhere.
pub(super) const WHOLE: Extent = [1.0; 4];

/// A draft in which a block has been cut out.
#[derive(Debug, Clone)]
pub(super) struct Carved {
    pub(super) draft: Draft,
    /// Indices of the patches of the block.
    pub(super) block: Vec<usize>,
    /// Indices of those beyond it.
    pub(super) beyond: Vec<usize>,
}

/// Cuts a block out of a patch of the workshop's draft. Cuts across the long way come first, so
/// what lies beyond them is as compact as can be.
pub(super) fn carve(
    workshop: &mut Workshop<'_>,
    outline: usize,
    site: &Site,
    shape: Shape,
    extent: &Extent,
) -> Result<Carved, Refusal> {
    let mut carving = Carving {
        draft: workshop.draft.clone(),
        patch: outline,
        last: outline,
        window: Window::new(site, extent),
    };
    let [ab, bc, dc, ad] = site.arms;
    let order = if bc + ad >= ab + dc {
        [Family::U, Family::V]
    } else {
        [Family::V, Family::U]
    };
    for along in order {
        carving.trim(workshop, along)?;
    }
    let [south, east, north, west] = carving.window.inside(site.feet);
    let split = match shape {
        Shape::One => None,
        Shape::Two(Family::U) => Some(Proposal::Edge {
            along: Family::U,
            from: south,
            to: north,
        }),
        Shape::Two(Family::V) => Some(Proposal::Edge {
            along: Family::V,
            from: west,
            to: east,
        }),
        Shape::Four => Some(Proposal::Corner {
            at: site.at,
            shares: [south, east, north, west],
        }),
    };
    if let Some(split) = split {
        carving.cut(workshop, &split, true)?;
        carving.last += shape.parts() - 1;
    }
    let Carving {
        draft, patch, last, ..
    } = carving;
    let block: Vec<usize> = (patch..patch + shape.parts()).collect();
    let beyond = (outline..=last).filter(|i| !block.contains(i)).collect();
    Ok(Carved {
        draft,
        block,
        beyond,
    })
}

/// The lines that bound a block, and what is left of the outline between them.
struct Window {
    /// Shares of AB and of DC at which lines of the u-family end: before and behind the peak.
    u: [[f64; 2]; 2],
    /// Shares of AD and of BC for the v-family.
    v: [[f64; 2]; 2],
}

impl Window {
    fn new(site: &Site, extent: &Extent) -> Self {
        let [ab, bc, dc, ad] = site.feet;
        let [south, east, north, west] = *extent;
        let before = |foot: f64, reach: f64| foot * (1.0 - reach);
        let behind = |foot: f64, reach: f64| foot + (1.0 - foot) * reach;
        Self {
            u: [
                [ab, dc].map(|f| before(f, west)),
                [ab, dc].map(|f| behind(f, east)),
            ],
            v: [
                [ad, bc].map(|f| before(f, south)),
                [ad, bc].map(|f| behind(f, north)),
            ],
        }
    }

    /// Shares of the outline's sides AB, BC, DC, AD as those of the block's.
    fn inside(&self, [ab, bc, dc, ad]: [f64; 4]) -> [f64; 4] {
        let within = |lines: [[f64; 2]; 2], end: usize, share: f64| {
            (share - lines[0][end]) / (lines[1][end] - lines[0][end])
        };
        [
            within(self.u, 0, ab),
            within(self.v, 1, bc),
            within(self.u, 1, dc),
            within(self.v, 0, ad),
        ]
    }
}

struct Carving {
    draft: Draft,
    /// Index of what becomes the block.
    patch: usize,
    /// Index of the last part of the outline.
    last: usize,
    window: Window,
}

impl Carving {
    /// Cuts along both lines of a family that bound the block.
    fn trim(&mut self, workshop: &mut Workshop<'_>, along: Family) -> Result<(), Refusal> {
        let [before, behind] = match along {
            Family::U => self.window.u,
            Family::V => self.window.v,
        };
        let edge = |[from, to]: [f64; 2]| Proposal::Edge { along, from, to };
        let cuts = |line: [f64; 2]| line.iter().all(|s| *s > 0.0 && *s < 1.0);
        let mut rest = behind;
        if cuts(before) {
            self.cut(workshop, &edge(before), true)?;
            self.patch += 1;
            self.last += 1;
            rest = [0, 1].map(|i| (behind[i] - before[i]) / (1.0 - before[i]));
        }
        if cuts(behind) {
            // The middle of what is left of the outline is no place of it.
            self.cut(workshop, &edge(rest), !cuts(before))?;
            self.last += 1;
        }
        Ok(())
    }

    fn cut(
        &mut self,
        workshop: &mut Workshop<'_>,
        proposal: &Proposal,
        centre: bool,
    ) -> Result<(), Refusal> {
        let lengths = workshop.sides(&self.draft, self.patch);
        let lengths = lengths.ok_or(Refusal::Folded)?;
        let rules = Rules {
            centre,
            ..workshop.rules
        };
        self.draft.cut(self.patch, proposal, lengths, &rules)
    }
}
