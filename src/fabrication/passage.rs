//! Passage: a sheet that is longer than the bed, as one cut file a window.
//!
//! Windows overlap, so where one ends and the next begins is each part's own matter: the *seam* of
//! a part lies in the overlap, as near to its middle as openings, labels, joints and ends of that
//! part allow. Everything left of the seam is cut in one window, everything right of it in the
//! next; openings and labels are never divided. Outlines are, on their straight edges: both
//! windows cut half a millimetre over the seam, so that the cuts meet although the panel was moved
//! between them.
//!
//! Two pins hold the panel: the holes for them are cut in one window, and drawn as guides where
//! they are after the push. A window has its own origin, the lower left corner of the bed.

use super::drawing::{Bounds, Closure, Entity, Layer, Path, Segment, Shape, Vertex};
use super::part::Part;
use super::units::MM;
use crate::plan::SheetRecord;

/// Outlines are cut over a seam by half of this in both windows, millimetres.
pub const OVERCUT: f64 = 1.0;
/// From a seam to an opening, label, joint or end, millimetres.
const CLEAR: f64 = 4.0;
/// From a seam to the end of a window, millimetres.
const INSIDE: f64 = 5.0;
/// Seams are sought in steps of this, millimetres.
const STEP: f64 = 1.0;
/// Diameter of the pins, millimetres.
pub const PIN: f64 = 3.0;
/// Least width of the wood around a pin, millimetres.
const PIN_BORDER: f64 = 5.0;

/// From the edge of the panel to a pin at most: pins that are far apart hold the panel straight.
const PIN_FROM_EDGE: f64 = 10.0;

/// A stretch of a panel on the bed, millimetres along the panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Where the bed begins.
    pub from: f64,
    /// Where the bed or the panel ends.
    pub to: f64,
}

/// The windows of a sheet, none if the bed takes it as a whole.
pub fn windows(sheet: &SheetRecord) -> Vec<Window> {
    let window = |w: &crate::plan::WindowRecord| Window {
        from: w.from * MM,
        to: (w.to * MM).min(sheet.length * MM),
    };
    sheet.windows.iter().map(window).collect()
}

/// Where a part is divided: the window that it begins in, and its seams from there on.
#[derive(Debug, Clone, PartialEq)]
pub struct Seams {
    /// Index of the window in which the part begins.
    pub first: usize,
    /// Between the windows that follow, ascending; millimetres along the panel.
    pub at: Vec<f64>,
}

/// Seams of a part whose lower left corner is at `x`.
pub fn seams(part: &Part, x: f64, windows: &[Window]) -> Seams {
    let [start, end] = [x, x + part.length];
    let mut keep: Vec<[f64; 2]> = part
        .shapes
        .iter()
        .filter(|entity| entity.layer != Layer::CutOuter)
        .map(|entity| {
            let bounds = entity.shape.bounds();
            [x + bounds.min[0], x + bounds.max[0]]
        })
        .collect();
    keep.push([start, start + part.ends[0]]);
    keep.push([end - part.ends[1], end]);
    let clear = |at: f64| {
        keep.iter()
            .map(|[from, to]| (from - at).max(at - to))
            .fold(f64::INFINITY, f64::min)
    };
    // The last window that the beginning of the part lies in needs the fewest seams.
    let first = windows
        .iter()
        .rposition(|window| window.from + INSIDE <= start)
        .unwrap_or(0);
    let mut at = Vec::new();
    for pair in windows[first..].windows(2) {
        let [window, next] = [pair[0], pair[1]];
        if end <= window.to - INSIDE {
            break;
        }
        let last = at.last().copied().unwrap_or(start);
        let [low, high] = [
            (next.from + INSIDE).max(last),
            (window.to - INSIDE).min(end),
        ];
        at.push(seam(low, high, clear));
    }
    Seams { first, at }
}

/// The place nearest to the middle that is clear, or the clearest one.
fn seam(low: f64, high: f64, clear: impl Fn(f64) -> f64) -> f64 {
    let middle = 0.5 * (low + high);
    let steps = libm::floor(0.5 * (high - low) / STEP).max(0.0) as u32;
    let mut best = (f64::NEG_INFINITY, middle);
    for step in 0..=steps {
        for at in [-1.0, 1.0].map(|side| middle + side * f64::from(step) * STEP) {
            let clearance = clear(at);
            if clearance >= CLEAR {
                return at;
            }
            if clearance > best.0 {
                best = (clearance, at);
            }
        }
    }
    best.1
}

