//! Codes of reading and writing files: `E09xx`.

use super::CodeInfo;

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0901",
        name: "mesh-unreadable",
        title: "the mesh file cannot be read",
        text: "\
`surface.mesh` names a file relative to the folder of the project file. It is not there, or may not \
be read. Check the spelling; paths use forward slashes on every system.",
    },
    CodeInfo {
        code: "E0902",
        name: "mesh-outside",
        title: "the mesh lies outside the project",
        text: "\
Whoever has the project should have its mesh: the path may not leave the git repository of the \
project file, or its folder where there is no repository. Copy the mesh beside the project file.",
    },
];
