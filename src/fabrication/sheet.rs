//! Sheets: the cut file of a panel, and an overview of it for people.
//!
//! The cut file is the panel at 1:1 with its lower left corner at the origin: the parts, each
//! engraved before its openings and these before its outline are cut, one part after the other
//! along the rows. On the guide layer, which no tool touches, stand the panel's frame, a
//! reference bar to check the scale with, and a title that says what a workshop must know: name,
//! material, sheet, scale, kerf, grain and the hash of what is cut.

use super::drawing::{Anchor, Bounds, Closure, Drawing, Entity, Layer, Palette, Path, Shape, Text};
use super::nesting::TITLE_STRIP;
use super::part::Part;
use super::passage::{self, Seams};
use super::stroke_font;
use super::units::MM;
use crate::plan::SheetRecord;
use crate::project::model::{ColourPreset, Grain};
use std::collections::BTreeMap;

/// What a sheet's drawings say and how they look.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetStyle<'a> {
    /// The project's name.
    pub project: &'a str,
    /// How many sheets there are.
    pub count: usize,
    /// Kerf that is compensated, millimetres; 0 for nominal geometry.
    pub kerf: f64,
    /// Which way the grain runs in the parts.
    pub grain: Grain,
    /// Colours of tools.
    pub colours: ColourPreset,
    /// How good the nesting is, where the plan tells.
    pub goodness: Option<Goodness>,
}

/// What is told of a sheet's nesting: sheets that were needed and the least number of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goodness {
    /// Sheets of this material and thickness.
    pub sheets: u32,
    /// No nesting in rows can do with fewer.
    pub bound: u32,
}

/// Parts by id.
pub type Parts<'a> = BTreeMap<&'a str, &'a Part>;

/// Lengths of reference bars, millimetres: the first that fits is drawn.
const BARS: [f64; 4] = [100.0, 50.0, 20.0, 10.0];

/// The cut file of a sheet.
pub fn cut_file(sheet: &SheetRecord, parts: &Parts<'_>, style: &SheetStyle<'_>) -> Drawing {
    let size = [sheet.length * MM, sheet.width * MM];
    let name = format!("{} {} of {:02}", style.project, sheet.id, style.count);
    let mut drawing = Drawing::new(name, size, Palette::Cut(style.colours));
    for (part, at) in placed(sheet, parts) {
        for Entity {
            layer,
            subject,
            shape,
        } in &part.shapes
        {
            drawing.draw(*layer, subject, shape.translated(at));
        }
    }
    let title = title(sheet, style, "", &drawing.content_hash());
    guide(&mut drawing, &title);
    drawing
}

/// One cut file for each window of a sheet that is longer than the bed, and whether there is wood
/// for the pins.
pub fn window_files(
    sheet: &SheetRecord,
    parts: &Parts<'_>,
    style: &SheetStyle<'_>,
) -> (Vec<Drawing>, bool) {
    let windows = passage::windows(sheet);
    let placed: Vec<(&Part, [f64; 2])> = placed(sheet, parts).collect();
    let divided: Vec<Seams> = placed
        .iter()
        .map(|(part, [x, _])| passage::seams(part, *x, &windows))
        .collect();
    let bottom = placed
        .iter()
        .map(|(_, at)| at[1])
        .fold(f64::INFINITY, f64::min);
    let top = placed
        .iter()
        .map(|(part, at)| at[1] + part.width)
        .fold(0.0, f64::max);
    let pins: Vec<Vec<[f64; 2]>> = windows
        .windows(2)
        .map(|pair| passage::pins(sheet, [bottom, top], [pair[0], pair[1]]))
        .collect();
    let pinned = pins.iter().all(|pins| !pins.is_empty());
    let pin = |[x, y]: [f64; 2], from: f64| Shape::Circle {
        centre: [x - from, y],
        radius: 0.5 * (passage::PIN - style.kerf),
    };
    let mut drawings = Vec::new();
    for (i, window) in windows.iter().enumerate() {
        let size = [window.to - window.from, sheet.width * MM];
        let number = format!("window {} of {}", i + 1, windows.len());
        let name = format!(
            "{} {} of {:02}, {number}",
            style.project, sheet.id, style.count
        );
        let mut drawing = Drawing::new(name, size, Palette::Cut(style.colours));
        for ((part, at), seams) in placed.iter().zip(&divided) {
            for entity in passage::share(part, *at, seams, i) {
                let shape = entity.shape.translated([-window.from, 0.0]);
                drawing.draw(entity.layer, &entity.subject, shape);
            }
        }
        for at in pins.get(i).into_iter().flatten() {
            drawing.draw(Layer::CutInner, "", pin(*at, window.from));
        }
        for at in i
            .checked_sub(1)
            .and_then(|i| pins.get(i))
            .into_iter()
            .flatten()
        {
            drawing.draw(Layer::Guide, "", pin(*at, window.from));
        }
        let step = match windows.get(i + 1) {
            Some(next) => format!("{number}, then push {:.2} mm", next.from - window.from),
            None => format!("{number}, the last"),
        };
        let title = title(sheet, style, &step, &drawing.content_hash());
        guide(&mut drawing, &title);
        drawings.push(drawing);
    }
    (drawings, pinned)
}

