//! `[hardware]` and `[fabrication]`: defaults, and what fits into what.

use super::lamellae::Lamellae;
use super::section;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::Code;
use crate::project::file::choices::{Pick, Splicing};
use crate::project::file::hardware::usual_bolt;
use crate::project::file::quantity::{Length, readable};
use crate::project::file::reader::{Defaulted, Sink};
use crate::project::file::words::Label;
use crate::project::file::{BedFile, FabricationSection, ProjectFile, StickerFile, StockFile};
use crate::project::model::{
    Bed, Bolt, ColourPreset, Fabrication, Hardware, Lamella, Shell, SpliceKind, Sticker, Stock,
};

/// A play smaller than this binds, metres; [`fabrication`] warns.
const TIGHT_PLAY: f64 = 0.00005;

/// A kerf wider than this is no laser's, metres.
const WIDE_KERF: f64 = 0.001;

pub(super) fn hardware(
    file: &ProjectFile,
    lamellae: &Lamellae<'_>,
    sink: &mut Sink,
) -> Option<Hardware> {
    let section = section(file.hardware.as_ref())?;
    let said_bolt = section.and_then(|section| section.bolt.as_ref());
    let shell = section.and_then(|section| section.shell.as_ref());
    let shell = shell.cloned().said()?.map(|shell| shell.0);
    let narrowest = lamellae
        .all()
        .and_then(|all| all.into_iter().min_by(|a, b| a.width.total_cmp(&b.width)));
    let bolt = match said_bolt {
        Some(bolt) => bolt.good()?.0.clone(),
        None => usual_bolt(narrowest.as_ref()?.width),
    };
    let mut fits = true;
    if let Some(shell) = &shell {
        fits = bolt_in_shell(&bolt, shell, sink);
    }
    if let (Some(lamella), true) = (narrowest, fits) {
        opening_in_lamella(&bolt, shell.as_ref(), &lamella, file, sink);
    }
    let sticker = match section.and_then(|section| section.sticker.as_ref()) {
        None => None,
        Some(said) => Some(sticker(said.good()?)?),
    };
    Some(Hardware {
        bolt,
        sticker,
        shell,
    })
}

/// Length and width of a sheet of foil where the project says none, metres: the longer mat of
/// knife plotters for the desk.
const FOIL_SHEET: [f64; 2] = [0.6, 0.3];

fn sticker(said: &StickerFile) -> Option<Sticker> {
    let sheet = match &said.sheet {
        None => FOIL_SHEET,
        Some(sheet) => {
            let sheet = sheet.good()?;
            [sheet.length.good()?.si, sheet.width.good()?.si]
        }
    };
    Some(Sticker {
        foil: said.foil.said_or(Label("PTFE".to_owned()))?.0,
        thickness: said.thickness.good()?.si,
        margin: said.margin.said_or(Length::new(0.002))?.si,
        sheet,
    })
}

fn bolt_in_shell(bolt: &Bolt, shell: &Shell, sink: &mut Sink) -> bool {
    let bore = shell.diameter - 2.0 * shell.wall;
    // A thousandth of a millimetre: 5 - 2 x 0.5 is 4 in decimals only.
    let fits = bolt.diameter <= bore + 1e-6;
    if !fits {
        sink.error(|| {
            Diagnostic::error(
                Code::new("E0216"),
                format!(
                    "the bolt `{}` does not go through the tube `{}`",
                    bolt.name, shell.name
                ),
            )
            .at_key("hardware.shell", format!("bore {} mm", millimetres(bore)))
            .at_key(
                "hardware.bolt",
                format!("{} mm", millimetres(bolt.diameter)),
            )
            .help("choose a wider tube or a thinner bolt")
        });
    }
    fits
}

