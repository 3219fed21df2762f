//! `egg init`: a project that builds as it is.

use crate::cli::console::Console;
use crate::cli::exit::Exit;
use crate::project::{TEMPLATE_EXTENT, template};
use crate::surface::generate::{Grid, Pattern, graph};
use crate::surface::write_obj;
use std::fs;
use std::io;
use std::path::Path;

/// Triangles are about this long, millimetres.
const EDGE: f64 = 12.0;
/// Height of the dome in the middle, millimetres.
const HEIGHT: f64 = 90.0;

pub(in crate::cli) fn run(console: Console, name: &str) -> Exit {
    let folder = Path::new(name);
    let Some(stem) = folder
        .file_name()
        .and_then(|n| n.to_str())
        .filter(|n| usable(n))
    else {
        console.complain(
            &format!("`{name}` is no name for a project"),
            Some("use letters, digits, `-` and `_`"),
        );
        return Exit::Usage;
    };
    if folder.exists() {
        console.complain(
            &format!("`{name}` exists already"),
            Some("choose another name; nothing was written"),
        );
        return Exit::Usage;
    }
    match write(folder, stem) {
        Ok(()) => {
            console.status(
                "Created",
                &format!("project `{stem}` in {}", folder.display()),
            );
            Exit::Done
        }
        Err(error) => {
            console.complain(&format!("cannot create `{name}`: {error}"), None);
            Exit::Usage
        }
    }
}

fn usable(name: &str) -> bool {
    !name.is_empty()
        && name
            .chars()
            .all(|c| c.is_alphanumeric() || c == '-' || c == '_')
}

/// Writes into a new folder only: nothing of the user's is touched.
fn write(folder: &Path, stem: &str) -> io::Result<()> {
    fs::create_dir(folder)?;
    fs::write(folder.join(format!("{stem}.toml")), template(stem))?;
    fs::write(folder.join(format!("{stem}.obj")), dome())?;
    fs::write(folder.join("egg.schema.json"), crate::project::schema())?;
    fs::write(folder.join(".gitignore"), "/build\n")
}

/// A gentle dome over the extent of the template, in millimetres.
fn dome() -> String {
    let [[x0, y0], [x1, y1]] = TEMPLATE_EXTENT;
    let (width, depth) = (x1 - x0, y1 - y0);
    let grid = Grid {
        u: [x0, x1],
        v: [y0, y1],
        cells: [(width / EDGE) as u32, (depth / EDGE) as u32],
        pattern: Pattern::Alternating,
    };
    let arch = |share: f64| libm::sin(std::f64::consts::PI * share);
    let height = |x: f64, y: f64| HEIGHT * arch((x - x0) / width) * arch((y - y0) / depth);
    write_obj(&graph(&grid, height), "a gentle dome, millimetres")
}