/// A part alone: its cuts and nothing else, in a frame that is just large enough.
pub fn part_file(part: &Part, kerf: f64, colours: ColourPreset) -> Drawing {
    let shift = [0.5 * kerf; 2];
    let size = [part.length + kerf, part.width + kerf];
    let title = format!("{}, {}", part.id, kerf_statement(kerf));
    let mut drawing = Drawing::new(title, size, Palette::Cut(colours));
    for entity in &part.shapes {
        if matches!(entity.layer, Layer::CutInner | Layer::CutOuter) {
            drawing.draw(entity.layer, &part.id, entity.shape.translated(shift));
        }
    }
    drawing
}

/// What a workshop must know of a cut file.
fn title(sheet: &SheetRecord, style: &SheetStyle<'_>, step: &str, hash: &str) -> String {
    let step = if step.is_empty() {
        String::new()
    } else {
        format!("{step}   ")
    };
    format!(
        "{}   {} {} mm   {} of {:02}   {step}1:1 mm   {}   {}   {hash}",
        style.project,
        sheet.material,
        trim(sheet.thickness * MM),
        sheet.id,
        style.count,
        kerf_statement(style.kerf),
        grain_statement(style.grain),
    )
}

/// An overview of a sheet: filled parts with large ids.
pub fn overview(sheet: &SheetRecord, parts: &Parts<'_>, style: &SheetStyle<'_>) -> Drawing {
    let [length, width] = [sheet.length * MM, sheet.width * MM];
    let pen = length.max(width) / 600.0;
    let band = 16.0 * pen;
    let name = format!(
        "{} {} of {:02}, overview",
        style.project, sheet.id, style.count
    );
    let mut drawing = Drawing::new(name, [length, width + band], Palette::People);
    drawing.pen = pen;
    drawing.draw(Layer::Sheet, "", Path::rectangle([0.0; 2], [length, width]));
    for (part, at) in placed(sheet, parts) {
        let mut openings = Vec::new();
        for entity in &part.shapes {
            let layer = match entity.layer {
                Layer::CutOuter => Layer::LamellaU,
                Layer::CutInner => {
                    openings.push(entity.shape.bounds());
                    Layer::OpeningU
                }
                _ => continue,
            };
            drawing.draw(layer, &part.id, entity.shape.translated(at));
        }
        let label = large_label(part, &openings);
        drawing.draw(Layer::Label, &part.id, Shape::Text(label).translated(at));
    }
    borders(&mut drawing, sheet);
    let goodness = style.goodness.map_or_else(String::new, |goodness| {
        let plural = if goodness.sheets == 1 { "" } else { "s" };
        format!(
            " ({} sheet{plural}, at least {})",
            goodness.sheets, goodness.bound
        )
    });
    let pushed = match sheet.windows.as_slice() {
        [first, second, ..] => format!(
            "{} windows, push {:.2} mm   ",
            sheet.windows.len(),
            (second.from - first.from) * MM
        ),
        _ => String::new(),
    };
    let title = format!(
        "{}   {} of {:02}   {} {} mm   {} x {} mm   {} parts   yield {:.1} %{goodness}   {pushed}{}",
        style.project,
        sheet.id,
        style.count,
        sheet.material,
        trim(sheet.thickness * MM),
        trim(length),
        trim(width),
        sheet.parts.len(),
        sheet.yield_share * 100.0,
        grain_statement(style.grain),
    );
    let height = (7.0 * pen).min(0.96 * length / stroke_font::width(&title));
    drawing.draw(
        Layer::Title,
        "",
        Text::new(
            title,
            [0.02 * length, width + 0.5 * (band - height)],
            height,
        ),
    );
    drawing
}

