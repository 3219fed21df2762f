//! Setting out: where on the ground the supports stand, for people with tapes and a line.
//!
//! The two supports that are farthest apart span the base line: the first is the origin, x runs
//! to the second, y to the left of that. Every other support is found by two tapes, from the one
//! and from the other end of the base line; distances along the rim check the result. Heights are
//! above the level ground. The arrow at a support shows where its contact face falls to.
//!
//! The drawing is in millimetres at full size, seen from above, the base line level.

use super::super::drawing::{
    Anchor, Bounds, Closure, Drawing, Layer, Palette, Path, Shape, Text, Tile, upright,
};
use super::super::stroke_font;
use super::super::units::MM;
use crate::plan::{Plan, SupportRecord};
use crate::project::model::SupportKind;

/// A support on the ground. Millimetres and degrees.
#[derive(Debug, Clone, PartialEq)]
pub struct Station<'a> {
    /// What stands there.
    pub support: &'a SupportRecord,
    /// Along the base line and to its left.
    pub at: [f64; 2],
    /// Distances from the two ends of the base line.
    pub tapes: [f64; 2],
    /// Direction in which its contact face falls, counter-clockwise from the base line.
    pub falls: f64,
}

/// The ground plan.
#[derive(Debug, Clone, PartialEq)]
pub struct SettingOut<'a> {
    /// In the order of the plan's supports.
    pub stations: Vec<Station<'a>>,
    /// Indices of the ends of the base line.
    pub base: [usize; 2],
    /// Direction of the base line in the frame of the surface, radians.
    direction: f64,
    origin: [f64; 2],
}

impl<'a> SettingOut<'a> {
    /// None for fewer than two supports, or where all stand on one point.
    pub fn new(supports: &'a [SupportRecord]) -> Option<Self> {
        let flat = |record: &SupportRecord| [record.position[0] * MM, record.position[1] * MM];
        let mut base = [0, 0];
        let mut longest = 0.0;
        for (i, a) in supports.iter().enumerate() {
            for (j, b) in supports.iter().enumerate().skip(i + 1) {
                let length = distance(flat(a), flat(b));
                // Of equal ones, which rounding tells apart at random, the first is taken.
                if length > longest + 1e-3 {
                    (base, longest) = ([i, j], length);
                }
            }
        }
        if longest == 0.0 {
            return None;
        }
        let [origin, end] = base.map(|i| flat(&supports[i]));
        let direction = libm::atan2(end[1] - origin[1], end[0] - origin[0]);
        let mut setting = Self {
            stations: Vec::new(),
            base,
            direction,
            origin,
        };
        setting.stations = supports
            .iter()
            .map(|support| {
                let place = flat(support);
                let turned = (support.azimuth - direction.to_degrees()).rem_euclid(360.0);
                Station {
                    support,
                    at: setting.local(place),
                    tapes: [distance(place, origin), distance(place, end)],
                    falls: turned,
                }
            })
            .collect();
        Some(setting)
    }

    /// From the frame of the surface, millimetres, to that of the base line.
    fn local(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.direction);
        let [dx, dy] = [x - self.origin[0], y - self.origin[1]];
        [cos * dx + sin * dy, cos * dy - sin * dx]
    }

    /// Mean of all stations.
    fn middle(&self) -> [f64; 2] {
        let count = self.stations.len() as f64;
        [0, 1].map(|i| self.stations.iter().map(|s| s.at[i]).sum::<f64>() / count)
    }

    /// Letters of names, which stand like rays: no higher than neighbours leave room for.
    fn name_height(&self, letters: f64) -> f64 {
        let around = self.around();
        let next = around.iter().cycle().skip(1);
        let gaps = around.iter().zip(next).map(|(a, b)| distance(a.at, b.at));
        let least = gaps.filter(|gap| *gap > 0.0).fold(f64::INFINITY, f64::min);
        letters.min(0.6 * least)
    }

    /// Stations in order around their middle: neighbours along the rim of a convex structure.
    fn around(&self) -> Vec<&Station<'a>> {
        let middle = self.middle();
        let mut order: Vec<&Station<'_>> = self.stations.iter().collect();
        order.sort_by(|a, b| {
            let angle = |s: &Station<'_>| libm::atan2(s.at[1] - middle[1], s.at[0] - middle[0]);
            angle(a).total_cmp(&angle(b))
        });
        order
    }
}

