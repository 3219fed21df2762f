//! Positive curvature, gathered in cells: what two geodesics with common ends have to enclose.

use super::charts::Charts;
use crate::surface::{HalfEdge, Mesh, Point3, Vector3};
use std::ops::Range;

/// Fine cells along the longest side of a mesh.
const FINE: f64 = 128.0;

/// Fine cells along a coarse one.
const COARSE: i64 = 8;

/// The positive curvature of a part of the mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mass {
    /// Mean place of its vertices.
    pub(super) at: Point3,
    /// None of them is farther from there, metres.
    pub(super) radius: f64,
    /// Radians.
    pub(super) curvature: f64,
    /// Whether faces about it are folded, so that places in space do not tell sides.
    pub(super) rough: bool,
}

/// The least cosine between the normals of neighbouring faces that are not folded.
const FOLDED: f64 = 0.5;

/// The positive curvature of a mesh in cells of two sizes.
pub(super) struct Masses {
    /// Coarse cells.
    pub(super) wholes: Vec<Whole>,
    /// Fine cells.
    pub(super) parts: Vec<Mass>,
    /// All of the mesh, if none of it is rough.
    pub(super) all: Option<All>,
}

/// The positive curvature of a mesh as a whole.
#[derive(Debug, Clone, Copy)]
pub(super) struct All {
    /// Radians.
    pub(super) curvature: f64,
    /// The greatest curvature of a vertex by the third of the faces about it, radians by square metre.
    pub(super) densest: f64,
    /// That third reaches no farther from its vertex, metres.
    pub(super) cell: f64,
}

/// A coarse cell.
pub(super) struct Whole {
    pub(super) mass: Mass,
    /// Its fine cells.
    pub(super) parts: Range<usize>,
    /// The sum of all curvature in it, radians: little where the mesh is merely uneven.
    pub(super) net: f64,
    /// The greatest curvature of a vertex by the third of the faces about it, radians by square metre.
    pub(super) densest: f64,
    /// That third reaches no farther from its vertex, metres.
    pub(super) cell: f64,
}

/// A vertex and its cells.
struct Vertex {
    coarse: [i64; 3],
    fine: [i64; 3],
    at: Point3,
    curvature: f64,
    /// A third of the faces about it, square metres.
    area: f64,
    /// That third is no farther from the vertex, metres.
    cell: f64,
    rough: bool,
}

impl Masses {
    pub(super) fn new(mesh: &Mesh, charts: &Charts) -> Self {
        let positions = mesh.positions();
        let (low, high) = mesh.bounding_box();
        let extent = (high - low).iter().copied().fold(0.0, f64::max);
        let side = if extent > 0.0 { extent / FINE } else { 1.0 };
        let rough = rough(mesh);
        let mut vertices: Vec<Vertex> = positions
            .iter()
            .zip(&charts.curvatures)
            .zip(&rough)
            .map(|((&at, &curvature), &rough)| {
                let fine = [0, 1, 2].map(|i| ((at[i] - low[i]) / side).floor() as i64);
                Vertex {
                    coarse: fine.map(|i| i / COARSE),
                    fine,
                    at,
                    curvature,
                    area: 0.0,
                    cell: 0.0,
                    rough,
                }
            })
            .collect();
        for (face, corners) in (0..).zip(mesh.faces()) {
            let chart = charts.chart(HalfEdge::new(face, 0));
            let area = 0.5 * chart.length * chart.apex()[1];
            let at = mesh.corners(face);
            let middle = Point3::from((at[0].coords + at[1].coords + at[2].coords) / 3.0);
            for (i, &v) in corners.iter().enumerate() {
                // A third of a face lies between its corner, its middle and those of two sides.
                let sides = [(i + 1) % 3, (i + 2) % 3].map(|j| 0.5 * (at[j] - at[i]).norm());
                let far = (middle - at[i]).norm().max(sides[0]).max(sides[1]);
                let vertex = &mut vertices[v as usize];
                vertex.area += area / 3.0;
                vertex.cell = vertex.cell.max(far);
            }
        }
        // Stable: sums within a cell keep the order of the vertices.
        vertices.sort_by_key(|vertex| (vertex.coarse, vertex.fine));
        let mut masses = Self {
            wholes: Vec::new(),
            parts: Vec::new(),
            all: None,
        };
        for whole in vertices.chunk_by(|a, b| a.coarse == b.coarse) {
            let begin = masses.parts.len();
            let cells = whole.chunk_by(|a, b| a.fine == b.fine);
            masses.parts.extend(cells.filter_map(gather));
            if let Some(mass) = gather(whole) {
                masses.wholes.push(Whole {
                    mass,
                    parts: begin..masses.parts.len(),
                    net: whole.iter().map(|vertex| vertex.curvature).sum(),
                    densest: most(whole, |vertex| vertex.curvature / vertex.area),
                    cell: most(whole, |vertex| vertex.cell),
                });
            }
        }
        let most = |value: fn(&Whole) -> f64| masses.wholes.iter().map(value).fold(0.0, f64::max);
        masses.all = masses
            .wholes
            .iter()
            .all(|whole| !whole.mass.rough)
            .then(|| All {
                curvature: masses.wholes.iter().map(|whole| whole.mass.curvature).sum(),
                densest: most(|whole| whole.densest),
                cell: most(|whole| whole.cell),
            });
        masses
    }
}

/// The positive curvature of some vertices, if there is any.
fn gather(vertices: &[Vertex]) -> Option<Mass> {
    let positive = || vertices.iter().filter(|vertex| vertex.curvature > 0.0);
    let sum: Vector3 = positive().map(|vertex| vertex.at.coords).sum();
    let count = positive().count();
    let at = Point3::from(sum / count as f64);
    let far = positive().map(|vertex| (vertex.at - at).norm());
    (count > 0).then(|| Mass {
        at,
        radius: far.fold(0.0, f64::max),
        curvature: positive().map(|vertex| vertex.curvature).sum(),
        rough: positive().any(|vertex| vertex.rough),
    })
}

/// The greatest value of those vertices that have positive curvature.
fn most(vertices: &[Vertex], value: impl Fn(&Vertex) -> f64) -> f64 {
    let positive = vertices.iter().filter(|vertex| vertex.curvature > 0.0);
    positive.map(value).fold(0.0, f64::max)
}

/// Per vertex whether faces about it or about a neighbour are folded.
fn rough(mesh: &Mesh) -> Vec<bool> {
    let normals: Vec<Vector3> = (0..mesh.face_count())
        .map(|f| mesh.face_normal(f))
        .collect();
    let mut folded = vec![false; mesh.positions().len()];
    for h in mesh.edges() {
        if let Some(twin) = mesh.twin(h)
            && normals[h.face() as usize].dot(&normals[twin.face() as usize]) < FOLDED
        {
            for v in [mesh.origin(h), mesh.target(h)] {
                folded[v as usize] = true;
            }
        }
    }
    let mut rough = folded.clone();
    for face in mesh
        .faces()
        .iter()
        .filter(|f| f.iter().any(|&v| folded[v as usize]))
    {
        for &v in face {
            rough[v as usize] = true;
        }
    }
    rough
}
