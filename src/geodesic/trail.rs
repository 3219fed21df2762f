//! Places along a path in space, to see what lies beside it.

use super::unrolled::Tight;
use super::walk::Walk;
use crate::surface::{Point3, SurfacePoint, Vector3};
use std::ops::RangeInclusive;

/// Places along a path where the bound is kept, beside its begin.
pub(super) const PLACES: usize = 24;

/// Crossings of a path that are compared with a trail.
const COMPARED: usize = 8;

/// Places along a geodesic, evenly, with its normals.
#[derive(Debug, Clone)]
pub(super) struct Trail {
    pub(super) points: [Point3; PLACES + 1],
    pub(super) normals: [Vector3; PLACES + 1],
    /// Metres.
    pub(super) length: f64,
    /// The path is no farther from its chords, metres.
    pub(super) sag: f64,
    /// How far the surface along the path stays nearly flat around each place, metres.
    pub(super) flat: [f64; PLACES + 1],
}

/// The least cosine between normals where the surface is nearly flat.
const FLAT: f64 = 0.7;

impl Trail {
    /// A trail over places, with the normals of the surface there.
    pub(super) fn new(
        points: &[Point3; PLACES + 1],
        normals: &[Vector3; PLACES + 1],
        length: f64,
        sag: f64,
    ) -> Self {
        let step = length / PLACES as f64;
        let flat = std::array::from_fn(|i: usize| {
            let alike = |j: usize| normals[i].dot(&normals[j]) > FLAT;
            let ahead = (i + 1..=PLACES).take_while(|&j| alike(j)).count();
            let behind = (0..i).rev().take_while(|&j| alike(j)).count();
            // Beyond an end nobody has looked.
            let ahead = if i + ahead == PLACES {
                usize::MAX
            } else {
                ahead
            };
            let behind = if behind == i { usize::MAX } else { behind };
            match ahead.min(behind) {
                usize::MAX => length,
                places => places as f64 * step,
            }
        });
        Self {
            points: *points,
            normals: *normals,
            length,
            sag,
            flat,
        }
    }

    /// How far a point is from the trail, metres, near a place.
    pub(super) fn distance(&self, point: &Point3, near: usize) -> f64 {
        let far = |i: &usize| (self.points[*i] - point).norm_squared();
        let places = near.saturating_sub(2)..=(near + 2).min(PLACES);
        let nearest = places.min_by(|a, b| far(a).total_cmp(&far(b)));
        let i = nearest.unwrap_or(PLACES);
        let chord = self.points[(i + 1).min(PLACES)] - self.points[i.saturating_sub(1)];
        let out = point - self.points[i];
        let along = out.dot(&chord).powi(2) / chord.norm_squared();
        (out.norm_squared() - along).max(0.0).sqrt()
    }

    /// Which of some places is next to a point, and how far that is, metres.
    pub(super) fn nearest(&self, point: &Point3, places: RangeInclusive<usize>) -> (usize, f64) {
        let (mut nearest, mut least) = (0, f64::INFINITY);
        for i in places {
            let far = (self.points[i] - point).norm_squared();
            if far < least {
                (nearest, least) = (i, far);
            }
        }
        (nearest, least.sqrt())
    }
}

impl Walk<'_> {
    /// Places along the path that was found last.
    pub(super) fn trail(&self, path: &Tight, to: &SurfacePoint) -> Trail {
        let mesh = self.mesh;
        let mut points = [self.from.position(mesh); PLACES + 1];
        let mut normals = [Vector3::zeros(); PLACES + 1];
        let step = path.length / PLACES as f64;
        let mut crossings = Vec::with_capacity(self.unrolled.faces.len() + 2);
        crossings.push((0.0, points[0]));
        let mut face = self.unrolled.first.entry.face();
        let mut next = 0;
        // Places up to a crossing lie on the straight piece from the crossing before.
        let mut go_on = |(along, at): (f64, Point3), into: u32| {
            let (passed, before) = crossings[crossings.len() - 1];
            while next <= PLACES && next as f64 * step <= along {
                let share = (next as f64 * step - passed) / (along - passed);
                let share = if share.is_finite() { share } else { 0.0 };
                points[next] = before + (at - before) * share;
                normals[next] = mesh.face_normal(face);
                next += 1;
            }
            crossings.push((along, at));
            face = into;
        };
        for (leg, crossed) in self.unrolled.legs() {
            for i in crossed {
                let crossing = self.unrolled.crossing(mesh, &leg, i);
                go_on(crossing, self.unrolled.faces[i].entry.face());
            }
        }
        // Rounding may leave the last place beyond the end.
        let last = self.unrolled.last().entry.face();
        go_on((path.length * (1.0 + 1e-9), to.position(mesh)), last);
        let sag = crossings.iter().map(|&(along, at)| {
            let i = ((along / step) as usize).min(PLACES - 1);
            let (chord, out) = (points[i + 1] - points[i], at - points[i]);
            let share = (out.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (out - chord * share).norm()
        });
        let sag = sag.fold(0.0, f64::max);
        Trail::new(&points, &normals, path.length, sag)
    }

    /// How far the path that was found last strays from a trail, metres.
    pub(super) fn strays(&self, path: &Tight, trail: &Trail) -> f64 {
        let mut farthest = 0.0_f64;
        let every = (self.unrolled.faces.len() / COMPARED).max(1);
        for (leg, crossed) in self.unrolled.legs() {
            for i in crossed.filter(|i| i % every == 0) {
                let (along, at) = self.unrolled.crossing(self.mesh, &leg, i);
                let near = (along / path.length * PLACES as f64).round() as usize;
                farthest = farthest.max(trail.distance(&at, near));
            }
        }
        farthest
    }
}