/// What of a part is cut in a window, in the frame of the panel.
pub fn share(part: &Part, at: [f64; 2], seams: &Seams, window: usize) -> Vec<Entity> {
    let Some(stretch) = window
        .checked_sub(seams.first)
        .filter(|i| *i <= seams.at.len())
    else {
        return Vec::new();
    };
    let low = match stretch {
        0 => f64::NEG_INFINITY,
        i => seams.at[i - 1],
    };
    let high = seams.at.get(stretch).copied().unwrap_or(f64::INFINITY);
    let mut share = Vec::new();
    for entity in &part.shapes {
        let shape = entity.shape.translated(at);
        let is_divided = entity.layer == Layer::CutOuter && !seams.at.is_empty();
        let entity = |shape| Entity {
            layer: entity.layer,
            subject: entity.subject.clone(),
            shape,
        };
        match shape {
            Shape::Path(path) if is_divided => {
                let range = [low - 0.5 * OVERCUT, high + 0.5 * OVERCUT];
                share.extend(clipped(&path, range).into_iter().map(|p| entity(p.into())));
            }
            whole => {
                let Bounds { min, max } = whole.bounds();
                let middle = 0.5 * (min[0] + max[0]);
                if low <= middle && middle < high {
                    share.push(entity(whole));
                }
            }
        }
    }
    share
}

/// Where the pins for the push from a window to the next stand, in the frame of the panel: below
/// and above all parts, whose lowest and highest millimetre is given, in the middle of the overlap.
/// None if there is no wood for them.
pub fn pins(sheet: &SheetRecord, [bottom, top]: [f64; 2], pair: [Window; 2]) -> Vec<[f64; 2]> {
    let x = 0.5 * (pair[1].from + pair[0].to);
    let above = sheet.width * MM - top;
    if bottom < PIN_BORDER || above < PIN_BORDER {
        return Vec::new();
    }
    let [low, high] = [bottom, above].map(|border| (0.5 * border).min(PIN_FROM_EDGE));
    vec![[x, low], [x, sheet.width * MM - high]]
}

/// The stretch of a closed path over a range of x: itself, or open chains.
fn clipped(path: &Path, range: [f64; 2]) -> Vec<Path> {
    let mut chains: Vec<Vec<Segment>> = Vec::new();
    let meet = |a: &Segment, b: &Segment| {
        (a.to[0] - b.from[0]).abs() < 1e-9 && (a.to[1] - b.from[1]).abs() < 1e-9
    };
    for segment in path.segments() {
        for piece in inside(&segment, range) {
            match chains.last_mut() {
                Some(chain) if chain.last().is_some_and(|last| meet(last, &piece)) => {
                    chain.push(piece);
                }
                _ => chains.push(vec![piece]),
            }
        }
    }
    let wraps = match (chains.first(), chains.last()) {
        (Some(first), Some(last)) => last
            .last()
            .zip(first.first())
            .is_some_and(|(last, first)| meet(last, first)),
        _ => false,
    };
    if wraps && chains.len() == 1 {
        return vec![path.clone()];
    }
    if wraps && let Some(mut last) = chains.pop() {
        last.append(&mut chains[0]);
        chains[0] = last;
    }
    chains.iter().map(|chain| open(chain)).collect()
}

/// The pieces of a segment over a range of x. Arcs that stick out are halved until the rest is
/// as good as straight.
fn inside(segment: &Segment, [low, high]: [f64; 2]) -> Vec<Segment> {
    let alone = Path {
        vertices: [(segment.from, segment.bulge), (segment.to, 0.0)]
            .map(|([x, y], bulge)| Vertex { x, y, bulge })
            .into(),
        closed: Closure::Open,
    };
    let Bounds { min, max } = alone.bounds();
    if max[0] < low || min[0] > high {
        return Vec::new();
    }
    if min[0] >= low && max[0] <= high {
        return vec![*segment];
    }
    if segment.bulge != 0.0 && segment.chord() > 0.01 {
        let [a, b] = segment.halves();
        return [inside(&a, [low, high]), inside(&b, [low, high])].concat();
    }
    let [[x0, y0], [x1, y1]] = [segment.from, segment.to];
    let at = |x: f64| {
        let share = ((x - x0) / (x1 - x0)).clamp(0.0, 1.0);
        [x0 + share * (x1 - x0), y0 + share * (y1 - y0)]
    };
    let [from, to] = if x0 < x1 { [low, high] } else { [high, low] };
    vec![Segment {
        from: at(from),
        to: at(to),
        bulge: 0.0,
    }]
}