/// Where the windows of a sheet begin and end, numbered above the parts.
fn borders(drawing: &mut Drawing, sheet: &SheetRecord) {
    let width = sheet.width * MM;
    let height = 6.0 * drawing.pen;
    for (i, window) in passage::windows(sheet).into_iter().enumerate() {
        for x in [window.from, window.to] {
            if x > 0.0 && x < sheet.length * MM {
                let line = Path::polyline(&[[x, 0.0], [x, width]], Closure::Open);
                drawing.draw(Layer::Axis, "", line);
            }
        }
        let at = [window.from + height, width - 1.3 * height];
        let text = Text::new(format!("{} →", i + 1), at, height);
        drawing.draw(Layer::Halo, "", text.clone());
        drawing.draw(Layer::Title, "", text);
    }
}

/// Parts with the place of their lower left corner, in the order of rows, each row run in the
/// opposite direction of the one below.
fn placed<'a>(
    sheet: &SheetRecord,
    parts: &Parts<'a>,
) -> impl Iterator<Item = (&'a Part, [f64; 2])> {
    let mut order: Vec<_> = sheet.parts.iter().collect();
    order.sort_by(|a, b| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)));
    for (number, row) in order.chunk_by_mut(|a, b| a.y == b.y).enumerate() {
        if number % 2 == 1 {
            row.reverse();
        }
    }
    order
        .into_iter()
        .filter_map(|place| {
            let part = *parts.get(place.part.as_str())?;
            Some((part, [place.x * MM, place.y * MM]))
        })
        .collect::<Vec<_>>()
        .into_iter()
}

/// Frame, reference bar and title in the lower margin.
pub(super) fn guide(drawing: &mut Drawing, title: &str) {
    let [length, width] = drawing.size;
    drawing.draw(Layer::Guide, "", Path::rectangle([0.0; 2], [length, width]));
    let strip = TITLE_STRIP * MM;
    let left = 0.5 * strip;
    let Some(bar) = BARS.into_iter().find(|bar| bar + 2.0 * left <= length) else {
        return;
    };
    let y = 0.5 * strip;
    let tick = 0.25 * strip;
    for line in [
        [[left, y], [left + bar, y]],
        [[left, y - tick], [left, y + tick]],
        [[left + bar, y - tick], [left + bar, y + tick]],
    ] {
        drawing.draw(Layer::Guide, "", Path::polyline(&line, Closure::Open));
    }
    let text = format!("{bar} mm   {title}");
    let start = left + bar + 0.5 * strip;
    let room = length - left - start;
    let height = (0.42 * strip).min(room / stroke_font::width(&text));
    if height > 0.5 {
        drawing.draw(
            Layer::Guide,
            "",
            Text::new(text, [start, y - 0.5 * height], height),
        );
    }
}

/// A part's id in the first stretch between openings that takes it at full size, otherwise as
/// large as the longest one does, or above all openings where that is larger.
fn large_label(part: &Part, openings: &[Bounds]) -> Text {
    let full = 0.55 * part.width;
    let width = stroke_font::width(&part.id);
    let fitting = |[from, to]: [f64; 2]| (0.85 * (to - from) / width).min(full);
    let [first, last] = part.ends;
    let starts = [first].into_iter().chain(openings.iter().map(|o| o.max[0]));
    let ends = openings
        .iter()
        .map(|o| o.min[0])
        .chain([part.length - last]);
    let mut best = [0.0, part.length];
    let mut height = 0.0;
    for stretch in starts.zip(ends).map(<[f64; 2]>::from) {
        if fitting(stretch) > height {
            best = stretch;
            height = fitting(stretch);
        }
    }
    let highest = openings.iter().map(|o| o.max[1]).fold(0.0, f64::max);
    let band = part.width - highest;
    let above = (0.85 * (part.length - first - last) / width).min(0.6 * band);
    let middle = if above > height {
        height = above;
        [
            0.5 * (first + part.length - last),
            highest + 0.5 * (band - height),
        ]
    } else {
        [0.5 * (best[0] + best[1]), 0.5 * (part.width - height)]
    };
    Text::new(&part.id, middle, height).anchored(Anchor::Middle)
}

/// Halves in decimals are a little less than that in binary.
const TIE: f64 = 1e-9;

fn kerf_statement(kerf: f64) -> String {
    if kerf > 0.0 {
        format!("kerf {kerf:.2} mm compensated")
    } else {
        "nominal, kerf not compensated".to_owned()
    }
}

fn grain_statement(grain: Grain) -> &'static str {
    match grain {
        Grain::Along => "grain →",
        Grain::Across => "grain ↑",
        Grain::None => "no grain",
    }
}

/// A dimension as people write it: at most three decimals, half of the last one upwards. An eighth
/// of an inch is 3.175 mm, a sixteenth 1.588 mm.
pub fn trim(value: f64) -> String {
    let text = format!("{:.3}", value + TIE);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
