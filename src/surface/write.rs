//! Writes meshes as Wavefront OBJ.

use super::Mesh;
use std::fmt::Write;

/// OBJ text of a mesh in metres, to the nanometre, preceded by a comment; ends with a newline.
///
/// Equal meshes give equal bytes. Reading it back gives the same faces and positions within half
/// a nanometre.
pub fn write_obj(mesh: &Mesh, comment: &str) -> String {
    let mut text = String::new();
    for line in comment.lines() {
        // Without a backslash at its end, which joins lines for some readers.
        push(
            &mut text,
            format_args!("# {}\n", line.trim_end_matches('\\')),
        );
    }
    for p in mesh.positions() {
        // Adding zero after rounding turns -0 into 0.
        let [x, y, z] = [p.x, p.y, p.z].map(|c| (c * 1e9).round() / 1e9 + 0.0);
        push(&mut text, format_args!("v {x:.9} {y:.9} {z:.9}\n"));
    }
    for [a, b, c] in mesh.faces() {
        push(&mut text, format_args!("f {} {} {}\n", a + 1, b + 1, c + 1));
    }
    text
}

fn push(text: &mut String, line: std::fmt::Arguments<'_>) {
    text.write_fmt(line).expect("a string takes all text");
}
