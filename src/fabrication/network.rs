//! The layout from above: anchors, sides and patches with their names, and which way the families
//! of each patch run. A picture that fits on a page, x and y of the surface.

use super::drawing::{
    Anchor, Bounds, Closure, Drawing, Layer, Palette, Path, Shape, Text, upright,
};
use super::sheet::trim;
use super::units::{MM, round_length};
use crate::plan::{EdgeRecord, PatchRecord, PointRecord};
use serde::Serialize;
use std::collections::BTreeMap;

/// The longer side of the network on the page, millimetres.
const PAGE: f64 = 240.0;

/// A patch by the names of what frames it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NamedQuad {
    /// Its name.
    pub name: String,
    /// Its corners.
    pub corners: [String; 4],
    /// Ids of the edges of its sides 1-2, 2-3, 3-4, 4-1; where there are several, the anchors
    /// between them are T-junctions.
    pub sides: [Vec<String>; 4],
}

impl NamedQuad {
    /// From names.
    pub fn new(name: &str, corners: &[String; 4], sides: [Vec<String>; 4]) -> Self {
        Self {
            name: name.to_owned(),
            corners: corners.clone(),
            sides,
        }
    }

    /// Of a plan.
    pub fn of(patch: &PatchRecord) -> Self {
        let sides = patch.sides.each_ref().map(|side| side.edges.clone());
        Self::new(&patch.id, &patch.corners, sides)
    }
}

/// Draws the network of a structure.
pub fn draw(
    project: &str,
    patches: &[NamedQuad],
    points: &[PointRecord],
    edges: &[EdgeRecord],
) -> Drawing {
    let title = format!("{project}: patches");
    let mut drawing = Drawing::new(title, [1.0; 2], Palette::People);
    let mut bounds = Bounds::EMPTY;
    for place in edges.iter().flat_map(|edge| &edge.polyline) {
        bounds.add(flat(*place));
    }
    if bounds.is_empty() {
        return drawing;
    }
    let size = bounds.size();
    let full = size[0].max(size[1]).max(f64::MIN_POSITIVE);
    let scale = PAGE / full;
    let border = PAGE / 9.0;
    drawing.size = size.map(|length| scale * length + 2.0 * border);
    drawing.pen = PAGE / 500.0;
    let mut sketch = Sketch {
        low: bounds.min,
        scale,
        border,
        letters: PAGE / 50.0,
        drawing,
    };
    for edge in edges {
        sketch.edge(edge);
    }
    let places: BTreeMap<&str, [f64; 2]> = points
        .iter()
        .map(|point| (point.id.as_str(), sketch.place(point.position)))
        .collect();
    for patch in patches {
        sketch.patch(patch, &places, edges);
    }
    for point in points {
        let is_corner = |patch: &NamedQuad| patch.corners.contains(&point.id);
        if patches.iter().any(is_corner) {
            sketch.point(
                &point.id,
                places[point.id.as_str()],
                is_junction(&point.id, patches, edges),
            );
        }
    }
    sketch.scale_bar(project, full);
    sketch.drawing
}

/// Whether an anchor stands inside a side of a patch.
fn is_junction(point: &str, patches: &[NamedQuad], edges: &[EdgeRecord]) -> bool {
    let ends_here = |id: &&String| {
        let mut records = edges.iter().filter(|edge| edge.id == **id);
        records.any(|edge| edge.from == point || edge.to == point)
    };
    patches.iter().any(|patch| {
        let mut sides = patch.sides.iter();
        sides.any(|side| side.iter().filter(ends_here).count() > 1)
    })
}

struct Sketch {
    drawing: Drawing,
    low: [f64; 2],
    scale: f64,
    border: f64,
    letters: f64,
}

impl Sketch {
    fn place(&self, position: [f64; 3]) -> [f64; 2] {
        let full = flat(position);
        std::array::from_fn(|k| self.border + self.scale * (full[k] - self.low[k]))
    }

    /// A name that stands out from what it covers.
    fn name(&mut self, subject: &str, text: Text) {
        self.drawing.draw(Layer::Halo, subject, text.clone());
        self.drawing.draw(Layer::Label, subject, text);
    }

    fn edge(&mut self, edge: &EdgeRecord) {
        let line: Vec<[f64; 2]> = edge.polyline.iter().map(|p| self.place(*p)).collect();
        let path = Path::polyline(&line, Closure::Open);
        self.drawing.draw(Layer::Side, &edge.id, path);
        let (middle, along) = halfway(&line);
        // Along the edge, to be read from below or from the right.
        let (angle, _) = upright(libm::atan2(along[1], along[0]));
        let height = 0.55 * self.letters;
        let (sin, cos) = libm::sincos(angle);
        let at = [
            middle[0] + 0.5 * height * sin,
            middle[1] - 0.5 * height * cos,
        ];
        let text = Text::new(&edge.id, at, height).anchored(Anchor::Middle);
        self.name(&edge.id, text.turned(angle));
    }

