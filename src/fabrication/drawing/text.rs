//! Lines of single-stroke text.

use super::{Bounds, Path};
use crate::fabrication::stroke_font;

/// A line of text in the stroke font: one line, no line breaks.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// What it says.
    pub content: String,
    /// Where its anchor stands on the baseline, millimetres.
    pub at: [f64; 2],
    /// Height of a capital letter, millimetres.
    pub height: f64,
    /// Direction of reading, radians counter-clockwise from x.
    pub angle: f64,
    /// Which point of the line `at` is.
    pub anchor: Anchor,
}

/// The direction of reading for a text along a line in a direction, readable from below or from the
/// right, and whether it is against the line.
pub fn upright(angle: f64) -> (f64, bool) {
    let quarter = core::f64::consts::FRAC_PI_2;
    let is_turned = angle > quarter + 1e-9 || angle <= -quarter + 1e-9;
    let turn = if is_turned {
        core::f64::consts::PI
    } else {
        0.0
    };
    (angle + turn, is_turned)
}

/// Which point of the baseline a text is placed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

impl Text {
    /// A horizontal line that starts at a point.
    pub fn new(content: impl Into<String>, at: [f64; 2], height: f64) -> Self {
        Self {
            content: content.into(),
            at,
            height,
            angle: 0.0,
            anchor: Anchor::Start,
        }
    }

    /// The same with another anchor.
    #[must_use]
    pub fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same in another direction, radians.
    #[must_use]
    pub fn turned(self, angle: f64) -> Self {
        Self { angle, ..self }
    }

    /// Its length along the baseline.
    pub fn width(&self) -> f64 {
        stroke_font::width(&self.content) * self.height
    }

    /// What the tool draws.
    pub fn strokes(&self) -> Vec<Path> {
        let (sin, cos) = libm::sincos(self.angle);
        let shift = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * self.width(),
            Anchor::End => -self.width(),
        };
        stroke_font::strokes(&self.content)
            .iter()
            .map(|stroke| {
                stroke.mapped(|[x, y]| {
                    let [x, y] = [x * self.height + shift, y * self.height];
                    [
                        self.at[0] + cos * x - sin * y,
                        self.at[1] + sin * x + cos * y,
                    ]
                })
            })
            .collect()
    }

    /// Smallest box around its strokes.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for stroke in self.strokes() {
            bounds.join(&stroke.bounds());
        }
        bounds
    }
}
