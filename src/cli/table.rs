//! The table of `egg check`: a row a patch, columns as wide as what stands in them.

use crate::splitting::{PatchCheck, PerFamily};
use std::fmt::Write;

/// Rows of a table, the head first.
const HEAD: [&str; 10] = [
    "patch",
    "members",
    "η u",
    "η v",
    "longest",
    "unique to",
    "slopes u",
    "slopes v",
    "angle",
    "feasible angles",
];

/// The criteria of all patches as an aligned table with its limits below.
pub(super) fn checks(checks: &[PatchCheck]) -> String {
    let mut rows: Vec<Vec<String>> = vec![HEAD.map(str::to_owned).to_vec()];
    rows[0].push("verdict".to_owned());
    rows.extend(checks.iter().map(row));
    let columns = rows[0].len();
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in &rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let fill = " ".repeat(width - cell.chars().count());
            if column > 0 {
                line.push_str("  ");
            }
            // Names and lists begin at the left, numbers end at the right.
            if column == 0 || column + 2 >= columns {
                line.push_str(cell);
                line.push_str(&fill);
            } else {
                line.push_str(&fill);
                line.push_str(cell);
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    if let Some(first) = checks.first() {
        let [least, most] = first.slope_bounds;
        let _ = writeln!(
            text,
            "limits: η {}, slopes {least} to {most}",
            first.eta_max
        );
    }
    text
}

fn row(check: &PatchCheck) -> Vec<String> {
    let dash = || "-".to_owned();
    let PerFamily { u, v } = check.members;
    let eta = |pick: fn(&PerFamily<f64>) -> f64| {
        check
            .eta
            .as_ref()
            .map_or_else(dash, |eta| format!("{:.4}", pick(eta)))
    };
    let slopes = |slopes: Option<[f64; 2]>| {
        slopes.map_or_else(dash, |[low, high]| format!("{low:.2}-{high:.2}"))
    };
    let angles: Vec<String> = check
        .angle
        .feasible
        .iter()
        .map(|[low, high]| format!("{low:.1}-{high:.1}°"))
        .collect();
    let verdict = if check.feasible {
        "feasible".to_owned()
    } else {
        format!("not: {}", check.violated.join(", "))
    };
    vec![
        check.patch.clone(),
        format!("{u} x {v}"),
        eta(|eta| eta.u),
        eta(|eta| eta.v),
        check.longest_geodesic.map_or_else(dash, metres),
        match (check.injectivity_bound, check.curvature_max) {
            (Some(bound), _) => metres(bound),
            (None, Some(_)) => "any".to_owned(),
            (None, None) => dash(),
        },
        slopes(check.slopes.u),
        slopes(check.slopes.v),
        check
            .angle
            .planar
            .map_or_else(dash, |angle| format!("{angle:.1}°")),
        if angles.is_empty() {
            dash()
        } else {
            angles.join(" ")
        },
        verdict,
    ]
}

/// Four digits are what a person compares.
fn metres(length: f64) -> String {
    let decimals = if length < 10.0 {
        3
    } else if length < 100.0 {
        2
    } else {
        1
    };
    format!("{length:.decimals$} m")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::splitting::AngleCheck;

    fn unmeasured(name: &str) -> PatchCheck {
        PatchCheck {
            patch: name.into(),
            corners: ["a", "b", "c", "d"].map(Into::into),
            feasible: false,
            violated: vec!["layout".into()],
            members: [7, 11].into(),
            sides: None,
            eta: None,
            eta_max: 1.0015,
            peaks: Vec::new(),
            curvature_max: None,
            injectivity_bound: None,
            longest_geodesic: None,
            diagonals: None,
            slopes: PerFamily { u: None, v: None },
            slope_bounds: [0.5, 2.0],
            angle: AngleCheck {
                surface: None,
                planar: None,
                convex: None,
                feasible: Vec::new(),
            },
        }
    }

    #[test]
    fn columns_are_aligned_whatever_stands_in_them() {
        let mut measured = unmeasured("a-long-name");
        measured.eta = Some([1.0, 1.00412].into());
        measured.curvature_max = Some(-1.0);
        measured.longest_geodesic = Some(25.716);
        measured.slopes.u = Some([0.62, 1.61]);
        measured.angle.planar = Some(32.4);
        measured.angle.feasible = vec![[20.0, 40.25], [110.0, 150.0]];
        measured.violated = vec!["eta v".into()];
        let table = checks(&[measured, unmeasured("b")]);
        let rows: Vec<&str> = table.lines().collect();
        let [head, long, short, limits] = rows[..] else {
            panic!("{table}")
        };
        let column = |row: &str, text: &str| {
            let at = row.find(text).expect("there");
            row[..at].chars().count()
        };
        assert_eq!(
            column(head, "feasible angles"),
            column(long, "20.0-40.2° 110.0"),
            "{table}"
        );
        for (row, verdict) in [(long, "not: eta v"), (short, "not: layout")] {
            assert_eq!(column(head, "verdict"), column(row, verdict), "{table}");
        }
        // Numbers end where their title ends.
        let end = |row: &str, text: &str| column(row, text) + text.chars().count();
        assert_eq!(end(head, "η v"), end(long, "1.0041"));
        assert_eq!(end(head, "longest"), end(long, "25.72 m"));
        assert_eq!(end(head, "unique to"), end(long, "any"));
        assert_eq!(limits, "limits: η 1.0015, slopes 0.5 to 2");
    }
}