/// A support without what all names of supports share.
pub fn short_name(support: &SupportRecord) -> &str {
    &support.at
}

/// Draws the ground plan.
pub fn draw(plan: &Plan) -> Option<Drawing> {
    let setting = SettingOut::new(&plan.supports)?;
    let mut bounds = Bounds::EMPTY;
    for station in &setting.stations {
        bounds.add(station.at);
    }
    for edge in &plan.edges {
        for point in &edge.polyline {
            bounds.add(setting.local([point[0] * MM, point[1] * MM]));
        }
    }
    let [width, height] = bounds.size();
    let extent = width.max(height);
    let letters = extent / 60.0;
    let mut drawing = Drawing::new(
        format!("{}: setting out of the supports", plan.name),
        [0.0; 2],
        Palette::People,
    );
    drawing.pen = extent / 600.0;
    for edge in &plan.edges {
        let points: Vec<[f64; 2]> = edge
            .polyline
            .iter()
            .map(|point| setting.local([point[0] * MM, point[1] * MM]))
            .collect();
        drawing.draw(
            Layer::Gridline,
            &edge.id,
            Path::polyline(&points, Closure::Open),
        );
    }
    let height = setting.name_height(letters);
    let mut taken = Vec::new();
    for station in &setting.stations {
        let name = name(&setting, station, letters, height);
        let arrow = tip(station, letters);
        taken.extend(arrow.map(|tip| Tile::along([station.at, tip], 0.7 * letters)));
        taken.push(Tile::of_text(&name));
        draw_station(&mut drawing, station, letters);
        drawing.draw(Layer::Halo, &station.support.id, name.clone());
        drawing.draw(Layer::Label, &station.support.id, name);
    }
    distances(&mut drawing, &setting, letters, &mut taken);
    let table_top = drawing.bounds().min[1] - 3.0 * letters;
    draw_table(&mut drawing, plan, &setting, table_top, letters);
    let all = drawing.bounds();
    let border = 2.0 * letters;
    let shift = [border - all.min[0], border - all.min[1]];
    for entity in &mut drawing.entities {
        entity.shape = entity.shape.translated(shift);
    }
    let [width, height] = all.size();
    drawing.size = [width + 2.0 * border, height + 2.0 * border];
    Some(drawing)
}

/// Where along its line a distance stands, and how far from it, in letter heights: the first of
/// these where nothing else does.
const SHARES: [f64; 7] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8];
const LIFTS: [f64; 4] = [0.4, -1.4, 1.0, -2.0];

