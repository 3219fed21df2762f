//! Hardware by its trade names: bolts (`M4`) and tubes (`brass 5x0.5`).

use super::reader::{FromNode, Reader, shortened};
use super::words::inline_schema;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::decimal::Decimal;
use crate::project::model::{Bolt, Shell};
use crate::project::notation::{Node, Value};
use crate::project::suggest;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;

/// Nominal diameters of ISO 261's first choice that are sold as machine screws, in tenths of a
/// millimetre.
const BOLTS: [(&str, u32); 15] = [
    ("M1.6", 16),
    ("M2", 20),
    ("M2.5", 25),
    ("M3", 30),
    ("M4", 40),
    ("M5", 50),
    ("M6", 60),
    ("M8", 80),
    ("M10", 100),
    ("M12", 120),
    ("M14", 140),
    ("M16", 160),
    ("M20", 200),
    ("M24", 240),
    ("M30", 300),
];

/// The bolt for a lamella of this width where the project names none: M3 for model sizes (8 to
/// 15 mm), M4 up to 30 mm, then a diameter of about a tenth of the width.
pub(crate) fn usual_bolt(width: f64) -> Bolt {
    let name = match width {
        w if w < 0.008 => "M2",
        w if w < 0.015 => "M3",
        w if w <= 0.030 => "M4",
        w if w <= 0.050 => "M5",
        w if w <= 0.070 => "M6",
        w if w <= 0.100 => "M8",
        w if w <= 0.150 => "M10",
        w if w <= 0.300 => "M12",
        _ => "M16",
    };
    bolt(name).expect("the names above are in the table")
}

fn bolt(name: &str) -> Option<Bolt> {
    let (name, tenths) = BOLTS.iter().find(|(known, _)| *known == name)?;
    Some(Bolt {
        name: (*name).to_owned(),
        diameter: f64::from(*tenths) / 10_000.0,
    })
}

/// A metric bolt by its size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BoltName(pub(crate) Bolt);

inline_schema!(BoltName, _ => json_schema!({
    "type": "string",
    "enum": BOLTS.map(|(name, _)| name),
}));

impl FromNode for BoltName {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let Value::Text(written) = &node.value else {
            return reader.wrong_type(node, at, "a metric bolt such as \"M4\"");
        };
        let found = bolt(written);
        if found.is_none() {
            reader.sink.error(|| {
                let message = format!("there is no bolt `{}`", shortened(written));
                let diagnostic = Diagnostic::error(Code::new("E0122"), message)
                    .at_key(at.as_str(), "expected a metric bolt such as \"M4\"");
                let head = written.split(['x', 'X', ' ']).next().unwrap_or_default();
                if head.len() < written.len() && bolt(head).is_some() {
                    diagnostic.help(format!(
                        "write `{head}`; the length follows from what is clamped"
                    ))
                } else {
                    let names = BOLTS.map(|(name, _)| name);
                    match suggest::help(written, "bolt", names) {
                        Some(help) => diagnostic.help(help),
                        None => {
                            diagnostic.help(format!("the sizes are {}", suggest::all_of(&names)))
                        }
                    }
                }
            });
        }
        found.map(Self)
    }
}

/// A tube by its material, outer diameter and wall in millimetres.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TubeName(pub(crate) Shell);

inline_schema!(TubeName, _ => json_schema!({
    "type": "string",
    "maxLength": 60,
    "pattern": "^.*\\S\\s+[0-9]+(\\.[0-9]+)?\\s*[x×]\\s*[0-9]+(\\.[0-9]+)?$",
}));

impl FromNode for TubeName {
    fn read(node: &Node, at: &KeyPath, reader: &mut Reader) -> Option<Self> {
        let expected = "a tube such as \"brass 5x0.5\"";
        let Value::Text(written) = &node.value else {
            return reader.wrong_type(node, at, expected);
        };
        let fault = match tube(written) {
            Some(shell) if shell.diameter > 0.2 => "is more than 200 mm in diameter",
            Some(shell) if shell.wall <= 0.0 || shell.diameter <= 2.0 * shell.wall => "has no bore",
            Some(shell) => return Some(Self(shell)),
            None => "is not a material, an outer diameter and a wall in millimetres",
        };
        reader.sink.error(|| {
            let message = format!("the tube `{}` {fault}", shortened(written));
            Diagnostic::error(Code::new("E0123"), message)
                .at_key(at.as_str(), format!("expected {expected}"))
                .help("the numbers are the outer diameter and the thickness of the wall, as sold")
        });
        None
    }
}

fn tube(written: &str) -> Option<Shell> {
    if written.len() > 60 || written.chars().any(char::is_control) {
        return None;
    }
    let (left, wall) = written.rsplit_once(['x', '×'])?;
    let (material, diameter) = left.trim_end().rsplit_once(char::is_whitespace)?;
    if material.trim().is_empty() {
        return None;
    }
    let millimetres = |text: &str| {
        let plain = |byte: u8| byte.is_ascii_digit() || byte == b'.';
        let number = text.bytes().all(plain).then(|| Decimal::parse(text))??;
        Some(number.scaled(1, -3).to_f64())
    };
    Some(Shell {
        name: written.to_owned(),
        diameter: millimetres(diameter)?,
        wall: millimetres(wall.trim_start())?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tubes_are_read_as_sold() {
        for written in ["brass 5x0.5", "brass 5 x 0.5", "brass 5×0.5"] {
            let shell = tube(written).expect("a tube");
            assert_eq!((shell.diameter, shell.wall), (0.005, 0.0005), "{written}");
            assert_eq!(shell.name, written);
        }
        for written in [
            "5x0.5",
            "brass 5",
            "brass",
            "brass x0.5",
            " 5x0.5",
            "brass -5x0.5",
        ] {
            assert_eq!(tube(written), None, "{written}");
        }
    }

    #[test]
    fn the_usual_bolt_leaves_most_of_the_lamella() {
        for width in [0.008, 0.010, 0.015, 0.03, 0.04, 0.07, 0.1, 0.15, 0.25, 0.4] {
            let bolt = usual_bolt(width);
            assert!(bolt.diameter <= 0.4 * width, "{width} {}", bolt.name);
        }
    }
}
