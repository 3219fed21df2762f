//! Anchors, lines and patches.

use super::cladding::no_geodesic;
use super::{judged, plain};
use crate::build::{Failure, Node, Numerics, Stage};
use crate::diagnostics::codes::layout as codes;
use crate::diagnostics::{Diagnostic, Warned};
use crate::geodesic::GeodesicError;
use crate::layout::{
    Bend, Domain, Network, PlacedPatch, Quad, Side, Structure, bend_at_border, check_network,
    check_quad, hole_inside, place, place_anchors, shortest_line,
};
use crate::project::model::Anchor;
use crate::surface::{Mesh, Point3, SurfaceMesh, SurfacePoint};
use serde::Serialize;
use std::collections::BTreeMap;

/// Anchors by name; those on a line are left to it.
pub(in crate::build) type Anchors = BTreeMap<String, SurfacePoint>;

/// Finds all anchors that have a place of their own.
pub(in crate::build) const ANCHORS: Stage<Vec<(String, Anchor)>, Node<SurfaceMesh>, Anchors> =
    Stage {
        name: "anchors",
        version: 2,
        numerics: Numerics::Portable,
        run: |anchors, surface, _| {
            let Warned { value, warnings } =
                place_anchors(surface, anchors).map_err(Failure::Errors)?;
            let named = anchors.iter().zip(value);
            let value = named
                .filter_map(|((name, _), at)| Some((name.clone(), at?)))
                .collect();
            Ok(Warned { value, warnings })
        },
    };

/// One anchor of all: what depends on it does not depend on the others.
pub(in crate::build) const ANCHOR: Stage<String, Node<Anchors>, SurfacePoint> = Stage {
    name: "anchor",
    version: 1,
    numerics: Numerics::Portable,
    run: |name, anchors, _| match anchors.get(name) {
        Some(point) => plain(*point),
        None => Err(Failure::Errors(Vec::new())),
    },
};

/// The shortest geodesic between two anchors.
pub(in crate::build) const LINE: Stage<
    (),
    (Node<SurfaceMesh>, Node<SurfacePoint>, Node<SurfacePoint>),
    Side,
> = Stage {
    name: "line",
    version: 5,
    numerics: Numerics::Portable,
    run: |(), (surface, from, to), _| {
        let mesh = &surface.mesh;
        let path = shortest_line(mesh, from, to)
            .map_err(|error| Failure::from(no_line(mesh, [from, to], &error)))?;
        match bend_at_border(mesh, &path) {
            Some(bend) => Err(blocked(mesh, [from, to], &bend).into()),
            None => plain(Side::new(mesh, path)),
        }
    },
};

/// Both ends of a line with their places. The names are those of the fields `from` and `to`.
fn ends(mesh: &Mesh, [from, to]: [&SurfacePoint; 2]) -> String {
    let [from, to] = [from, to].map(|point| place(point.position(mesh)));
    format!("{{.from}} at {from} to {{.to}} at {to}")
}

fn no_line(mesh: &Mesh, points: [&SurfacePoint; 2], error: &GeodesicError) -> Diagnostic {
    let (code, why, help) = match error {
        GeodesicError::Coincident { .. } => (
            codes::SAME_PLACE,
            "they are one place of the surface".to_owned(),
            "move one of the two anchors of this side",
        ),
        GeodesicError::Unreachable { .. } => (
            codes::NO_PATH,
            "they lie on different parts of the surface".to_owned(),
            "put both anchors on the same part of the surface",
        ),
        other => (
            codes::NO_PATH,
            other.to_string(),
            "check the mesh for faces without area between the anchors",
        ),
    };
    let ends = ends(mesh, points);
    Diagnostic::error(code, format!("no geodesic leads from {ends}: {why}"))
        .at_key(".", "a side begins here")
        .help(help)
}

fn blocked(mesh: &Mesh, points: [&SurfacePoint; 2], bend: &Bend) -> Diagnostic {
    Diagnostic::error(
        codes::BLOCKED,
        format!(
            "the shortest way from {} is blocked by the border of the surface: it bends around it \
             by {:.1}°, most at {}",
            ends(mesh, points),
            bend.total.to_degrees(),
            place(bend.at)
        ),
    )
    .at_key(".", "a side begins here")
    .help(
        "lay the side beside the hole, let two patches meet in an anchor on the way, or close the \
         hole in the mesh",
    )
}

/// The place of an anchor on a line, by share of its length.
pub(in crate::build) const STATION: Stage<f64, (Node<SurfaceMesh>, Node<Side>), SurfacePoint> =
    Stage {
        name: "station",
        version: 1,
        numerics: Numerics::Portable,
        run: |share, (surface, line), _| plain(line.at(&surface.mesh, *share)),
    };

/// Which pieces of lines the sides of a patch are: shares from and to, for the sides 1-2, 2-3,
/// 3-4 and 4-1.
#[derive(Debug, Serialize)]
pub(in crate::build) struct PatchInput {
    pub(in crate::build) corners: [[f64; 2]; 4],
}

type Lines = (Node<Side>, Node<Side>, Node<Side>, Node<Side>);

/// The domain of a patch, on the part of the mesh around it.
pub(in crate::build) const PATCH: Stage<PatchInput, (Node<SurfaceMesh>, Lines), Domain> = Stage {
    name: "patch",
    version: 3,
    numerics: Numerics::Portable,
    run: |input, (surface, (first, second, third, fourth)), _| {
        let mesh = &surface.mesh;
        let piece =
            |line: &Side, i: usize| line.piece(mesh, input.corners[i][0], input.corners[i][1]);
        let quad = Quad {
            ab: piece(first, 0),
            bc: piece(second, 1),
            dc: piece(third, 2).reversed(mesh),
            ad: piece(fourth, 3).reversed(mesh),
        };
        let domain = Domain::around(mesh, quad).map_err(|error| no_geodesic(&error))?;
        let mut faults = check_quad(&domain);
        if faults.is_empty() {
            faults.extend(hole_inside(mesh, &domain).map(pierced));
        }
        judged(domain, faults)
    },
};

fn pierced(at: Point3) -> Diagnostic {
    Diagnostic::error(
        codes::HOLE,
        format!(
            "the surface has a hole inside patch {{.}}: its border passes {}",
            place(at)
        ),
    )
    .at_key(".corners", "the corners of this patch")
    .help("lay several patches around the hole, or close it in the mesh")
}

/// What lines and patches are called, in the order of the nodes that carry them.
#[derive(Debug, Serialize)]
pub(in crate::build) struct NetworkInput {
    pub(in crate::build) network: Network,
    /// Names of patches and of their corners.
    pub(in crate::build) patches: Vec<(String, [String; 4])>,
}

type NetworkNeeds = (Node<SurfaceMesh>, Vec<Node<Side>>, Vec<Node<Domain>>);

/// Whether patches stand beside each other as they should.
pub(in crate::build) const NETWORK: Stage<NetworkInput, NetworkNeeds, ()> = Stage {
    name: "network",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (surface, lines, domains), _| {
        let named = input.patches.iter().zip(&input.network.sides);
        let structure = Structure {
            mesh: &surface.mesh,
            lines: input.network.lines.iter().zip(lines).collect(),
            patches: named
                .zip(domains)
                .map(|(((name, corners), sides), domain)| PlacedPatch {
                    name,
                    corners,
                    sides: *sides,
                    domain,
                })
                .collect(),
        };
        judged((), check_network(&structure))
    },
};