/// An opening takes at most half of the width: the net section carries the bending.
fn opening_in_lamella(
    bolt: &Bolt,
    shell: Option<&Shell>,
    lamella: &Lamella,
    file: &ProjectFile,
    sink: &mut Sink,
) {
    let clearance = match section(file.fabrication.as_ref()) {
        None => return,
        Some(section) => section.and_then(|section| section.clearance.as_ref()),
    };
    let Some(clearance) = clearance.map_or(Some(DEFAULT_CLEARANCE), |c| c.good().map(|c| c.si))
    else {
        return;
    };
    let inside = shell.map_or(bolt.diameter, |shell| shell.diameter);
    let opening = inside + clearance;
    if opening <= lamella.width / 2.0 {
        return;
    }
    sink.error(|| {
        let (key, what) = match shell {
            Some(shell) => ("hardware.shell", format!("the tube `{}`", shell.name)),
            None => ("hardware.bolt", format!("the bolt `{}`", bolt.name)),
        };
        Diagnostic::error(
            Code::new("E0215"),
            format!(
                "the opening for {what} is {} mm wide, more than half of a lamella of {} mm",
                millimetres(opening),
                millimetres(lamella.width)
            ),
        )
        .at_key(
            key,
            format!(
                "{} mm and {} mm of clearance",
                millimetres(inside),
                millimetres(clearance)
            ),
        )
        .at_key("lamella.width", "the narrowest lamella counts")
        .help("choose a thinner bolt or a wider lamella")
    });
}

const DEFAULT_CLEARANCE: f64 = 0.0002;

pub(super) fn fabrication(
    file: &ProjectFile,
    lamellae: &Lamellae<'_>,
    sink: &mut Sink,
) -> Option<Fabrication> {
    let nothing = FabricationSection {
        stock: None,
        bed: None,
        kerf: None,
        clearance: None,
        spacing: None,
        margin: None,
        end_margin: None,
        label_height: None,
        colours: None,
        splice: None,
    };
    let said = section(file.fabrication.as_ref())?.unwrap_or(&nothing);
    let stock = match &said.stock {
        None => Some(Stock {
            length: 2.5,
            width: 1.25,
            price: None,
        }),
        Some(stock) => stock.good().and_then(model_stock),
    };
    let bed = match &said.bed {
        None => Some(None),
        Some(bed) => bed.good().and_then(model_bed).map(Some),
    };
    let kerf = said.kerf.said_or(Length::new(0.0)).map(|q| q.si);
    let clearance = said
        .clearance
        .said_or(Length::new(DEFAULT_CLEARANCE))
        .map(|q| q.si);
    let spacing = said.spacing.said_or(Length::new(0.003)).map(|q| q.si);
    let margin = said.margin.said_or(Length::new(0.01)).map(|q| q.si);
    let label_height = said.label_height.said_or(Length::new(0.004)).map(|q| q.si);
    let widest = lamellae
        .all()
        .map(|all| all.iter().map(|l| l.width).fold(0.0, f64::max));
    if let (Some(stock), Some(bed), Some(margin), Some(widest)) = (&stock, &bed, margin, widest) {
        room(stock, bed.as_ref(), margin, widest, said, sink);
    }
    if let Some(kerf) = kerf {
        cut(kerf, spacing, said, sink);
    }
    if let (Some(clearance), Some(_)) = (clearance, &said.clearance) {
        play(clearance, sink);
    }
    if let (Some(height), Some(all)) = (label_height, lamellae.all()) {
        label(height, &all, sink);
    }
    let end_margin = said.end_margin.said()?.map(|length| length.si);
    Some(Fabrication {
        stock: stock?,
        bed: bed?,
        kerf: kerf?,
        clearance: clearance?,
        spacing: spacing?,
        margin: margin?,
        end_margin,
        label_height: label_height?,
        colours: said.colours.said_or(Pick(ColourPreset::RedCut))?.0,
        splice: match said.splice.said_or(Pick(Splicing::None))?.0 {
            Splicing::None => None,
            Splicing::Finger => Some(SpliceKind::Finger),
            Splicing::Scarf => Some(SpliceKind::Scarf),
            Splicing::Plate => Some(SpliceKind::Plate),
        },
    })
}

fn model_stock(said: &StockFile) -> Option<Stock> {
    Some(Stock {
        length: said.length.good()?.si,
        width: said.width.good()?.si,
        price: said.price.said()?.map(|price| price.si),
    })
}