    fn patch(
        &mut self,
        patch: &NamedQuad,
        places: &BTreeMap<&str, [f64; 2]>,
        edges: &[EdgeRecord],
    ) {
        let corners = patch
            .corners
            .each_ref()
            .map(|name| places.get(name.as_str()));
        let [Some(a), Some(b), Some(c), Some(d)] = corners else {
            return;
        };
        // Sides may bulge: their middles say better than the corners where the patch is.
        let middles: Vec<[f64; 2]> = patch
            .sides
            .iter()
            .filter_map(|side| {
                let id = side.get(side.len() / 2)?;
                let edge = edges.iter().find(|edge| edge.id == *id)?;
                let line: Vec<[f64; 2]> = edge.polyline.iter().map(|p| self.place(*p)).collect();
                Some(halfway(&line).0)
            })
            .collect();
        let mean = |k: usize| {
            let corners = 0.25 * (a[k] + b[k] + c[k] + d[k]);
            let middles = middles.iter().map(|m| m[k]).sum::<f64>() / middles.len().max(1) as f64;
            0.5 * (corners + middles)
        };
        let height = 1.2 * self.letters;
        let text = Text::new(&patch.name, [mean(0), mean(1) + 0.8 * height], height);
        self.name(&patch.name, text.anchored(Anchor::Middle));
        // Below it, the ways of both families: from side 1-2 to 4-3, and from 1-4 to 2-3.
        let centre = [mean(0), mean(1) - 1.1 * self.letters];
        let u = [0, 1].map(|k| c[k] + d[k] - a[k] - b[k]);
        let v = [0, 1].map(|k| b[k] + c[k] - a[k] - d[k]);
        self.arrow(Layer::CurveU, "u", &patch.name, centre, u);
        self.arrow(Layer::CurveV, "v", &patch.name, centre, v);
    }

    fn arrow(
        &mut self,
        layer: Layer,
        name: &str,
        subject: &str,
        centre: [f64; 2],
        along: [f64; 2],
    ) {
        let length = libm::hypot(along[0], along[1]).max(f64::MIN_POSITIVE);
        let unit = along.map(|x| x / length);
        let half = self.letters;
        let [from, to] = [-half, half].map(|s| [centre[0] + s * unit[0], centre[1] + s * unit[1]]);
        let size = 0.4 * self.letters;
        let barb = |side: f64| {
            [
                to[0] - size * (unit[0] - 0.4 * side * unit[1]),
                to[1] - size * (unit[1] + 0.4 * side * unit[0]),
            ]
        };
        for line in [[from, to], [barb(1.0), to], [barb(-1.0), to]] {
            self.drawing
                .draw(layer, subject, Path::polyline(&line, Closure::Open));
        }
        let height = 0.6 * self.letters;
        let at = [
            to[0] + 0.5 * self.letters * unit[0],
            to[1] + 0.5 * self.letters * unit[1] - 0.5 * height,
        ];
        self.name(
            subject,
            Text::new(name, at, height).anchored(Anchor::Middle),
        );
    }

    /// Corners are round, T-junctions are squares.
    fn point(&mut self, name: &str, at: [f64; 2], junction: bool) {
        let radius = 0.3 * self.letters;
        if junction {
            let corner = |sign: f64| at.map(|x| x + sign * radius);
            let square = Path::rectangle(corner(-1.0), corner(1.0));
            self.drawing.draw(Layer::Bolt, name, square);
        } else {
            let shape = Shape::Circle { centre: at, radius };
            self.drawing.draw(Layer::Bolt, name, shape);
        }
        let middle = 0.5 * self.drawing.size[0];
        let left = at[0] < middle - 0.01 * self.drawing.size[0];
        let (anchor, side) = if left {
            (Anchor::End, -1.0)
        } else {
            (Anchor::Start, 1.0)
        };
        let up = (at[1] - 0.5 * self.drawing.size[1]).signum();
        let place = [
            at[0] + side * 0.6 * self.letters,
            at[1] + up * 0.8 * self.letters - 0.4 * self.letters,
        ];
        self.name(
            name,
            Text::new(name, place, 0.8 * self.letters).anchored(anchor),
        );
    }

    fn scale_bar(&mut self, project: &str, full: f64) {
        let bar = round_length(full / 5.0);
        let y = 0.3 * self.border;
        let end = self.border + self.scale * bar;
        let path = Path::polyline(&[[self.border, y], [end, y]], Closure::Open);
        self.drawing.draw(Layer::Axis, "", path);
        let length = if bar < MM {
            format!("{} mm", trim(bar))
        } else {
            format!("{} m", trim(bar / MM))
        };
        let text = format!("{length}   {project}, patches from above");
        let at = [end + self.letters, y - 0.4 * self.letters];
        let text = Text::new(text, at, 0.8 * self.letters);
        self.drawing.draw(Layer::Title, "", text);
    }
}

fn flat([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x * MM, y * MM]
}

/// The place at half the length of a line, and the direction there.
fn halfway(line: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let along = |w: &[[f64; 2]]| [w[1][0] - w[0][0], w[1][1] - w[0][1]];
    let step = |w: &[[f64; 2]]| libm::hypot(along(w)[0], along(w)[1]);
    let mut left = 0.5 * line.windows(2).map(step).sum::<f64>();
    for pair in line.windows(2) {
        let length = step(pair);
        if left <= length && length > 0.0 {
            let t = left / length;
            let at = std::array::from_fn(|k| pair[0][k] + t * (pair[1][k] - pair[0][k]));
            return (at, along(pair));
        }
        left -= length;
    }
    (line[line.len() / 2], [1.0, 0.0])
}
