//! A shortest path: where it crosses the mesh, how long it is, how it starts and ends.

use super::charts::Charts;
use super::strip;
use crate::surface::{HalfEdge, Mesh, Point3, SurfacePoint, Tangent};
use serde::{Deserialize, Serialize};

/// A geodesic on a mesh: straight inside faces, straight across edges when these are laid flat,
/// bent only at saddle vertices and at vertices of the border.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// The start, every crossing of an edge or a vertex in order, the end.
    pub points: Vec<SurfacePoint>,
    /// The face between each point and the next; for a piece along an edge, either of its faces.
    pub faces: Vec<u32>,
    /// Metres.
    pub length: f64,
    /// Direction in which the path leaves its start.
    pub start: Tangent,
    /// Direction in which the path arrives at its end, pointing onward.
    pub end: Tangent,
}

/// A straight piece of a path between two points where it may bend.
pub(super) struct Leg {
    pub(super) from: SurfacePoint,
    /// The half-edges of the faces being left.
    pub(super) through: Vec<HalfEdge>,
    pub(super) to: SurfacePoint,
    /// The face of both points if nothing is crossed.
    pub(super) face: u32,
}

impl Path {
    /// Lays straight legs end to end. `None` without legs, or if one is no line.
    pub(super) fn through(mesh: &Mesh, charts: &Charts, legs: &[Leg]) -> Option<Self> {
        let mut path: Option<Self> = None;
        for leg in legs {
            let line = strip::line(mesh, charts, &leg.from, &leg.through, &leg.to, leg.face)?;
            let path = path.get_or_insert_with(|| Self {
                points: vec![leg.from],
                faces: Vec::new(),
                length: 0.0,
                start: line.start,
                end: line.end,
            });
            for (&h, &at) in leg.through.iter().zip(&line.crossings) {
                path.push(SurfacePoint::on_half_edge(mesh, h, at), h.face());
            }
            path.push(leg.to, line.end.face);
            path.length += line.length;
            path.end = line.end;
        }
        path
    }

    /// Continues through a face to a point; crossings at the same vertex are one.
    fn push(&mut self, point: SurfacePoint, face: u32) {
        if self.points.last() != Some(&point) {
            self.points.push(point);
            self.faces.push(face);
        }
    }

    /// Arc length from the start to each of the points, metres.
    pub fn arc_lengths(&self, mesh: &Mesh) -> Vec<f64> {
        let mut lengths = Vec::with_capacity(self.points.len());
        let mut sum = 0.0;
        let mut previous: Option<Point3> = None;
        for point in &self.points {
            let position = point.position(mesh);
            sum += previous.map_or(0.0, |p| (position - p).norm());
            lengths.push(sum);
            previous = Some(position);
        }
        lengths
    }

    /// Positions of the points, metres.
    pub fn polyline(&self, mesh: &Mesh) -> Vec<Point3> {
        self.points.iter().map(|p| p.position(mesh)).collect()
    }

    /// The point at an arc length from the start, metres; clamped to the ends.
    pub fn point_at(&self, mesh: &Mesh, s: f64) -> SurfacePoint {
        let Some((piece, share)) = self.locate(mesh, s) else {
            return self.points[0];
        };
        let (from, to) = (self.points[piece], self.points[piece + 1]);
        if share <= 0.0 {
            return from;
        }
        if share >= 1.0 {
            return to;
        }
        let face = self.faces[piece];
        let mix = from.bary_in(mesh, face).zip(to.bary_in(mesh, face));
        mix.and_then(|(a, b)| {
            let bary = [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * share);
            SurfacePoint::in_face(mesh, face, bary)
        })
        .unwrap_or(from)
    }

    /// Direction of travel at an arc length from the start, metres; clamped to the ends. At a
    /// crossing it is that of the piece which ends there.
    pub fn tangent_at(&self, mesh: &Mesh, s: f64) -> Tangent {
        match self.locate(mesh, s) {
            None | Some((0, _)) => self.start,
            Some((piece, _)) if piece + 1 == self.faces.len() => self.end,
            Some((piece, _)) => {
                let [from, to] = [piece, piece + 1].map(|i| self.points[i].position(mesh));
                Tangent {
                    face: self.faces[piece],
                    direction: (to - from).normalize(),
                }
            }
        }
    }

    /// The same way walked from its end.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let turned = |t: Tangent| Tangent {
            face: t.face,
            direction: -t.direction,
        };
        Self {
            points: self.points.iter().rev().copied().collect(),
            faces: self.faces.iter().rev().copied().collect(),
            length: self.length,
            start: turned(self.end),
            end: turned(self.start),
        }
    }

    /// The piece that holds an arc length, and the share of it that has been passed.
    fn locate(&self, mesh: &Mesh, s: f64) -> Option<(usize, f64)> {
        let last = self.faces.len().checked_sub(1)?;
        let lengths = self.arc_lengths(mesh);
        let piece = lengths[1..].partition_point(|&end| end < s).min(last);
        let (begin, end) = (lengths[piece], lengths[piece + 1]);
        let share = (s - begin) / (end - begin);
        Some((piece, if share.is_nan() { 0.0 } else { share }))
    }
}
