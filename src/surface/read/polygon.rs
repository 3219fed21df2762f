//! Cuts polygons into triangles: quadrilaterals along the shorter diagonal, larger ones by
//! clipping ears in their mean plane (normal by Newell's method), the best-shaped ear first.

use crate::surface::{Point3, Vector3};
use nalgebra::Vector2;

/// Most corners of a polygon: clipping ears takes their square in time.
pub(super) const MAX_POLYGON: usize = 256;

/// A polygon with less area than this share of its squared size has no plane.
const FLAT: f64 = 1e-9;
/// Diagonals that differ by less than this share count as equal, so that rounding in the file does
/// not decide how a regular grid is cut.
const EQUAL_DIAGONALS: f64 = 1e-6;
/// A triangle with less than this share of its polygon's area has its corners on a line. The ears
/// of a regular polygon with [`MAX_POLYGON`] corners have about 6e-7.
const COLLINEAR: f64 = 1e-12;

/// Why a polygon cannot be cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PolygonFault {
    /// More than [`MAX_POLYGON`] corners.
    TooManyCorners,
    /// No area, hence no plane.
    Flat,
    /// Seen along its normal, it crosses or touches itself.
    Crossing,
}

/// Triangles, as corners of the polygon in its own rotation; consecutive corners must differ.
pub(super) fn cut(corners: &[Point3]) -> Result<Vec<[usize; 3]>, PolygonFault> {
    let n = corners.len();
    if n > MAX_POLYGON {
        return Err(PolygonFault::TooManyCorners);
    }
    if n == 3 {
        return Ok(vec![[0, 1, 2]]);
    }
    let normal = newell(corners);
    let size = (1..n).fold(0.0, |size: f64, i| {
        size.max((corners[i] - corners[0]).norm())
    });
    if normal.norm() <= FLAT * size * size {
        return Err(PolygonFault::Flat);
    }
    if n == 4 {
        cut_quad(corners, &normal)
    } else {
        cut_ears(corners, &normal)
    }
}

/// Twice the vector area of a closed polygon (Newell); the reference point is a corner, for
/// precision far from the origin.
fn newell(corners: &[Point3]) -> Vector3 {
    let origin = corners[0];
    corners
        .windows(2)
        .map(|edge| (edge[0] - origin).cross(&(edge[1] - origin)))
        .sum()
}

fn cut_quad(corners: &[Point3], normal: &Vector3) -> Result<Vec<[usize; 3]>, PolygonFault> {
    let least = COLLINEAR * normal.norm_squared();
    let faces_up = |&[a, b, c]: &[usize; 3]| {
        let [a, b, c] = [a, b, c].map(|i| corners[i]);
        (b - a).cross(&(c - a)).dot(normal) > least
    };
    let along_02 = [[0, 1, 2], [0, 2, 3]];
    let along_13 = [[0, 1, 3], [1, 2, 3]];
    let shorter_13 = (corners[3] - corners[1]).norm()
        < (1.0 - EQUAL_DIAGONALS) * (corners[2] - corners[0]).norm();
    let order = if shorter_13 {
        [along_13, along_02]
    } else {
        [along_02, along_13]
    };
    let fitting = order
        .into_iter()
        .find(|triangles| triangles.iter().all(faces_up));
    Ok(fitting.ok_or(PolygonFault::Crossing)?.to_vec())
}

fn cut_ears(corners: &[Point3], normal: &Vector3) -> Result<Vec<[usize; 3]>, PolygonFault> {
    let flat = project(corners, normal);
    if !is_simple(&flat) {
        return Err(PolygonFault::Crossing);
    }
    let least = COLLINEAR * normal.norm();
    let mut ring: Vec<usize> = (0..corners.len()).collect();
    let mut ears: Vec<Option<f64>> = (0..ring.len())
        .map(|i| ear(&flat, corners, &ring, i, least))
        .collect();
    let mut triangles = Vec::with_capacity(corners.len() - 2);
    while ring.len() > 3 {
        let best = (0..ring.len())
            .filter(|&i| ears[i].is_some())
            .max_by(|&i, &j| {
                // Ties go to the first.
                let (p, q) = (ears[i].unwrap_or(0.0), ears[j].unwrap_or(0.0));
                p.total_cmp(&q).then(j.cmp(&i))
            })
            .ok_or(PolygonFault::Crossing)?;
        triangles.push(around(&ring, best));
        ring.remove(best);
        ears.remove(best);
        let n = ring.len();
        for i in [(best + n - 1) % n, best % n] {
            ears[i] = ear(&flat, corners, &ring, i, least);
        }
    }
    triangles.push([ring[0], ring[1], ring[2]]);
    Ok(triangles)
}

