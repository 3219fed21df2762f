//! What a workshop would object to: sections that are too weak, features that are too small,
//! openings that run into each other, grain that runs the wrong way.
//!
//! Limits are rules of trade, each named here with its reason. They are warnings, save for parts
//! that fall apart.

use super::hardware::Series;
use super::outputs::{Grains, Workshop};
use super::part::opening_extent;
use super::sheet::trim;
use super::units::MM;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::plan::LamellaRecord;
use crate::project::model::{Grain, Hardware};

/// Narrowest web that laser shops cut without burning it, millimetres.
const LEAST_WEB: f64 = 1.0;
/// Webs between openings in bolt diameters, below which the wood between two bolts shears out.
const WEB_IN_BOLTS: f64 = 1.5;
/// Share of the section that an opening may take: bending stress at the opening is that of the
/// full section over the rest.
const LARGEST_LOSS: f64 = 0.5;
/// Openings in thicknesses of the sheet: smaller ones come out conical and charred.
const HOLE_IN_THICKNESSES: f64 = 1.5;
/// From the centre of an opening to the end of the lamella in diameters of the opening, below
/// which the end splits.
const END_IN_DIAMETERS: f64 = 2.0;
/// A washer bears on this much wood beside the notch, on both sides together, millimetres.
const WASHER_BEARING: f64 = 4.0;

/// Share of a lamella's thickness that the two foils of a crossing may have together.
const LARGEST_FOIL: f64 = 0.3;

/// Everything that is objected to, errors among warnings; each cause is told once, at its worst
/// place.
pub fn lints(lamellae: &[LamellaRecord], workshop: &Workshop) -> Vec<Diagnostic> {
    let hardware = &workshop.hardware;
    let mut told = webs(lamellae, hardware);
    told.extend(ends(lamellae));
    told.extend(sections(lamellae));
    told.extend(small_holes(lamellae));
    told.extend(washers(lamellae, hardware));
    told.extend(grain(lamellae, &workshop.grains));
    told.extend(spacing(lamellae, workshop));
    told.extend(foil(lamellae, hardware));
    told
}

/// Wood between neighbouring openings: the worst place, and a list of all.
fn webs(lamellae: &[LamellaRecord], hardware: &Hardware) -> Vec<Diagnostic> {
    let limit = WEB_IN_BOLTS * hardware.bolt.diameter * MM;
    let mut narrow: Vec<Web> = lamellae
        .iter()
        .flat_map(webs_of)
        .filter(|web| web.width < limit.max(LEAST_WEB))
        .collect();
    narrow.sort_by(|a, b| a.width.total_cmp(&b.width));
    let (meeting, narrow): (Vec<_>, Vec<_>) =
        narrow.into_iter().partition(|web| web.width < LEAST_WEB);
    let mut told = Vec::new();
    if let Some((worst, others)) = meeting.split_first() {
        let how = if worst.width <= 0.0 {
            format!("overlap by {:.2} mm", -worst.width)
        } else {
            format!("leave {:.2} mm of wood", worst.width)
        };
        let diagnostic = Diagnostic::error(
            codes::OPENINGS_MEET,
            format!("{} {how}, {LEAST_WEB} mm is the least", worst.name()),
        )
        .help("fewer members, a smaller patch or another planar angle shorten the slides");
        told.push(list_others(diagnostic, others).about(worst.lamella));
    }
    if let Some((worst, others)) = narrow.split_first() {
        let diagnostic = Diagnostic::warning(
            codes::NARROW_WEB,
            format!(
                "{} leave {:.2} mm of wood, {WEB_IN_BOLTS} bolt diameters are {limit:.2} mm",
                worst.name(),
                worst.width
            ),
        );
        told.push(list_others(diagnostic, others).about(worst.lamella));
    }
    told
}

/// Wood between two openings of a lamella.
struct Web<'a> {
    lamella: &'a str,
    crossings: [&'a str; 2],
    /// Millimetres; negative where the openings overlap.
    width: f64,
}

impl Web<'_> {
    fn name(&self) -> String {
        let [a, b] = self.crossings;
        format!("on `{}` the openings for `{a}` and `{b}`", self.lamella)
    }
}

fn list_others(diagnostic: Diagnostic, others: &[Web<'_>]) -> Diagnostic {
    if others.is_empty() {
        return diagnostic;
    }
    let list: Vec<String> = others
        .iter()
        .map(|web| {
            format!(
                "`{}` before `{}`: {:.2} mm",
                web.lamella, web.crossings[1], web.width
            )
        })
        .collect();
    diagnostic.note(format!("also on {}", list.join("; ")))
}

fn webs_of(lamella: &LamellaRecord) -> Vec<Web<'_>> {
    let mut edges: Vec<([f64; 2], &str)> = lamella
        .openings
        .iter()
        .map(|opening| {
            let ([from, to], diameter) = opening_extent(lamella, opening);
            let radius = 0.5 * diameter;
            ([from - radius, to + radius], opening.crossing())
        })
        .collect();
    edges.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    edges
        .windows(2)
        .map(|pair| Web {
            lamella: &lamella.id,
            crossings: [pair[0].1, pair[1].1],
            width: pair[1].0[0] - pair[0].0[1],
        })
        .collect()
}

