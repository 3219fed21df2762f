//! The design surface and its curvature.

use super::{outcome, plain};
use crate::build::{Node, Numerics, SourceFile, Stage};
use crate::surface::{Curvature, ReadOptions, SurfaceMesh, read_obj};
use serde::Serialize;

/// A mesh file and how to read it.
#[derive(Debug, Serialize)]
pub(in crate::build) struct SurfaceInput {
    pub(in crate::build) mesh: SourceFile,
    pub(in crate::build) options: ReadOptions,
}

/// Reads and repairs the mesh.
pub(in crate::build) const SURFACE: Stage<SurfaceInput, (), SurfaceMesh> = Stage {
    name: "surface",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (), _| outcome(read_obj(&input.mesh.bytes()?, &input.options)),
};

/// Estimates curvature at all vertices.
pub(in crate::build) const CURVATURE: Stage<(), Node<SurfaceMesh>, Curvature> = Stage {
    name: "curvature",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), surface, _| plain(Curvature::estimate(&surface.mesh)),
};
