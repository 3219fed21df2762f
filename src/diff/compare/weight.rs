//! How much a change weighs: the order in which changes are told.

use crate::diff::class::Class;
use crate::diff::part::Kind;
use crate::diff::quantity::Quantity;
use std::cmp::Reverse;

/// Class, then whether it is a point (what a user moved comes before what follows from that), then
/// how many tolerances the worst value is away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weight {
    pub(super) class: Class,
    pub(super) is_point: bool,
    pub(super) ratio: f64,
}

impl Weight {
    pub(super) fn new(kind: Kind, class: Class, ratio: f64) -> Reverse<Self> {
        Reverse(Self {
            class,
            is_point: kind == Kind::Point,
            ratio,
        })
    }
}

impl Eq for Weight {}

impl PartialOrd for Weight {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Weight {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        (self.class, self.is_point)
            .cmp(&(other.class, other.is_point))
            .then(self.ratio.total_cmp(&other.ratio))
    }
}

/// How far a value is from where it was.
pub(super) struct Moved {
    pub(super) delta: Option<f64>,
    pub(super) quantity: Option<Quantity>,
    /// In tolerances.
    pub(super) ratio: f64,
}

/// The worst of several values.
#[derive(Debug, Default)]
pub(super) struct Judged {
    pub(super) class: Option<Class>,
    pub(super) ratio: f64,
}

impl Judged {
    pub(super) fn raise(&mut self, class: Class, ratio: f64) {
        match self.class {
            Some(worst) if worst > class => {}
            Some(worst) if worst == class => self.ratio = self.ratio.max(ratio),
            _ => {
                self.class = Some(class);
                self.ratio = ratio;
            }
        }
    }
}
