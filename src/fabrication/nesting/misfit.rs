//! Why parts do not fit.

use super::{Blank, Format, Settings};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;

/// So many of the parts that do not fit are named.
const NAMED: usize = 6;

/// Why a group does not fit on a format, if so.
pub(super) fn misfit(
    blanks: &[&Blank],
    settings: &Settings,
    format: &Format,
) -> Option<Diagnostic> {
    let [length, width] = settings.usable(format);
    if length <= 0.0 || width <= 0.0 {
        return Some(
            Diagnostic::error(
                codes::NO_USABLE_STOCK,
                format!(
                    "margins of {:.1} mm leave nothing of a sheet of {:.0} x {:.0} mm",
                    settings.margin * 1e3,
                    format.length * 1e3,
                    format.width * 1e3
                ),
            )
            .at_key("fabrication.margin", "too wide for the stock"),
        );
    }
    let over = |extent: fn(&Blank) -> f64, limit: f64| {
        let mut over: Vec<&&Blank> = blanks.iter().filter(|b| extent(b) > limit).collect();
        over.sort_by(|a, b| extent(b).total_cmp(&extent(a)).then(a.id.cmp(&b.id)));
        over
    };
    let too_wide = over(|blank| blank.width, width);
    if let Some(widest) = too_wide.first() {
        return Some(
            Diagnostic::error(
                codes::PART_TOO_WIDE,
                format!(
                    "lamella `{}` is {:.1} mm wide, a sheet takes {:.1} mm",
                    widest.id,
                    widest.width * 1e3,
                    width * 1e3
                ),
            )
            .at_key(
                "fabrication.stock",
                "the width of a sheet, or of the bed where that is less, without margins",
            )
            .about(&widest.id),
        );
    }
    let too_long = over(|blank| blank.length, length);
    let (longest, others) = too_long.split_first()?;
    let mut diagnostic = Diagnostic::error(
        codes::PART_TOO_LONG,
        format!(
            "lamella `{}` is too long: {:.1} mm, where a sheet takes {:.1} mm",
            longest.id,
            longest.length * 1e3,
            length * 1e3
        ),
    )
    .at_key(
        "fabrication.stock",
        "the length of a sheet, or of the bed where that is less, without margins",
    )
    .help("choose longer stock, or set `splice` in `[fabrication]`")
    .about(&longest.id);
    if !others.is_empty() {
        let named = others.iter().take(NAMED);
        let names: Vec<String> = named.map(|b| format!("`{}`", b.id)).collect();
        let more = match others.len().saturating_sub(NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        diagnostic = diagnostic.note(format!("too long as well: {}{more}", names.join(", ")));
    }
    Some(diagnostic)
}

pub(super) fn spacing_below_kerf(settings: &Settings) -> Diagnostic {
    Diagnostic::error(
        codes::SPACING_BELOW_KERF,
        format!(
            "parts are {:.2} mm apart and the cut is {:.2} mm wide",
            settings.spacing * 1e3,
            settings.kerf * 1e3
        ),
    )
    .at_key("fabrication.spacing", "must be larger than the kerf")
}
