//! The coupon: a small test piece that tells what a machine does to a sheet, before it is let at
//! the lamellae.
//!
//! **Kerf.** A frame of 100 mm holds ten bars of 10 mm, cut free all around and from each other
//! by nine lines. Every cut takes the kerf, so that the bars pushed together leave a gap of eleven
//! kerfs: half of one at each end of the frame, half of one at each end of every bar. A scale
//! beside the frame tells the kerf that belongs to a gap.
//!
//! **Fit.** Holes and short notches in steps of 0.05 mm about the size of the shell, and holes
//! about that of the bolt: the smallest notch in which the shell slides and the smallest hole
//! that the bolt goes through tell what to write as `clearance`.
//!
//! Coupons have nominal geometry whatever the project's kerf is: they are what it is measured
//! with. Millimetres.

use super::drawing::{Anchor, Closure, Drawing, Layer, Palette, Path, Shape, Text};
use super::units::MM;
use crate::plan::LamellaRecord;
use crate::project::model::{ColourPreset, Hardware};
use serde::{Deserialize, Serialize};

/// A material and thickness that lamellae are cut from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CouponSection {
    /// Name of the material.
    pub material: String,
    /// Metres.
    pub thickness: f64,
}

/// Bars of the kerf frame, and their width.
const BARS: u32 = 10;
const BAR: f64 = 10.0;
/// Height of the frame.
const FRAME: f64 = 12.0;
/// Play is tried from none to this many steps.
const STEPS: u32 = 8;
const STEP: f64 = 0.05;
/// Around everything.
const BORDER: f64 = 8.0;
/// Height of letters.
const LETTERS: f64 = 3.0;
/// Wood between two openings.
const WEB: f64 = 6.0;
/// How far the shell slides in the notches.
const SLIDE: f64 = 6.0;
/// Kerfs that the scale has a tick for.
const SCALE: [f64; 5] = [0.1, 0.15, 0.2, 0.25, 0.3];

/// Materials and thicknesses of lamellae, each once, in order.
pub fn sections(lamellae: &[LamellaRecord]) -> Vec<CouponSection> {
    let mut sections: Vec<CouponSection> = lamellae
        .iter()
        .map(|lamella| CouponSection {
            material: lamella.material.clone(),
            thickness: lamella.thickness,
        })
        .collect();
    sort(&mut sections);
    sections
}

/// Each section once, in order of material and thickness.
pub fn sort(sections: &mut Vec<CouponSection>) {
    sections
        .sort_by(|a, b| (a.material.cmp(&b.material)).then(a.thickness.total_cmp(&b.thickness)));
    sections.dedup();
}

/// Gap that the bars of the frame leave for a kerf.
pub fn gap(kerf: f64) -> f64 {
    f64::from(BARS + 1) * kerf
}

/// Draws the coupon of a section.
pub fn draw(section: &CouponSection, hardware: &Hardware, colours: ColourPreset) -> Drawing {
    let bolt = hardware.bolt.diameter * MM;
    let slider = hardware.shell.as_ref().map_or(bolt, |s| s.diameter * MM);
    let pitch = (slider + SLIDE + WEB).max(LETTERS * 4.0);
    let row = pitch * f64::from(STEPS + 1);
    let frame = BAR * f64::from(BARS);
    let width = row.max(frame) + 2.0 * BORDER;
    let largest = slider + STEP * f64::from(STEPS);
    let rise = largest + LETTERS + 2.0 * WEB;
    let height = 3.0 * BORDER + FRAME + 2.5 * LETTERS + 2.0 * rise + 2.0 * LETTERS;
    let thickness = super::sheet::trim(section.thickness * MM);
    let title = format!(
        "coupon {} {thickness} mm, nominal geometry",
        section.material
    );
    let mut drawing = Drawing::new(title, [width, height], Palette::Cut(colours));

    let engrave = |drawing: &mut Drawing, text: String, at: [f64; 2], anchor: Anchor| {
        let text = Text::new(text, at, LETTERS).anchored(anchor);
        drawing.draw(Layer::Engrave, "", text);
    };
    let heading = format!("{} {thickness} mm", section.material);
    let top = height - BORDER - LETTERS;
    engrave(&mut drawing, heading, [BORDER, top], Anchor::Start);
    scale(&mut drawing, BORDER + frame, BORDER + FRAME);

    // Rows of openings above the frame: notches and their holes for what slides, then the bolt.
    let first = 2.0 * BORDER + FRAME + 2.5 * LETTERS;
    for (number, (name, size, slide)) in [("bolt", bolt, 0.0), ("slide", slider, SLIDE)]
        .into_iter()
        .enumerate()
    {
        let y = first + rise * number as f64 + 0.5 * largest;
        for step in 0..=STEPS {
            let play = STEP * f64::from(step);
            let x = BORDER + pitch * (f64::from(step) + 0.5);
            let at = [x, y + 0.5 * largest + 0.5 * WEB];
            let text = if step == 0 {
                format!("{name} {}", super::sheet::trim(size))
            } else {
                format!("+{play:.2}")
            };
            engrave(&mut drawing, text, at, Anchor::Middle);
        }
        for step in 0..=STEPS {
            let radius = 0.5 * (size + STEP * f64::from(step));
            let x = BORDER + pitch * (f64::from(step) + 0.5);
            let shape = if slide > 0.0 {
                Path::slot(x - 0.5 * slide, x + 0.5 * slide, y, radius).into()
            } else {
                Shape::Circle {
                    centre: [x, y],
                    radius,
                }
            };
            drawing.draw(Layer::CutInner, "", shape);
        }
    }
    // The lines between the bars before the frame that lets them fall.
    for bar in 1..BARS {
        let x = BORDER + BAR * f64::from(bar);
        let line = [[x, BORDER], [x, BORDER + FRAME]];
        drawing.draw(Layer::CutInner, "", Path::polyline(&line, Closure::Open));
    }
    let frame = Path::rectangle([BORDER, BORDER], [BORDER + frame, BORDER + FRAME]);
    drawing.draw(Layer::CutInner, "", frame);
    drawing.draw(
        Layer::CutOuter,
        "",
        Path::rectangle([0.0; 2], [width, height]),
    );
    drawing
}

