//! Why parts do not fit.

use super::{Blank, Format, Settings, formats, lays};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::fabrication::names::listed;

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
                limit(widest, settings).key(),
                format!("leaves {:.1} mm of width, without margins", width * 1e3),
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
        limit(longest, settings).key(),
        format!("leaves {:.1} mm of length, without margins", length * 1e3),
    )
    .help(match limit(longest, settings) {
        Limit::Stock => "choose longer stock, or set `splice` in `[fabrication]`",
        Limit::Bed => {
            "set `pass_through = true` in `bed` if the machine takes panels that are pushed on, or \
             `splice` in `[fabrication]`"
        }
    })
    .about(&longest.id);
    if !others.is_empty() {
        let names = listed(others.iter().map(|blank| &*blank.id));
        diagnostic = diagnostic.note(format!("too long as well: {names}"));
    }
    Some(diagnostic)
}

/// What ends the sheets that a part does not fit on.
#[derive(Clone, Copy)]
enum Limit {
    Stock,
    Bed,
}

impl Limit {
    fn key(self) -> &'static str {
        match self {
            Self::Stock => "fabrication.stock",
            Self::Bed => "fabrication.bed",
        }
    }
}

/// The bed, if the part fits on a panel that is not sawn.
fn limit(blank: &Blank, settings: &Settings) -> Limit {
    let panels = Settings {
        bed: None,
        ..settings.clone()
    };
    let fits = lays(blank.grain).iter().any(|lay| {
        formats(&panels, *lay).iter().any(|format| {
            let [length, width] = panels.usable(format);
            blank.length <= length && blank.width <= width
        })
    });
    if settings.bed.is_some() && fits {
        Limit::Bed
    } else {
        Limit::Stock
    }
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
