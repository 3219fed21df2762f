//! Sheets of foil: stickers on cards, in the order of assembly.
//!
//! Every sticker stands on a card of its own backing with its number, the crossing that it is for
//! and the direction of its lamella: cards stay sorted on the bench until the foil is peeled off.
//! Stickers are drawn as seen on the side that is *not* glued, so those for lower faces are
//! mirrored. A card's number is drawn with a pen, foil and slot are kiss-cut, the card is cut
//! through. Cards stand in rows from the lower left, one after the other, so that nobody has to
//! search; sheets that nest tighter would save little foil and cost much time.
//!
//! The foil is meant for a knife: lasers release hydrogen fluoride from PTFE, and every sheet
//! says so.

use super::super::drawing::{Closure, Drawing, Layer, Palette, Path, Shape, Text};
use super::super::nesting::TITLE_STRIP;
use super::super::part::LEAST_SLIDE;
use super::super::sheet::{guide, trim};
use super::super::stroke_font;
use super::super::units::MM;
use crate::diagnostics::codes::fabrication as codes;
use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::plan::{Face, PlacedPart, SheetRecord, StickerRecord};
use crate::project::model::{ColourPreset, Sticker};
use std::collections::BTreeMap;

/// Border of a card around its sticker, millimetres.
const CARD: f64 = 2.0;
/// Height of the strip for the number above the sticker, millimetres.
const NUMBER_STRIP: f64 = 4.0;
/// Height of the number, millimetres.
const NUMBER: f64 = 2.5;
/// Distance of two cards, millimetres.
const GAP: f64 = 1.5;
/// Border of a sheet, millimetres: what plotters hold it by.
const BORDER: f64 = 8.0;
/// Below the cards stand the title and the warning.
const FOOT: f64 = 2.5 * TITLE_STRIP * MM;

/// What the sheets say and how they look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoilStyle<'a> {
    /// The project's name.
    pub project: &'a str,
    /// How many sheets there are.
    pub count: usize,
    /// Colours of tools.
    pub colours: ColourPreset,
}

/// A sticker as it lies on its card, millimetres from the card's lower left corner.
struct Card {
    size: [f64; 2],
    outline: Path,
    slot: Shape,
}

impl Card {
    fn new(sticker: &StickerRecord) -> Self {
        // Seen from below, left and right change sides.
        let mirror = match sticker.face {
            Face::Top => 1.0,
            Face::Bottom => -1.0,
        };
        let mut corners = sticker.outline.map(|[x, y]| [x * MM, mirror * y * MM]);
        if sticker.face == Face::Bottom {
            corners.reverse();
        }
        let path = Path::polyline(&corners, Closure::Closed);
        let bounds = path.bounds();
        let [width, height] = bounds.size();
        let shift = [CARD - bounds.min[0], CARD - bounds.min[1]];
        let radius = 0.5 * sticker.diameter * MM;
        let [from, to] = sticker.slot.map(|x| x * MM + shift[0]);
        let slot = if to - from < LEAST_SLIDE {
            Shape::Circle {
                centre: [0.5 * (from + to), shift[1]],
                radius,
            }
        } else {
            Path::slot(from, to, shift[1], radius).into()
        };
        Self {
            size: [width + 2.0 * CARD, height + 2.0 * CARD + NUMBER_STRIP],
            outline: path.translated(shift),
            slot,
        }
    }
}

/// Places all stickers on sheets in the order of their numbers.
pub fn nest(stickers: &[StickerRecord], sticker: &Sticker) -> Checked<Vec<SheetRecord>> {
    let [length, width] = sticker.sheet.map(|v| v * MM);
    let mut sheets: Vec<SheetRecord> = Vec::new();
    // The next free place, and the top of the row.
    let (mut x, mut y, mut top) = (BORDER, FOOT, FOOT);
    let mut areas = Vec::new();
    for record in stickers {
        let [w, h] = Card::new(record).size;
        if w > length - 2.0 * BORDER || h > width - FOOT - BORDER {
            return Err(vec![too_large(record, [w, h], sticker)]);
        }
        if x + w > length - BORDER {
            (x, y) = (BORDER, top + GAP);
        }
        if sheets.is_empty() || y + h > width - BORDER {
            (x, y, top) = (BORDER, FOOT, FOOT);
            sheets.push(empty(sticker));
            areas.push(0.0);
        }
        if let (Some(sheet), Some(area)) = (sheets.last_mut(), areas.last_mut()) {
            sheet.parts.push(PlacedPart {
                part: record.id.clone(),
                x: x / MM,
                y: y / MM,
            });
            *area += area_of(record);
        }
        x += w + GAP;
        top = top.max(y + h);
    }
    let digits = sheets.len().to_string().len().max(2);
    for (number, (sheet, area)) in sheets.iter_mut().zip(areas).enumerate() {
        sheet.id = format!("foil-{:0digits$}", number + 1);
        sheet.yield_share = area / (sheet.length * sheet.width);
    }
    Ok(Warned {
        value: sheets,
        warnings: Vec::new(),
    })
}

