//! Fits a polynomial height function over the tangent plane and reads the curvature from it.
//!
//! The fit is repeated in the tangent plane that it found itself until that stays, so that the
//! first guess of the normal does not matter. It need not pass through the vertex: that damps the
//! rounding of coordinates in files.

use super::VertexCurvature;
use crate::surface::Vector3;
use nalgebra::{Cholesky, Const, SMatrix, SVector};

/// Sensitivity up to which a fit is used without looking wider: a height error of e changes slopes
/// by at most this times e/h and second derivatives by this times e/h². Two full rings of an even
/// triangulation have 0.4, half discs of three rings 3, of four rings 1.5.
const WELL_DETERMINED: f64 = 1.5;

/// The tangent plane stays when its slope is below this. Slopes enter the curvature exactly, only
/// the choice of cubics depends on the plane.
const LEVEL: f64 = 1e-6;
/// A column with a smaller pivot depends on the others but for rounding: points on three lines do
/// not determine a cubic. Quarter discs have 1e-2; the square of 1e-3 leaves 10 of 16 digits.
const DEPENDENT: f64 = 1e-3;
/// Rounds of turning the tangent plane. The slope shrinks by the order of the square of the
/// neighbourhood's turning a round; two to four are usual.
const ROUNDS: usize = 8;

/// Second derivatives of the height over the tangent plane.
#[derive(Debug, Clone)]
pub(super) struct Jet {
    /// Two directions of the tangent plane and the normal.
    frame: [Vector3; 3],
    /// First derivatives, nearly zero.
    slope: [f64; 2],
    /// Derivatives by xx, xy and yy, 1/m.
    second: [f64; 3],
    /// How strongly the derivatives depend on each height, see [`WELL_DETERMINED`].
    pub(super) sensitivity: f64,
}

impl Jet {
    /// A cubic through offsets from a vertex, itself first, if it is well determined.
    pub(super) fn cubic(points: &[Vector3], edge: f64, normal: Vector3) -> Option<Self> {
        Self::level(points, edge, normal, WELL_DETERMINED, |x, y| {
            let (xx, xy, yy) = (x * x, x * y, y * y);
            SVector::from([1.0, x, y, xx, xy, yy, xx * x, xx * y, x * yy, y * yy])
        })
    }

    /// A quadratic, if it is determined better than this jet.
    pub(super) fn better_quadratic(
        &self,
        points: &[Vector3],
        edge: f64,
        normal: Vector3,
    ) -> Option<Self> {
        Self::level(points, edge, normal, self.sensitivity, |x, y| {
            SVector::from([1.0, x, y, x * x, x * y, y * y])
        })
    }

    /// No curvature.
    pub(super) fn flat(normal: Vector3) -> Self {
        Self {
            frame: frame(normal),
            slope: [0.0; 2],
            second: [0.0; 3],
            sensitivity: f64::INFINITY,
        }
    }

    /// Whether no wider look is needed.
    pub(super) fn is_well_determined(&self) -> bool {
        self.sensitivity <= WELL_DETERMINED
    }

    /// Fits in the tangent plane of the fit, if that is less sensitive than `most`. `powers` begins
    /// with 1, x, y, x², xy, y².
    fn level<const N: usize>(
        points: &[Vector3],
        edge: f64,
        normal: Vector3,
        most: f64,
        powers: impl Fn(f64, f64) -> SVector<f64, N>,
    ) -> Option<Self> {
        let mut fit = Fit::new(points, normal, &powers)?;
        let sensitivity = fit.sensitivity(edge);
        if sensitivity > most {
            return None;
        }
        for _ in 1..ROUNDS {
            let [p, q] = fit.slope();
            if p.abs().max(q.abs()) < LEVEL {
                break;
            }
            let [x, y, z] = fit.frame;
            fit = Fit::new(points, (z - x * p - y * q).normalize(), &powers)?;
        }
        Some(Self {
            frame: fit.frame,
            slope: fit.slope(),
            second: fit.second(),
            sensitivity,
        })
    }

