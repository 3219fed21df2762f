use super::search::{LOCATE, ROUND};
use super::*;
use crate::cladding::nodes;

const MODES: usize = 5;

/// A curve over the plane: a chord with offsets in a sine basis.
struct Curve {
    a: [f64; 2],
    b: [f64; 2],
    offsets: [f64; MODES],
}

impl Curve {
    /// Position over the plane and the length of the derivative on the dome
    /// z = 0.25 exp(-r^2 / (2 0.3^2)) around (0.5, 0.5).
    fn at(&self, t: f64) -> ([f64; 2], f64) {
        let [dx, dy] = [self.b[0] - self.a[0], self.b[1] - self.a[1]];
        let chord = libm::hypot(dx, dy);
        let (mut offset, mut slope) = (0.0, 0.0);
        for (k, c) in self.offsets.iter().enumerate() {
            let w = (k + 1) as f64 * std::f64::consts::PI;
            offset += c * libm::sin(w * t);
            slope += c * w * libm::cos(w * t);
        }
        let (x, y) = (
            self.a[0] + t * dx - offset * dy / chord,
            self.a[1] + t * dy + offset * dx / chord,
        );
        let (vx, vy) = (dx - slope * dy / chord, dy + slope * dx / chord);
        let (rx, ry) = (x - 0.5, y - 0.5);
        let z = 0.25 * libm::exp(-(rx * rx + ry * ry) / 0.18);
        let vz = -z * (rx * vx + ry * vy) / 0.09;
        ([x, y], (vx * vx + vy * vy + vz * vz).sqrt())
    }

    /// Arc length up to t, by Gauss's rule with three points a cell.
    fn length(&self, to: f64) -> f64 {
        let n = 48;
        let gauss = [
            (-0.774_596_669_241_483_4, 5.0),
            (0.0, 8.0),
            (0.774_596_669_241_483_4, 5.0),
        ];
        let cell = to / f64::from(n);
        (0..n / 3)
            .flat_map(|i| gauss.map(|(x, w)| (3.0 * cell * (f64::from(i) + 0.5 + 0.5 * x), w)))
            .map(|(t, w)| self.at(t).1 * w * 3.0 * cell / 18.0)
            .sum()
    }

    /// The geodesic between two points: Newton's method on the length.
    fn geodesic(a: [f64; 2], b: [f64; 2]) -> Self {
        let mut curve = Self {
            a,
            b,
            offsets: [0.0; MODES],
        };
        for _ in 0..5 {
            let h = 1e-3;
            let shifted = |i: usize, j: usize, si: f64, sj: f64| {
                let mut offsets = curve.offsets;
                offsets[i] += si * h;
                offsets[j] += sj * h;
                Curve { a, b, offsets }.length(1.0)
            };
            let gradient = nalgebra::SVector::<f64, MODES>::from_fn(|i, _| {
                (shifted(i, i, 0.5, 0.5) - shifted(i, i, -0.5, -0.5)) / (2.0 * h)
            });
            let hessian = nalgebra::SMatrix::<f64, MODES, MODES>::from_fn(|i, j| {
                let (i, j) = (i.min(j), i.max(j));
                (shifted(i, j, 1.0, 1.0) - shifted(i, j, 1.0, -1.0) - shifted(i, j, -1.0, 1.0)
                    + shifted(i, j, -1.0, -1.0))
                    / (4.0 * h * h)
            });
            let step = hessian.lu().solve(&gradient).unwrap();
            for i in 0..MODES {
                curve.offsets[i] -= step[i];
            }
        }
        curve
    }

    /// Points at equal arc lengths.
    fn points(&self, n: usize) -> Vec<[f64; 2]> {
        let total = self.length(1.0);
        nodes(n)
            .map(|share| {
                let mut t = share;
                for _ in 0..8 {
                    t -= (self.length(t) - share * total) / self.at(t).1;
                }
                self.at(t).0
            })
            .collect()
    }
}