/// A place of the ring with its two neighbours.
fn around(ring: &[usize], i: usize) -> [usize; 3] {
    let n = ring.len();
    [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]]
}

/// How well-shaped the ear at a place of the ring is, if it is one: convex, and no other corner in
/// it or on its rim.
fn ear(
    flat: &[Vector2<f64>],
    corners: &[Point3],
    ring: &[usize],
    i: usize,
    least: f64,
) -> Option<f64> {
    let tip = around(ring, i);
    let [a, b, c] = tip.map(|i| flat[i]);
    let convex = turn(&a, &b, &c) > least;
    let empty = || {
        ring.iter().filter(|i| !tip.contains(i)).all(|&i| {
            let p = flat[i];
            turn(&a, &b, &p) < 0.0 || turn(&b, &c, &p) < 0.0 || turn(&c, &a, &p) < 0.0
        })
    };
    (convex && empty()).then(|| {
        let [a, b, c] = tip.map(|i| corners[i]);
        let longest = (b - a).norm_squared();
        let longest = longest.max((c - b).norm_squared());
        let longest = longest.max((a - c).norm_squared());
        (b - a).cross(&(c - a)).norm() / longest
    })
}

/// Coordinates in the plane across the normal, counter-clockwise as the polygon.
fn project(corners: &[Point3], normal: &Vector3) -> Vec<Vector2<f64>> {
    let normal = normal.normalize();
    let x = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    let y = normal.cross(&x);
    corners
        .iter()
        .map(|p| p - corners[0])
        .map(|d| Vector2::new(d.dot(&x), d.dot(&y)))
        .collect()
}

