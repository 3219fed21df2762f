//! Rectangles in any direction: whether a name stands on something.

use super::{Anchor, Text};
use crate::fabrication::stroke_font;

/// A rectangle in any direction. Millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tile {
    centre: [f64; 2],
    /// Unit vector along it.
    along: [f64; 2],
    /// Half of its length, and half of its width.
    half: [f64; 2],
}

impl Tile {
    /// Around a line with half of a width on both sides.
    pub fn along([from, to]: [[f64; 2]; 2], width: f64) -> Self {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(dx, dy);
        Self {
            centre: [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])],
            along: if length > 0.0 {
                [dx / length, dy / length]
            } else {
                [1.0, 0.0]
            },
            half: [0.5 * length, 0.5 * width],
        }
    }

    /// Around a text, from what hangs below its line to the top of its capitals.
    pub fn of_text(text: &Text) -> Self {
        let (sin, cos) = libm::sincos(text.angle);
        let length = text.width();
        let [low, high] = [-stroke_font::DESCENT * text.height, text.height];
        let x = match text.anchor {
            Anchor::Start => 0.5 * length,
            Anchor::Middle => 0.0,
            Anchor::End => -0.5 * length,
        };
        let y = 0.5 * (low + high);
        Self {
            centre: [
                text.at[0] + cos * x - sin * y,
                text.at[1] + sin * x + cos * y,
            ],
            along: [cos, sin],
            half: [0.5 * length, 0.5 * (high - low)],
        }
    }

    /// Whether two rectangles share a point: no side of either separates them.
    pub fn overlaps(&self, other: &Self) -> bool {
        let between = [
            other.centre[0] - self.centre[0],
            other.centre[1] - self.centre[1],
        ];
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let reach = |tile: &Self, axis: [f64; 2]| {
            let across = [-tile.along[1], tile.along[0]];
            tile.half[0] * dot(tile.along, axis).abs() + tile.half[1] * dot(across, axis).abs()
        };
        [self.along, other.along]
            .into_iter()
            .flat_map(|[x, y]| [[x, y], [-y, x]])
            .all(|axis| dot(between, axis).abs() <= reach(self, axis) + reach(other, axis))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_in_any_direction_overlap_where_no_side_separates_them() {
        let level = Tile::along([[0.0, 0.0], [10.0, 0.0]], 2.0);
        // Its box overlaps that of the other, its corner does not reach it.
        let diagonal = |x: f64| Tile::along([[x, 2.0], [x + 5.0, 7.0]], 1.0);
        assert!(!level.overlaps(&diagonal(9.0)) && !diagonal(9.0).overlaps(&level));
        let through = Tile::along([[4.0, -3.0], [6.0, 3.0]], 0.1);
        assert!(level.overlaps(&through) && through.overlaps(&level));
        let beside = Tile::along([[0.0, 2.1], [10.0, 2.1]], 2.0);
        assert!(!level.overlaps(&beside));
    }

    #[test]
    fn the_tile_of_a_text_holds_its_strokes() {
        for anchor in [Anchor::Start, Anchor::Middle, Anchor::End] {
            let text = Text::new("u03 gQ", [3.0, 4.0], 2.0)
                .anchored(anchor)
                .turned(0.7);
            let tile = Tile::of_text(&text);
            for stroke in text.strokes() {
                for v in &stroke.vertices {
                    let point = Tile::along([[v.x, v.y], [v.x, v.y]], 1e-9);
                    assert!(tile.overlaps(&point), "{anchor:?} {v:?}");
                }
            }
        }
    }
}
