//! Outlines of parts, counter-clockwise, in the frame of the part: millimetres from the lower
//! left corner of the nominal outline.
//!
//! **Ends are round**, half circles over the whole width. Several lamellae turn about one bolt
//! where patches meet, and round ends show the same outline at every angle, leave no corner that
//! catches or splits, and keep at least the wood around an end hole that a square end of the same
//! margin has in the direction of the pull.
//!
//! **Fingers** of a joint are straight and as wide as the gaps between them: the piece before the
//! joint has those in the first, third, ... row from below, the piece after it the others, so the
//! glue lies between flanks that run with the grain. **Scarfs and plates** end square.
//!
//! **Kerf.** With kerf `k` an outline grows by `k/2` all around: fingers too, and the gaps between
//! them shrink.

use super::drawing::{Closure, Path, Vertex};
use super::pieces::{End, Piece};
use super::units::MM;
use crate::plan::LamellaRecord;
use crate::project::model::SpliceKind;

/// The outline of a lamella as if it were in one piece.
pub fn whole(lamella: &LamellaRecord, kerf: f64) -> Path {
    let [length, width] = [lamella.length * MM, lamella.width * MM];
    let radius = 0.5 * width.min(length);
    Path::slot(radius, length - radius, 0.5 * width, radius + 0.5 * kerf)
}

/// The outline of a piece.
pub fn of(piece: &Piece<'_>, kerf: f64) -> Path {
    if piece.start == End::Round && piece.end == End::Round {
        return whole(piece.lamella, kerf);
    }
    let [length, width] = [piece.length(), piece.lamella.width * MM];
    let grow = 0.5 * kerf;
    // Each end in its own frame: x into the wood from the nominal end, y across from the edge
    // where the path arrives.
    let right = end(piece.end, width, grow);
    let left = end(piece.start, width, grow);
    let mut vertices: Vec<Vertex> = right
        .into_iter()
        .map(|v| Vertex {
            x: length - v.x,
            ..v
        })
        .collect();
    // The left end is passed downwards.
    vertices.extend(left.into_iter().map(|v| Vertex {
        x: v.x,
        y: width - v.y,
        bulge: v.bulge,
    }));
    Path {
        vertices,
        closed: Closure::Closed,
    }
}

/// A plate, or any part with square corners.
pub fn rectangle(length: f64, width: f64, kerf: f64) -> Path {
    let grow = 0.5 * kerf;
    Path::rectangle([-grow, -grow], [length + grow, width + grow])
}

fn end(end: End<'_>, width: f64, grow: f64) -> Vec<Vertex> {
    let straight = |x, y| Vertex { x, y, bulge: 0.0 };
    match end {
        End::Round => {
            let radius = 0.5 * width;
            vec![
                Vertex {
                    x: radius,
                    y: -grow,
                    bulge: 1.0,
                },
                straight(radius, width + grow),
            ]
        }
        End::Joint(joint) if joint.kind == SpliceKind::Finger && joint.fingers > 0 => {
            fingers(joint.length * MM, 2 * joint.fingers, width, grow)
        }
        End::Joint(_) => vec![straight(-grow, -grow), straight(-grow, width + grow)],
    }
}

/// The comb of a piece: fingers and gaps across the width, first a finger, last a gap. The comb
/// of the other piece is the same turned by half a turn about the middle of the joint, which puts
/// its fingers into the gaps.
fn fingers(length: f64, rows: u32, width: f64, grow: f64) -> Vec<Vertex> {
    let is_finger = |row: u32| row.is_multiple_of(2);
    let depth = |row: u32| if is_finger(row) { 0.0 } else { length } - grow;
    let vertex = |x, y| Vertex { x, y, bulge: 0.0 };
    let mut comb = vec![vertex(depth(0), -grow)];
    for row in 1..rows {
        // The wood of a finger grows into the gap beside it.
        let side = if is_finger(row - 1) { grow } else { -grow };
        let y = width * f64::from(row) / f64::from(rows) + side;
        comb.push(vertex(depth(row - 1), y));
        comb.push(vertex(depth(row), y));
    }
    comb.push(vertex(depth(rows - 1), width + grow));
    comb
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::pieces::pieces;
    use crate::plan::{JointRecord, PieceRecord};

    /// A lamella of 1000 x 24 x 3 mm in two pieces that meet in the middle.
    fn spliced(kind: SpliceKind) -> LamellaRecord {
        let piece = |id: &str, from, to, joint| PieceRecord {
            id: id.to_owned(),
            from,
            to,
            joint,
        };
        let joint = JointRecord {
            kind,
            length: 0.016,
            fingers: if kind == SpliceKind::Finger { 2 } else { 0 },
            screws: Vec::new(),
            hole: 0.0,
        };
        LamellaRecord {
            id: "w.u01".to_owned(),
            member: "w.u01".to_owned(),
            material: "poplar".to_owned(),
            length: 1.0,
            end_margin: 0.024,
            width: 0.024,
            thickness: 0.003,
            mass: 0.0,
            openings: Vec::new(),
            pieces: vec![
                piece("w.u01a", 0.0, 0.5, Some(joint)),
                piece("w.u01b", 0.5, 1.0, None),
            ],
        }
    }

    #[test]
    fn pieces_with_fingers_fill_the_lamella_without_gap_or_overlap() {
        let lamella = spliced(SpliceKind::Finger);
        let [first, second] = &pieces(&lamella)[..] else {
            panic!("two pieces");
        };
        let [a, b] = [
            of(first, 0.0),
            of(second, 0.0).translated([second.from, 0.0]),
        ];
        assert!((a.area() + b.area() - whole(&lamella, 0.0).area()).abs() < 1e-9);
        // Every corner of one comb is a corner of the other.
        let near = |v: &&Vertex| v.x > 480.0 && v.x < 520.0;
        let inside = |v: &&Vertex| v.y > 0.0 && v.y < 24.0;
        let corners: Vec<_> = a.vertices.iter().filter(near).filter(inside).collect();
        assert_eq!(corners.len(), 6);
        for v in corners {
            let same = |w: &&Vertex| libm::hypot(v.x - w.x, v.y - w.y) < 1e-9;
            assert!(b.vertices.iter().any(|w| same(&w)), "{v:?}");
        }
    }

    #[test]
    fn kerf_leaves_its_width_between_the_flanks_of_drawn_fingers() {
        let lamella = spliced(SpliceKind::Finger);
        let kerf = 0.2;
        let [first, second] = &pieces(&lamella)[..] else {
            panic!("two pieces");
        };
        // A cut part has lost half a kerf all around: what is drawn is larger by that.
        for piece in [first, second] {
            let [drawn, nominal] = [of(piece, kerf), of(piece, 0.0)];
            let grown = nominal.area() + 0.5 * kerf * nominal.length();
            // Corners add and take squares of half a kerf; round ends a little of a circle.
            assert!(
                (drawn.area() - grown).abs() < 0.1,
                "{} {grown}",
                drawn.area()
            );
        }
    }

    #[test]
    fn scarfs_end_square_and_overlap_by_their_length() {
        let lamella = spliced(SpliceKind::Scarf);
        let pieces = pieces(&lamella);
        assert!((pieces[0].to - pieces[1].from - 16.0).abs() < 1e-9);
        let bounds = of(&pieces[0], 0.0).bounds();
        assert!(bounds.min[0].abs() < 1e-9 && (bounds.max[0] - 508.0).abs() < 1e-9);
        assert_eq!(of(&pieces[0], 0.0).vertices.len(), 4);
    }
}