/// The dome h = 0.25, sigma = 0.3 on the unit square; by its symmetry one table serves both
/// families.
fn dome_maps() -> (SideLengths, DistanceTable, DistanceTable) {
    let side = Curve::geodesic([0.0, 0.0], [1.0, 0.0]);
    let near = side.points(17);
    let rows: Vec<Vec<f64>> = near
        .iter()
        .map(|p| {
            near.iter()
                .map(|q| Curve::geodesic(*p, [q[0], 1.0 - q[1]]).length(1.0))
                .collect()
        })
        .collect();
    let length = side.length(1.0);
    let table = DistanceTable::new(&rows);
    (
        SideLengths {
            ab: length,
            bc: length,
            cd: length,
            da: length,
        },
        table.clone(),
        table,
    )
}

const LOOSE: Demands = Demands {
    slope: [0.01, 100.0],
    members: [7, 7],
    width: 0.0,
};

#[test]
fn the_dome_has_the_slopes_of_the_method_notes() {
    let (sides, u, v) = dome_maps();
    let maps = Maps {
        sides,
        u: &u,
        v: &v,
    };
    // The notes print two digits. Here finer tables and curves change the slopes by less than
    // 2e-3, so the distance to the notes is theirs, and grows towards the gap.
    for (degrees, low, high, within) in [
        (30.0, 0.70, 1.43, 0.03),
        (60.0, 0.53, 1.88, 0.04),
        (75.0, 0.26, 3.9, 0.06),
    ] {
        let clad = clad(&maps, &LOOSE, degrees * DEGREE).unwrap();
        let range = clad.u.slope_range();
        assert!(
            (range[0] / low - 1.0).abs() < within,
            "{degrees}: {range:?}"
        );
        assert!(
            (range[1] / high - 1.0).abs() < within,
            "{degrees}: {range:?}"
        );
        // Turned by 180 degrees the dome is itself, so the function is its own inverse.
        assert!(
            (range[0] * range[1] - 1.0).abs() < 2e-3,
            "{degrees}: {range:?}"
        );
    }
    let in_the_gap = clad(&maps, &LOOSE, 90.0 * DEGREE).unwrap_err();
    assert!(
        matches!(in_the_gap, Obstacle::NoCladding(..)),
        "{in_the_gap:?}"
    );
}

#[test]
fn feasible_angles_lie_on_both_sides_of_a_gap_and_the_most_compact_is_taken() {
    let (sides, u, v) = dome_maps();
    let maps = Maps {
        sides,
        u: &u,
        v: &v,
    };
    let demands = Demands {
        slope: [0.5, 2.0],
        members: [7, 7],
        width: 0.05,
    };
    let choice = choose_angle(&maps, &demands);
    assert_eq!(choice.feasible.len(), 2, "{:?}", choice.feasible);
    let [left, right] = [choice.feasible[0], choice.feasible[1]];
    // The dome is symmetric: what holds at an angle holds at its supplement.
    assert!((left.0 + right.1 - std::f64::consts::PI).abs() < 1e-4);
    assert!(left.1 < 65.0 * DEGREE && right.0 > 115.0 * DEGREE);
    let taken = choice.taken.unwrap();
    assert!((taken.alpha - left.0).abs() < ROUND || (taken.alpha - right.1).abs() < ROUND);
    let tenths = taken.alpha / ROUND;
    assert!((tenths - tenths.round()).abs() < 1e-9);
    // One step further the lamellae would overlap.
    let further = clad(&maps, &demands, left.0 - 2.0 * LOCATE).unwrap_err();
    assert!(matches!(further, Obstacle::Overlap(..)), "{further:?}");
}

#[test]
fn an_infeasible_patch_says_what_comes_closest() {
    let (sides, u, v) = dome_maps();
    let maps = Maps {
        sides,
        u: &u,
        v: &v,
    };
    let strict = Demands {
        slope: [0.95, 1.05],
        members: [7, 7],
        width: 0.05,
    };
    let choice = choose_angle(&maps, &strict);
    assert!(choice.feasible.is_empty());
    let Err(Infeasible {
        obstacle: Obstacle::Slope(_, [low, high], _),
        ..
    }) = choice.taken
    else {
        panic!("{:?}", choice.taken)
    };
    assert!(low < 0.95 && high > 1.05);
    let impossible = SideLengths {
        ab: 1.0,
        bc: 0.1,
        cd: 0.1,
        da: 0.1,
    };
    let none = choose_angle(
        &Maps {
            sides: impossible,
            u: &u,
            v: &v,
        },
        &strict,
    );
    assert_eq!(none.convex, None);
}
