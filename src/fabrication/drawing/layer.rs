//! Layers and what they look like.
//!
//! Cut files keep to what laser shops agree on: one pure colour a tool, hairlines, no fills, no
//! greys (drivers engrave them), names of capitals and underscores that DXF layers, SVG groups
//! and Inkscape layers share. Drawings for people have layers and looks of their own.

use crate::project::model::ColourPreset;

/// Every layer of every drawing, in the order in which an SVG paints them. A drawing uses the
/// layers of one of the kinds only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Layer {
    // Cut files.
    /// Sheet frame, reference bar, title: for the eye, never for a tool.
    Guide,
    /// Labels.
    Engrave,
    /// Marks for hand work: scarfs, registration.
    Score,
    /// Openings; cut before the outline, while the part still holds.
    CutInner,
    /// Outlines; cut last.
    CutOuter,
    // Foil sheets.
    /// Numbers for a pen, or for the eye where the plotter has none.
    Pen,
    /// Cuts through the foil that leave its backing whole.
    KissCut,
    /// Cuts through foil and backing.
    ThroughCut,
    // Drawings of lamellae for people.
    /// The panel.
    Sheet,
    /// Lamellae below: the v-family.
    LamellaV,
    /// Lamellae above: the u-family, or the parts on a sheet.
    LamellaU,
    /// Openings of the lamellae above.
    OpeningU,
    /// Openings of the lamellae below, seen through those above.
    OpeningV,
    /// Bolts in the flat state.
    Bolt,
    // Figures.
    /// Grid lines of axes.
    Gridline,
    /// Axes and frames.
    Axis,
    /// Curves of the v-family.
    CurveV,
    /// Curves of the u-family.
    CurveU,
    /// Sides of patches.
    Side,
    /// Members of the v-family.
    DotV,
    /// Members of the u-family.
    DotU,
    // Both of the latter.
    /// Clears what lies under a name.
    Halo,
    /// Names.
    Label,
    /// Title block.
    Title,
}

impl Layer {
    /// Name in every file format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Guide => "GUIDE",
            Self::Engrave => "ENGRAVE",
            Self::Score => "SCORE",
            Self::CutInner => "CUT_INNER",
            Self::CutOuter => "CUT_OUTER",
            Self::Pen => "PEN",
            Self::KissCut => "KISS_CUT",
            Self::ThroughCut => "THROUGH_CUT",
            Self::Sheet => "SHEET",
            Self::LamellaV => "LAMELLA_V",
            Self::OpeningV => "OPENING_V",
            Self::LamellaU => "LAMELLA_U",
            Self::OpeningU => "OPENING_U",
            Self::Bolt => "BOLT",
            Self::Gridline => "GRIDLINE",
            Self::Axis => "AXIS",
            Self::CurveV => "CURVE_V",
            Self::CurveU => "CURVE_U",
            Self::Side => "SIDE",
            Self::DotV => "DOT_V",
            Self::DotU => "DOT_U",
            Self::Halo => "HALO",
            Self::Label => "LABEL",
            Self::Title => "TITLE",
        }
    }

    /// The layer of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|layer| layer.name() == name)
    }

    /// All layers in painting order.
    pub const ALL: [Self; 24] = [
        Self::Guide,
        Self::Engrave,
        Self::Score,
        Self::CutInner,
        Self::CutOuter,
        Self::Pen,
        Self::KissCut,
        Self::ThroughCut,
        Self::Sheet,
        Self::LamellaV,
        Self::LamellaU,
        Self::OpeningU,
        Self::OpeningV,
        Self::Bolt,
        Self::Gridline,
        Self::Axis,
        Self::CurveV,
        Self::CurveU,
        Self::Side,
        Self::DotV,
        Self::DotU,
        Self::Halo,
        Self::Label,
        Self::Title,
    ];
}

/// Who a drawing is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Palette {
    /// A machine, with the colours of a shop.
    Cut(ColourPreset),
    /// People: filled lamellae, legible strokes.
    People,
}

/// The look of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Stroke.
    pub rgb: [u8; 3],
    /// The same in the colour index of DXF.
    pub aci: u8,
    /// Width of the stroke in pens of the drawing.
    pub pen: f64,
    /// Fill of closed shapes, in SVG only.
    pub fill: Option<[u8; 3]>,
    /// Stroke of letters as a share of their height, in SVG only; `None` takes the layer's.
    pub letters: Option<f64>,
}

/// Hairline of cut files, millimetres: thin enough for every driver to take it as a vector.
const HAIRLINE: f64 = 0.01;

