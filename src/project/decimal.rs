//! Exact decimals: the number that the file says, before it becomes an `f64`.
//!
//! `8 mm`, `8.0mm` and `0.008 m` must be the same value, bit by bit, or rewriting a file in
//! other units would rebuild it. Scaling an `f64` cannot promise that (`8.0 * 1e-3` and `0.008`
//! may differ in the last bit), so a number stays a string of decimal digits with a power of
//! ten, is multiplied exactly by its unit (every length, stress and density unit is a finite
//! decimal of the SI unit: an inch is 254e-4 m), and is rounded once, by the correctly rounding
//! parser of the standard library.

/// A finite decimal number: `0.d1 d2 d3...` digits with a power of ten, of any length.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Decimal {
    negative: bool,
    /// Decimal digits, most significant first, 0 to 9.
    digits: Vec<u8>,
    /// Power of ten of the last digit.
    power: i64,
}

/// Powers beyond this are zero or infinite in `f64` whatever the digits; cutting here keeps
/// sums of powers far from overflow.
const POWER_LIMIT: i64 = 1_000_000_000;

impl Decimal {
    /// Reads `-12.5e-3`: sign, digits with at most one point, exponent. `None` for anything
    /// else; underscores are the notation's business and already gone.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let (negative, unsigned) = match text.as_bytes().first()? {
            b'-' => (true, &text[1..]),
            b'+' => (false, &text[1..]),
            _ => (false, text),
        };
        let (mantissa, power) = match unsigned.find(['e', 'E']) {
            Some(at) => (&unsigned[..at], parse_power(&unsigned[at + 1..])?),
            None => (unsigned, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let all_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
        if whole.len() + fraction.len() == 0 || !all_digits(whole) || !all_digits(fraction) {
            return None;
        }
        let digits = whole.bytes().chain(fraction.bytes());
        Some(Self {
            negative,
            digits: digits.map(|byte| byte - b'0').collect(),
            power: power - i64::try_from(fraction.len()).ok()?,
        })
    }

    /// The number times `factor * 10^power`, exactly.
    #[must_use]
    pub(crate) fn scaled(mut self, factor: u32, power: i64) -> Self {
        if factor != 1 {
            let mut carry = 0_u64;
            for digit in self.digits.iter_mut().rev() {
                carry += u64::from(*digit) * u64::from(factor);
                *digit = (carry % 10) as u8;
                carry /= 10;
            }
            let mut leading = Vec::new();
            while carry > 0 {
                leading.push((carry % 10) as u8);
                carry /= 10;
            }
            leading.reverse();
            self.digits.splice(0..0, leading);
        }
        self.power += power;
        self
    }

    /// The closest `f64`; infinite beyond its range. Negative zero becomes zero, so that equal
    /// values have equal bits.
    pub(crate) fn to_f64(&self) -> f64 {
        let mut text = String::with_capacity(self.digits.len() + 16);
        text.extend(self.digits.iter().map(|digit| char::from(b'0' + digit)));
        text.push('e');
        text.push_str(&self.power.to_string());
        let size: f64 = text
            .parse()
            .expect("digits, an `e` and an integer are a float literal");
        if self.negative && size != 0.0 {
            -size
        } else {
            size
        }
    }
}

fn parse_power(text: &str) -> Option<i64> {
    let (sign, digits) = match text.as_bytes().first()? {
        b'-' => (-1, &text[1..]),
        b'+' => (1, &text[1..]),
        _ => (1, text),
    };
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let size = digits.bytes().fold(0, |sum, byte| {
        (sum * 10 + i64::from(byte - b'0')).min(POWER_LIMIT)
    });
    Some(sign * size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn metres(text: &str, factor: u32, power: i64) -> f64 {
        Decimal::parse(text)
            .expect("a decimal")
            .scaled(factor, power)
            .to_f64()
    }

    #[test]
    fn one_length_has_one_value_in_every_unit() {
        let millimetres = metres("8", 1, -3);
        assert_eq!(millimetres.to_bits(), metres("8.0", 1, -3).to_bits());
        assert_eq!(millimetres.to_bits(), metres("0.008", 1, 0).to_bits());
        assert_eq!(millimetres.to_bits(), metres("0.8", 1, -2).to_bits());
        assert_eq!(metres("1", 3048, -4), 0.3048);
        assert_eq!(
            metres("12", 254, -4).to_bits(),
            metres("1", 3048, -4).to_bits()
        );
        assert_eq!(metres("-0", 1, 0).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn sizes_beyond_a_float_are_infinite_or_zero_and_never_slow() {
        assert_eq!(metres("1e999999999999999999999", 1, 9), f64::INFINITY);
        assert_eq!(metres("1e-999999999999999999999", 1, 9), 0.0);
    }

    #[test]
    fn what_is_no_decimal_is_refused() {
        for text in [
            "", "-", ".", "1e", "1e+", "e5", "1.2.3", "0x10", "inf", "1_000", " 1", "１",
        ] {
            assert_eq!(Decimal::parse(text), None, "{text:?}");
        }
    }

    proptest! {
        #[test]
        fn an_unscaled_decimal_is_the_nearest_float(value in any::<f64>().prop_filter("finite", |v| v.is_finite())) {
            for text in [format!("{value:?}"), format!("{value}"), format!("{value:e}")] {
                let read = Decimal::parse(&text).expect("a decimal").to_f64();
                prop_assert!(read == value, "{} {}", read, value);
            }
        }

        #[test]
        fn the_same_length_in_other_units_has_the_same_bits(digits in 1_u64..10_000_000, shift in -6_i64..6) {
            let feet = metres(&format!("{digits}e{shift}"), 3048, -4);
            let inches = metres(&format!("{}e{shift}", digits * 12), 254, -4);
            let micrometres = metres(&format!("{}e{shift}", digits * 304_800), 1, -6);
            prop_assert_eq!(feet.to_bits(), inches.to_bits());
            prop_assert_eq!(feet.to_bits(), micrometres.to_bits());
        }
    }
}