fn open(chain: &[Segment]) -> Path {
    let vertex = |[x, y]: [f64; 2], bulge| Vertex { x, y, bulge };
    let mut vertices: Vec<Vertex> = chain.iter().map(|s| vertex(s.from, s.bulge)).collect();
    vertices.extend(chain.last().map(|s| vertex(s.to, 0.0)));
    Path {
        vertices,
        closed: Closure::Open,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn windows() -> Vec<Window> {
        [[0.0, 1000.0], [900.0, 1900.0], [1800.0, 2800.0]]
            .map(|[from, to]| Window { from, to })
            .into()
    }

    /// A part of 30 mm width with holes at places from its start.
    fn part(length: f64, holes: &[f64]) -> Part {
        let entity = |layer, shape| Entity {
            layer,
            subject: "w.u01".to_owned(),
            shape,
        };
        let mut shapes: Vec<Entity> = holes
            .iter()
            .map(|&x| {
                let centre = [x, 15.0];
                entity(
                    Layer::CutInner,
                    Shape::Circle {
                        centre,
                        radius: 2.0,
                    },
                )
            })
            .collect();
        let outline = Path::slot(15.0, length - 15.0, 15.0, 15.0);
        shapes.push(entity(Layer::CutOuter, outline.into()));
        Part {
            id: "w.u01".to_owned(),
            length,
            width: 30.0,
            ends: [15.0; 2],
            shapes,
        }
    }

    #[test]
    fn a_seam_avoids_openings_and_ends_near_the_middle_of_the_overlap() {
        let windows = windows();
        let free = seams(&part(1500.0, &[]), 10.0, &windows);
        assert_eq!((free.first, free.at.len()), (0, 1));
        assert_eq!(free.at, [950.0]);
        let holed = seams(&part(1500.0, &[939.0, 944.0]), 10.0, &windows);
        // 6 mm from the centre of the nearer hole, and both are 949 and 954.
        assert!(
            (holed.at[0] - 943.0).abs() <= 1.0 || (holed.at[0] - 960.0).abs() <= 1.0,
            "{holed:?}"
        );
        let short = seams(&part(700.0, &[]), 950.0, &windows);
        assert_eq!((short.first, short.at.len()), (1, 0));
        let through = seams(&part(2700.0, &[]), 10.0, &windows);
        assert_eq!(through.at, [950.0, 1850.0]);
    }

    #[test]
    fn windows_together_cut_everything_once_and_a_millimetre_at_seams_twice() {
        let windows = windows();
        let part = part(2700.0, &[100.0, 940.0, 1840.0, 2600.0]);
        let at = [10.0, 20.0];
        let seams = seams(&part, at[0], &windows);
        let mut length = 0.0;
        let mut holes = 0;
        for (i, window) in windows.iter().enumerate() {
            let share = share(&part, at, &seams, i);
            for entity in &share {
                let bounds = entity.shape.bounds();
                assert!(bounds.min[0] >= window.from && bounds.max[0] <= window.to);
                match &entity.shape {
                    Shape::Path(path) => length += path.length(),
                    _ => holes += 1,
                }
            }
        }
        assert_eq!(holes, 4);
        let outline = Path::slot(15.0, 2685.0, 15.0, 15.0).length();
        // Two seams, two edges each.
        assert!(
            (length - outline - 4.0 * OVERCUT).abs() < 1e-6,
            "{length} {outline}"
        );
    }

    #[test]
    fn an_arc_that_sticks_out_is_cut_on_its_circle() {
        let disc = Path::slot(100.0, 200.0, 0.0, 50.0);
        let [left] = &clipped(&disc, [f64::NEG_INFINITY, 70.0])[..] else {
            panic!("one chain");
        };
        for v in &left.vertices {
            assert!((libm::hypot(v.x - 100.0, v.y) - 50.0).abs() < 1e-3);
        }
        assert!((left.bounds().max[0] - 70.0).abs() < 1e-2);
    }
}
