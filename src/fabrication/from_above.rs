//! The members on the surface, seen from above: a picture of the deployed structure with the
//! names of its anchors and patches. Millimetres at full size, x and y of the surface.

use super::drawing::{Anchor, Bounds, Closure, Drawing, Layer, Palette, Path, Shape, Text};
use super::sheet::trim;
use super::units::MM;
use super::units::round_length;
use crate::plan::{MemberRecord, PatchRecord, PointRecord};
use crate::project::model::Family;

/// Draws members, sides and anchors.
pub fn draw(
    project: &str,
    patches: &[PatchRecord],
    members: &[MemberRecord],
    points: &[PointRecord],
) -> Drawing {
    let mut drawing = Drawing::new(
        format!("{project}: members from above"),
        [1.0; 2],
        Palette::People,
    );
    let mut bounds = Bounds::EMPTY;
    for point in members.iter().flat_map(|member| &member.polyline) {
        bounds.add(flat(*point));
    }
    if bounds.is_empty() {
        return drawing;
    }
    let [width, height] = bounds.size();
    let extent = width.max(height).max(1.0);
    let border = extent / 12.0;
    let place = |[x, y]: [f64; 2]| [x - bounds.min[0] + border, y - bounds.min[1] + border];
    drawing.size = [width + 2.0 * border, height + 2.0 * border];
    drawing.pen = extent / 500.0;
    let letters = extent / 45.0;

    for member in members {
        let layer = match (member.boundary, member.family) {
            (true, _) => Layer::Side,
            (false, Family::U) => Layer::CurveU,
            (false, Family::V) => Layer::CurveV,
        };
        let points: Vec<[f64; 2]> = member.polyline.iter().map(|p| place(flat(*p))).collect();
        drawing.draw(layer, &member.id, Path::polyline(&points, Closure::Open));
    }
    let middle = drawing.size.map(|v| 0.5 * v);
    for point in points {
        let centre = place(flat(point.position));
        let radius = 0.35 * letters;
        drawing.draw(Layer::Bolt, &point.id, Shape::Circle { centre, radius });
        let away = [centre[0] - middle[0], centre[1] - middle[1]];
        let anchor = if away[0] < 0.0 {
            Anchor::End
        } else {
            Anchor::Start
        };
        let at = [
            centre[0] + letters.copysign(away[0]) * 0.8,
            centre[1] + letters.copysign(away[1]) * 0.8 - 0.5 * letters,
        ];
        drawing.draw(
            Layer::Label,
            &point.id,
            Text::new(&point.id, at, letters).anchored(anchor),
        );
    }
    for patch in patches {
        if let Some(centre) = centre(patch, points) {
            let at = place(flat(centre));
            let text = Text::new(&patch.id, [at[0], at[1] - 0.6 * letters], 1.2 * letters)
                .anchored(Anchor::Middle);
            drawing.draw(Layer::Halo, &patch.id, text.clone());
            drawing.draw(Layer::Label, &patch.id, text);
        }
    }
    let bar = round_length(extent / 5.0);
    let y = 0.35 * border;
    let line = [[border, y], [border + bar, y]];
    drawing.draw(Layer::Axis, "", Path::polyline(&line, Closure::Open));
    let text = format!("{} mm   {project}, members from above", trim(bar));
    drawing.draw(
        Layer::Title,
        "",
        Text::new(
            text,
            [border + bar + letters, y - 0.4 * letters],
            0.8 * letters,
        ),
    );
    drawing
}

fn flat([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x * MM, y * MM]
}

/// Mean of a patch's corners.
fn centre(patch: &PatchRecord, points: &[PointRecord]) -> Option<[f64; 3]> {
    let mut sum = [0.0; 3];
    for corner in &patch.corners {
        let point = points.iter().find(|point| point.id == *corner)?;
        for (total, value) in sum.iter_mut().zip(point.position) {
            *total += value / 4.0;
        }
    }
    Some(sum)
}