/// Wood behind the outermost openings.
fn ends(lamellae: &[LamellaRecord]) -> Vec<Diagnostic> {
    // From the centre of the opening that is nearest to an end, and its diameter.
    let outermost = |lamella: &LamellaRecord| {
        lamella
            .openings
            .iter()
            .map(|opening| {
                let ([from, to], diameter) = opening_extent(lamella, opening);
                (from.min(lamella.length * MM - to), diameter)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
    };
    worst(lamellae, |lamella, _| {
        let (rest, diameter) = outermost(lamella)?;
        (rest < END_IN_DIAMETERS * diameter).then_some(-rest)
    })
    .into_iter()
    .filter_map(|(lamella, _, count)| {
        let (rest, diameter) = outermost(lamella)?;
        let message = format!(
            "an opening of {diameter:.1} mm is {rest:.1} mm from the end, {END_IN_DIAMETERS} \
             diameters are {:.1} mm, on `{}`{}",
            END_IN_DIAMETERS * diameter,
            lamella.id,
            and_others(count)
        );
        let diagnostic = if rest < 0.5 * diameter + LEAST_WEB {
            Diagnostic::error(codes::OPENING_AT_END, message)
        } else {
            Diagnostic::warning(codes::SHORT_END, message)
        };
        Some(
            diagnostic
                .at_key("fabrication.end_margin", "too short")
                .about(&lamella.id),
        )
    })
    .collect()
}

/// The worst lamella of each section, the diameter of its widest opening and how many lamellae
/// of the section are bad.
fn worst(
    lamellae: &[LamellaRecord],
    badness: impl Fn(&LamellaRecord, f64) -> Option<f64>,
) -> Vec<(&LamellaRecord, f64, usize)> {
    let mut found: Vec<(&LamellaRecord, f64, f64, usize)> = Vec::new();
    for lamella in lamellae {
        let widest = lamella
            .openings
            .iter()
            .map(|opening| opening_extent(lamella, opening).1)
            .fold(0.0, f64::max);
        let Some(bad) = badness(lamella, widest) else {
            continue;
        };
        let same = found.iter_mut().find(|(other, ..)| {
            other.width == lamella.width && other.thickness == lamella.thickness
        });
        match same {
            Some(entry) => {
                entry.3 += 1;
                if bad > entry.1 + 1e-9 {
                    (entry.0, entry.1, entry.2) = (lamella, bad, widest);
                }
            }
            None => found.push((lamella, bad, widest, 1)),
        }
    }
    found
        .into_iter()
        .map(|(lamella, _, widest, count)| (lamella, widest, count))
        .collect()
}

/// The section that openings leave.
fn sections(lamellae: &[LamellaRecord]) -> Vec<Diagnostic> {
    worst(lamellae, |lamella, widest| {
        let loss = widest / (lamella.width * MM);
        (loss > LARGEST_LOSS).then_some(loss)
    })
    .into_iter()
    .map(|(lamella, widest, count)| {
        let width = lamella.width * MM;
        let message = format!(
            "openings of {widest:.1} mm leave {:.1} mm of a width of {width:.1} mm, \
             on `{}`{}",
            width - widest,
            lamella.id,
            and_others(count)
        );
        let sides = 0.5 * (width - widest);
        let diagnostic = if sides < LEAST_WEB {
            Diagnostic::error(codes::OPENING_TOO_WIDE, message)
        } else {
            Diagnostic::warning(codes::NET_SECTION, message).note(format!(
                "bending stress at an opening is {:.1} times that of the full section",
                width / (width - widest)
            ))
        };
        diagnostic
            .at_key("hardware", "bolt and shell set the width of openings")
            .help("wider lamellae, or a thinner bolt and shell")
            .about(&lamella.id)
    })
    .collect()
}

fn small_holes(lamellae: &[LamellaRecord]) -> Vec<Diagnostic> {
    let smallest = |lamella: &LamellaRecord| {
        lamella
            .openings
            .iter()
            .map(|opening| opening_extent(lamella, opening).1)
            .fold(f64::INFINITY, f64::min)
    };
    worst(lamellae, |lamella, _| {
        let ratio = smallest(lamella) / (lamella.thickness * MM);
        (ratio < HOLE_IN_THICKNESSES).then_some(-ratio)
    })
    .into_iter()
    .map(|(lamella, _, count)| {
        Diagnostic::warning(
            codes::SMALL_HOLE,
            format!(
                "openings of {} mm in a sheet of {} mm, {HOLE_IN_THICKNESSES} thicknesses are {} mm, \
                 on `{}`{}",
                trim(smallest(lamella)),
                trim(lamella.thickness * MM),
                trim(HOLE_IN_THICKNESSES * lamella.thickness * MM),
                lamella.id,
                and_others(count)
            ),
        )
        .at_key("hardware.bolt", "openings are as wide as the bolt and its play")
        .note("smaller openings come out conical and charred")
        .help("a thicker bolt, a thinner sheet, or a test cut with `egg coupon`")
        .about(&lamella.id)
    })
    .collect()
}

/// Washers that fall into the notch, or stand over the edge.
fn washers(lamellae: &[LamellaRecord], hardware: &Hardware) -> Vec<Diagnostic> {
    let Some(series) = Series::of(hardware.bolt.diameter) else {
        return Vec::new();
    };
    let outer = series.washer[1];
    let narrow = worst(lamellae, |_, widest| {
        (outer < widest + WASHER_BEARING).then_some(widest)
    });
    let wide = worst(lamellae, |lamella, _| {
        (outer > lamella.width * MM).then_some(-lamella.width)
    });
    let bridge = narrow.into_iter().map(|(lamella, widest, count)| {
        Diagnostic::warning(
            codes::WASHER_NARROW,
            format!(
                "washers of {outer:.0} mm bear on {:.1} mm of wood beside openings of \
                 {widest:.1} mm, on `{}`{}",
                (outer - widest).max(0.0),
                lamella.id,
                and_others(count)
            ),
        )
        .help("order body washers, or choose a shell that is closer to the bolt")
        .about(&lamella.id)
    });
    let over = wide.into_iter().map(|(lamella, _, count)| {
        Diagnostic::warning(
            codes::WASHER_WIDE,
            format!(
                "washers of {outer:.0} mm stand over the edge of `{}`{}, {:.1} mm wide",
                lamella.id,
                and_others(count),
                lamella.width * MM
            ),
        )
        .help("a smaller bolt, or wider lamellae")
        .about(&lamella.id)
    });
    bridge.chain(over).collect()
}

/// Grain across the lamella: what made the paper's first showcase collapse.
fn grain(lamellae: &[LamellaRecord], grains: &Grains) -> Vec<Diagnostic> {
    grains
        .iter()
        .filter(|(_, grain)| *grain == Grain::Across)
        .filter_map(|(material, _)| {
            let first = lamellae.iter().find(|l| l.material == material)?;
            Some(
                Diagnostic::warning(
                    codes::GRAIN_ACROSS,
                    format!("the grain of `{material}` runs across the lamellae"),
                )
                .at_key(format!("materials.{material}"), "grain across")
                .help("turn the panel: along the grain wood is about five times as stiff")
                .about(&first.id),
            )
        })
        .collect()
}

/// Parts that lie closer than heat and a thin strip of waste allow.
fn spacing(lamellae: &[LamellaRecord], workshop: &Workshop) -> Option<Diagnostic> {
    let thickest = lamellae
        .iter()
        .map(|lamella| lamella.thickness)
        .fold(0.0, f64::max);
    let least = (workshop.kerf + 0.5 * thickest).max(2e-3);
    (workshop.spacing < least - 1e-9).then(|| {
        Diagnostic::warning(
            codes::NARROW_SPACING,
            format!(
                "parts are {} mm apart, {} mm are usual for this sheet",
                trim(workshop.spacing * MM),
                trim(least * MM)
            ),
        )
        .at_key("fabrication.spacing", "narrow")
        .note("half the thickness and the kerf, at least 2 mm")
        .help(format!(
            "`spacing = \"{} mm\"` in `[fabrication]` leaves a strip of waste that holds",
            trim(least * MM)
        ))
    })
}

/// Foils that lift the inner members off the surface.
fn foil(lamellae: &[LamellaRecord], hardware: &Hardware) -> Option<Diagnostic> {
    let sticker = hardware.sticker.as_ref()?;
    let thinnest = lamellae
        .iter()
        .map(|lamella| lamella.thickness)
        .min_by(f64::total_cmp)?;
    let both = 2.0 * sticker.thickness;
    (both > LARGEST_FOIL * thinnest + 1e-9).then(|| {
        Diagnostic::warning(
            codes::FOIL_THICK,
            format!(
                "two foils of {} mm lie between lamellae of {} mm",
                trim(sticker.thickness * MM),
                trim(thinnest * MM)
            ),
        )
        .at_key("hardware.sticker.thickness", "thick")
        .help("foils for this purpose are 0.1 to 0.25 mm thick")
    })
}

fn and_others(count: usize) -> String {
    match count {
        0 | 1 => String::new(),
        2 => " and another".to_owned(),
        n => format!(" and {} others", n - 1),
    }
}
