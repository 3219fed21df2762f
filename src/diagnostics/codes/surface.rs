//! Codes of the surface: `E03xx` and lints `W03xx`, all about the mesh file.

use super::{Code, CodeInfo};

/// Nothing in the file.
pub const EMPTY: Code = Code::new("E0301");
/// Another format.
pub const NOT_OBJ: Code = Code::new("E0302");
/// More than egg takes.
pub const TOO_LARGE: Code = Code::new("E0303");
/// A `v` record without three usable numbers.
pub const BAD_VERTEX: Code = Code::new("E0304");
/// An `f` record that names no polygon.
pub const BAD_FACE: Code = Code::new("E0305");
/// A face that names a vertex that is not there.
pub const BAD_INDEX: Code = Code::new("E0306");
/// No face at all.
pub const NO_FACES: Code = Code::new("E0307");
/// A polygon that cannot be cut into triangles.
pub const BAD_POLYGON: Code = Code::new("E0308");
/// A face without area that cannot be taken out.
pub const DEGENERATE: Code = Code::new("E0309");
/// More than two faces at an edge.
pub const EDGE_FAN: Code = Code::new("E0310");
/// Two parts that hang together in one vertex only.
pub const VERTEX_FANS: Code = Code::new("E0311");
/// A Möbius band.
pub const ONE_SIDED: Code = Code::new("E0312");
/// Several parts.
pub const SEVERAL_PARTS: Code = Code::new("E0313");

/// Lines that say nothing to egg.
pub const IGNORED_LINES: Code = Code::new("W0301");
/// Faces that were turned over.
pub const TURNED_FACES: Code = Code::new("W0302");
/// Faces that were taken out.
pub const DROPPED_FACES: Code = Code::new("W0303");
/// A gap that is no border.
pub const OPEN_SEAM: Code = Code::new("W0304");
/// Small parts that were taken out.
pub const DEBRIS: Code = Code::new("W0305");
/// A size that suggests another unit.
pub const SIZE: Code = Code::new("W0306");
/// No border.
pub const CLOSED: Code = Code::new("W0307");
/// Needle-like faces.
pub const SLIVERS: Code = Code::new("W0308");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0301",
        name: "mesh-empty",
        title: "the mesh file is empty",
        text: "The file that `surface.mesh` names has no content at all, or only comments and blank \
lines.

