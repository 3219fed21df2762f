//! Is this an OBJ file at all? Judged before its lines are, so that another format gives one
//! answer instead of a thousand.

use super::MAX_BYTES;
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};

/// UTF-8 byte order mark.
const BOM: &[u8] = b"\xef\xbb\xbf";

/// Where the text begins, behind a byte order mark; or why this is no OBJ text.
pub(super) fn text_start(bytes: &[u8]) -> Result<usize, Box<Diagnostic>> {
    if bytes.len() > MAX_BYTES {
        return Err(too_large(format!(
            "the mesh file has {} MB, the limit is {} MB",
            bytes.len() >> 20,
            MAX_BYTES >> 20
        )));
    }
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        let diagnostic = not_obj("the mesh file is UTF-16 text", 0..2);
        return Err(Box::new(diagnostic.help("save it as UTF-8 or ASCII")));
    }
    if let Some(name) = format_of(bytes) {
        return Err(Box::new(
            not_obj(format!("the mesh file is {name}, not Wavefront OBJ"), 0..1)
                .help("export the surface as Wavefront OBJ (.obj)"),
        ));
    }
    if let Some(at) = bytes.iter().position(|&b| b == 0) {
        return Err(Box::new(
            not_obj(
                "the mesh file is binary, not Wavefront OBJ text",
                at..at + 1,
            )
            .help("export the surface as Wavefront OBJ (.obj)"),
        ));
    }
    let start = if bytes.starts_with(BOM) { BOM.len() } else { 0 };
    if bytes[start..].trim_ascii().is_empty() {
        return Err(Box::new(
            Diagnostic::error(codes::EMPTY, "the mesh file is empty")
                .at_bytes(File::Mesh, 0..bytes.len().min(1), "nothing here")
                .help("export the surface again as Wavefront OBJ"),
        ));
    }
    Ok(start)
}

pub(super) fn too_large(message: String) -> Box<Diagnostic> {
    Box::new(
        Diagnostic::error(codes::TOO_LARGE, message)
            .at_bytes(File::Mesh, 0..1, "the file")
            .help("remesh the surface more coarsely"),
    )
}

fn not_obj(message: impl Into<String>, at: std::ops::Range<usize>) -> Diagnostic {
    Diagnostic::error(codes::NOT_OBJ, message).at_bytes(File::Mesh, at, "found here")
}

/// Formats that are met under the name `.obj`, by how they begin. Only marks that no OBJ file can
/// begin with.
fn format_of(bytes: &[u8]) -> Option<&'static str> {
    const MARKS: [(&[u8], &str); 14] = [
        (b"solid", "an STL file"),
        (b"ply\n", "a PLY file"),
        (b"ply\r", "a PLY file"),
        (b"OFF", "an OFF file"),
        (b"PK\x03\x04", "a zip archive"),
        (b"\x1f\x8b", "a gzip archive"),
        (b"glTF", "a binary glTF file"),
        (b"{", "a JSON or glTF file"),
        (b"<", "an XML file (COLLADA, AMF or 3MF)"),
        (b"ISO-10303-21", "a STEP file"),
        (b"3D Geometry File Format", "a Rhino 3DM file"),
        (b"Kaydara FBX", "an FBX file"),
        (b"BLENDER", "a Blender file"),
        (b"\x4c\x01", "compiled object code (COFF)"),
    ];
    let text = bytes.strip_prefix(BOM).unwrap_or(bytes).trim_ascii_start();
    MARKS
        .iter()
        .find(|(mark, _)| text.starts_with(mark))
        .map(|&(_, name)| name)
}