fn empty(sticker: &Sticker) -> SheetRecord {
    SheetRecord {
        id: String::new(),
        material: sticker.foil.clone(),
        thickness: sticker.thickness,
        length: sticker.sheet[0],
        width: sticker.sheet[1],
        yield_share: 0.0,
        kerf: 0.0,
        parts: Vec::new(),
        windows: Vec::new(),
    }
}

/// Foil of a sticker, its slot not subtracted, square metres.
pub(in crate::fabrication) fn area_of(sticker: &StickerRecord) -> f64 {
    Path::polyline(&sticker.outline, Closure::Closed).area()
}

/// The cut file of a sheet of foil.
pub fn draw(
    sheet: &SheetRecord,
    stickers: &BTreeMap<&str, &StickerRecord>,
    style: &FoilStyle<'_>,
) -> Drawing {
    let size = [sheet.length * MM, sheet.width * MM];
    let name = format!("{} {} of {:02}", style.project, sheet.id, style.count);
    let mut drawing = Drawing::new(name, size, Palette::Cut(style.colours));
    let mut numbers: Vec<u32> = Vec::new();
    for place in &sheet.parts {
        let Some(sticker) = stickers.get(place.part.as_str()) else {
            continue;
        };
        numbers.push(sticker.number);
        draw_card(&mut drawing, sticker, [place.x * MM, place.y * MM]);
    }
    let range = match (numbers.first(), numbers.last()) {
        (Some(first), Some(last)) => format!("stickers {first} to {last}"),
        _ => "no stickers".to_owned(),
    };
    let title = format!(
        "{}   {} {} mm   {} of {:02}   1:1 mm   {range}   {}",
        style.project,
        sheet.material,
        trim(sheet.thickness * MM),
        sheet.id,
        style.count,
        drawing.content_hash(),
    );
    guide(&mut drawing, &title);
    let warning = warning(&sheet.material);
    let strip = TITLE_STRIP * MM;
    let height = (0.42 * strip).min((size[0] - strip) / stroke_font::width(&warning));
    let at = [0.5 * strip, 1.5 * strip - 0.5 * height];
    drawing.draw(Layer::Guide, "", Text::new(warning, at, height));
    drawing
}

/// What must be known before anybody puts the foil on a machine.
fn warning(foil: &str) -> String {
    let upper = foil.to_ascii_uppercase();
    if ["PTFE", "TEFLON", "FEP", "PFA", "ETFE", "PVC", "VINYL"]
        .iter()
        .any(|name| upper.contains(name))
    {
        format!(
            "NO LASER: {foil} gives off poisonous, corrosive gas. Knife, plotter or punch only."
        )
    } else {
        "Knife or plotter. Ask the maker of the foil before you put it under a laser.".to_owned()
    }
}

fn draw_card(drawing: &mut Drawing, sticker: &StickerRecord, at: [f64; 2]) {
    let card = Card::new(sticker);
    let [width, height] = card.size;
    let room = width - 2.0 * CARD;
    let long = format!("{} {} →", sticker.number, sticker.id);
    let short = format!("{} →", sticker.number);
    let words = [long, short]
        .into_iter()
        .find(|words| stroke_font::width(words) * NUMBER <= room);
    if let Some(words) = words {
        let baseline = height - CARD - NUMBER;
        let text = Text::new(words, [CARD, baseline], NUMBER);
        drawing.draw(Layer::Pen, &sticker.id, Shape::Text(text).translated(at));
    }
    let card_outline = Path::rectangle([0.0; 2], card.size);
    for (layer, shape) in [
        (Layer::KissCut, card.slot),
        (Layer::KissCut, card.outline.into()),
        (Layer::ThroughCut, card_outline.into()),
    ] {
        drawing.draw(layer, &sticker.id, shape.translated(at));
    }
}

