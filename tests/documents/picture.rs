//! A picture of a plan: the lamellae bolted together flat, and unfolded on the surface, at one
//! scale.

use egg::plan::{CrossingRecord, LamellaRecord, MemberRecord, OpeningRecord, Plan};
use egg::project::model::Family;
use std::fmt::Write;

type Point2 = nalgebra::Point2<f64>;
type Point3 = nalgebra::Point3<f64>;
type Vector2 = nalgebra::Vector2<f64>;
type Vector3 = nalgebra::Vector3<f64>;

/// Width of the picture.
const WIDTH: f64 = 800.0;
const MARGIN: f64 = 20.0;
/// Pieces that all lamellae together are drawn in, in space, and the fewest and the most of one.
const PIECES: usize = 2400;
const FEWEST: usize = 8;
const MOST: usize = 24;
/// Where the viewer stands, degrees: from the front (negative y) to the right, and up.
const AZIMUTH: f64 = -28.0;
const ELEVATION: f64 = 32.0;

/// Draws a plan.
pub(crate) fn draw(plan: &Plan) -> String {
    let pictures = [flat(plan), space(plan)].map(|shapes| (Frame::around(&shapes), shapes));
    let widest = pictures.iter().map(|(frame, _)| frame.size().x);
    let scale = (WIDTH - 2.0 * MARGIN) / widest.fold(0.0, f64::max);
    let tall: f64 = pictures.iter().map(|(frame, _)| frame.size().y).sum();
    let height = libm::ceil(scale * tall + 4.0 * MARGIN);
    let mut paths = String::new();
    let mut looks: Vec<Look> = Vec::new();
    let mut top = MARGIN;
    for (frame, shapes) in &pictures {
        let left = (WIDTH - scale * frame.size().x) / 2.0;
        for shape in shapes {
            let known = looks.iter().position(|look| *look == shape.look);
            let look = known.unwrap_or_else(|| {
                looks.push(shape.look.clone());
                looks.len() - 1
            });
            let place = |p: &Point2| {
                let p = p - frame.low;
                [left + scale * p.x, top + scale * (frame.size().y - p.y)]
            };
            shape.write(look, place, &mut paths);
        }
        top += scale * frame.size().y + 2.0 * MARGIN;
    }
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         width=\"{WIDTH}\" height=\"{height}\">\n<style>path{{stroke-width:.6;\
         stroke-linejoin:round}}"
    );
    for (i, Look { fill, edge }) in looks.iter().enumerate() {
        let _ = write!(text, ".c{i}{{fill:{fill};stroke:{edge}}}");
    }
    text.push_str("</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    text.push_str(&paths);
    text.push_str("</svg>\n");
    text
}

/// A filled polygon.
struct Shape {
    outline: Vec<Point2>,
    look: Look,
}

#[derive(Clone, PartialEq)]
struct Look {
    fill: String,
    edge: String,
}

impl Look {
    fn edged(fill: &str) -> Self {
        Self {
            fill: fill.to_owned(),
            edge: "#7a5028".to_owned(),
        }
    }

    fn plain(fill: &str) -> Self {
        Self {
            fill: fill.to_owned(),
            edge: fill.to_owned(),
        }
    }
}

impl Shape {
    fn write(&self, look: usize, place: impl Fn(&Point2) -> [f64; 2], text: &mut String) {
        let _ = write!(text, "<path class=\"c{look}\" d=\"");
        for (i, point) in self.outline.iter().enumerate() {
            let [x, y] = place(point);
            let _ = write!(text, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
        }
        text.push_str("Z\"/>\n");
    }
}

/// A box around shapes.
#[derive(Clone, Copy)]
struct Frame {
    low: Point2,
    high: Point2,
}

impl Frame {
    fn around(shapes: &[Shape]) -> Self {
        let mut frame = Self {
            low: Point2::new(f64::INFINITY, f64::INFINITY),
            high: Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        for point in shapes.iter().flat_map(|shape| &shape.outline) {
            frame.low = frame.low.inf(point);
            frame.high = frame.high.sup(point);
        }
        frame
    }

    fn size(self) -> Vector2 {
        self.high - self.low
    }
}

fn lamella_of<'a>(plan: &'a Plan, member: &MemberRecord) -> &'a LamellaRecord {
    let found = plan.lamellae.iter().find(|l| l.member == member.id);
    found.expect("every member is a lamella")
}

/// Families in drawing order: v lies below u.
fn in_order(plan: &Plan) -> impl Iterator<Item = &MemberRecord> {
    let of = |family: Family| plan.members.iter().filter(move |m| m.family == family);
    of(Family::V).chain(of(Family::U))
}

