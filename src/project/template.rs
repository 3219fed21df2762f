//! The project file that `egg init` writes: small, commented, and it builds as it is.

/// What the mesh beside the template must cover, in millimetres: x and y of two opposite
/// corners of a smooth, gently domed surface, z up. The template's anchors lie well inside.
pub const TEMPLATE_EXTENT: [[f64; 2]; 2] = [[0.0, 0.0], [600.0, 450.0]];

/// The text of a new project in TOML. It names the mesh `NAME.obj`, in millimetres, which covers
/// [`TEMPLATE_EXTENT`].
///
/// `name` must be usable as a project's name; a name that is not makes a file that `egg check`
/// refuses with the reason.
pub fn template(name: &str) -> String {
    let escaped = name.replace('\\', "\\\\").replace('"', "\\\"");
    TEMPLATE.replace("NAME", &escaped)
}

const TEMPLATE: &str = r#"#:schema ./egg.schema.json
# An elastic geodesic grid. `egg check` explains what is wrong, `egg build` writes the plan and
# the drawings, `egg schema project > egg.schema.json` helps your editor.

[project]
format = 1
name = "NAME"
units = "mm"                  # of every number without a unit; "3 mm" or "2.5 m" say their own

[surface]
mesh = "NAME.obj"             # the design surface: triangles or polygons
units = "mm"

[points]                      # anchors: [x, y] lies on the surface above or below that place
a = [70, 70]
b = [530, 70]
c = [530, 380]
d = [70, 380]

[patches.dome]                # a quadrilateral of shortest geodesics between four anchors
corners = ["a", "b", "c", "d"]
members = { u = 7, v = 9 }    # u runs from side a-b to side d-c, v from a-d to b-c
alpha = "auto"                # planar angle at the first corner, or degrees such as 60

[lamella]
width = 10                    # about 2 % of the structure
thickness = 1                 # less than a fifth of the width
material = "limewood"         # `egg materials` lists the others

[hardware]
bolt = "M3"

[fabrication]
stock = { length = 1000, width = 300 }    # sheets, grain along the length
kerf = 0                      # 0 draws nominal geometry; most laser drivers compensate
clearance = 0.2               # play of the bolt in its opening
spacing = 3                   # between parts
margin = 10                   # border of the sheet that stays free
label_height = 3
"#;