fn too_large(record: &StickerRecord, [w, h]: [f64; 2], sticker: &Sticker) -> Diagnostic {
    let [length, width] = sticker.sheet.map(|v| v * MM);
    Diagnostic::error(
        codes::STICKER_TOO_LARGE,
        format!(
            "the sticker `{}` needs a card of {w:.0} x {h:.0} mm, a sheet of foil of {} x {} mm \
             has room for {:.0} x {:.0} mm",
            record.id,
            trim(length),
            trim(width),
            length - 2.0 * BORDER,
            width - FOOT - BORDER
        ),
    )
    .at_key("hardware.sticker", "sheets are too small")
    .help("give the size of your foil: `sheet = { length = 500, width = 300 }`")
    .about(&record.id)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(face: Face) -> StickerRecord {
        StickerRecord {
            id: "west.u02-v03.u".to_owned(),
            number: 7,
            crossing: "west.u02-v03".to_owned(),
            lamella: "west.u02".to_owned(),
            face,
            outline: [[0.1, -0.01], [0.14, -0.01], [0.15, 0.01], [0.11, 0.01]],
            slot: [0.12, 0.13],
            diameter: 0.0045,
        }
    }

    fn foil(sheet: [f64; 2]) -> Sticker {
        Sticker {
            foil: "PTFE".to_owned(),
            thickness: 0.13e-3,
            margin: 2e-3,
            sheet,
        }
    }

    #[test]
    fn stickers_for_lower_faces_are_mirrored_and_keep_their_place_along_the_lamella() {
        let corners = |face| {
            let card = Card::new(&square(face));
            let mut corners: Vec<[i64; 2]> = card
                .outline
                .vertices
                .iter()
                .map(|v| [v.x, v.y].map(|x| libm::round(x * 1e6) as i64))
                .collect();
            corners.sort_unstable();
            (corners, card.outline.area())
        };
        let mm = |points: [[i64; 2]; 4]| points.map(|point| point.map(|v| v * 1_000_000));
        let (top, area) = corners(Face::Top);
        assert_eq!(top, mm([[2, 2], [12, 22], [42, 2], [52, 22]]));
        let (bottom, mirrored) = corners(Face::Bottom);
        assert_eq!(bottom, mm([[2, 22], [12, 2], [42, 22], [52, 2]]));
        // Both run counter-clockwise.
        assert!(area > 799.0 && (area - mirrored).abs() < 1e-9);
    }

    #[test]
    fn cards_stand_in_order_and_clear_of_each_other() {
        let stickers: Vec<StickerRecord> = (1..=40)
            .map(|number| StickerRecord {
                id: format!("s{number}"),
                number,
                ..square(Face::Top)
            })
            .collect();
        let sheets = nest(&stickers, &foil([0.3, 0.2])).expect("they fit").value;
        // Cards of 54 x 28 mm with 1.5 mm between them: 5 in a row, 6 rows in 177 mm.
        let counts: Vec<usize> = sheets.iter().map(|sheet| sheet.parts.len()).collect();
        assert_eq!(counts, [30, 10]);
        let order: Vec<&str> = sheets
            .iter()
            .flat_map(|sheet| sheet.parts.iter().map(|part| part.part.as_str()))
            .collect();
        assert!(order.iter().zip(&stickers).all(|(id, s)| *id == s.id));
        assert_eq!(sheets[0].parts[6].x, (BORDER + 54.0 + GAP) / MM);
        assert_eq!(sheets[0].parts[6].y, (FOOT + 28.0 + GAP) / MM);
    }

    #[test]
    fn a_sticker_that_is_larger_than_the_foil_is_refused() {
        let told = nest(&[square(Face::Top)], &foil([0.06, 0.2])).expect_err("too long");
        assert_eq!(told[0].code, codes::STICKER_TOO_LARGE);
    }

    #[test]
    fn foils_with_fluorine_or_chlorine_are_kept_from_lasers() {
        assert!(warning("skived ptfe film").starts_with("NO LASER"));
        assert!(warning("UHMW-PE").starts_with("Knife"));
    }
}