/// The base line, and the distances between neighbours, clear of names and arrows, and of feet where
/// there is room.
fn distances(drawing: &mut Drawing, setting: &SettingOut<'_>, letters: f64, taken: &mut Vec<Tile>) {
    let feet: Vec<Tile> = setting.stations.iter().map(foot).collect();
    let base = setting.base.map(|i| &setting.stations[i]);
    let around = setting.around();
    let mut pairs: Vec<(Layer, [&Station<'_>; 2])> = Vec::new();
    for (i, station) in around.iter().enumerate() {
        let next = around[(i + 1) % around.len()];
        let is_base = |pair: [&Station<'_>; 2]| pair == base || [pair[1], pair[0]] == base;
        // Two stations are neighbours once.
        if !is_base([*station, next]) && around.len() > 2 {
            pairs.push((Layer::Axis, [*station, next]));
        }
    }
    pairs.push((Layer::Side, base));
    for (layer, [a, b]) in pairs {
        let line = [a.at, b.at];
        drawing.draw(layer, "", Path::polyline(&line, Closure::Open));
        let [dx, dy] = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
        let length = libm::hypot(dx, dy);
        let (angle, _) = upright(libm::atan2(dy, dx));
        let (sin, cos) = libm::sincos(angle);
        let size = letters.min(0.6 * length / stroke_font::width("00000"));
        let text = |[share, lift]: [f64; 2]| {
            let lift = lift * size;
            let at = [
                a.at[0] + share * dx - lift * sin,
                a.at[1] + share * dy + lift * cos,
            ];
            Text::new(format!("{length:.0}"), at, size)
                .anchored(Anchor::Middle)
                .turned(angle)
        };
        let mut places = LIFTS
            .into_iter()
            .flat_map(|lift| SHARES.into_iter().map(move |share| [share, lift]));
        let is_clear = |of: &[Tile], place: [f64; 2]| {
            let tile = Tile::of_text(&text(place));
            !of.iter().any(|other| other.overlaps(&tile))
        };
        let place = places
            .clone()
            .find(|place| is_clear(&feet, *place) && is_clear(taken, *place))
            .or_else(|| places.find(|place| is_clear(taken, *place)))
            .unwrap_or([SHARES[0], LIFTS[0]]);
        let text = text(place);
        taken.push(Tile::of_text(&text));
        drawing.draw(Layer::Halo, "", text.clone());
        drawing.draw(Layer::Label, "", text);
    }
}

/// Where the arrow of a support ends; level ones have none.
fn tip(station: &Station<'_>, letters: f64) -> Option<[f64; 2]> {
    let (sin, cos) = libm::sincos(station.falls.to_radians());
    let [x, y] = station.at;
    let reach = 2.6 * letters;
    (station.support.tilt > 0.05).then_some([x + reach * cos, y + reach * sin])
}

/// Where the foot of a support stands.
fn foot(station: &Station<'_>) -> Tile {
    let foot = station.support.body.map_or(0.0, |body| body.foot * MM);
    let (sin, cos) = libm::sincos(station.falls.to_radians());
    let [x, y] = station.at;
    let half = 0.5 * foot;
    let ends = [-half, half].map(|r| [x + r * cos, y + r * sin]);
    Tile::along(ends, foot)
}

fn draw_station(drawing: &mut Drawing, station: &Station<'_>, letters: f64) {
    let support = station.support;
    let [x, y] = station.at;
    let (sin, cos) = libm::sincos(station.falls.to_radians());
    if let Some(body) = support.body {
        let half = 0.5 * body.foot * MM;
        let outline: Shape = if support.kind == SupportKind::Printed {
            Shape::Circle {
                centre: [x, y],
                radius: half,
            }
        } else {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[p, q]| {
                let [p, q] = [half * p, half * q];
                [x + cos * p - sin * q, y + sin * p + cos * q]
            });
            Path::polyline(&corners, Closure::Closed).into()
        };
        drawing.draw(Layer::LamellaV, &support.id, outline);
    }
    let arm = 0.6 * letters;
    for line in [[[x - arm, y], [x + arm, y]], [[x, y - arm], [x, y + arm]]] {
        drawing.draw(
            Layer::Bolt,
            &support.id,
            Path::polyline(&line, Closure::Open),
        );
    }
    if let Some(tip) = tip(station, letters) {
        let barb = |side: f64| {
            let back = [-0.7 * letters, side * 0.35 * letters];
            [
                tip[0] + cos * back[0] - sin * back[1],
                tip[1] + sin * back[0] + cos * back[1],
            ]
        };
        for line in [vec![[x, y], tip], vec![barb(1.0), tip, barb(-1.0)]] {
            drawing.draw(
                Layer::CurveU,
                &support.id,
                Path::polyline(&line, Closure::Open),
            );
        }
    }
}

/// The name outside, away from the lines, readable from below or from the right.
fn name(setting: &SettingOut<'_>, station: &Station<'_>, letters: f64, height: f64) -> Text {
    let support = station.support;
    let middle = setting.middle();
    let mut ray = [station.at[0] - middle[0], station.at[1] - middle[1]];
    let length = libm::hypot(ray[0], ray[1]);
    ray = if length > 0.0 {
        ray.map(|v| v / length)
    } else {
        [1.0, 0.0]
    };
    let foot = support.body.map_or(0.0, |body| 0.75 * body.foot * MM);
    let away = foot.max(3.0 * letters) + 0.6 * letters;
    let (angle, is_turned) = upright(libm::atan2(ray[1], ray[0]));
    let anchor = if is_turned {
        Anchor::End
    } else {
        Anchor::Start
    };
    let (sin, cos) = libm::sincos(angle);
    let drop = 0.5 * height;
    let at = [
        station.at[0] + away * ray[0] + drop * sin,
        station.at[1] + away * ray[1] - drop * cos,
    ];
    Text::new(short_name(support), at, height)
        .anchored(anchor)
        .turned(angle)
}

/// Title, table and how to read it.
fn draw_table(
    drawing: &mut Drawing,
    plan: &Plan,
    setting: &SettingOut<'_>,
    top: f64,
    letters: f64,
) {
    let [a, b] = setting
        .base
        .map(|i| short_name(setting.stations[i].support));
    let small = 0.8 * letters;
    let mut y = top;
    let mut line = |words: &str, size: f64, layer: Layer| {
        drawing.draw(layer, "", Text::new(words, [0.0, y], size));
        y -= 1.9 * size;
    };
    line(
        &format!(
            "{}: supports on level ground, seen from above, mm",
            plan.name
        ),
        1.2 * letters,
        Layer::Title,
    );
    line(
        &format!(
            "base line from {a} to {b}, x along it, y to its left. Contact faces fall to the arrows."
        ),
        small,
        Layer::Title,
    );
    let header = [
        "support".to_owned(),
        "x".to_owned(),
        "y".to_owned(),
        format!("from {a}"),
        format!("from {b}"),
        "height".to_owned(),
        "tilt °".to_owned(),
        "falls to °".to_owned(),
    ];
    let rows: Vec<[String; 8]> = std::iter::once(header)
        .chain(setting.stations.iter().map(row))
        .collect();
    y -= 0.5 * letters;
    let mut right = 0.0;
    for column in 0..8 {
        let widest = rows
            .iter()
            .map(|row| stroke_font::width(&row[column]) * small)
            .fold(0.0, f64::max);
        right += widest;
        for (number, row) in rows.iter().enumerate() {
            let (x, anchor) = if column == 0 {
                (0.0, Anchor::Start)
            } else {
                (right, Anchor::End)
            };
            let layer = if number == 0 {
                Layer::Title
            } else {
                Layer::Label
            };
            let at = [x, y - 1.9 * small * number as f64];
            drawing.draw(
                layer,
                "",
                Text::new(&row[column], at, small).anchored(anchor),
            );
        }
        right += 2.5 * small;
    }
}

fn row(station: &Station<'_>) -> [String; 8] {
    let whole = |v: f64| {
        let text = format!("{v:.0}");
        if text == "-0" { "0".to_owned() } else { text }
    };
    let support = station.support;
    let falls = if support.tilt > 0.05 {
        format!("{:.1}", station.falls)
    } else {
        "level".to_owned()
    };
    [
        short_name(support).to_owned(),
        whole(station.at[0]),
        whole(station.at[1]),
        whole(station.tapes[0]),
        whole(station.tapes[1]),
        format!("{:.1}", support.height * MM),
        format!("{:.1}", support.tilt),
        falls,
    ]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}