An export that was interrupted or that had nothing selected leaves such a file. Select the surface \
in the modelling program, mesh it, and export it again as Wavefront OBJ.",
    },
    CodeInfo {
        code: "E0302",
        name: "mesh-not-obj",
        title: "the mesh file is no Wavefront OBJ text",
        text: "egg reads meshes as Wavefront OBJ: a text file with `v x y z` and `f a b c` lines. The \
file looks like something else: binary data, UTF-16 text, or another mesh format.

The ending of a file name does not make its format. Export as OBJ; every modelling program has it. \
Text has to be UTF-8 or plain ASCII (comments and names may be in any single-byte encoding).",
    },
    CodeInfo {
        code: "E0303",
        name: "mesh-too-large",
        title: "the mesh is larger than egg takes",
        text: "The file exceeds a fixed limit on its size, its vertices or its faces.

A design surface of 10,000 to 100,000 faces gives member lengths that are far finer than any saw; \
more only costs time. Remesh with longer edges: about 1/100 of the size of a patch is plenty.",
    },
    CodeInfo {
        code: "E0304",
        name: "mesh-vertex",
        title: "a vertex has no usable coordinates",
        text: "A `v` record needs three finite numbers, written with a decimal point: `v 1.5 -0.2 3e-2`.
Further columns (a weight, colours) are allowed and ignored.

Decimal commas come from a program that follows the language of the system: switch its number format \
to a decimal point for the export. `nan` and `inf` come from a computation that failed; look at the \
vertex in the modelling program. A coordinate beyond 100,000 km is taken as a mistake too.",
    },
    CodeInfo {
        code: "E0305",
        name: "mesh-face",
        title: "a face record names no polygon",
        text: "An `f` record lists at least three corners, each `v`, `v/vt`, `v//vn` or `v/vt/vn` with \
whole numbers: `f 1 2 3`, `f 1/1 2/2 3/3`, `f -3 -2 -1`. Texture coordinates and normals are ignored.",
    },
    CodeInfo {
        code: "E0306",
        name: "mesh-index",
        title: "a face names a vertex that the file does not have",
        text: "Vertices are numbered from 1 in the order of the `v` records; negative numbers count back \
from the last one read, -1 being the latest. 0 and numbers beyond the last vertex name nothing.

Usually the file is cut off, or was put together from several files without renumbering.",
    },
    CodeInfo {
        code: "E0307",
        name: "mesh-without-faces",
        title: "the mesh has no faces",
        text: "The file has no `f` record, or none that encloses an area. Points, lines and free-form \
(NURBS) surfaces are not a mesh: mesh the surface in the modelling program and export that.",
    },
    CodeInfo {
        code: "E0308",
        name: "mesh-polygon",
        title: "a polygon cannot be cut into triangles",
        text: "Faces with more than three corners are cut into triangles: quadrilaterals along their \
shorter diagonal, larger polygons (convex or not) by cutting ears in their mean plane. That needs a \
polygon that does not cross or touch itself, encloses an area, and has at most 256 corners.

Triangulate the mesh in the modelling program, or correct the face.",
    },
    CodeInfo {
        code: "E0309",
        name: "mesh-degenerate-face",
        title: "a face without area cannot be taken out",
        text: "A triangle whose corners lie on a line (to a billionth of its length) has no normal and no \
place in the unfolding. egg takes such faces out by turning an edge of the neighbour, or by cutting \
them off at the border. Here neither is possible without tearing the surface.

Remesh the place, or collapse its short edges.",
    },
    CodeInfo {
        code: "E0310",
        name: "mesh-non-manifold-edge",
        title: "more than two faces meet at an edge",
        text: "A surface continues over an edge from one face to one other. Where three or more faces \
meet, as at a rib or where one surface ends on another, `along the surface` has no meaning, and no \
geodesic can be drawn.

Delete the faces that do not belong to the design surface (inner walls, stiffeners, doubled layers).",
    },
    CodeInfo {
        code: "E0311",
        name: "mesh-non-manifold-vertex",
        title: "parts of the surface touch in a single vertex",
        text: "The faces around a vertex have to form one fan. Here they form two or more that touch in \
nothing but the vertex: two sheets that meet in a point, or a hole whose corner touches the border.

Separate the sheets, or fill the gap with a face.",
    },
    CodeInfo {
        code: "E0312",
        name: "mesh-one-sided",
        title: "the surface has only one side",
        text: "Going around the surface, faces come back turned over, as on a Möbius band: there is no \
upper side on which lamellae could lie. This is a property of the shape, not of the order of the \
vertices, which egg repairs by itself.",
    },
    CodeInfo {
        code: "E0313",
        name: "mesh-several-parts",
        title: "the mesh consists of several parts",
        text: "The faces form parts that share no edge, so geodesics cannot pass from one to the other. \
egg does not guess which one is meant. Crumbs with less than a thousandth of the largest part's area \
are dropped with a warning (`mesh-debris`).

If the parts should be one surface, their vertices do not coincide along the seam: weld or join them \
in the modelling program (egg itself welds vertices with exactly equal coordinates only). If they \
should not, export one part.",
    },
    CodeInfo {
        code: "W0301",
        name: "mesh-ignored-lines",
        title: "lines of the mesh file are not understood and ignored",
        text: "The surface is read from `v` and `f` records. Names, groups, materials, normals, texture \
coordinates, points and polylines do not matter to it and are passed over silently. Free-form (NURBS) \
surfaces, weights other than 1, surplus columns and unknown records are passed over with this warning, \
because something might be missing then.",
    },
    CodeInfo {
        code: "W0302",
        name: "mesh-turned-faces",
        title: "faces were turned over to agree with their neighbours",
        text: "Neighbouring faces list their vertices in opposite rotation, so their normals point to \
opposite sides. egg turns over the smaller part (by area). Afterwards the whole surface is oriented so \
that its normals point up on average, or down with `surface.flip`; a closed surface so that they point \
outward.

Unify the normals in the modelling program to silence this, after a look at whether the faces belong \
there at all.",
    },
    CodeInfo {
        code: "W0303",
        name: "mesh-dropped-faces",
        title: "faces without area or present twice were taken out",
        text: "A face that names one point twice, whose corners lie on a line, or that repeats another \
face adds nothing to the surface. It is taken out such that the surface stays closed there.",
    },
    CodeInfo {
        code: "W0304",
        name: "mesh-open-seam",
        title: "border vertices nearly coincide",
        text: "Two vertices of the border lie closer together than a millionth of the surface's size, but \
not at the same place. Most likely two pieces were meant to be joined there. egg welds exactly equal \
coordinates only; geodesics do not cross the slit, so members beside it may be far longer than they \
look.

Weld or join the vertices in the modelling program, with a tolerance of about the distance named.",
    },
    CodeInfo {
        code: "W0305",
        name: "mesh-debris",
        title: "small separate parts were dropped",
        text: "Besides the surface the mesh has parts with less than a thousandth of its area. They are \
taken for crumbs of modelling and dropped.",
    },
    CodeInfo {
        code: "W0306",
        name: "mesh-size",
        title: "the surface has an unusual size",
        text: "Elastic geodesic grids are some decimetres (models) to some hundred metres (roofs) large. \
The mesh is far outside; often it is in another unit than `surface.units` says, which defaults to \
`project.units`. OBJ files do not state their unit.",
    },
    CodeInfo {
        code: "W0307",
        name: "mesh-closed",
        title: "the surface has no border",
        text: "The mesh is closed, like a ball. Often that means that a solid was exported: a shell with \
its upper side, lower side and rim. Then shortest paths may run over the rim and back underneath. \
Export only the design surface: one sheet, without thickness.",
    },
    CodeInfo {
        code: "W0308",
        name: "mesh-slivers",
        title: "some faces are very thin",
        text: "A face is more than a thousand times longer than high. Lengths along the surface stay \
exact, but its curvature, which decides about splitting, is estimated from few rows of vertices there. \
Remeshing with triangles of even size helps.",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_constant_is_explained() {
        let constants = [
            EMPTY,
            NOT_OBJ,
            TOO_LARGE,
            BAD_VERTEX,
            BAD_FACE,
            BAD_INDEX,
            NO_FACES,
            BAD_POLYGON,
            DEGENERATE,
            EDGE_FAN,
            VERTEX_FANS,
            ONE_SIDED,
            SEVERAL_PARTS,
            IGNORED_LINES,
            TURNED_FACES,
            DROPPED_FACES,
            OPEN_SEAM,
            DEBRIS,
            SIZE,
            CLOSED,
            SLIVERS,
        ];
        let listed: Vec<_> = CODES.iter().map(|info| info.code).collect();
        assert_eq!(constants.map(|code| code.to_string()).to_vec(), listed);
    }
}