    /// Principal curvatures and directions of the graph z(x, y) at the vertex.
    pub(super) fn curvature(&self) -> VertexCurvature {
        let [x, y, z] = self.frame;
        let [p, q] = self.slope;
        let [xx, xy, yy] = self.second;
        // An orthonormal frame of the tangent plane of the fit, by x and y: e along x, f across.
        let a = (1.0 + p * p).sqrt();
        let w = (1.0 + p * p + q * q).sqrt();
        let (e, f) = ([1.0 / a, 0.0], [-p * q / (a * w), a / w]);
        // The second fundamental form in that frame.
        let form = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            (xx * a * c + xy * (a * d + b * c) + yy * b * d) / w
        };
        let (ee, ef, ff) = (form(e, e), form(e, f), form(f, f));
        let lift = |[a, b]: [f64; 2]| x * a + y * b + z * (p * a + q * b);
        let (e, f) = (lift(e), lift(f));
        let half = 0.5 * (ee - ff);
        let spread = (half * half + ef * ef).sqrt();
        let mean = 0.5 * (ee + ff);
        // Half-angle formulas without angles; the branch keeps clear of cancellation.
        let direction = if spread == 0.0 {
            e
        } else if half >= 0.0 {
            (e * (half + spread) + f * ef).normalize()
        } else {
            (e * ef + f * (spread - half)).normalize()
        };
        let direction = upright(direction);
        let normal = e.cross(&f);
        VertexCurvature {
            principal: [mean + spread, mean - spread],
            directions: [direction, normal.cross(&direction)],
            normal,
        }
    }
}

/// One of a direction and its opposite: the one whose largest coordinate is positive.
fn upright(direction: Vector3) -> Vector3 {
    if direction[direction.iamax()] < 0.0 {
        -direction
    } else {
        direction
    }
}

/// Two directions across a normal, and the normal.
fn frame(normal: Vector3) -> [Vector3; 3] {
    let x = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    [x, normal.cross(&x), normal]
}

/// Least squares by normal equations with columns of unit length; coordinates are in units of the
/// neighbourhood's radius.
struct Fit<const N: usize> {
    frame: [Vector3; 3],
    radius: f64,
    /// One over the length of each column.
    scale: SVector<f64, N>,
    cholesky: Cholesky<f64, Const<N>>,
    coefficients: SVector<f64, N>,
}

impl<const N: usize> Fit<N> {
    /// `None` if the points do not determine all coefficients.
    fn new(
        points: &[Vector3],
        normal: Vector3,
        powers: &impl Fn(f64, f64) -> SVector<f64, N>,
    ) -> Option<Self> {
        if points.len() < N {
            return None;
        }
        let frame = frame(normal);
        let [x, y, z] = frame;
        let radius = points.iter().fold(0.0, |r: f64, p| r.max(p.norm()));
        let mut matrix = SMatrix::<f64, N, N>::zeros();
        let mut right = SVector::<f64, N>::zeros();
        for p in points {
            let row = powers(p.dot(&x) / radius, p.dot(&y) / radius);
            for j in 0..N {
                for i in j..N {
                    matrix[(i, j)] += row[i] * row[j];
                }
            }
            right += row * (p.dot(&z) / radius);
        }
        let scale = matrix.diagonal().map(|d| 1.0 / d.sqrt());
        for j in 0..N {
            for i in j..N {
                matrix[(i, j)] *= scale[i] * scale[j];
            }
        }
        let cholesky = Cholesky::new(matrix)?;
        // A squared pivot is the share of a column that the columns before it do not explain.
        if cholesky.l_dirty().diagonal().min() <= DEPENDENT {
            return None;
        }
        let coefficients = cholesky
            .solve(&right.component_mul(&scale))
            .component_mul(&scale);
        Some(Self {
            frame,
            radius,
            scale,
            cholesky,
            coefficients,
        })
    }

    /// First derivatives.
    fn slope(&self) -> [f64; 2] {
        [self.coefficients[1], self.coefficients[2]]
    }

    /// Second derivatives by xx, xy and yy, 1/m.
    fn second(&self) -> [f64; 3] {
        let c = &self.coefficients;
        [2.0 * c[3], c[4], 2.0 * c[5]].map(|d| d / self.radius)
    }

    /// Greatest standard deviation of the derivatives for a height error of one edge length, see
    /// [`WELL_DETERMINED`].
    fn sensitivity(&self, edge: f64) -> f64 {
        let inverse = self.cholesky.inverse();
        let share = edge / self.radius;
        let deviation = |i: usize| self.scale[i] * inverse[(i, i)].sqrt();
        let slope = deviation(1).max(deviation(2));
        let second = deviation(4).max(2.0 * deviation(3).max(deviation(5)));
        f64::max(slope * share, second * share * share)
    }
}
