//! Nesting: parts in rows on as few sheets as possible.
//!
//! Lamellae are strips of one width or a few, all along the grain, so the problem of the plane
//! falls apart into two of the line: strips into rows of the sheet's length, rows into sheets.
//! Both are packed by [`packing`]; of the sizes of sheet that stock and bed allow ([`panels`]) the
//! one that needs the fewest panels is taken. Sheets hold one material and thickness.
//!
//! Lengths in metres. Same parts, same sheets, in whatever order the parts are given.

mod misfit;
mod packing;
mod panels;
mod rows;
mod windows;

use crate::diagnostics::{Checked, Diagnostic, Warned};
use crate::plan::{NestingRecord, PlacedPart, SheetRecord};
use crate::project::model::{Bed, Fabrication, Grain};
use misfit::{misfit, spacing_below_kerf};
use panels::{Lay, formats};
use rows::{Row, rows};
use serde::{Deserialize, Serialize};

pub use panels::{Format, SAW};

/// Least lower margin, metres: the title stands there.
pub const TITLE_STRIP: f64 = 0.006;

/// A part to be placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Blank {
    /// Its id.
    pub id: String,
    /// Name of the material.
    pub material: String,
    /// Metres.
    pub thickness: f64,
    /// Metres, along the grain unless `grain` says otherwise.
    pub length: f64,
    /// Metres.
    pub width: f64,
    /// Longest shape of it that has to be cut in one go, metres: its longest opening.
    pub whole: f64,
    /// Which way the grain runs in the part.
    pub grain: Grain,
}

/// What of `[fabrication]` nesting depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Along the grain of the panel, metres.
    pub stock_length: f64,
    /// Metres.
    pub stock_width: f64,
    /// The machine's bed.
    pub bed: Option<BedSize>,
    /// Border that stays free.
    pub margin: f64,
    /// Least distance of parts.
    pub spacing: f64,
    /// Width of the cut that drawings compensate.
    pub kerf: f64,
}

/// A machine's bed, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BedSize {
    /// In the direction in which panels are pushed.
    pub length: f64,
    /// Across it.
    pub width: f64,
    /// Whether a longer panel can be pushed through.
    pub pass_through: bool,
}

/// Sheets and how good they are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Nest {
    /// In order of material, thickness and first part.
    pub sheets: Vec<SheetRecord>,
    /// One for each material and thickness, in the same order.
    pub groups: Vec<Group>,
}

/// What was needed of one material and thickness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Group {
    /// Name of the material.
    pub material: String,
    /// Metres.
    pub thickness: f64,
    /// Size of sheet that was chosen.
    pub format: Format,
    /// Sheets.
    pub sheets: u32,
    /// No nesting in rows can do with fewer sheets of this size.
    pub sheets_bound: u32,
    /// Rows on all sheets.
    pub rows: u32,
    /// No nesting in rows can do with fewer rows.
    pub rows_bound: u32,
    /// Panels to buy.
    pub panels: u32,
    /// Area of parts over area of sheets.
    pub yield_share: f64,
    /// The same for a nesting that reaches both bounds.
    pub yield_bound: f64,
}

impl Nest {
    /// How good it is, as the plan says it.
    pub fn records(&self) -> Vec<NestingRecord> {
        let record = |group: &Group| NestingRecord {
            material: group.material.clone(),
            thickness: group.thickness,
            sheets: group.sheets,
            sheets_bound: group.sheets_bound,
            rows: group.rows,
            rows_bound: group.rows_bound,
            panels: group.panels,
            yield_share: group.yield_share,
            yield_bound: group.yield_bound,
        };
        self.groups.iter().map(record).collect()
    }
}

impl Settings {
    /// From the project's values.
    pub fn new(fabrication: &Fabrication) -> Self {
        let bed = |bed: &Bed| BedSize {
            length: bed.length,
            width: bed.width,
            pass_through: bed.pass_through,
        };
        Self {
            stock_length: fabrication.stock.length,
            stock_width: fabrication.stock.width,
            bed: fabrication.bed.as_ref().map(bed),
            margin: fabrication.margin,
            spacing: fabrication.spacing,
            kerf: fabrication.kerf,
        }
    }

    /// Length of the longest part that a sheet takes, metres.
    pub fn longest(&self, grain: Grain) -> f64 {
        lays(grain)
            .iter()
            .flat_map(|lay| formats(self, *lay))
            .map(|format| self.usable(&format)[0])
            .fold(0.0, f64::max)
    }

    fn usable(&self, format: &Format) -> [f64; 2] {
        [
            format.length - 2.0 * self.margin,
            format.width - self.margin - self.margin.max(TITLE_STRIP),
        ]
    }
}

/// Places every part, or tells why one cannot be placed.
pub fn nest(blanks: &[Blank], settings: &Settings) -> Checked<Nest> {
    if settings.spacing <= settings.kerf {
        return Err(vec![spacing_below_kerf(settings)]);
    }
    let mut blanks: Vec<&Blank> = blanks.iter().collect();
    blanks.sort_by(|a, b| {
        (a.material.cmp(&b.material))
            .then(a.thickness.total_cmp(&b.thickness))
            .then(a.id.cmp(&b.id))
    });
    let mut errors = Vec::new();
    let mut nest = Nest {
        sheets: Vec::new(),
        groups: Vec::new(),
    };
    for group in blanks.chunk_by(|a, b| a.material == b.material && a.thickness == b.thickness) {
        match nest_group(group, settings) {
            Ok((sheets, summary)) => {
                nest.sheets.extend(sheets);
                nest.groups.push(summary);
            }
            Err(error) => errors.push(*error),
        }
    }
    let digits = nest.sheets.len().to_string().len().max(2);
    for (number, sheet) in nest.sheets.iter_mut().enumerate() {
        sheet.id = format!("sheet-{:0digits$}", number + 1);
    }
    if errors.is_empty() {
        Ok(Warned {
            value: nest,
            warnings: Vec::new(),
        })
    } else {
        Err(errors)
    }
}

