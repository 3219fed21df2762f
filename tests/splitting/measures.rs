//! Measures of single patches.

use crate::{grid, single, surface};
use egg::cladding::{Maps, distance_table};
use egg::geodesic::Geodesics;
use egg::layout::{Domain, Network, Quad, Side, place_anchors};
use egg::project::model::{Anchor, Family};
use egg::splitting::{Draft, Feasibility, feasibility};
use egg::surface::generate::{bump, graph};
use egg::surface::{Curvature, Mesh, SurfaceMesh};

/// The bounds that are wide enough to leave the choice of places to η.
const SLOPE: [f64; 2] = [0.5, 2.0];

/// The first patch of a draft, whose sides are lines of their own.
fn domain(surface: &SurfaceMesh, draft: &Draft) -> Domain {
    let anchors: Vec<(String, Anchor)> = draft
        .points
        .iter()
        .map(|p| (p.name.clone(), p.anchor.clone()))
        .collect();
    let placed = place_anchors(surface, &anchors)
        .expect("on the surface")
        .value;
    let network = Network::new(&draft.points, &draft.as_patches());
    let geodesics = Geodesics::new(&surface.mesh);
    let [ab, bc, cd, da] = network.sides[0].map(|piece| {
        let place = |station: usize| {
            let name = &network.lines[piece.line].stations[station].name;
            let index = draft.points.iter().position(|p| p.name == *name);
            placed[index.expect("defined")].expect("has a place")
        };
        let path = geodesics.shortest(&place(piece.from), &place(piece.to));
        Side::new(&surface.mesh, path.expect("a way"))
    });
    let quad = Quad {
        ab,
        bc,
        dc: cd.reversed(&surface.mesh),
        ad: da.reversed(&surface.mesh),
    };
    Domain::around(&surface.mesh, quad).expect("a patch")
}

fn measure(mesh: &Mesh, half: [f64; 2]) -> Feasibility {
    let surface = surface(mesh);
    let domain = domain(&surface, &single(half, [5, 5]));
    let [u, v] = [Family::U, Family::V].map(|f| distance_table(&domain, f).expect("a table").0);
    let maps = Maps {
        sides: domain.lengths(),
        u: &u,
        v: &v,
    };
    let curvature = Curvature::estimate(&surface.mesh);
    feasibility(&surface.mesh, &curvature, &domain, &maps, SLOPE).expect("measures")
}

/// Values of the method notes for a bump of spread 0.15 on a square of side 0.9, computed with
/// another program.
#[test]
fn eta_of_a_bump_is_that_of_the_reference() {
    for (height, eta, within) in [(0.1, 1.0, 2e-4), (0.2, 1.019, 3e-3), (0.3, 1.09, 9e-3)] {
        let mesh = bump(height, 0.15, &grid([0.55, 0.55], [44, 44]));
        let found = measure(&mesh, [0.45, 0.45]);
        assert_eq!(found.peaks.len(), 1, "height {height}");
        for (family, found) in found.eta().into_iter().enumerate() {
            assert!(
                (found - eta).abs() < within,
                "height {height}, family {family}: {found} for {eta}"
            );
        }
    }
}

#[test]
fn a_side_over_the_peak_runs_straight_across() {
    let mesh = bump(0.1, 0.15, &grid([0.55, 0.55], [44, 44]));
    let found = measure(&mesh, [0.45, 0.45]);
    for cover in found.peaks[0].coverage {
        assert!((cover.start - 0.5).abs() < 0.05 && (cover.end - 0.5).abs() < 0.05);
        assert!((cover.arms[0] - cover.arms[1]).abs() < 0.03 * cover.arms[0]);
    }
}

#[test]
fn on_an_oblique_patch_a_gentle_peak_near_a_corner_is_covered() {
    // The place of the first side that is closest to the peak is where the straight way over the
    // peak leaves the patch through a neighbouring side.
    let mesh = graph(&grid([2.0, 1.5], [64, 48]), |x, y| {
        let r2 = (x + 0.75) * (x + 0.75) + (y + 0.4) * (y + 0.4);
        0.04 * libm::exp(-r2 / (2.0 * 0.2 * 0.2))
    });
    let surface = surface(&mesh);
    let mut draft = single([1.0, 1.0], [5, 5]);
    for (point, at) in
        draft
            .points
            .iter_mut()
            .zip([[-1.2, -0.6], [0.4, -0.6], [1.4, 0.9], [-0.2, 0.9]])
    {
        point.anchor = Anchor::Above(at);
    }
    let domain = domain(&surface, &draft);
    let [u, v] = [Family::U, Family::V].map(|f| distance_table(&domain, f).expect("a table").0);
    let maps = Maps {
        sides: domain.lengths(),
        u: &u,
        v: &v,
    };
    let curvature = Curvature::estimate(&surface.mesh);
    let found = feasibility(&surface.mesh, &curvature, &domain, &maps, SLOPE).expect("measures");
    assert_eq!(found.peaks.len(), 1);
    for eta in found.eta() {
        assert!(eta < 1.0005, "{eta}");
    }
}

#[test]
fn a_flat_patch_has_no_peak_and_no_bound_and_its_diagonals_are_its_longest_ways() {
    let mesh = graph(&grid([2.0, 1.5], [20, 15]), |_, _| 0.0);
    let found = measure(&mesh, [1.6, 1.2]);
    assert!(found.peaks.is_empty());
    assert_eq!(found.eta(), [1.0, 1.0]);
    for length in [found.longest, found.diagonals[0], found.diagonals[1]] {
        assert!((length - 4.0).abs() < 1e-12, "{length}");
    }
    assert!(found.centre.coords.norm() < 1e-12);
}

#[test]
fn the_bound_of_a_dome_is_that_of_its_sphere() {
    // z of a sphere of radius 5: geodesics are unique up to π 5.
    let mesh = graph(&grid([2.0, 2.0], [40, 40]), |x, y| {
        (25.0 - x * x - y * y).sqrt() - 5.0
    });
    let bound = measure(&mesh, [1.5, 1.5]).injectivity_bound();
    let expected = 5.0 * std::f64::consts::PI;
    assert!((bound.expect("domed") / expected - 1.0).abs() < 0.01);
}