/// Ticks at the right end of the frame: bars pushed to the left, the last one ends at the tick of
/// the kerf.
fn scale(drawing: &mut Drawing, right: f64, above: f64) {
    for (i, kerf) in SCALE.into_iter().enumerate() {
        let x = right - gap(kerf);
        let long = i % 2 == 0;
        let tick = if long { 0.8 * LETTERS } else { 0.5 * LETTERS };
        let line = [[x, above + 0.5], [x, above + 0.5 + tick]];
        drawing.draw(Layer::Engrave, "", Path::polyline(&line, Closure::Open));
    }
    let [most, least] = [SCALE[SCALE.len() - 1], SCALE[0]];
    let y = above + 0.5 + LETTERS;
    for (kerf, anchor, text) in [
        (most, Anchor::End, format!("kerf {most}")),
        (least, Anchor::Start, format!("{least}")),
    ] {
        let at = [right - gap(kerf), y];
        let text = Text::new(text, at, 0.9 * LETTERS).anchored(anchor);
        drawing.draw(Layer::Engrave, "", text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::model::{Bolt, Shell};

    fn hardware(shell: Option<f64>) -> Hardware {
        Hardware {
            bolt: Bolt {
                name: "M4".to_owned(),
                diameter: 0.004,
            },
            sticker: None,
            shell: shell.map(|diameter| Shell {
                name: "brass".to_owned(),
                diameter,
                wall: 0.00045,
            }),
        }
    }

    #[test]
    fn a_coupon_has_the_frame_with_its_bars_and_two_rows_of_openings() {
        let section = CouponSection {
            material: "poplar-plywood".to_owned(),
            thickness: 0.003,
        };
        let drawing = draw(&section, &hardware(Some(0.005)), ColourPreset::RedCut);
        let bounds = drawing.bounds();
        assert!(bounds.min == [0.0; 2] && bounds.max == drawing.size);
        let count = |wanted: fn(&Shape) -> bool| {
            let inner = drawing
                .entities
                .iter()
                .filter(|e| e.layer == Layer::CutInner);
            inner.filter(|e| wanted(&e.shape)).count()
        };
        assert_eq!(count(|s| matches!(s, Shape::Circle { .. })), 9);
        let open = |s: &Shape| matches!(s, Shape::Path(p) if p.closed == Closure::Open);
        assert_eq!(count(open), 9);
        // Nine notches and the frame.
        assert_eq!(
            count(|s| matches!(s, Shape::Path(p) if p.closed == Closure::Closed)),
            10
        );
    }

    #[test]
    fn a_gap_of_eleven_kerfs_stays_beside_the_bars() {
        // Length that is left of the frame, and of the bars in it.
        let kerf = 0.2;
        let frame = f64::from(BARS) * BAR + kerf;
        let bars = f64::from(BARS) * (BAR - kerf);
        assert!((frame - bars - gap(kerf)).abs() < 1e-12);
    }

    #[test]
    fn each_section_has_one_coupon() {
        let section = |material: &str, thickness| CouponSection {
            material: material.to_owned(),
            thickness,
        };
        let mut all = vec![
            section("b", 0.003),
            section("a", 0.004),
            section("b", 0.003),
        ];
        sort(&mut all);
        assert_eq!(all, [section("a", 0.004), section("b", 0.003)]);
    }
}
