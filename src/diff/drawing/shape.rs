//! What a drawing is made of, and a canvas that fits around it.

use super::Drawing;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a shape is.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// On both sides and equal.
    Same,
    /// As it was.
    Before,
    /// As it is.
    After,
}

/// A line or an outline, millimetres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Outline {
    /// Straight stretches from the first place to the last.
    Line(Vec<[f64; 2]>),
    /// The same, and back to the first.
    Ring(Vec<[f64; 2]>),
    /// All places nearer than a radius to a stretch; a disc where its ends are one.
    Slot([f64; 2], [f64; 2], f64),
}

/// A shape of a part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Shape {
    /// Id of the part that it belongs to; empty for frames.
    pub part: String,
    /// What it is.
    pub state: State,
    /// Where it is.
    pub outline: Outline,
}

/// Something that went from one place to another, millimetres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Move {
    /// Id of the part.
    pub part: String,
    /// Where it was.
    pub from: [f64; 2],
    /// Where it is.
    pub to: [f64; 2],
    /// How far, in words.
    pub text: String,
}

/// A name, with its middle at a place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Label {
    /// Id of the part that it names; empty for other words.
    pub part: String,
    /// What it says.
    pub text: String,
    /// Millimetres.
    pub at: [f64; 2],
    /// What it names.
    pub state: State,
}

/// A drawing in any frame, to be fitted into its own.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    pub(super) shapes: Vec<Shape>,
    pub(super) moves: Vec<Move>,
    pub(super) labels: Vec<Label>,
}

impl Canvas {
    pub(super) fn draw(&mut self, part: &str, state: State, outline: Outline) {
        self.shapes.push(Shape {
            part: part.to_owned(),
            state,
            outline,
        });
    }

    pub(super) fn label(&mut self, part: &str, state: State, at: [f64; 2]) {
        self.labels.push(Label {
            part: part.to_owned(),
            text: part.to_owned(),
            at,
            state,
        });
    }

    pub(super) fn arrow(&mut self, part: &str, from: [f64; 2], to: [f64; 2], text: String) {
        self.moves.push(Move {
            part: part.to_owned(),
            from,
            to,
            text,
        });
    }

    /// The drawing with its lower left corner, and a border, at the origin. Unchanged shapes are
    /// painted first, what is after last. Nothing if there is nothing to see.
    pub(super) fn fit(mut self, id: String, title: String) -> Option<Drawing> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for shape in &self.shapes {
            for place in shape.outline.places() {
                for axis in 0..2 {
                    low[axis] = low[axis].min(place[axis]);
                    high[axis] = high[axis].max(place[axis]);
                }
            }
        }
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        if !extent.is_finite() || extent <= 0.0 {
            return None;
        }
        let border = 0.05 * extent;
        let place = |[x, y]: [f64; 2]| {
            [
                hundredths(x - low[0] + border),
                hundredths(y - low[1] + border),
            ]
        };
        for shape in &mut self.shapes {
            shape.outline = match &shape.outline {
                Outline::Line(line) => {
                    let line = simplified(line, extent / 4000.0);
                    Outline::Line(line.into_iter().map(place).collect())
                }
                Outline::Ring(ring) => Outline::Ring(ring.iter().copied().map(place).collect()),
                Outline::Slot(a, b, radius) => {
                    Outline::Slot(place(*a), place(*b), hundredths(*radius))
                }
            };
        }
        for arrow in &mut self.moves {
            arrow.from = place(arrow.from);
            arrow.to = place(arrow.to);
        }
        for label in &mut self.labels {
            label.at = place(label.at);
        }
        self.shapes.sort_by_key(|shape| shape.state);
        Some(Drawing {
            id,
            title,
            size: [0, 1].map(|axis| hundredths(high[axis] - low[axis] + 2.0 * border)),
            shapes: self.shapes,
            moves: self.moves,
            labels: self.labels,
        })
    }
}

impl Outline {
    /// Places that it is drawn through.
    fn places(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Line(places) | Self::Ring(places) => places.clone(),
            Self::Slot(a, b, _) => vec![*a, *b],
        }
    }
}

/// Rounded to a hundredth of a millimetre, without a negative zero.
fn hundredths(value: f64) -> f64 {
    (value * 100.0).round() / 100.0 + 0.0
}

/// The line without places that are nearer than `far` to it (Douglas and Peucker, 1973).
fn simplified(line: &[[f64; 2]], far: f64) -> Vec<[f64; 2]> {
    let mut kept = vec![false; line.len()];
    if let (Some(first), true) = (kept.first_mut(), line.len() > 1) {
        *first = true;
    }
    if let Some(last) = kept.last_mut() {
        *last = true;
    }
    let mut stretches = vec![(0, line.len().saturating_sub(1))];
    while let Some((from, to)) = stretches.pop() {
        let farthest = (from + 1..to)
            .map(|i| (off(line[i], line[from], line[to]), i))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, i)) = farthest
            && distance > far
        {
            kept[i] = true;
            stretches.extend([(from, i), (i, to)]);
        }
    }
    let pairs = line.iter().zip(kept);
    pairs
        .filter(|(_, kept)| *kept)
        .map(|(place, _)| *place)
        .collect()
}

/// Distance of a place from a stretch.
fn off(place: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, to) = (
        [b[0] - a[0], b[1] - a[1]],
        [place[0] - a[0], place[1] - a[1]],
    );
    let square = along[0] * along[0] + along[1] * along[1];
    let share = if square > 0.0 {
        ((to[0] * along[0] + to[1] * along[1]) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    libm::hypot(to[0] - share * along[0], to[1] - share * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_its_ends_and_its_corners() {
        let line = [[0.0, 0.0], [1.0, 0.001], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0]];
        assert_eq!(
            simplified(&line, 0.01),
            [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]]
        );
        assert_eq!(simplified(&[[1.0, 1.0]], 0.01), [[1.0, 1.0]]);
        assert!(simplified(&[], 0.01).is_empty());
    }

    #[test]
    fn a_drawing_fits_around_its_shapes_with_the_result_on_top() {
        let mut canvas = Canvas::default();
        let line = |x: f64| Outline::Line(vec![[x, 0.0], [x, 100.0]]);
        canvas.draw("a", State::After, line(-50.0));
        canvas.draw("a", State::Before, line(50.0));
        canvas.draw("b", State::Same, line(0.0));
        let drawing = canvas.fit("above".to_owned(), String::new()).unwrap();
        assert_eq!(drawing.size, [110.0, 110.0]);
        let states: Vec<State> = drawing.shapes.iter().map(|shape| shape.state).collect();
        assert_eq!(states, [State::Same, State::Before, State::After]);
        assert_eq!(
            drawing.shapes[2].outline,
            Outline::Line(vec![[5.0, 5.0], [5.0, 105.0]])
        );
        assert!(
            Canvas::default()
                .fit(String::new(), String::new())
                .is_none()
        );
    }
}
