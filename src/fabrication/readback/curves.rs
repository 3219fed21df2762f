//! Curves as they are read, and whether two files show the same.

use super::{Agreement, Findings, Folder, dxf, svg};
use crate::fabrication::drawing::{Bounds, Closure, Path};
use std::collections::BTreeMap;

/// A drawing that was read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Read {
    /// Width and height of its frame, millimetres.
    pub(super) size: [f64; 2],
    /// In the order of the file.
    pub(super) curves: Vec<Curve>,
}

/// A curve of a drawing; millimetres, y up.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve {
    pub(super) layer: String,
    /// What it belongs to, where the file tells.
    pub(super) subject: Option<String>,
    pub(super) geometry: Geometry,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Geometry {
    Path(Path),
    Circle { centre: [f64; 2], radius: f64 },
}

/// DXF and SVG of a folder by path.
pub(super) type Drawings = BTreeMap<String, Read>;

/// Two files of a drawing may differ by this, millimetres: SVG has four decimals, which add up
/// along a curve.
const SAME: f64 = 1e-3;
/// Places of a curve that are compared.
const PLACES: u32 = 24;

impl Geometry {
    pub(super) fn bounds(&self) -> Bounds {
        match self {
            Self::Path(path) => path.bounds(),
            Self::Circle { centre, radius } => {
                let [x, y] = *centre;
                Path::slot(x, x, y, *radius).bounds()
            }
        }
    }

    /// Enclosed area; none of an open chain.
    pub(super) fn area(&self) -> f64 {
        match self {
            Self::Path(path) if path.closed == Closure::Closed => path.area().abs(),
            Self::Path(_) => 0.0,
            Self::Circle { radius, .. } => core::f64::consts::PI * radius * radius,
        }
    }

    pub(super) fn length(&self) -> f64 {
        match self {
            Self::Path(path) => path.length(),
            Self::Circle { radius, .. } => core::f64::consts::TAU * radius,
        }
    }

    pub(super) fn is_closed(&self) -> bool {
        !matches!(self, Self::Path(path) if path.closed == Closure::Open)
    }

    /// Largest distance of places at the same share of two curves.
    fn distance(&self, other: &Self) -> f64 {
        match (self, other) {
            (
                Self::Circle {
                    centre: a,
                    radius: r,
                },
                Self::Circle {
                    centre: b,
                    radius: s,
                },
            ) => libm::hypot(a[0] - b[0], a[1] - b[1]) + (r - s).abs(),
            (Self::Path(a), Self::Path(b)) if a.closed == b.closed => (0..=PLACES)
                .map(|i| f64::from(i) / f64::from(PLACES))
                .map(|share| {
                    let [p, q] = [a, b].map(|path| at(path, share));
                    libm::hypot(p[0] - q[0], p[1] - q[1])
                })
                .fold(0.0, f64::max),
            _ => f64::INFINITY,
        }
    }
}

/// The place at a share of a path's length.
fn at(path: &Path, share: f64) -> [f64; 2] {
    let mut rest = share * path.length();
    let mut last = path.vertices.first().map_or([0.0; 2], |v| [v.x, v.y]);
    for segment in path.segments() {
        let length = segment.length();
        if rest <= length && length > 0.0 {
            let part = rest / length;
            return segment.arc().map_or_else(
                || {
                    let along =
                        |k: usize| segment.from[k] + part * (segment.to[k] - segment.from[k]);
                    [along(0), along(1)]
                },
                |arc| arc.at(arc.start + part * arc.sweep),
            );
        }
        rest -= length;
        last = segment.to;
    }
    last
}

/// Reads every DXF and SVG of a folder.
pub(super) fn read_all(folder: &Folder, findings: &mut Findings) -> Drawings {
    let mut drawings = Drawings::new();
    for (path, bytes) in folder {
        let reader = match path.rsplit('.').next() {
            Some("dxf") => dxf::read,
            Some("svg") => svg::read,
            _ => continue,
        };
        let text = String::from_utf8_lossy(bytes);
        match reader(&text) {
            Ok(read) => {
                drawings.insert(path.clone(), read);
            }
            Err(why) => findings.unreadable(path, &why),
        }
    }
    drawings
}

/// Every SVG that has a DXF beside it shows the same.
pub(super) fn check_pairs(drawings: &Drawings, agreement: &mut Agreement, findings: &mut Findings) {
    for (path, from_svg) in drawings {
        let Some(stem) = path.strip_suffix(".svg") else {
            continue;
        };
        let Some(from_dxf) = drawings.get(&format!("{stem}.dxf")) else {
            continue;
        };
        match difference(from_svg, from_dxf) {
            Some(how) => findings.drawing(path, &format!("differs from the DXF beside it: {how}")),
            None => agreement.pairs += 1,
        }
    }
}

fn difference(svg: &Read, dxf: &Read) -> Option<String> {
    let sides = [0, 1].map(|k| (svg.size[k] - dxf.size[k]).abs());
    if sides[0].max(sides[1]) > SAME {
        return Some("its frame has another size".to_owned());
    }
    let [left, right] = [by_layer(svg), by_layer(dxf)];
    let layers: Vec<&str> = left.keys().chain(right.keys()).copied().collect();
    for layer in layers {
        let [a, b] = [&left, &right].map(|all| all.get(layer).map_or(&[][..], Vec::as_slice));
        if a.len() != b.len() {
            return Some(format!(
                "{} curves on layer {layer} where the DXF has {}",
                a.len(),
                b.len()
            ));
        }
        for (a, b) in a.iter().zip(b) {
            let distance = a.geometry.distance(&b.geometry);
            if distance > SAME {
                let whose = a.subject.as_deref().unwrap_or("the sheet");
                return Some(if distance.is_finite() {
                    format!("a curve of `{whose}` on layer {layer} is {distance:.3} mm off")
                } else {
                    format!("a curve of `{whose}` on layer {layer} is of another kind")
                });
            }
        }
    }
    None
}

fn by_layer(read: &Read) -> BTreeMap<&str, Vec<&Curve>> {
    let mut layers: BTreeMap<&str, Vec<&Curve>> = BTreeMap::new();
    for curve in &read.curves {
        layers.entry(&curve.layer).or_default().push(curve);
    }
    layers
}