fn model_bed(said: &BedFile) -> Option<Bed> {
    Some(Bed {
        length: said.length.good()?.si,
        width: said.width.good()?.si,
        pass_through: said.pass_through.said_or(false)?,
    })
}

/// The sheet, what the machine reaches of it, and the widest lamella.
fn room(
    stock: &Stock,
    bed: Option<&Bed>,
    margin: f64,
    widest: f64,
    said: &FabricationSection,
    sink: &mut Sink,
) {
    let mut sheets = vec![("fabrication.stock", "the sheet", stock.width, stock.length)];
    sheets.extend(bed.map(|bed| ("fabrication.bed", "the bed", bed.width, bed.length)));
    for (key, what, width, length) in sheets {
        let free = width - 2.0 * margin;
        if free >= widest && length - 2.0 * margin > 0.0 {
            continue;
        }
        sink.error(|| {
            let mut diagnostic = Diagnostic::error(
                Code::new("E0217"),
                format!("no lamella of {} mm fits on {what}", millimetres(widest)),
            )
            .at_key(
                key,
                format!(
                    "{} mm x {} mm, {} mm x {} mm inside the margin",
                    millimetres(length),
                    millimetres(width),
                    millimetres((length - 2.0 * margin).max(0.0)),
                    millimetres(free.max(0.0))
                ),
            );
            if said.margin.is_some() {
                diagnostic = diagnostic.at_key("fabrication.margin", "taken off on all four sides");
            }
            diagnostic.help("correct the sizes; lengths without a unit are in `project.units`")
        });
        return;
    }
}

fn cut(kerf: f64, spacing: Option<f64>, said: &FabricationSection, sink: &mut Sink) {
    if kerf > WIDE_KERF {
        sink.warning(|| {
            Diagnostic::warning(
                Code::new("W0203"),
                format!("a kerf of {} mm is wide for a laser", millimetres(kerf)),
            )
            .at_key("fabrication.kerf", "a laser removes 0.08 to 0.3 mm")
            .help("check the unit; for a mill this is the diameter of the cutter, and the lint can be allowed")
        });
    }
    if let Some(spacing) = spacing
        && spacing < kerf
    {
        sink.warning(|| {
            let mut diagnostic = Diagnostic::warning(
                Code::new("W0210"),
                format!(
                    "parts {} mm apart are cut into by a kerf of {} mm",
                    millimetres(spacing),
                    millimetres(kerf)
                ),
            )
            .at_key("fabrication.spacing", "less than the kerf");
            if said.kerf.is_some() {
                diagnostic = diagnostic.at_key("fabrication.kerf", "the kerf");
            }
            let enough = libm::ceil(kerf * 1e3) + 2.0;
            diagnostic.help(format!("use at least {enough} mm"))
        });
    }
}

fn play(clearance: f64, sink: &mut Sink) {
    if clearance >= TIGHT_PLAY {
        return;
    }
    sink.warning(|| {
        Diagnostic::warning(
            Code::new("W0204"),
            format!(
                "with a clearance of {} mm nothing slides",
                millimetres(clearance)
            ),
        )
        .at_key("fabrication.clearance", "a running fit has 0.2 to 0.3 mm")
        .help("use \"0.2 mm\", and a test piece for the fit of your machine")
    });
}

fn label(height: f64, lamellae: &[Lamella], sink: &mut Sink) {
    let narrowest = lamellae
        .iter()
        .map(|lamella| lamella.width)
        .fold(f64::INFINITY, f64::min);
    if height < 0.8 * narrowest {
        return;
    }
    sink.warning(|| {
        Diagnostic::warning(
            Code::new("W0209"),
            format!(
                "labels of {} mm do not fit on a lamella of {} mm",
                millimetres(height),
                millimetres(narrowest)
            ),
        )
        .at_key(
            "fabrication.label_height",
            "more than four fifths of the width",
        )
        .at_key("lamella.width", "the narrowest lamella counts")
        .help("use smaller labels, down to 2 mm")
    });
}

fn millimetres(metres: f64) -> String {
    readable(metres * 1000.0)
}
