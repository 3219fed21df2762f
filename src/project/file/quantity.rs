//! Numbers and quantities: a dimension, an interval, and one reader and one schema for all.

use super::intervals::Edge::{Closed, Open};
use super::intervals::Interval;
use super::reader::{FromNode, Reader, shortened};
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::decimal::Decimal;
use crate::project::notation::{Node, Number, Value};
use crate::project::suggest;
use crate::project::units::{self, Dimension, Unit};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;
use std::marker::PhantomData;

/// A number with its dimension `D`, within the interval `I`; in SI units.
#[derive(Debug, PartialEq)]
pub(crate) struct Quantity<D, I> {
    /// The value in the SI unit; angles in radians.
    pub(crate) si: f64,
    kind: PhantomData<(D, I)>,
}

impl<D, I> Clone for Quantity<D, I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D, I> Copy for Quantity<D, I> {}

impl<D, I> Quantity<D, I> {
    pub(crate) const fn new(si: f64) -> Self {
        Self {
            si,
            kind: PhantomData,
        }
    }
}

/// What is measured.
pub(crate) trait Measure {
    const DIMENSION: Dimension;
    /// The unit of bare numbers; `None` takes the project's unit of length.
    const BARE: Option<Unit>;
}

macro_rules! measure {
    ($($name:ident = $dimension:expr, $bare:expr;)*) => {$(
        #[doc = concat!("Marks `", stringify!($dimension), "`.")]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub(crate) enum $name {}

        impl Measure for $name {
            const DIMENSION: Dimension = $dimension;
            const BARE: Option<Unit> = $bare;
        }
    )*};
}

const ONE: Unit = Unit {
    symbol: "",
    aliases: &[],
    factor: 1,
    power: 0,
};

measure! {
    OfLength = units::LENGTH, None;
    OfAngle = units::ANGLE, Some(units::DEGREE);
    OfStress = units::STRESS, Some(units::STRESS.units[0]);
    OfDensity = units::DENSITY, Some(units::DENSITY.units[0]);
    OfAcceleration = units::ACCELERATION, Some(units::ACCELERATION.units[0]);
    OfPlain = units::PLAIN, Some(ONE);
}

/// A length.
pub(crate) type Length<I> = Quantity<OfLength, I>;
/// A plain number.
pub(crate) type Plain<I> = Quantity<OfPlain, I>;

impl<D: Measure, I: Interval> FromNode for Quantity<D, I> {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let (decimal, unit) = match &node.value {
            Value::Number(number) => {
                let bare = D::BARE.unwrap_or(reader.length_unit);
                (finite(number, at, reader)?, bare)
            }
            Value::Text(text) if !D::DIMENSION.units.is_empty() => {
                with_unit(text, D::DIMENSION, at, reader)?
            }
            _ if D::DIMENSION.units.is_empty() => {
                return reader.wrong_type(node, at, D::DIMENSION.name);
            }
            _ => {
                let name = D::DIMENSION.name;
                let expected = format!("{name} (a number, or a string with a unit)");
                return reader.wrong_type(node, at, &expected);
            }
        };
        let written = decimal.scaled(unit.factor, unit.power).to_f64();
        let (compared, si) = if unit == units::DEGREE {
            (written, written.to_radians())
        } else if unit == units::RADIAN {
            (written.to_degrees(), written)
        } else {
            (written, written)
        };
        let above = match I::LOW {
            Closed(low) => compared >= low,
            Open(low) => compared > low,
        };
        let below = match I::HIGH {
            Closed(high) => compared <= high,
            Open(high) => compared < high,
        };
        if above && below {
            return Some(Self::new(si));
        }
        let shown = if D::DIMENSION == units::ANGLE {
            units::DEGREE
        } else {
            D::BARE.unwrap_or(reader.length_unit)
        };
        reader.sink.error(|| {
            let size = if shown == units::DEGREE {
                1.0
            } else {
                shown.size()
            };
            let range = range_text::<I>(size, shown.symbol);
            out_of_range(at, &as_written(&node.value), &range, I::ADVICE)
        });
        None
    }
}

/// `found` is the value as written, `range` what it should be: `at least 2`.
pub(crate) fn out_of_range(
    at: &KeyPath,
    found: &str,
    range: &str,
    advice: Option<&str>,
) -> Diagnostic {
    let found = shortened(found);
    let message = format!("`{at}` is {found}, but must be {range}");
    let diagnostic =
        Diagnostic::error(Code::new("E0117"), message).at_key(at.as_str(), "out of range");
    match advice {
        Some(advice) => diagnostic.help(advice),
        None => diagnostic,
    }
}

/// A number or string as it stands in the file.
fn as_written(value: &Value) -> String {
    match value {
        Value::Number(number) => number.text.clone(),
        Value::Text(text) => format!("\"{text}\""),
        other => other.kind().to_owned(),
    }
}

fn range_text<I: Interval>(size: f64, symbol: &str) -> String {
    let show = |value: f64| {
        let number = readable(value / size);
        if symbol.is_empty() || value == 0.0 {
            number
        } else {
            format!("{number} {symbol}")
        }
    };
    let low = match I::LOW {
        Closed(low) => format!("at least {}", show(low)),
        Open(low) => format!("more than {}", show(low)),
    };
    let high = match I::HIGH {
        Closed(high) => format!("at most {}", show(high)),
        Open(high) => format!("less than {}", show(high)),
    };
    format!("{low} and {high}")
}

