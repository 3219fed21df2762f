//! The part model: what two plans are compared by. A part has a kind and an id, a few named
//! values with what a change of each asks for, and items (the openings of a lamella, the parts on
//! a sheet) that are compared by their own ids.
//!
//! Every record of the plan becomes parts in one function of [`records`](super::records), and
//! everything after that (comparison, lock, text for `git diff`) knows parts only.

use super::class::Class;
use super::quantity::Quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// What a part is.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A part to cut.
    Lamella,
    /// A foil between lamellae.
    Sticker,
    /// What the structure stands on.
    Support,
    /// A geodesic quadrilateral.
    Patch,
    /// A grid curve.
    Member,
    /// Families that members run through one after the other.
    Strip,
    /// An anchor.
    Point,
    /// A panel with its parts.
    Sheet,
    /// What was needed of a material and thickness, and how good that is.
    Nesting,
    /// A line of the bill of materials.
    BillRow,
    /// The whole.
    Structure,
}

impl Kind {
    /// All kinds, in the order in which they are counted.
    pub const ALL: [Self; 11] = [
        Self::Lamella,
        Self::Sticker,
        Self::Support,
        Self::Patch,
        Self::Member,
        Self::Strip,
        Self::Point,
        Self::Sheet,
        Self::Nesting,
        Self::BillRow,
        Self::Structure,
    ];

    /// One of them.
    pub fn word(self) -> &'static str {
        match self {
            Self::Lamella => "lamella",
            Self::Sticker => "sticker",
            Self::Support => "support",
            Self::Patch => "patch",
            Self::Member => "member",
            Self::Strip => "strip",
            Self::Point => "point",
            Self::Sheet => "sheet",
            Self::Nesting => "nesting",
            Self::BillRow => "bill-row",
            Self::Structure => "structure",
        }
    }

    /// Several of them.
    pub fn plural(self) -> &'static str {
        match self {
            Self::Lamella => "lamellae",
            Self::Sticker => "stickers",
            Self::Support => "supports",
            Self::Patch => "patches",
            Self::Member => "members",
            Self::Strip => "strips",
            Self::Point => "points",
            Self::Sheet => "sheets",
            Self::Nesting => "nestings",
            Self::BillRow => "bill rows",
            Self::Structure => "structures",
        }
    }

    /// The kind of a word, as [`Kind::word`] gives it.
    pub(super) fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.word() == word)
    }
}

/// A value of a part.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// A number in the unit of the plan.
    Number(f64, Quantity),
    /// A word.
    Text(String),
    /// An id of something else: it follows renames.
    Id(String),
    /// A place, metres.
    Place([f64; 3]),
    /// Places along a curve at equal shares of its length, metres: two meshes of one surface
    /// have curves with different corners and the same places.
    Curve(Vec<[f64; 3]>),
}

/// A named value with what its change asks for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    pub(super) name: Cow<'static, str>,
    pub(super) value: Value,
    pub(super) effect: Class,
    /// Whether it stands in the lock and in the text for `git diff`.
    pub(super) headline: bool,
}

impl Field {
    pub(super) fn new(name: impl Into<Cow<'static, str>>, effect: Class, value: Value) -> Self {
        Self {
            name: name.into(),
            value,
            effect,
            headline: false,
        }
    }

    pub(super) fn number(
        name: &'static str,
        effect: Class,
        value: f64,
        quantity: Quantity,
    ) -> Self {
        Self::new(name, effect, Value::Number(value, quantity))
    }

    pub(super) fn length(name: &'static str, effect: Class, metres: f64) -> Self {
        Self::number(name, effect, metres, Quantity::Length)
    }

    pub(super) fn count(name: &'static str, effect: Class, count: usize) -> Self {
        Self::number(name, effect, count as f64, Quantity::Count)
    }

    pub(super) fn text(name: &'static str, effect: Class, text: impl Into<String>) -> Self {
        Self::new(name, effect, Value::Text(text.into()))
    }

    pub(super) fn id(name: &'static str, effect: Class, id: impl Into<String>) -> Self {
        Self::new(name, effect, Value::Id(id.into()))
    }

    pub(super) fn place(name: &'static str, effect: Class, metres: [f64; 3]) -> Self {
        Self::new(name, effect, Value::Place(metres))
    }

    /// Puts it into the lock and into the text for `git diff`.
    pub(super) fn headline(self) -> Self {
        Self {
            headline: true,
            ..self
        }
    }
}

/// A piece of a part with an id of its own.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Item {
    /// `hole`, `notch`, `part`, `piece`, `crossing`, `family`.
    pub(super) kind: &'static str,
    pub(super) id: String,
    pub(super) fields: Vec<Field>,
    /// What its coming or going asks for.
    pub(super) presence: Class,
}

/// A part.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    pub(super) kind: Kind,
    pub(super) id: String,
    pub(super) fields: Vec<Field>,
    pub(super) items: Vec<Item>,
    /// What its coming or going asks for.
    pub(super) presence: Class,
}

/// Order of ids as people count: `u2` before `u10`.
pub(super) fn by_number(a: &str, b: &str) -> std::cmp::Ordering {
    let (mut a, mut b) = (a.as_bytes(), b.as_bytes());
    loop {
        let digits = |text: &[u8]| text.iter().take_while(|c| c.is_ascii_digit()).count();
        let (x, y) = (digits(a), digits(b));
        if x > 0 && y > 0 {
            let strip = |text: &[u8]| -> Vec<u8> {
                text.iter().copied().skip_while(|c| *c == b'0').collect()
            };
            let (left, right) = (strip(&a[..x]), strip(&b[..y]));
            let order = (left.len(), left).cmp(&(right.len(), right));
            if order.is_ne() {
                return order;
            }
            (a, b) = (&a[x..], &b[y..]);
            continue;
        }
        match (a.split_first(), b.split_first()) {
            (Some((x, rest_a)), Some((y, rest_b))) => {
                if x != y {
                    return x.cmp(y);
                }
                (a, b) = (rest_a, rest_b);
            }
            (left, right) => return left.is_some().cmp(&right.is_some()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_sorted_as_people_count() {
        let mut ids = [
            "west.u10",
            "west.u2",
            "east.v100",
            "west.u02-v9",
            "west.u2-v10",
        ];
        ids.sort_by(|a, b| by_number(a, b));
        assert_eq!(
            ids,
            [
                "east.v100",
                "west.u2",
                "west.u02-v9",
                "west.u2-v10",
                "west.u10"
            ]
        );
    }

    #[test]
    fn every_kind_has_a_word_that_leads_back() {
        for kind in Kind::ALL {
            assert_eq!(Kind::named(kind.word()), Some(kind));
        }
    }
}