/// Ways to lay parts whose grain runs along them, across them, or not at all.
fn lays(grain: Grain) -> &'static [Lay] {
    match grain {
        Grain::Across => &[Lay::Across],
        Grain::None => &[Lay::Along, Lay::Across],
        Grain::Along => &[Lay::Along],
    }
}

fn nest_group(
    blanks: &[&Blank],
    settings: &Settings,
) -> Result<(Vec<SheetRecord>, Group), Box<Diagnostic>> {
    let grain = blanks.first().map_or(Grain::Along, |blank| blank.grain);
    let mut formats: Vec<Format> = lays(grain)
        .iter()
        .flat_map(|lay| formats(settings, *lay))
        .collect();
    // The longest first: what does not fit on any is explained on that one.
    formats.sort_by(|a, b| {
        b.length
            .total_cmp(&a.length)
            .then(b.width.total_cmp(&a.width))
    });
    let mut best: Option<(Vec<SheetRecord>, Group)> = None;
    for format in &formats {
        if misfit(blanks, settings, format).is_some() {
            continue;
        }
        let nested = nest_on(blanks, settings, *format);
        let cost = |(_, group): &(Vec<SheetRecord>, Group)| (group.panels, group.sheets);
        if best.as_ref().is_none_or(|best| cost(&nested) < cost(best)) {
            best = Some(nested);
        }
    }
    best.ok_or_else(|| {
        formats
            .iter()
            .filter_map(|format| misfit(blanks, settings, format))
            .min_by_key(|diagnostic| diagnostic.code.clone())
            .expect("a group without nesting has a misfit on every format")
            .into()
    })
}

fn nest_on(blanks: &[&Blank], settings: &Settings, format: Format) -> (Vec<SheetRecord>, Group) {
    let [length, width] = settings
        .usable(&format)
        .map(|usable| usable + settings.spacing);
    let (rows, rows_bound) = rows(blanks, settings, length);
    let heights: Vec<f64> = rows
        .iter()
        .map(|row| row.width + settings.spacing)
        .collect();
    let stacks = packing::pack(&heights, width);
    let sheets_bound = sheets_bound(blanks, settings, [length, width], rows_bound);
    let mut sheets: Vec<SheetRecord> = stacks
        .iter()
        .map(|stack| {
            let mut stack: Vec<&Row> = stack.iter().map(|&row| &rows[row]).collect();
            stack.sort_by_key(|row| row.parts.first().map(|part| &part.id));
            sheet(&stack, settings, format)
        })
        .collect();
    sheets.sort_by_cached_key(|sheet| sheet.parts.first().map(|part| part.part.clone()));
    let count = sheets.len() as u32;
    let parts: f64 = blanks.iter().map(|blank| blank.length * blank.width).sum();
    let group = Group {
        material: blanks
            .first()
            .map_or_else(String::new, |blank| blank.material.clone()),
        thickness: blanks.first().map_or(0.0, |blank| blank.thickness),
        format,
        sheets: count,
        sheets_bound,
        rows: rows.len() as u32,
        rows_bound: rows_bound as u32,
        panels: count.div_ceil(format.per_panel),
        yield_share: parts / (f64::from(count) * format.length * format.width),
        yield_bound: parts / (f64::from(sheets_bound.max(1)) * format.length * format.width),
    };
    (sheets, group)
}

/// By rows of the narrowest width, and by area.
fn sheets_bound(
    blanks: &[&Blank],
    settings: &Settings,
    [length, width]: [f64; 2],
    rows_bound: usize,
) -> u32 {
    let narrowest = blanks
        .iter()
        .map(|blank| blank.width)
        .fold(f64::INFINITY, f64::min);
    let rows_per_sheet = libm::floor(width / (narrowest + settings.spacing) + 1e-9).max(1.0);
    let area: f64 = blanks
        .iter()
        .map(|blank| (blank.length + settings.spacing) * (blank.width + settings.spacing))
        .sum();
    let by_area = libm::ceil(area / (length * width) - 1e-9) as u32;
    by_area.max(rows_bound.div_ceil(rows_per_sheet as usize) as u32)
}

fn sheet(stack: &[&Row], settings: &Settings, format: Format) -> SheetRecord {
    let mut parts = Vec::new();
    let mut area = 0.0;
    let mut whole = 0.0;
    let mut y = settings.margin.max(TITLE_STRIP);
    for row in stack {
        let mut x = settings.margin;
        for part in &row.parts {
            parts.push(PlacedPart {
                part: part.id.clone(),
                x,
                y,
            });
            area += part.length * part.width;
            whole = f64::max(whole, part.whole);
            x += part.length + settings.spacing;
        }
        y += row.width + settings.spacing;
    }
    let first = stack.first().and_then(|row| row.parts.first());
    SheetRecord {
        id: String::new(),
        material: first.map_or_else(String::new, |part| part.material.clone()),
        thickness: first.map_or(0.0, |part| part.thickness),
        length: format.length,
        width: format.width,
        yield_share: area / (format.length * format.width),
        kerf: settings.kerf,
        parts,
        windows: windows::windows(format.length, settings.bed.as_ref(), whole),
    }
}

#[cfg(test)]
mod tests;