/// A number for a message: at most six digits after the point, no trailing zeros.
pub(crate) fn readable(value: f64) -> String {
    if value != 0.0 && (value.abs() >= 1e9 || value.abs() < 1e-5) {
        return format!("{value:e}");
    }
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.to_owned()
}

/// The decimal of a number that is one.
pub(crate) fn finite(number: &Number, at: &KeyPath, reader: &mut Reader) -> Option<Decimal> {
    let decimal = Decimal::parse(&number.text);
    if decimal.is_none() {
        reader.sink.error(|| {
            Diagnostic::error(
                Code::new("E0118"),
                format!(
                    "`{at}` is `{}`, which measures nothing",
                    shortened(&number.text)
                ),
            )
            .at_key(at.as_str(), "expected a finite number")
        });
    }
    decimal
}

/// `"7.6 GPa"`: the number and its unit.
fn with_unit(
    text: &str,
    dimension: Dimension,
    at: &KeyPath,
    reader: &mut Reader,
) -> Option<(Decimal, Unit)> {
    let text = text.trim();
    let (number, written) = text.split_at(number_length(text));
    let written = written.trim_start();
    let Some(decimal) = Decimal::parse(number) else {
        reader.sink.error(|| not_a_quantity(text, dimension, at));
        return None;
    };
    if let Some(unit) = dimension.unit(written) {
        return Some((decimal, unit));
    }
    reader.sink.error(|| {
        if written.is_empty() || written.starts_with(',') {
            return not_a_quantity(text, dimension, at);
        }
        let written = shortened(written);
        let symbols: Vec<_> = dimension.symbols().collect();
        let fitting = match symbols.as_slice() {
            [one] => format!("the unit that fits is `{one}`"),
            _ => format!("units that fit are {}", suggest::all_of(&symbols)),
        };
        match units::dimension_of(&written) {
            Some(other) => Diagnostic::error(
                Code::new("E0116"),
                format!(
                    "`{at}` is {}, but `{written}` measures {}",
                    dimension.name, other.name
                ),
            )
            .at_key(at.as_str(), format!("expected {}", dimension.name)),
            None => Diagnostic::error(Code::new("E0116"), format!("there is no unit `{written}`"))
                .at_key(at.as_str(), "unknown unit"),
        }
        .help(fitting)
    });
    None
}

fn not_a_quantity(text: &str, dimension: Dimension, at: &KeyPath) -> Diagnostic {
    let symbol = dimension.symbols().next().unwrap_or_default();
    let name = dimension.name;
    let diagnostic = Diagnostic::error(
        Code::new("E0115"),
        format!(
            "`{at}` is \"{}\", which is not {name} with a unit",
            shortened(text)
        ),
    )
    .at_key(
        at.as_str(),
        format!("expected {name} such as \"3 {symbol}\""),
    );
    if text.contains(',') {
        diagnostic.help("decimals are written with a point: \"0.5\", not \"0,5\"")
    } else if Decimal::parse(text).is_some() {
        diagnostic.help(format!(
            "write a bare number, or a unit behind it: \"{} {symbol}\"",
            shortened(text)
        ))
    } else {
        diagnostic
    }
}

/// Length of the decimal at the start of a text. An exponent counts only with its digits.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count()
    };
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    end += digits(end);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let start = end + 1 + sign(end + 1);
        let count = digits(start.min(bytes.len()));
        if count > 0 {
            end = start + count;
        }
    }
    end
}

impl<D: Measure, I: Interval> JsonSchema for Quantity<D, I> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let mut number = json_schema!({ "type": "number" });
        // Bare lengths are in `project.units`: the schema has the loosest bound, that of the unit
        // in which the number is largest (or smallest); beyond it no unit is right.
        let loosest = |word: &str, bound: f64| match D::BARE {
            Some(unit) if unit == units::DEGREE => bound,
            Some(unit) => bound / unit.size(),
            None if word.ends_with("aximum") == (bound > 0.0) => bound / units::MILLIMETRE.size(),
            None => bound / units::METRE.size(),
        };
        let low = match I::LOW {
            Closed(_) => "minimum",
            Open(_) => "exclusiveMinimum",
        };
        let high = match I::HIGH {
            Closed(_) => "maximum",
            Open(_) => "exclusiveMaximum",
        };
        for (word, edge) in [(low, I::LOW), (high, I::HIGH)] {
            number.insert(word.to_owned(), loosest(word, edge.value()).into());
        }
        if D::DIMENSION.units.is_empty() {
            return number;
        }
        let sign = if I::LOW.value() >= 0.0 {
            "\\+?"
        } else {
            "[+-]?"
        };
        let names: Vec<String> = D::DIMENSION
            .units
            .iter()
            .flat_map(|unit| unit.aliases.iter().chain([&unit.symbol]))
            .map(|name| name.replace('^', "\\^"))
            .collect();
        let pattern = format!(
            "^\\s*{sign}([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+-]?[0-9]+)?\\s*({})\\s*$",
            names.join("|")
        );
        json_schema!({ "anyOf": [number, { "type": "string", "pattern": pattern }] })
    }
}
