//! What is measured: its unit for people, its decimals, and the step below which two numbers are
//! the same number.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A kind of number. Plans hold SI units and degrees; differences show the units of a workshop.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Of a part or a place, shown in millimetres.
    Length,
    /// Of all parts together, shown in metres.
    LongLength,
    /// Degrees.
    Angle,
    /// Kilograms.
    Mass,
    /// Square metres.
    Area,
    /// Shown in litres.
    Volume,
    /// A part of a whole, shown in per cent.
    Share,
    /// A quotient, as it is.
    Ratio,
    /// Shown in megapascals.
    Stress,
    /// How many.
    Count,
    /// Of a bill, in its unit.
    Amount,
    /// In the currency of the project file.
    Money,
}

impl Quantity {
    /// Unit in which it is shown; empty where there is none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Length => "mm",
            Self::LongLength => "m",
            Self::Angle => "deg",
            Self::Mass => "kg",
            Self::Area => "m2",
            Self::Volume => "l",
            Self::Share => "%",
            Self::Stress => "MPa",
            Self::Ratio | Self::Count | Self::Amount | Self::Money => "",
        }
    }

    /// Shown value of 1 in the unit of the plan.
    fn scale(self) -> f64 {
        match self {
            Self::Length | Self::Volume => 1e3,
            Self::Share => 1e2,
            Self::Stress => 1e-6,
            _ => 1.0,
        }
    }

    /// Decimals in which it is shown.
    pub fn decimals(self) -> usize {
        match self {
            Self::Count => 0,
            Self::Share => 1,
            Self::Length | Self::Stress | Self::Money | Self::Volume => 2,
            Self::LongLength | Self::Angle | Self::Mass | Self::Area | Self::Amount => 3,
            Self::Ratio => 4,
        }
    }

    /// Steps smaller than this are lost when a plan is written: the two numbers are one.
    pub(super) fn resolution(self) -> f64 {
        match self {
            Self::Length | Self::LongLength | Self::Share | Self::Ratio => 2.5e-9,
            Self::Stress => 1.0,
            _ => 2.5e-6,
        }
    }

    /// A value of the plan in the unit that is shown, rounded to a tenth of what is shown: a
    /// difference keeps no digits that nobody reads.
    pub(super) fn shown(self, value: f64) -> f64 {
        let digits = libm::pow(10.0, self.decimals() as f64 + 1.0);
        let rounded = (value * self.scale() * digits).round() / digits;
        if rounded.is_finite() {
            rounded + 0.0
        } else {
            value
        }
    }

    /// The same with three significant digits: of what is hidden because it is small.
    pub(super) fn shown_finely(self, value: f64) -> f64 {
        let value = value * self.scale();
        if value == 0.0 || !value.is_finite() {
            return value;
        }
        let digits = libm::pow(10.0, 2.0 - libm::floor(libm::log10(value.abs())));
        (value * digits).round() / digits
    }

    /// A shown value in the unit of the plan.
    pub(super) fn of_shown(self, value: f64) -> f64 {
        value / self.scale()
    }

    /// The quantity that a written unit belongs to.
    pub(super) fn of_unit(unit: &str) -> Option<Self> {
        Some(match unit {
            "mm" => Self::Length,
            "m" => Self::LongLength,
            "deg" => Self::Angle,
            "kg" => Self::Mass,
            "m2" => Self::Area,
            "l" => Self::Volume,
            "%" => Self::Share,
            "MPa" => Self::Stress,
            "" => Self::Amount,
            _ => return None,
        })
    }
}

/// A shown number as text: decimals of its quantity, trailing zeros and a negative zero dropped.
pub fn number(value: f64, quantity: Quantity) -> String {
    // An eighth of an inch is 3.175 mm, which is a little less in binary, and 3.18 for people.
    let tie = if quantity == Quantity::Length {
        value * 1e-12
    } else {
        0.0
    };
    let mut text = format!("{:.*}", quantity.decimals(), value + tie);
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if text == "-0" {
        text.remove(0);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_in_the_unit_of_a_workshop_without_tails() {
        let shown = |value, quantity: Quantity| number(quantity.shown(value), quantity);
        assert_eq!(shown(1.180_25, Quantity::Length), "1180.25");
        assert_eq!(shown(0.4, Quantity::Length), "400");
        assert_eq!(shown(0.003_175, Quantity::Length), "3.18");
        assert_eq!(shown(-0.003_175, Quantity::Length), "-3.18");
        assert_eq!(shown(-1e-12, Quantity::Length), "0");
        assert_eq!(shown(0.331, Quantity::Share), "33.1");
        assert_eq!(shown(20.0, Quantity::Count), "20");
        assert_eq!(shown(430e6, Quantity::Stress), "430");
    }

    #[test]
    fn a_written_unit_leads_back_to_its_quantity() {
        for quantity in [Quantity::Length, Quantity::Angle, Quantity::Mass] {
            assert_eq!(Quantity::of_unit(quantity.unit()), Some(quantity));
        }
        assert_eq!(Quantity::of_unit("furlong"), None);
    }
}
