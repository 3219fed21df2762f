//! Sheets: the cut file of a panel, and an overview of it for people.
//!
//! The cut file is the panel at 1:1 with its lower left corner at the origin: the parts, each
//! engraved before its openings and these before its outline are cut, one part after the other
//! along the rows. On the guide layer, which no tool touches, stand the panel's frame, a
//! reference bar to check the scale with, and a title that says what a workshop must know: name,
//! material, sheet, scale, kerf, grain and the hash of what is cut.

use super::drawing::{Anchor, Closure, Drawing, Entity, Layer, Palette, Path, Shape, Text};
use super::nesting::TITLE_STRIP;
use super::part::Part;
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
    let title = format!(
        "{}   {} {} mm   {} of {:02}   1:1 mm   {}   {}   {}",
        style.project,
        sheet.material,
        trim(sheet.thickness * MM),
        sheet.id,
        style.count,
        kerf_statement(style.kerf),
        grain_statement(style.grain),
        drawing.content_hash(),
    );
    guide(&mut drawing, &title);
    drawing
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
                    let bounds = entity.shape.bounds();
                    openings.push([bounds.min[0], bounds.max[0]]);
                    Layer::OpeningU
                }
                _ => continue,
            };
            drawing.draw(layer, &part.id, entity.shape.translated(at));
        }
        let label = large_label(part, &openings);
        drawing.draw(Layer::Label, &part.id, Shape::Text(label).translated(at));
    }
    let title = format!(
        "{}   {} of {:02}   {} {} mm   {} x {} mm   {} parts   yield {:.0} %   {}",
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
/// large as the longest one does.
fn large_label(part: &Part, openings: &[[f64; 2]]) -> Text {
    let full = 0.55 * part.width;
    let width = stroke_font::width(&part.id);
    let fitting = |[from, to]: [f64; 2]| (0.85 * (to - from) / width).min(full);
    let starts = [0.0].into_iter().chain(openings.iter().map(|o| o[1]));
    let ends = openings.iter().map(|o| o[0]).chain([part.length]);
    let mut best = [0.0, part.length];
    let mut height = 0.0;
    for stretch in starts.zip(ends).map(<[f64; 2]>::from) {
        if fitting(stretch) > height {
            best = stretch;
            height = fitting(stretch);
        }
    }
    let middle = [0.5 * (best[0] + best[1]), 0.5 * (part.width - height)];
    Text::new(&part.id, middle, height).anchored(Anchor::Middle)
}

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

/// A dimension as people write it: at most two decimals.
pub(super) fn trim(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