/// Twice the signed area of a triangle.
fn turn(a: &Vector2<f64>, b: &Vector2<f64>, c: &Vector2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// Whether no two edges of a polygon meet but neighbours in their common corner.
fn is_simple(flat: &[Vector2<f64>]) -> bool {
    let n = flat.len();
    (0..n).all(|i| {
        let (a, b, c) = (flat[i], flat[(i + 1) % n], flat[(i + 2) % n]);
        let folds_back = turn(&a, &b, &c) == 0.0 && (b - a).dot(&(c - b)) < 0.0;
        // Edges i and j are no neighbours.
        let end = if i == 0 { n - 1 } else { n };
        !folds_back && (i + 2..end).all(|j| !meet([a, b], [flat[j], flat[(j + 1) % n]]))
    })
}

/// Whether two segments have a point in common.
fn meet([a, b]: [Vector2<f64>; 2], [c, d]: [Vector2<f64>; 2]) -> bool {
    let apart = |i: usize| a[i].max(b[i]) < c[i].min(d[i]) || c[i].max(d[i]) < a[i].min(b[i]);
    if apart(0) || apart(1) {
        return false;
    }
    let crosses = |p, q| p <= 0.0 && q >= 0.0 || p >= 0.0 && q <= 0.0;
    crosses(turn(&a, &b, &c), turn(&a, &b, &d)) && crosses(turn(&c, &d, &a), turn(&c, &d, &b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polygon(points: &[[f64; 2]]) -> Vec<Point3> {
        points
            .iter()
            .map(|&[x, y]| Point3::new(x, y, 0.3 * x - 0.2 * y))
            .collect()
    }

    /// Cuts, and checks that the triangles have the polygon's area without a flat or reversed one.
    fn cut_covers(points: &[[f64; 2]]) -> Vec<[usize; 3]> {
        let corners = polygon(points);
        let triangles = cut(&corners).unwrap();
        assert_eq!(triangles.len(), corners.len() - 2);
        let normal = newell(&corners);
        let mut sum = 0.0;
        for t in &triangles {
            let [a, b, c] = t.map(|i| corners[i]);
            let area = (b - a).cross(&(c - a)).dot(&normal.normalize());
            assert!(area > 0.0, "{t:?} of {points:?} is flat or reversed");
            sum += area;
        }
        assert!((sum - normal.norm()).abs() < 1e-12 * normal.norm());
        triangles
    }

    #[test]
    fn quads_take_the_shorter_diagonal_that_lies_inside() {
        let square = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]];
        assert_eq!(cut_covers(&square)[0], [0, 1, 2]);
        let kite = [[0., 0.], [1., -0.3], [4., 0.], [1., 0.3]];
        assert_eq!(cut_covers(&kite)[0], [0, 1, 3]);
        // The shorter diagonal of an arrow lies outside.
        let arrow = [[0., 0.], [1., 2.], [0., 0.5], [-1., 2.]];
        assert_eq!(cut_covers(&arrow)[0], [0, 1, 2]);
        let corner_on_side = [[0., 0.], [1., 0.], [2., 0.], [0., 1.]];
        assert_eq!(cut_covers(&corner_on_side)[0], [0, 1, 3]);
    }

    #[test]
    fn concave_polygons_and_corners_on_sides_are_cut_inside() {
        // L, comb, spiral, and a triangle with two more corners on one side.
        cut_covers(&[[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]]);
        let comb: Vec<_> = (0..40)
            .map(|i| [f64::from(i), if i % 2 == 0 { 1.0 } else { 0.05 }])
            .chain([[39., 0.], [0., 0.]])
            .rev()
            .collect();
        cut_covers(&comb);
        let spiral: Vec<_> = (0..60)
            .map(|i| (i, 1.0))
            .chain((0..60).rev().map(|i| (i, 1.4)))
            .map(|(i, wide)| {
                let (sin, cos) = libm::sincos(f64::from(i) * 0.3);
                let r = wide * (1.0 + f64::from(i) * 0.1);
                [r * cos, r * sin]
            })
            .rev()
            .collect();
        cut_covers(&spiral);
        cut_covers(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.], [1., 2.]]);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

        #[test]
        fn star_shaped_polygons_are_cut_inside(
            radii in prop::collection::vec(0.05..1.0_f64, 3..60), turn in 0.0..7.0_f64,
        ) {
            let step = std::f64::consts::TAU / radii.len() as f64;
            let points: Vec<_> = (0..)
                .zip(&radii)
                .map(|(i, r)| (turn + step * f64::from(i), r))
                .map(|(angle, r)| [r * libm::cos(angle), r * libm::sin(angle)])
                .collect();
            cut_covers(&points);
        }
    }

    #[test]
    fn a_regular_polygon_of_the_most_corners_is_cut() {
        let round: Vec<_> = (0..MAX_POLYGON)
            .map(|i| {
                let angle = std::f64::consts::TAU * i as f64 / MAX_POLYGON as f64;
                [libm::cos(angle), libm::sin(angle)]
            })
            .collect();
        cut_covers(&round);
        let larger = polygon(&vec![[0., 0.]; MAX_POLYGON + 1]);
        assert_eq!(cut(&larger), Err(PolygonFault::TooManyCorners));
    }

    #[test]
    fn polygons_without_inside_are_refused() {
        let faults = [
            // A bow tie of unequal wings, a pentagram, a spike, a corner that touches a side.
            vec![[0., 0.], [2., 2.], [2., 0.], [0., 1.]],
            (0..5)
                .map(|i| f64::from(i) * 0.8 * std::f64::consts::PI)
                .map(|angle| [libm::cos(angle), libm::sin(angle)])
                .collect(),
            vec![[0., 0.], [2., 0.], [4., 0.], [2., 0.], [2., 1.], [0., 1.]],
            vec![[0., 0.], [2., 0.], [2., 2.], [1., 0.], [0., 2.]],
        ];
        for points in faults {
            assert_eq!(
                cut(&polygon(&points)),
                Err(PolygonFault::Crossing),
                "{points:?}"
            );
        }
        let line = [[0., 0.], [1., 1.], [2., 2.], [3., 3.]];
        assert_eq!(cut(&polygon(&line)), Err(PolygonFault::Flat));
        let even_bow_tie = [[0., 0.], [1., 1.], [1., 0.], [0., 1.]];
        assert_eq!(cut(&polygon(&even_bow_tie)), Err(PolygonFault::Flat));
    }
}
