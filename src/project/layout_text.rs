//! Points and patches as text of a project file, with all that names them: what `egg split` prints, to
//! be pasted and kept. What is written is read back to the last bit, and what stays as it is keeps the
//! words of the file.

use super::Notation;
use super::decimal::Decimal;
use super::model::{Anchor, Family, Patch, Point, Project};
use super::units::{FOOT, INCH, Unit};
use std::fmt::Write;

/// How lengths are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthText {
    /// Bare, in a unit of `10^-power` metres: 3 for millimetres.
    Decimal {
        /// The power.
        power: usize,
    },
    /// Bare in inches, or with the unit metre where no number of inches is the same to the last bit.
    Inches,
    /// The same in feet.
    Feet,
}

impl LengthText {
    /// For a file with these `project.units`; millimetres where unsaid.
    pub fn of(units: Option<&str>) -> Self {
        match units {
            Some("in") => Self::Inches,
            Some("ft") => Self::Feet,
            Some("m") => Self::Decimal { power: 0 },
            Some("cm") => Self::Decimal { power: 2 },
            _ => Self::Decimal { power: 3 },
        }
    }

    fn write(self, metres: f64) -> String {
        let unit = match self {
            Self::Decimal { power } => return shifted(&format!("{metres}"), power),
            Self::Inches => INCH,
            Self::Feet => FOOT,
        };
        in_unit(metres, unit).unwrap_or_else(|| format!("\"{metres} m\""))
    }
}

/// A length in a unit, if a number of it is read back to the last bit.
fn in_unit(metres: f64, unit: Unit) -> Option<String> {
    let number = metres / unit.size();
    let short = (number * 1e9).round() / 1e9;
    let texts = [short, number].map(|number| number.to_string());
    texts.into_iter().find(|text| {
        let read = Decimal::parse(text).map(|d| d.scaled(unit.factor, unit.power).to_f64());
        read == Some(metres)
    })
}

/// What a project says of the lamellae of one patch, in its words.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnLamella {
    /// Name of the patch.
    pub patch: String,
    /// Width, if it says one.
    pub width: Option<String>,
    /// Thickness, if it says one.
    pub thickness: Option<String>,
    /// Material, if it says one.
    pub material: Option<String>,
}

impl OwnLamella {
    /// Its keys with their values.
    fn fields(&self, is: &str) -> Vec<String> {
        let said = [
            ("width", &self.width),
            ("thickness", &self.thickness),
            ("material", &self.material),
        ];
        said.into_iter()
            .filter_map(|(key, value)| Some(format!("{key}{is}{}", value.as_ref()?)))
            .collect()
    }
}

/// How a layout is written.
#[derive(Clone, Copy)]
pub struct Writing<'a> {
    /// TOML or RON.
    pub notation: Notation,
    /// Lengths that the file does not have.
    pub lengths: LengthText,
    /// The words of the file for the value at a key, where it is still the same.
    pub said: &'a dyn Fn(&[&str]) -> Option<&'a str>,
}

/// The tables `points`, `patches`, `distribution` and those of lamellae of single patches, as text
/// that replaces those of the project's file.
pub fn layout_text(project: &Project, own: &[OwnLamella], writing: Writing<'_>) -> String {
    match writing.notation {
        Notation::Toml => toml(project, own, writing),
        Notation::Ron => ron(project, own, writing),
    }
}

fn toml(project: &Project, own: &[OwnLamella], writing: Writing<'_>) -> String {
    let mut text = String::from("[points]\n");
    for point in &project.points {
        let place = place(point, writing, |edge, at| {
            format!("{{ on = [\"{}\", \"{}\"], at = {at} }}", edge[0], edge[1])
        });
        let place = match &point.anchor {
            Anchor::Vertex(vertex) => format!("{{ vertex = {vertex} }}"),
            _ => place,
        };
        let _ = writeln!(text, "{} = {place}", point.name);
    }
    for patch in &project.patches {
        let [a, b, c, d] = &patch.corners;
        let _ = writeln!(text, "\n[patches.{}]", patch.name);
        let _ = writeln!(text, "corners = [\"{a}\", \"{b}\", \"{c}\", \"{d}\"]");
        let members = members(patch, " = ");
        if !members.is_empty() {
            let _ = writeln!(text, "members = {{ {members} }}");
        }
        if let Some(alpha) = patch.alpha {
            let _ = writeln!(text, "alpha = {}", angle(patch, alpha, writing));
        }
    }
    let (weights, closed) = (weights(project, " = "), closed(project));
    if !weights.is_empty() || !closed.is_empty() {
        let _ = writeln!(text, "\n[distribution]");
    }
    if !weights.is_empty() {
        let _ = writeln!(text, "weights = {{ {weights} }}");
    }
    if !closed.is_empty() {
        let _ = writeln!(text, "closed = [{closed}]");
    }
    for lamella in own {
        let _ = writeln!(text, "\n[lamella.{}]", lamella.patch);
        for field in lamella.fields(" = ") {
            let _ = writeln!(text, "{field}");
        }
    }
    text
}

