//! The project that edits are tried on, and edits.

use crate::program::{Ran, Workshop};
use std::path::Path;

/// Project file and mesh.
#[derive(Debug, Clone)]
pub(crate) struct Project {
    pub(crate) text: String,
    pub(crate) mesh: String,
}

impl Project {
    /// The one of the corpus.
    pub(crate) fn bays() -> Self {
        let read = |name: &str| {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/diff");
            std::fs::read_to_string(folder.join(name)).expect("a file of the corpus")
        };
        Self {
            text: read("bays.toml"),
            mesh: read("bays.obj"),
        }
    }

    /// With one text replaced by another, which has to be there once.
    #[track_caller]
    pub(crate) fn with(mut self, old: &str, new: &str) -> Self {
        assert_eq!(self.text.matches(old).count(), 1, "{old}");
        self.text = self.text.replace(old, new);
        self
    }

    /// With every text replaced by another.
    #[track_caller]
    pub(crate) fn with_all(mut self, old: &str, new: &str) -> Self {
        assert!(self.text.contains(old), "{old}");
        self.text = self.text.replace(old, new);
        self
    }

    /// With the vertex at (x, y) of the mesh lifted, metres.
    #[track_caller]
    pub(crate) fn with_lifted(mut self, x: f64, y: f64, by: f64) -> Self {
        let begin = format!("v {x:.1} {y:.1} ");
        let line = self.mesh.lines().find(|line| line.starts_with(&begin));
        let line = line.expect("a vertex").to_owned();
        let z: f64 = line[begin.len()..].parse().expect("a height");
        self.mesh = self.mesh.replace(&line, &format!("{begin}{:.6}", z + by));
        self
    }

    /// Writes it into a folder of a workshop.
    pub(crate) fn write(&self, workshop: &Workshop, folder: &str) {
        workshop.write(&format!("{folder}/bays.toml"), &self.text);
        workshop.write(&format!("{folder}/bays.obj"), &self.mesh);
    }
}

/// An edit with a name.
pub(crate) type Edit = (&'static str, fn(Project) -> Project);

/// What people do to project files.
pub(crate) const EDITS: [Edit; 22] = [
    ("alpha", |p| p.with("v = 4 }", "v = 4 }\nalpha = 60")),
    ("bolt", |p| p.with("\"M4\"", "\"M5\"")),
    ("comment", |p| {
        p.with("[lamella]", "# Wood from the north.\n\n[lamella]")
    }),
    ("kerf", |p| p.with("kerf = 0.15", "kerf = 0.3")),
    ("lamella-width", |p| p.with("width = 20", "width = 22")),
    ("material", |p| {
        p.with("\"poplar-plywood\"", "\"birch-plywood\"")
    }),
    ("member-count", |p| p.with("u = 5, v = 4", "u = 6, v = 4")),
    ("mesh-vertex-a-hundredth", |p| p.with_lifted(0.5, 0.5, 1e-5)),
    ("mesh-vertex-five", |p| p.with_lifted(0.5, 0.5, 5e-3)),
    ("order-of-tables", |mut p| {
        let west =
            "[patches.west]\ncorners = [\"a\", \"b\", \"e\", \"d\"]\nmembers = { u = 5, v = 4 }\n";
        assert!(p.text.contains(west));
        p.text = p.text.replace(west, "") + "\n" + west;
        p
    }),
    ("patch-added", |p| {
        p.with("f = [1650, 850]", "f = [1650, 850]\ng = [1900, 150]\nh = [1900, 850]")
            .with(
                "[lamella]",
                "[patches.porch]\ncorners = [\"c\", \"g\", \"h\", \"f\"]\nmembers = { u = 3 }\n\n[lamella]",
            )
    }),
    ("patch-removed", |p| {
        p.with(
            "[patches.east]\ncorners = [\"b\", \"c\", \"f\", \"e\"]\nmembers = { u = 5 }\n",
            "",
        )
        .with("c = [1650, 150]\n", "")
        .with("f = [1650, 850]\n", "")
    }),
    ("patch-renamed", |p| {
        p.with("[patches.west]", "[patches.shore]")
    }),
    ("patch-renamed-and-widened", |p| {
        p.with("[patches.west]", "[patches.shore]")
            .with("width = 20", "width = 22")
    }),
    ("point-moved", |p| {
        p.with("a = [150, 150]", "a = [151, 150]")
    }),
    ("point-renamed", |p| {
        p.with("a = [150", "gate = [150")
            .with("[\"a\",", "[\"gate\",")
    }),
    ("price", |p| {
        p.with(
            "length = 1200, width = 400",
            "length = 1200, width = 400, price = 18",
        )
    }),
    ("project-renamed", |p| p.with("\"bays\"", "\"two-bays\"")),
    ("sheet-size", |p| {
        p.with("length = 1200, width = 400", "length = 1500, width = 400")
    }),
    ("support", |p| p.with("height = 120", "height = 150")),
    ("thickness-of-a-patch", |p| {
        p.with("[hardware]", "[lamella.east]\nthickness = 4\n\n[hardware]")
    }),
    ("units", |p| {
        p.with("units = \"mm\"", "units = \"cm\"")
            .with_all("[150, 150]", "[15, 15]")
            .with_all("[900, 150]", "[90, 15]")
            .with_all("[1650, 150]", "[165, 15]")
            .with_all("[150, 850]", "[15, 85]")
            .with_all("[900, 850]", "[90, 85]")
            .with_all("[1650, 850]", "[165, 85]")
            .with("width = 20", "width = \"20 mm\"")
            .with("thickness = 3", "thickness = 0.3")
            .with("height = 120", "height = 12")
            .with("length = 1200, width = 400", "length = 120, width = 40")
            .with("kerf = 0.15", "kerf = \"0.15 mm\"")
            .with("clearance = 0.2", "clearance = \"0.2 mm\"")
            .with("spacing = 3", "spacing = 0.3")
            .with("margin = 10", "margin = 1")
    }),
];

/// The project before and after an edit, in the folders `before` and `after`.
pub(crate) fn tried(workshop: &Workshop, edit: fn(Project) -> Project) {
    Project::bays().write(workshop, "before");
    edit(Project::bays()).write(workshop, "after");
}

/// `egg diff` of the two folders.
pub(crate) fn diff(workshop: &Workshop, options: &[&str]) -> Ran {
    let mut arguments = vec!["diff", "before/bays.toml", "after/bays.toml"];
    arguments.extend(options);
    workshop.egg(&arguments)
}
