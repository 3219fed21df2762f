//! One step of sequential quadratic programming: of all moves that meet the linearised constraints
//! within bounds, the one that is best for the quadratic model of the objective.

use nalgebra::{DMatrix, DVector};

/// The model: minimise g·d + ½ d·W d over moves d with r + J d = 0 and low <= d <= high.
#[derive(Debug)]
pub(super) struct Model {
    /// g.
    pub(super) gradient: DVector<f64>,
    /// W, positive definite.
    pub(super) hessian: DMatrix<f64>,
    /// r.
    pub(super) residual: DVector<f64>,
    /// J.
    pub(super) jacobian: DMatrix<f64>,
    /// Least moves, at most 0.
    pub(super) low: Vec<f64>,
    /// Largest moves, at least 0.
    pub(super) high: Vec<f64>,
}

/// Constraints that move together but for this share (in squares) count as one: their difference
/// is rounding, as between members of mirrored patches.
const TOGETHER: f64 = 1e-13;

impl Model {
    /// The move; `None` if the matrix is not positive definite.
    ///
    /// Variables that would leave their bounds are held there, the worst first.
    pub(super) fn step(&self) -> Option<DVector<f64>> {
        let count = self.gradient.len();
        let mut held: Vec<Option<f64>> = vec![None; count];
        loop {
            let open: Vec<usize> = (0..count).filter(|&i| held[i].is_none()).collect();
            let mut step = DVector::from_iterator(count, held.iter().map(|h| h.unwrap_or(0.0)));
            if open.is_empty() {
                return Some(step);
            }
            let gradient = (&self.gradient + &self.hessian * &step).select_rows(&open);
            let residual = &self.residual + &self.jacobian * &step;
            let hessian = self.hessian.select_rows(&open).select_columns(&open);
            let jacobian = self.jacobian.select_columns(&open);
            let moves = free_step(&gradient, hessian, &residual, &jacobian)?;
            let beyond = |k: usize| {
                let i = open[k];
                (self.low[i] - moves[k]).max(moves[k] - self.high[i])
            };
            let worst = (0..open.len()).max_by(|&a, &b| beyond(a).total_cmp(&beyond(b)))?;
            if beyond(worst) > 0.0 {
                let i = open[worst];
                held[i] = Some(if moves[worst] < 0.0 {
                    self.low[i]
                } else {
                    self.high[i]
                });
                continue;
            }
            for (&i, &by) in open.iter().zip(moves.iter()) {
                step[i] = by;
            }
            return Some(step);
        }
    }
}

/// The move without bounds, by the Schur complement of the constraints.
fn free_step(
    gradient: &DVector<f64>,
    hessian: DMatrix<f64>,
    residual: &DVector<f64>,
    jacobian: &DMatrix<f64>,
) -> Option<DVector<f64>> {
    let hessian = hessian.cholesky()?;
    let downhill = hessian.solve(gradient);
    let normal = hessian.solve(&jacobian.transpose());
    let mut schur = jacobian * &normal;
    let largest = schur.diagonal().max();
    if largest <= 0.0 {
        return Some(-downhill);
    }
    for i in 0..schur.nrows() {
        schur[(i, i)] += TOGETHER * largest;
    }
    let multipliers = schur.cholesky()?.solve(&(residual - jacobian * &downhill));
    Some(-downhill - normal * multipliers)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(low: f64, high: f64) -> Model {
        Model {
            gradient: DVector::from_vec(vec![0.0, 0.0, -1.0]),
            hessian: DMatrix::identity(3, 3),
            residual: DVector::from_vec(vec![-3.0]),
            jacobian: DMatrix::from_row_slice(1, 3, &[1.0, 2.0, 0.0]),
            low: vec![low; 3],
            high: vec![high; 3],
        }
    }

    #[test]
    fn of_all_moves_that_meet_the_constraints_the_shortest_downhill_one_is_taken() {
        let step = model(-9.0, 9.0).step().unwrap();
        for (got, exact) in step.iter().zip([0.6, 1.2, 1.0]) {
            assert!((got - exact).abs() < 1e-9, "{step}");
        }
    }

    #[test]
    fn what_a_bound_holds_back_the_others_make_up_for() {
        let step = model(-1.1, 1.1).step().unwrap();
        for (got, exact) in step.iter().zip([0.8, 1.1, 1.0]) {
            assert!((got - exact).abs() < 1e-9, "{step}");
        }
    }

    #[test]
    fn constraints_that_say_the_same_are_no_contradiction() {
        let mut twice = model(-9.0, 9.0);
        twice.residual = DVector::from_vec(vec![-3.0, -6.0]);
        twice.jacobian = DMatrix::from_row_slice(2, 3, &[1.0, 2.0, 0.0, 2.0, 4.0, 0.0]);
        let step = twice.step().unwrap();
        for (got, exact) in step.iter().zip([0.6, 1.2, 1.0]) {
            assert!((got - exact).abs() < 1e-6, "{step}");
        }
    }
}
