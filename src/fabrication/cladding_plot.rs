//! The cladding functions of a patch as a figure: where members end on one side, as a function of
//! where they start on the opposite one, both as shares of the sides' lengths, with the members
//! as dots (paper, figure *The influence of the planar angle*). Steep and flat stretches show
//! where members crowd together.

use super::drawing::{Anchor, Closure, Drawing, Layer, Palette, Path, Shape, Text};
use crate::plan::{CladdingFunction, MemberRecord, PatchRecord};
use crate::project::model::Family;

/// Side of the square of the axes, millimetres.
const SIDE: f64 = 100.0;
/// Left and lower border for the axes' names.
const BORDER: f64 = 16.0;
/// Upper and right border.
const HEAD: f64 = 8.0;
/// Band of the legend below the axes' names.
const LEGEND: f64 = 14.0;
/// Height of letters.
const LETTERS: f64 = 3.0;
/// Radius of a member's dot.
const DOT: f64 = 1.1;

/// Draws both functions of a patch with its members.
pub fn draw(patch: &PatchRecord, members: &[&MemberRecord]) -> Drawing {
    let size = [BORDER + SIDE + HEAD, LEGEND + BORDER + SIDE + HEAD];
    let title = format!("cladding functions of {}", patch.id);
    let mut drawing = Drawing::new(title, size, Palette::People);
    axes(&mut drawing);
    for (family, curve, dots) in [
        (Family::U, Layer::CurveU, Layer::DotU),
        (Family::V, Layer::CurveV, Layer::DotV),
    ] {
        let function = match family {
            Family::U => &patch.cladding.u,
            Family::V => &patch.cladding.v,
        };
        let points: Vec<[f64; 2]> = function.samples.iter().copied().map(place).collect();
        drawing.draw(curve, &patch.id, Path::polyline(&points, Closure::Open));
        for member in members.iter().filter(|m| m.family == family) {
            let centre = place([member.start, member.end]);
            let radius = DOT;
            drawing.draw(dots, &member.id, Shape::Circle { centre, radius });
        }
        legend(&mut drawing, family, function);
    }
    drawing
}

/// Shares to the sheet.
fn place([start, end]: [f64; 2]) -> [f64; 2] {
    [BORDER + SIDE * start, LEGEND + BORDER + SIDE * end]
}

fn axes(drawing: &mut Drawing) {
    for quarter in 0..=4 {
        let share = 0.25 * f64::from(quarter);
        let mut line = |layer, from, to| {
            let points = [place(from), place(to)];
            drawing.draw(layer, "", Path::polyline(&points, Closure::Open));
        };
        if quarter % 4 != 0 {
            line(Layer::Gridline, [share, 0.0], [share, 1.0]);
            line(Layer::Gridline, [0.0, share], [1.0, share]);
        }
        let name = ["0", "0.25", "0.5", "0.75", "1"][quarter as usize];
        let [x, y] = place([share, 0.0]);
        drawing.draw(
            Layer::Label,
            "",
            Text::new(name, [x, y - 1.8 * LETTERS], LETTERS).anchored(Anchor::Middle),
        );
        let [x, y] = place([0.0, share]);
        drawing.draw(
            Layer::Label,
            "",
            Text::new(name, [x - 0.6 * LETTERS, y - 0.5 * LETTERS], LETTERS).anchored(Anchor::End),
        );
    }
    let diagonal = [place([0.0; 2]), place([1.0; 2])];
    drawing.draw(
        Layer::Gridline,
        "",
        Path::polyline(&diagonal, Closure::Open),
    );
    drawing.draw(
        Layer::Axis,
        "",
        Path::rectangle(place([0.0; 2]), place([1.0; 2])),
    );
    let [x, y] = place([0.5, 0.0]);
    drawing.draw(
        Layer::Label,
        "",
        Text::new("share of the start side", [x, y - 3.8 * LETTERS], LETTERS)
            .anchored(Anchor::Middle),
    );
    let [x, y] = place([0.0, 0.5]);
    drawing.draw(
        Layer::Label,
        "",
        Text::new("share of the end side", [x - 3.6 * LETTERS, y], LETTERS)
            .anchored(Anchor::Middle)
            .turned(core::f64::consts::FRAC_PI_2),
    );
}

fn legend(drawing: &mut Drawing, family: Family, function: &CladdingFunction) {
    let (name, curve, dots, row) = match family {
        Family::U => ("u", Layer::CurveU, Layer::DotU, 1.0),
        Family::V => ("v", Layer::CurveV, Layer::DotV, 0.0),
    };
    let y = 2.5 + row * 2.0 * LETTERS;
    let middle = y + 0.5 * LETTERS;
    let line = [[BORDER, middle], [BORDER + 10.0, middle]];
    drawing.draw(curve, "", Path::polyline(&line, Closure::Open));
    drawing.draw(
        dots,
        "",
        Shape::Circle {
            centre: [BORDER + 5.0, middle],
            radius: DOT,
        },
    );
    let text = format!(
        "F{name}   slope {:.2} to {:.2}",
        function.slope_min, function.slope_max
    );
    drawing.draw(
        Layer::Label,
        "",
        Text::new(text, [BORDER + 13.0, y], LETTERS),
    );
}