fn ron(project: &Project, own: &[OwnLamella], writing: Writing<'_>) -> String {
    let mut text = String::from("points: {\n");
    for point in &project.points {
        let place = place(point, writing, |edge, at| {
            format!("(on: (\"{}\", \"{}\"), at: {at})", edge[0], edge[1])
        });
        let place = match &point.anchor {
            Anchor::Vertex(vertex) => format!("(vertex: {vertex})"),
            _ => place,
        };
        let _ = writeln!(text, "    \"{}\": {place},", point.name);
    }
    text.push_str("},\npatches: {\n");
    for patch in &project.patches {
        let [a, b, c, d] = &patch.corners;
        let mut fields = format!("corners: [\"{a}\", \"{b}\", \"{c}\", \"{d}\"]");
        let members = members(patch, ": ");
        if !members.is_empty() {
            let _ = write!(fields, ", members: ({members})");
        }
        if let Some(alpha) = patch.alpha {
            let _ = write!(fields, ", alpha: {}", angle(patch, alpha, writing));
        }
        let _ = writeln!(text, "    \"{}\": ({fields}),", patch.name);
    }
    text.push_str("},\n");
    let mut distribution = Vec::new();
    let (weights, closed) = (weights(project, ": "), closed(project));
    if !weights.is_empty() {
        distribution.push(format!("weights: {{ {weights} }}"));
    }
    if !closed.is_empty() {
        distribution.push(format!("closed: [{closed}]"));
    }
    if !distribution.is_empty() {
        let _ = writeln!(text, "distribution: ({}),", distribution.join(", "));
    }
    if !own.is_empty() {
        text.push_str("// These belong into `lamella`:\n");
    }
    for lamella in own {
        let fields = lamella.fields(": ").join(", ");
        let _ = writeln!(text, "    \"{}\": ({fields}),", lamella.patch);
    }
    text
}

fn place(point: &Point, writing: Writing<'_>, on: impl Fn(&[String; 2], f64) -> String) -> String {
    let list = |lengths_of: &[f64]| {
        if let Some(said) = (writing.said)(&["points", &point.name]) {
            return said.to_owned();
        }
        let lengths = lengths_of.iter().map(|&x| writing.lengths.write(x));
        format!("[{}]", lengths.collect::<Vec<String>>().join(", "))
    };
    match &point.anchor {
        Anchor::Above(at) => list(at),
        Anchor::Near(at) => list(at),
        Anchor::Vertex(_) => String::new(),
        Anchor::On { edge, at } => on(edge, *at),
    }
}

fn members(patch: &Patch, is: &str) -> String {
    let counts = [("u", patch.u), ("v", patch.v)];
    let said = counts
        .iter()
        .filter_map(|(family, count)| Some(format!("{family}{is}{}", (*count)?)));
    said.collect::<Vec<String>>().join(", ")
}

fn weights(project: &Project, is: &str) -> String {
    let weights = project.distribution.weights.iter();
    let said = weights.map(|([a, b], weight)| format!("\"{a}-{b}\"{is}{weight}"));
    said.collect::<Vec<String>>().join(", ")
}

fn closed(project: &Project) -> String {
    let letter = |family: Family| match family {
        Family::U => 'u',
        Family::V => 'v',
    };
    let closed = project.distribution.closed.iter();
    let said = closed.map(|(patch, family)| format!("\"{patch}.{}\"", letter(*family)));
    said.collect::<Vec<String>>().join(", ")
}

/// The planar angle of a patch, in degrees where the file does not say it: without the digits that
/// the way through radians left.
fn angle(patch: &Patch, radians: f64, writing: Writing<'_>) -> String {
    match (writing.said)(&["patches", &patch.name, "alpha"]) {
        Some(said) => said.to_owned(),
        None => ((radians.to_degrees() * 1e9).round() / 1e9).to_string(),
    }
}

/// A decimal number times a power of ten, exactly.
fn shifted(decimal: &str, power: usize) -> String {
    let (sign, digits) = decimal
        .strip_prefix('-')
        .map_or(("", decimal), |rest| ("-", rest));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let padded = format!("{fraction:0<power$}");
    let (moved, rest) = padded.split_at(power);
    let whole = format!("{whole}{moved}");
    let whole = whole.trim_start_matches('0');
    let whole = if whole.is_empty() { "0" } else { whole };
    let rest = rest.trim_end_matches('0');
    let point = if rest.is_empty() { "" } else { "." };
    format!("{sign}{whole}{point}{rest}")
}

