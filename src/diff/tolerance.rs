//! Below which change two plans are the same to the people who build from them.

use super::quantity::Quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Tolerances per quantity. A change that is not above them is noise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Tolerances {
    /// Lengths and places, millimetres. A laser repeats to a tenth; plywood moves more in a day.
    pub length: f64,
    /// Degrees.
    pub angle: f64,
    /// Shares and ratios, per cent of the whole.
    pub share: f64,
    /// Masses, areas, volumes, stresses and measured amounts of a bill, per cent of the value
    /// before.
    pub relative: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            length: 0.05,
            angle: 0.01,
            share: 0.05,
            relative: 0.1,
        }
    }
}

impl Tolerances {
    /// The largest change of a value that is noise, in the unit of the plan. Always measured
    /// from the value before, so that many small steps cannot hide a large one.
    pub(super) fn limit(&self, quantity: Quantity, before: f64) -> f64 {
        let limit = match quantity {
            Quantity::Length | Quantity::LongLength => self.length * 1e-3,
            Quantity::Angle => self.angle,
            Quantity::Share | Quantity::Ratio => self.share * 1e-2,
            Quantity::Mass
            | Quantity::Area
            | Quantity::Volume
            | Quantity::Stress
            | Quantity::Amount => self.relative * 1e-2 * before.abs(),
            Quantity::Count | Quantity::Money => 0.0,
        };
        limit.max(quantity.resolution())
    }

    /// Changes one of them as a user types it: `0.05mm` (lengths), `angle=0.1deg`,
    /// `share=1%`, `relative=0.5%`.
    ///
    /// # Errors
    /// What is wrong with the text.
    pub fn set(&mut self, text: &str) -> Result<(), String> {
        let (name, value) = text.split_once('=').unwrap_or(("length", text));
        let value = value.trim();
        let digits = value
            .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+')))
            .unwrap_or(value.len());
        let (digits, unit) = value.split_at(digits);
        let number: f64 = digits
            .parse()
            .map_err(|_| format!("`{text}` is no tolerance: write `0.05mm` or `angle=0.1deg`"))?;
        if !(number >= 0.0 && number.is_finite()) {
            return Err(format!("a tolerance is not negative, `{text}` is"));
        }
        let unit = unit.trim();
        let wrong = |units: &str| format!("`{unit}` is no unit of {name}: use {units}");
        match name.trim() {
            "length" => {
                let scale = match unit {
                    "" | "mm" => 1.0,
                    "um" | "µm" => 1e-3,
                    "cm" => 10.0,
                    "m" => 1e3,
                    "in" => 25.4,
                    _ => return Err(wrong("um, mm, cm, m or in")),
                };
                self.length = number * scale;
            }
            "angle" => match unit {
                "" | "deg" | "°" => self.angle = number,
                "rad" => self.angle = number.to_degrees(),
                _ => return Err(wrong("deg or rad")),
            },
            "share" if matches!(unit, "" | "%") => self.share = number,
            "relative" if matches!(unit, "" | "%") => self.relative = number,
            "share" | "relative" => return Err(wrong("%")),
            other => {
                return Err(format!(
                    "there is no tolerance of `{other}`: there are length, angle, share and relative"
                ));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_are_typed_with_their_units() {
        let mut tolerances = Tolerances::default();
        for text in ["0.1mm", "angle=0.5 deg", "share=2%", "relative=3%"] {
            tolerances.set(text).unwrap();
        }
        let expected = Tolerances {
            length: 0.1,
            angle: 0.5,
            share: 2.0,
            relative: 3.0,
        };
        assert_eq!(tolerances, expected);
        tolerances.set("length=1cm").unwrap();
        assert_eq!(tolerances.length, 10.0);
    }

    #[test]
    fn what_is_no_tolerance_is_refused_with_a_reason() {
        let refused = |text: &str| Tolerances::default().set(text).unwrap_err();
        assert!(refused("loose").contains("no tolerance"));
        assert!(refused("1kg").contains("no unit of length"));
        assert!(refused("-1mm").contains("not negative"));
        assert!(refused("mood=1").contains("no tolerance of `mood`"));
    }
}