/// Wood in a light between 0 and 1, in few steps.
fn wood(family: Family, light: f64) -> String {
    let dark = match family {
        Family::U => [150.0, 98.0, 52.0],
        Family::V => [112.0, 70.0, 38.0],
    };
    let bright = match family {
        Family::U => [250.0, 216.0, 160.0],
        Family::V => [226.0, 178.0, 118.0],
    };
    let light = libm::round(16.0 * light) / 16.0;
    let [r, g, b]: [u8; 3] =
        std::array::from_fn(|k| libm::round(dark[k] + light * (bright[k] - dark[k])) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The flat state, patch for patch in rows.
fn flat(plan: &Plan) -> Vec<Shape> {
    let columns = match plan.patches.len() {
        0..=2 => 1,
        3..=8 => 2,
        _ => 3,
    };
    let mut cells: Vec<(Frame, Vec<Shape>)> = flat_patches(plan)
        .into_iter()
        .map(|drawn| (Frame::around(&drawn), drawn))
        .collect();
    let widest = cells.iter().map(|(frame, _)| frame.size().x);
    let pitch = 1.05 * widest.fold(0.0, f64::max);
    let mut shapes = Vec::new();
    let mut below = 0.0;
    for row in cells.chunks_mut(columns) {
        for (column, (frame, drawn)) in row.iter_mut().enumerate() {
            let centre = pitch * (column as f64 - 0.5 * (columns as f64 - 1.0));
            let middle = 0.5 * (frame.low.x + frame.high.x);
            let shift = Vector2::new(centre - middle, below - frame.high.y);
            for point in drawn.iter_mut().flat_map(|shape| &mut shape.outline) {
                *point += shift;
            }
            shapes.append(drawn);
        }
        let tallest = row.iter().map(|(frame, _)| frame.size().y);
        below -= 1.05 * tallest.fold(0.0, f64::max);
    }
    shapes
}

/// Each patch when flat, its long diagonal level.
fn flat_patches(plan: &Plan) -> Vec<Vec<Shape>> {
    let mut patches = Vec::new();
    for patch in &plan.patches {
        let [a, b, c, d] = patch.planar_corners.map(Point2::from);
        let long = if (c - a).norm() > (d - b).norm() {
            c - a
        } else {
            b - d
        };
        let level = nalgebra::Rotation2::rotation_between(&long, &Vector2::x());
        let mut drawn = Vec::new();
        for member in in_order(plan).filter(|m| m.patch == patch.id) {
            let lamella = lamella_of(plan, member);
            let [from, to] = member.planar.map(|p| level * Point2::from(p));
            let along = (to - from).normalize();
            let across = Vector2::new(-along.y, along.x);
            drawn.push(Shape {
                outline: rounded([from, to], lamella.width, lamella.end_margin),
                look: Look::edged(&wood(member.family, 0.85)),
            });
            for opening in &lamella.openings {
                if let OpeningRecord::Notch {
                    from: flat,
                    to: deployed,
                    diameter,
                    ..
                } = opening
                {
                    let half = across * (0.5 * diameter);
                    let [p, q] =
                        [flat.min(*deployed), flat.max(*deployed)].map(|s| from + along * s);
                    let reach = along * (0.5 * diameter);
                    drawn.push(Shape {
                        outline: vec![
                            p - reach - half,
                            q + reach - half,
                            q + reach + half,
                            p - reach + half,
                        ],
                        look: Look::edged("#fffaf0"),
                    });
                }
            }
        }
        patches.push(drawn);
    }
    patches
}

/// The outline of a lamella: ends are half circles, a margin beyond the ends of its member.
fn rounded([from, to]: [Point2; 2], width: f64, margin: f64) -> Vec<Point2> {
    const STEPS: u32 = 6;
    let along = (to - from).normalize();
    let across = Vector2::new(-along.y, along.x);
    let radius = 0.5 * width;
    let cap = |centre: Point2, outwards: f64| {
        (0..=STEPS).map(move |i| {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(i) / f64::from(STEPS));
            centre + (across * -cos + along * sin) * (outwards * radius)
        })
    };
    let reach = along * (margin - radius);
    cap(to + reach, 1.0)
        .chain(cap(from - reach, -1.0))
        .collect()
}

/// The deployed state, from far to near, over its shadow.
fn space(plan: &Plan) -> Vec<Shape> {
    let camera = Camera::new();
    let ground = plan
        .members
        .iter()
        .flat_map(|member| &member.polyline)
        .map(|point| point[2])
        .fold(f64::INFINITY, f64::min);
    let mut shadow = Vec::new();
    let mut quads: Vec<(f64, Shape)> = Vec::new();
    for member in in_order(plan) {
        let lamella = lamella_of(plan, member);
        let ribbon = ribbon(plan, member, lamella);
        let reach = ribbon
            .windows(2)
            .map(|w| (w[1].centre - w[0].centre).norm());
        let piece = reach.fold(0.0, f64::max);
        // Where lamellae cross, the upper one hides the lower.
        let lift = match member.family {
            Family::U => 1.2 * piece,
            Family::V => 0.0,
        };
        let left = ribbon.iter().map(Section::left);
        let right = ribbon.iter().rev().map(Section::right);
        shadow.push(Shape {
            outline: left
                .chain(right)
                .map(|p| camera.see(Point3::new(p.x, p.y, ground)))
                .collect(),
            look: Look::plain("#e6e6e6"),
        });
        for pair in ribbon.windows(2) {
            let corners = [
                pair[0].left(),
                pair[1].left(),
                pair[1].right(),
                pair[0].right(),
            ];
            let normal = (pair[0].normal + pair[1].normal).normalize();
            let light = 0.25 + 0.75 * normal.dot(&camera.light).max(0.0);
            let middle = nalgebra::center(&pair[0].centre, &pair[1].centre);
            quads.push((
                camera.depth(middle) + lift,
                Shape {
                    outline: corners.map(|p| camera.see(p)).to_vec(),
                    look: Look::plain(&wood(member.family, light.min(1.0))),
                },
            ));
        }
    }
    // Rounded, so that a last digit does not decide who hides whom.
    quads.sort_by_key(|(depth, _)| libm::round(1e5 * depth) as i64);
    shadow.extend(quads.into_iter().map(|(_, shape)| shape));
    shadow
}

/// A parallel projection.
struct Camera {
    right: Vector3,
    up: Vector3,
    towards: Vector3,
    light: Vector3,
}

impl Camera {
    fn new() -> Self {
        let (sa, ca) = libm::sincos(f64::to_radians(AZIMUTH));
        let (se, ce) = libm::sincos(f64::to_radians(ELEVATION));
        let right = Vector3::new(ca, sa, 0.0);
        let towards = Vector3::new(sa * ce, -ca * ce, se);
        Self {
            right,
            up: towards.cross(&right),
            towards,
            light: Vector3::new(-0.55, -0.35, 0.75).normalize(),
        }
    }

    fn see(&self, point: Point3) -> Point2 {
        Point2::new(point.coords.dot(&self.right), point.coords.dot(&self.up))
    }

    fn depth(&self, point: Point3) -> f64 {
        point.coords.dot(&self.towards)
    }
}

/// A cross-section of a lamella in space.
struct Section {
    centre: Point3,
    /// Half its width.
    across: Vector3,
    normal: Vector3,
}

impl Section {
    fn left(&self) -> Point3 {
        self.centre + self.across
    }

    fn right(&self) -> Point3 {
        self.centre - self.across
    }
}

/// Sections along a lamella, from end to end.
fn ribbon(plan: &Plan, member: &MemberRecord, lamella: &LamellaRecord) -> Vec<Section> {
    let curve: Vec<Point3> = member.polyline.iter().map(|p| Point3::from(*p)).collect();
    let mut arc = vec![0.0];
    for pair in curve.windows(2) {
        arc.push(arc[arc.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let length = arc[arc.len() - 1];
    let mut normals: Vec<(f64, Vector3)> = plan
        .crossings
        .iter()
        .filter_map(|crossing: &CrossingRecord| {
            let place = match member.family {
                Family::U if crossing.u == member.id => crossing.on_u,
                Family::V if crossing.v == member.id => crossing.on_v,
                _ => return None,
            };
            Some((place.surface, Vector3::from(crossing.normal)))
        })
        .collect();
    normals.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |s: f64| -> Point3 {
        let i = arc[1..arc.len() - 1].partition_point(|a| *a <= s);
        let t = (s - arc[i]) / (arc[i + 1] - arc[i]);
        curve[i] + (curve[i + 1] - curve[i]) * t
    };
    let normal_at = |s: f64| -> Vector3 {
        let i = normals[1..normals.len() - 1].partition_point(|(a, _)| *a <= s);
        let (from, to) = (normals[i], normals[i + 1]);
        let t = ((s - from.0) / (to.0 - from.0)).clamp(0.0, 1.0);
        (from.1 * (1.0 - t) + to.1 * t).normalize()
    };
    let margin = lamella.end_margin;
    let pieces = (PIECES / plan.members.len()).clamp(FEWEST, MOST);
    (0..=pieces)
        .map(|i| {
            let s = -margin + (length + 2.0 * margin) * i as f64 / pieces as f64;
            let step = 0.01 * length;
            let inside = s.clamp(step, length - step);
            let tangent = (at(inside + step) - at(inside - step)).normalize();
            let normal = normal_at(s);
            // Beyond its ends a lamella runs straight on.
            let centre = if s < 0.0 {
                curve[0] + tangent * s
            } else if s > length {
                curve[curve.len() - 1] + tangent * (s - length)
            } else {
                at(s)
            };
            Section {
                centre,
                across: tangent.cross(&normal).normalize() * (0.5 * lamella.width),
                normal,
            }
        })
        .collect()
}