#[cfg(test)]
mod tests {
    use super::super::load;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_decimal_point_moves_without_rounding() {
        for (decimal, power, moved) in [
            ("0.1234567", 3, "123.4567"),
            ("-0.05", 3, "-50"),
            ("12", 3, "12000"),
            ("-0.00012", 2, "-0.012"),
            ("0", 3, "0"),
            ("1.5", 0, "1.5"),
        ] {
            assert_eq!(shifted(decimal, power), moved);
        }
    }

    #[test]
    fn whole_inches_and_feet_are_written_as_such() {
        for (units, metres, text) in [
            ("in", 0.1524, "6"),
            ("in", 0.0254 * 0.125, "0.125"),
            ("ft", 0.9144, "3"),
            ("in", 0.0, "0"),
        ] {
            assert_eq!(LengthText::of(Some(units)).write(metres), text);
        }
    }

    fn file(units: &str, layout: &str) -> String {
        format!(
            "project = {{ format = 1, units = \"{units}\" }}\nsurface = {{ mesh = \"m.obj\" }}\n\
             [lamella]\nwidth = \"30 mm\"\nthickness = \"3 mm\"\nmaterial = \"oak\"\n{layout}"
        )
    }

    fn ron_file(units: &str, layout: &str, own: &str) -> String {
        format!(
            "(project: (format: 1, units: {units}), surface: (mesh: \"m.obj\"), \
             lamella: {{ \"width\": \"30 mm\", \"thickness\": \"3 mm\", \"material\": \"limewood\", {own} }}, \
             {layout})"
        )
    }

    proptest! {
        #[test]
        fn what_is_written_is_read_back_to_the_last_bit(
            x in -100.0..100.0_f64,
            y in -1.0..1.0_f64,
            z in -0.01..0.01_f64,
            at in 0.01..0.99_f64,
            units in prop::sample::select(vec!["mm", "cm", "m", "in", "ft"]),
            ron in any::<bool>(),
        ) {
            let given = "[points]\na = [0, 0]\nb = [9, 0]\nc = [9, 9]\nd = { vertex = 7 }\n\
                t = { on = [\"a\", \"b\"], at = 0.5 }\n\
                [patches.p]\ncorners = [\"a\", \"b\", \"c\", \"d\"]\nmembers = { u = 3, v = 4 }\n\
                alpha = 62.3\n[distribution]\nweights = { \"a-b\" = 2.5 }\n";
            let loaded = load(&file("mm", given), Notation::Toml, "x");
            let mut project = loaded.project.expect("a right file");
            project.points[1].anchor = Anchor::Above([x, y]);
            project.points[2].anchor = Anchor::Near([x, y, z]);
            if let Anchor::On { at: share, .. } = &mut project.points[4].anchor {
                *share = at;
            }
            let notation = if ron { Notation::Ron } else { Notation::Toml };
            let own = [OwnLamella {
                patch: "p".to_owned(),
                width: Some("\"21.5 mm\"".to_owned()),
                thickness: None,
                material: Some("\"limewood\"".to_owned()),
            }];
            let writing = Writing {
                notation,
                lengths: LengthText::of(Some(units)),
                said: &|key| (key == ["points", "a"]).then_some("[\"0 mm\", 0]"),
            };
            let text = layout_text(&project, &own, writing);
            prop_assert!(text.contains("[\"0 mm\", 0]"), "{}", text);
            let text = if ron {
                // Fields of a single patch go where those of all are.
                let (text, own) = text.split_once("// These").expect("lamellae");
                let own = own.split_once('\n').expect("a line").1;
                ron_file(units, text, own)
            } else {
                file(units, &text)
            };
            let again = load(&text, notation, "x");
            prop_assert!(again.project.is_some(), "{:?}\n{text}", again.diagnostics);
            let again = again.project.unwrap();
            prop_assert_eq!(&again.points, &project.points);
            prop_assert_eq!(&again.distribution, &project.distribution);
            prop_assert_eq!(&again.patches[0].corners, &project.patches[0].corners);
            let alpha = again.patches[0].alpha.unwrap() - project.patches[0].alpha.unwrap();
            prop_assert!(alpha.abs() < 1e-11);
            let lamella = &again.patches[0].lamella;
            prop_assert_eq!((lamella.width, &*lamella.material), (0.0215, "limewood"));
        }
    }
}
