//! Codes of the language: `E01xx` reading the file, `E02xx` its meaning, `W02xx` lints.

use super::CodeInfo;

/// A registry entry.
const fn info(
    code: &'static str,
    name: &'static str,
    title: &'static str,
    text: &'static str,
) -> CodeInfo {
    CodeInfo {
        code,
        name,
        title,
        text,
    }
}

pub(super) const CODES: &[CodeInfo] = &[
    info(
        "E0101",
        "syntax",
        "the file is not TOML or RON",
        "The text breaks the rules of its notation, so nothing in it can be read for certain. A file \
that ends in `.toml` is read as TOML, one that ends in `.ron` as RON. All syntax errors of the file \
are reported at once.

Frequent slips in TOML: a string without quotes, a missing `]` or `}`, two keys in one line:

    name = pavilion          # wrong: a string needs quotes
    name = \"pavilion\"

In RON: a missing comma between fields, or a word with a hyphen without quotes:

    supports: (kind: \"concrete-block\", height: 120)",
    ),
    info(
        "E0102",
        "duplicate-key",
        "a key is set twice",
        "A key may be set once. Which of two values should count is not for a compiler to guess.

In TOML a table is opened once; its keys stand together:

    [patches.west]
    corners = [\"a\", \"b\", \"e\", \"d\"]
    [patches.west]                    # wrong: opened a second time
    members = { u = 9 }

Move the keys of the second one to the first, or rename one of the two.",
    ),
    info(
        "E0103",
        "nested-too-deep",
        "tables and lists are nested too deep",
        "No part of a project needs more than five levels of tables and lists in each other; the \
reader allows 32. A deeper file is most likely damaged, or a bracket is not closed.",
    ),
    info(
        "E0104",
        "not-utf8",
        "the project file is not UTF-8 text",
        "Project files are UTF-8 (plain ASCII is UTF-8). Some editors on Windows save \"Unicode\", \
which is UTF-16, or a local encoding such as Windows-1252, in which a letter with an accent is one \
byte. Save the file again and choose UTF-8. A byte order mark at the start does no harm.

If the file is a mesh or a drawing, it is not the project: give the `.toml` or `.ron` file that \
names it.",
    ),
    info(
        "E0105",
        "file-too-large",
        "the project file is too large",
        "A project is written by hand and has some hundred lines; files beyond 8 MB are not read. \
Surfaces are files of their own, named by `surface.mesh`.",
    ),
    info(
        "E0106",
        "unknown-format",
        "the format number is unknown",
        "`project.format` says for which version of the language the file was written, so that an \
old file keeps its meaning when the language grows. This `egg` reads format 1.

A larger number: the file was written for a newer `egg`. Install that version.

Any other number: write

    [project]
    format = 1",
    ),
    info(
        "E0110",
        "unknown-key",
        "a key is unknown",
        "Every key is known to the language; a misspelt one would otherwise be ignored, and its \
default would be built. Compare the spelling with the suggestion, or look the table up in the JSON \
schema (`egg schema project`), which editors use for completion.

    [lamella]
    widht = 30         # wrong: `width`",
    ),
    info(
        "E0111",
        "missing-key",
        "a required key is missing",
        "Everything has a default but the mesh, the points, the patches, the lamella and one count \
of members for each strip; tables such as a material or a stock sheet need all their values. The \
smallest project is:

    [surface]
    mesh = \"pavilion.obj\"

    [points]
    a = [0, 0]
    b = [800, 0]
    c = [800, 600]
    d = [0, 600]

    [patches.roof]
    corners = [\"a\", \"b\", \"c\", \"d\"]
    members = { u = 7, v = 7 }

    [lamella]
    width = 10
    thickness = 1
    material = \"limewood\"",
    ),
    info(
        "E0112",
        "wrong-type",
        "a value is of the wrong type",
        "The key takes another type of value. Counts are whole numbers without a point; lengths, \
angles and stresses are numbers or strings with a unit; names are strings in quotes.

    members = { u = 7.0 }     # wrong: a count is a whole number, 7
    width = \"30 mm\"           # right, and so is 30 with units = \"mm\"",
    ),
    info(
        "E0113",
        "wrong-length",
        "a list or table has the wrong number of items",
        "The list takes another number of items: a patch has exactly 4 corners, a point 2 or 3 \
coordinates, gravity 3 components, a slope 2 bounds. Items too many are never dropped silently.",
    ),
    info(
        "E0114",
        "unknown-word",
        "a word is not among those the key knows",
        "The key takes one of a few words, which the message lists. They are written in lower case, \
with hyphens: `concrete-block`, `every-boundary-crossing`.",
    ),
    info(
        "E0115",
        "not-a-quantity",
        "a string is not a number with a unit",
        "A string for a length, an angle, a stress, a density or an acceleration is a decimal number \
and a unit: `\"3 mm\"`, `\"7.6 GPa\"`, `\"430 kg/m^3\"`, `\"60 deg\"`. The space is optional. \
Decimals are written with a point, powers of ten as `1e3`; there are no thousands separators.

A number without quotes needs no unit: lengths are then in `project.units`, angles in degrees, the \
rest in SI (Pa, kg/m^3, m/s^2).",
    ),
    info(
        "E0116",
        "wrong-unit",
        "a unit does not fit",
        "The unit is unknown, or it measures something else than the key says.

| quantity     | units                       |
|--------------|-----------------------------|
| length       | mm, cm, m, in, ft           |
| angle        | deg, rad                    |
| stress       | Pa, kPa, MPa, GPa, N/mm^2   |
| density      | kg/m^3, g/cm^3              |
| acceleration | m/s^2                       |

    density = \"7.6 GPa\"      # wrong: that is a stress",
    ),
    info(
        "E0117",
        "out-of-range",
        "a value is out of range",
        "The value lies outside of what the key can mean: a width of 0, a share of 1, a plan angle of \
180 degrees, a count of members below 2. The message gives the bounds in the unit of the file. A \
length that is a thousand times off usually has the wrong unit: bare lengths are in \
`project.units`.",
    ),
    info(
        "E0118",
        "not-finite",
        "a number is infinite or not a number",
        "TOML and RON can write `inf` and `nan`, but no length, weight or modulus has such a value. \
To leave something without a limit, leave the key out.",
    ),
    info(
        "E0119",
        "bad-name",
        "a name cannot be used",
        "Names of points, patches, materials and of the project live on in ids (`west.u03-v05`), in \
file names and in labels engraved on the parts. So a name has 1 to 40 letters of the English \
alphabet, digits, `_` and `-`, and starts with a letter or digit. Names that Windows keeps for \
devices (`con`, `nul`, `com1`, ...) are refused everywhere.

A patch may not be called `width`, `thickness` or `material`: in `[lamella]` these keys are the \
properties of every lamella, and any other key there is the name of a patch.",
    ),
    info(
        "E0120",
        "names-collide",
        "two names differ only in upper and lower case",
        "On Windows and macOS `West.ron` and `west.ron` are one file, so the results of one patch \
would overwrite those of the other. Rename one.",
    ),
    info(
        "E0121",
        "bad-path",
        "a path cannot be used",
        "A path is relative to the folder of the project file and has `/` between its parts on every \
system. Then the project builds the same wherever it is copied or cloned.

    mesh = \"meshes/roof.obj\"            # right
    mesh = \"C:\\\\models\\\\roof.obj\"        # wrong: only on one machine",
    ),
    info(
        "E0122",
        "unknown-bolt",
        "the bolt is unknown",
        "`hardware.bolt` is the size of a metric machine screw as ISO 261 names it: M1.6, M2, M2.5, M3, \
M4, M5, M6, M8, M10, M12, M14, M16, M20, M24 or M30. Its length is not said: it follows from the \
thickness of what it clamps, and the bill of materials rounds it up to a length that is sold.",
    ),
    info(
        "E0123",
        "unknown-tube",
        "the tube is not understood",
        "`hardware.shell` is a tube as it is sold: a material, the outer diameter and the thickness of \
the wall, both in millimetres.

    shell = \"brass 5x0.5\"       # bore 4 mm, for an M4 bolt",
    ),
    info(
        "E0201",
        "undefined-point",
        "a point is not defined",
        "A corner, the edge of an anchor or a support names a point that `[points]` does not have. \
Points are defined by coordinates, by a vertex of the mesh, or on the geodesic between two others:

    [points]
    a = [150, 150]
    c = { vertex = 1207 }
    t = { on = [\"a\", \"b\"], at = 0.5 }",
    ),
    info(
        "E0202",
        "undefined-patch",
        "a patch is not defined",
        "A table in `[lamella]`, a family in `distribution.closed` or a crossing names a patch that \
`[patches]` does not have. In `[lamella]` the keys `width`, `thickness` and `material` are properties; \
every table there must have the name of a patch.",
    ),
    info(
        "E0203",
        "undefined-material",
        "a material is not defined",
        "The material is neither built in (`egg materials` lists those) nor defined in `[materials]`:

    [materials.my-ash]
    elastic_modulus = \"12 GPa\"
    shear_modulus = \"0.9 GPa\"
    density = \"680 kg/m^3\"
    bending_strength = \"90 MPa\"
    grain = \"along\"",
    ),
    info(
        "E0204",
        "undefined-lint",
        "a lint is not defined",
        "`lints.allow` holds names of warnings. The name stands beside the code of every warning; \
`egg explain NAME` tells what it is about. Errors cannot be allowed.

    [lints]
    allow = [\"thick-lamella\"]",
    ),
    info(
        "E0205",
        "repeated-corner",
        "a patch has a corner twice",
        "A patch is a quadrilateral with four different corners; with a corner twice one of its sides \
has no length and its families cannot be laid out. A triangular region is covered by three \
quadrilaterals that meet in its middle.",
    ),
    info(
        "E0206",
        "counts-disagree",
        "a strip is given two counts",
        "Members run on across the side that two patches share, so all patches that are chained in \
this way have one number of members. The families of a patch are chained independently: u-members \
cross sides 1-2 and 3-4, v-members sides 2-3 and 4-1. Give the count of a strip once, in any of its \
patches:

    [patches.west]
    corners = [\"a\", \"b\", \"e\", \"d\"]
    members = { u = 9, v = 7 }

    [patches.east]                   # shares the side b-e, so it has west's v
    corners = [\"b\", \"c\", \"f\", \"e\"]
    members = { u = 8 }",
    ),
    info(
        "E0207",
        "count-missing",
        "a strip is given no count",
        "Nobody says how many members this strip has. The count includes the two boundary members, so \
it is at least 2. Add it to `members` of any patch of the strip:

    members = { u = 9, v = 7 }

Across a T-junction a count is computed if all others are given (see E0218).",
    ),
    info(
        "E0208",
        "crowded-side",
        "more than two patches lie along one side",
        "A side on a surface has a left and a right, so at most two patches lie along it. Most likely a \
corner has a wrong name. With a T-junction the parts of a long side count as well: the long side \
is one patch's, its parts are the other patches'.",
    ),
    info(
        "E0209",
        "anchor-cycle",
        "anchors are defined by each other",
        "An anchor with `on` lies on the geodesic between two other anchors, which must be known \
before. Here the way leads back to the anchor itself. Give one of them coordinates or a vertex.

A pinwheel, where four patches turn around a small one and a corner of each stands on a side of the \
next, is such a circle: no side is there before the others, because each ends on the next. Break it \
where it shows least: give one of the inner corners coordinates, let the long side that passed it end \
there, and divide the patch of that long side by a side from there to the opposite one. The three \
other corners stay T-junctions.",
    ),
    info(
        "E0210",
        "no-edge",
        "an anchor lies between a point and itself",
        "`on` names the two different ends of a geodesic:

    t = { on = [\"a\", \"b\"], at = 0.5 }",
    ),
    info(
        "E0211",
        "unknown-side",
        "no patch has this side",
        "A weight belongs to a side of a patch, written as its two anchors with a hyphen between \
them, in either order. Diagonals are no sides.

    [distribution]
    weights = { \"a-d\" = 2.0 }",
    ),
    info(
        "E0212",
        "repeated-weight",
        "a side is given two weights",
        "`a-b` and `b-a` are the same side. Keep one of the weights.",
    ),
    info(
        "E0213",
        "unknown-support",
        "a support is at no point or crossing",
        "A list in `supports.at` holds names of points and ids of crossings. The id of a crossing is \
made of its patch and the two members, counted from 01: `west.u03-v05` is where the third u-member \
and the fifth v-member of `west` cross. Boundary members are counted too.",
    ),
    info(
        "E0214",
        "not-a-ring",
        "a strip that shall close is not a ring",
        "`distribution.closed` lists families whose members shall end where they start. That is only \
possible if the patches of the strip go around and the last shares a side with the first.",
    ),
    info(
        "E0215",
        "bolt-too-wide",
        "an opening takes more than half of the lamella",
        "At a crossing the opening (bolt or tube, and the clearance) interrupts the section that \
carries the bending. Beyond half of the width the lamella breaks there before it bends. Usual are M3 \
for lamellae of 8 to 15 mm, M4 up to 30 mm, and about a tenth of the width above.",
    ),
    info(
        "E0216",
        "bolt-outside-tube",
        "the bolt does not go through the tube",
        "The tube stands around the bolt: its bore (outer diameter less two walls) is at least the \
bolt's nominal diameter. `brass 4x0.45` has a bore of 3.1 mm for M3, `brass 5x0.45` one of 4.1 mm \
for M4.",
    ),
    info(
        "E0217",
        "sheet-too-small",
        "no lamella fits on the sheet or the bed",
        "A lamella lies along the grain, which is the sheet's length. Less the margin on both sides, \
the width of the sheet (and of the machine's bed) must hold at least one lamella. If the numbers look \
absurd the unit is wrong: bare lengths are in `project.units`.",
    ),
    info(
        "E0218",
        "junction-counts",
        "counts do not add up across a T-junction",
        "At a T-junction one long side borders on several shorter ones. Every member of the shorter \
patches runs on into the long side's patch, and two neighbours share the member at the anchor between \
them. So with parts of 5 and 4 members the long side has 5 + 4 - 1 = 8. Leave one of the counts out \
and it is computed.",
    ),
    info(
        "E0220",
        "repeated-patch",
        "two patches have the same corners",
        "Two patches between the same four anchors would be the same piece of the surface. Remove one \
or correct a corner.",
    ),
    info(
        "E0221",
        "ambiguous-side",
        "the name of a side can be read in several ways",
        "A side is written as its two anchors with a hyphen between them, and names may hold hyphens \
too: with points `a`, `b`, `a-b` and `b-c` ... `a-b-c` could be two different sides. Rename a point.",
    ),
    info(
        "E0224",
        "same-place",
        "two points are one place",
        "Two points have the same definition. Patches share a side only if they name the same two \
anchors, so a second name for a corner tears the structure apart there without a visible gap. Keep \
one name.",
    ),
    info(
        "W0201",
        "thick-lamella",
        "a lamella is thick for its width",
        "A lamella behaves like a thin strip that follows a geodesic only if it is much wider than \
thick; the paper's rule is a thickness below a fifth of the width. Thicker ones also twist at the \
crossings, and the bending stress grows with the thickness.",
    ),
    info(
        "W0202",
        "grain-unsaid",
        "a material does not say how its grain runs",
        "Across the grain wood and plywood have about a fifth of the stiffness they have along it. The \
paper's first pavilion was cut across by mistake and collapsed under its own weight. The grain also \
locks the direction of the parts on the sheet. Say it:

    grain = \"along\"        # or \"across\", or \"none\" for metals and plastics",
    ),
    info(
        "W0203",
        "wide-kerf",
        "the kerf is wide for a laser",
        "A laser removes 0.08 to 0.3 mm. A wider kerf is usually a slip of the unit. For a mill, where \
the kerf is the diameter of the cutter, allow the lint.",
    ),
    info(
        "W0204",
        "tight-clearance",
        "the clearance is too small to slide",
        "While the grid unfolds, bolts slide along their notches. Below 0.05 mm of play they bind; a \
running fit has 0.2 to 0.3 mm. The right value depends on machine and material: cut a test piece.",
    ),
    info(
        "W0205",
        "unused-point",
        "a point is never used",
        "No patch, anchor or support names the point. Remove it, or name it where it was meant.",
    ),
    info(
        "W0206",
        "unused-material",
        "a material is never used",
        "No lamella and no study names the material.",
    ),
    info(
        "W0207",
        "hidden-material",
        "a material hides a built-in one",
        "Your definition counts. But whoever reads `limewood` in the plan expects the built-in values; \
a name such as `our-limewood` avoids the misunderstanding.",
    ),
    info(
        "W0208",
        "implausible-material",
        "a material has an implausible value",
        "The value is far from that of any sheet material; most often the unit is missing. A bare number \
is in SI: `elastic_modulus = 12` means 12 Pa, `\"12 GPa\"` was meant.",
    ),
    info(
        "W0209",
        "tall-labels",
        "labels are too tall for the lamella",
        "Labels are engraved along the lamella; taller than four fifths of its width they run into its \
edges or openings.",
    ),
    info(
        "W0210",
        "tight-spacing",
        "parts are closer than the kerf",
        "Neighbouring parts on a sheet are cut on both sides of the gap between them. A gap narrower \
than the kerf makes each cut take material from the neighbour; and thin webs burn. Use at least 2 mm.",
    ),
    info(
        "W0290",
        "not-built",
        "the project asks for something that is not built",
        "The language describes more than this version of `egg` builds. The section is read and checked, \
but no stage uses it; the message says what happens instead. As a warning it concerns the parts that \
are cut, as a note only lists and reports.",
    ),
];
