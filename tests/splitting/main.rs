//! Feasibility of patches and their splitting: against closed forms and reference values, and from
//! end to end with what is said.

mod growth;
mod measures;
#[path = "../common/program.rs"]
mod program;
mod said;
mod workflows;

use egg::project::model::{Anchor, Axis, Point};
use egg::splitting::{Draft, DraftPatch};
use egg::surface::generate::{Grid, Pattern, graph};
use egg::surface::{Mesh, ReadOptions, Side, SurfaceMesh, read_obj, write_obj};

/// A mesh as it comes from a file.
fn surface(mesh: &Mesh) -> SurfaceMesh {
    let options = ReadOptions {
        metres_per_unit: 1.0,
        up: Axis::Z,
        side: Side::Upper,
    };
    let text = write_obj(mesh, "made for a test");
    read_obj(text.as_bytes(), &options)
        .expect("a good mesh")
        .value
}

/// An even grid over a rectangle around the origin.
fn grid(half: [f64; 2], cells: [u32; 2]) -> Grid {
    Grid {
        u: [-half[0], half[0]],
        v: [-half[1], half[1]],
        cells,
        pattern: Pattern::Alternating,
    }
}

/// Bumps of one height and spread at several places.
fn bumps(places: &[[f64; 2]], height: f64, spread: f64, grid: &Grid) -> Mesh {
    graph(grid, |x, y| {
        let bump = |[a, b]: &[f64; 2]| {
            let r2 = (x - a) * (x - a) + (y - b) * (y - b);
            height * libm::exp(-r2 / (2.0 * spread * spread))
        };
        places.iter().map(bump).sum()
    })
}

fn point(name: &str, at: [f64; 2]) -> Point {
    Point {
        name: name.into(),
        anchor: Anchor::Above(at),
    }
}

fn patch(name: &str, corners: [&str; 4], members: [u32; 2]) -> DraftPatch {
    DraftPatch {
        name: name.into(),
        origin: name.into(),
        corners: corners.map(Into::into),
        members,
        alpha: None,
        width: 0.01,
    }
}

/// One patch `p` over the rectangle with these half sides.
fn single(half: [f64; 2], members: [u32; 2]) -> Draft {
    let [x, y] = half;
    Draft {
        points: vec![
            point("a", [-x, -y]),
            point("b", [x, -y]),
            point("c", [x, y]),
            point("d", [-x, y]),
        ],
        patches: vec![patch("p", ["a", "b", "c", "d"], members)],
    }
}
