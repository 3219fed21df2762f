//! Anchors, lines and patches.

use super::cladding::no_geodesic;
use super::{judged, plain};
use crate::build::{Failure, Node, Numerics, Stage};
use crate::diagnostics::codes::layout as codes;
use crate::diagnostics::{Diagnostic, Warned};
use crate::geodesic::{GeodesicError, Geodesics};
use crate::layout::{Domain, Quad, Side, check_quad, place_anchors};
use crate::project::model::Anchor;
use crate::surface::{SurfaceMesh, SurfacePoint};
use serde::Serialize;
use std::collections::BTreeMap;

/// Anchors by name; those on a line are left to it.
pub(in crate::build) type Anchors = BTreeMap<String, SurfacePoint>;

/// Finds all anchors that have a place of their own.
pub(in crate::build) const ANCHORS: Stage<Vec<(String, Anchor)>, Node<SurfaceMesh>, Anchors> =
    Stage {
        name: "anchors",
        version: 1,
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
    version: 1,
    numerics: Numerics::Portable,
    run: |(), (surface, from, to), _| {
        let mesh = &surface.mesh;
        let path = Geodesics::new(mesh)
            .shortest(from, to)
            .map_err(|error| Failure::from(no_line(&error)))?;
        plain(Side::new(mesh, path))
    },
};

fn no_line(error: &GeodesicError) -> Diagnostic {
    let (code, help) = match error {
        GeodesicError::Coincident { .. } => (
            codes::SAME_PLACE,
            "move one of the two anchors of this side",
        ),
        GeodesicError::Unreachable { .. } => (
            codes::NO_PATH,
            "put both anchors on the same part of the surface",
        ),
        _ => (
            codes::NO_PATH,
            "check the mesh for faces without area between the anchors",
        ),
    };
    Diagnostic::error(code, format!("no geodesic joins the two anchors: {error}"))
        .at_key("", "this side")
        .help(help)
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
    version: 1,
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
        let faults = check_quad(&domain);
        judged(domain, faults)
    },
};