const RED: ([u8; 3], u8) = ([255, 0, 0], 1);
const MAGENTA: ([u8; 3], u8) = ([255, 0, 255], 6);
const BLUE: ([u8; 3], u8) = ([0, 0, 255], 5);
const GREEN: ([u8; 3], u8) = ([0, 255, 0], 3);
/// Colour 7 is drawn black on white and white on black.
const BLACK: ([u8; 3], u8) = ([0, 0, 0], 7);
const GREY: ([u8; 3], u8) = ([128, 128, 128], 8);

/// Ink of the u-family, the paper's blue.
const INK_U: ([u8; 3], u8) = ([31, 96, 160], 5);
/// Ink of the v-family, the paper's orange.
const INK_V: ([u8; 3], u8) = ([201, 103, 16], 30);
const WOOD_U: [u8; 3] = [216, 230, 243];
const WOOD_V: [u8; 3] = [250, 229, 206];
const PAPER: [u8; 3] = [255, 255, 255];

impl Palette {
    /// The look of a layer in this palette.
    pub fn style(self, layer: Layer) -> Style {
        match self {
            Self::Cut(preset) => cut_style(preset, layer),
            Self::People => people_style(layer),
        }
    }
}

fn style((rgb, aci): ([u8; 3], u8), pen: f64, fill: Option<[u8; 3]>) -> Style {
    Style {
        rgb,
        aci,
        pen,
        fill,
        letters: None,
    }
}

/// Cut and score swap between the first two presets; the third tells openings from outlines. Engraving
/// is black, what no tool shall touch is the remaining primary that shows on a screen.
fn cut_style(preset: ColourPreset, layer: Layer) -> Style {
    let (outer, inner, score) = match preset {
        ColourPreset::RedCut => (RED, RED, BLUE),
        ColourPreset::BlueCut => (BLUE, BLUE, RED),
        ColourPreset::ByLayer => (RED, BLUE, GREEN),
    };
    let colour = match layer {
        Layer::CutInner => inner,
        Layer::CutOuter | Layer::ThroughCut => outer,
        Layer::Score | Layer::KissCut => score,
        Layer::Engrave | Layer::Pen => BLACK,
        _ => MAGENTA,
    };
    style(colour, HAIRLINE, None)
}

/// Letters are as bold as technical lettering asks for (ISO 3098-B: a tenth of their height).
fn people_style(layer: Layer) -> Style {
    let letters = if layer == Layer::Halo { 0.5 } else { 0.1 };
    Style {
        letters: Some(letters),
        ..plain_people_style(layer)
    }
}

fn plain_people_style(layer: Layer) -> Style {
    match layer {
        Layer::Sheet => style(GREY, 0.25, Some(PAPER)),
        Layer::LamellaU => style(INK_U, 0.25, Some(WOOD_U)),
        Layer::LamellaV => style(INK_V, 0.25, Some(WOOD_V)),
        Layer::OpeningU => style(INK_U, 0.25, Some(PAPER)),
        Layer::OpeningV => style(INK_V, 0.25, None),
        Layer::CurveU => style(INK_U, 0.6, None),
        Layer::CurveV => style(INK_V, 0.6, None),
        Layer::DotU => style(INK_U, 0.2, Some(INK_U.0)),
        Layer::DotV => style(INK_V, 0.2, Some(INK_V.0)),
        Layer::Bolt => style(BLACK, 0.2, Some(BLACK.0)),
        Layer::Gridline => style(([214, 214, 214], 9), 0.18, None),
        Layer::Axis | Layer::Guide => style(GREY, 0.3, None),
        Layer::Side => style(BLACK, 0.8, None),
        Layer::Score | Layer::KissCut => style(BLUE, 0.25, None),
        Layer::Label | Layer::Title | Layer::Engrave | Layer::Pen => style(BLACK, 0.3, None),
        Layer::CutInner | Layer::CutOuter | Layer::ThroughCut => style(RED, 0.25, None),
        Layer::Halo => style((PAPER, 7), 1.0, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_give_every_tool_a_pure_colour_of_its_own() {
        use ColourPreset::{BlueCut, ByLayer, RedCut};
        let tools = [
            Layer::Engrave,
            Layer::Score,
            Layer::CutInner,
            Layer::CutOuter,
        ];
        for (preset, colours) in [(RedCut, 3), (BlueCut, 3), (ByLayer, 4)] {
            let mut seen: Vec<[u8; 3]> = Vec::new();
            for layer in tools {
                let style = Palette::Cut(preset).style(layer);
                assert!(style.rgb.iter().all(|c| matches!(c, 0 | 255)), "{layer:?}");
                assert_eq!(style.fill, None);
                if !seen.contains(&style.rgb) {
                    seen.push(style.rgb);
                }
            }
            assert_eq!(seen.len(), colours, "{preset:?}");
            let guide = Palette::Cut(preset).style(Layer::Guide).rgb;
            assert!(!seen.contains(&guide));
        }
    }
}
