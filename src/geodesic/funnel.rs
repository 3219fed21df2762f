//! The shortest line through a strip of faces laid flat: pulled tight, it bends at corners of
//! gates only (D. T. Lee, F. P. Preparata, *Euclidean shortest paths in the presence of
//! rectilinear barriers*, 1984).

use super::laid::{Laid, Side, V2, cross, norm, sub};

/// Where a tight line bends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bend {
    /// A gate that ends at the vertex.
    pub(super) gate: usize,
    /// On which side of the line the vertex lies.
    pub(super) side: Side,
    /// Where.
    pub(super) at: V2,
}

/// Bends of the tight line from the origin through all gates, the entries of faces laid one after
/// the other, to the end.
pub(super) fn pull(gates: &[Laid], end: V2, bends: &mut Vec<Bend>) {
    bends.clear();
    let count = gates.len();
    let ends = |i: usize| {
        if i < count {
            (gates[i].left, gates[i].right)
        } else {
            (end, end)
        }
    };
    let mut apex = [0.0; 2];
    let mut start = 0;
    'legs: while start <= count {
        let (mut left, mut right) = ends(start);
        let (mut at_left, mut at_right) = (start, start);
        let mut i = start + 1;
        while i <= count {
            let (new_left, new_right) = ends(i);
            if cross(sub(right, apex), sub(new_right, apex)) >= 0.0 {
                if right == apex || cross(sub(left, apex), sub(new_right, apex)) <= 0.0 {
                    (right, at_right) = (new_right, i);
                } else {
                    bends.push(Bend {
                        gate: at_left,
                        side: Side::Left,
                        at: left,
                    });
                    (apex, start) = (left, at_left + 1);
                    continue 'legs;
                }
            }
            if cross(sub(left, apex), sub(new_left, apex)) <= 0.0 {
                if left == apex || cross(sub(right, apex), sub(new_left, apex)) >= 0.0 {
                    (left, at_left) = (new_left, i);
                } else {
                    bends.push(Bend {
                        gate: at_right,
                        side: Side::Right,
                        at: right,
                    });
                    (apex, start) = (right, at_right + 1);
                    continue 'legs;
                }
            }
            i += 1;
        }
        break;
    }
}

/// Length of the line from the origin over bends to the end.
pub(super) fn length(bends: &[Bend], end: V2) -> f64 {
    let mut at = [0.0; 2];
    let mut sum = 0.0;
    for bend in bends {
        sum += norm(sub(bend.at, at));
        at = bend.at;
    }
    sum + norm(sub(end, at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::HalfEdge;

    fn gates(ends: &[(V2, V2)]) -> Vec<Laid> {
        let gate = |&(left, right): &(V2, V2)| Laid {
            entry: HalfEdge(0),
            left,
            right,
        };
        ends.iter().map(gate).collect()
    }

    #[test]
    fn a_line_through_open_gates_is_straight() {
        let gates = gates(&[([-1.0, 1.0], [1.0, 1.0]), ([-1.0, 2.0], [1.0, 2.0])]);
        let mut bends = Vec::new();
        pull(&gates, [0.5, 3.0], &mut bends);
        assert!(bends.is_empty());
    }

    #[test]
    fn a_line_round_two_corners_is_tight() {
        let gates = gates(&[
            ([1.0, 1.0], [2.0, 1.0]),
            ([1.0, 2.0], [2.0, 2.0]),
            ([-1.0, 3.0], [-0.5, 3.0]),
        ]);
        let mut bends = Vec::new();
        pull(&gates, [0.0, 5.0], &mut bends);
        let at: Vec<V2> = bends.iter().map(|b| b.at).collect();
        assert_eq!(at, [[1.0, 1.0], [1.0, 2.0], [-0.5, 3.0]]);
        let truth = 2.0_f64.sqrt() + 1.0 + libm::hypot(1.5, 1.0) + libm::hypot(0.5, 2.0);
        assert!((length(&bends, [0.0, 5.0]) - truth).abs() < 1e-15);
    }
}
