//! Codes of fabrication: `E07xx` parts that cannot be made, `W07xx` what a workshop should know.

use super::{Code, CodeInfo};

/// A lamella is longer than the panel or the bed.
pub const PART_TOO_LONG: Code = Code::new("E0701");
/// A lamella is wider than the panel or the bed.
pub const PART_TOO_WIDE: Code = Code::new("E0702");
/// Margins leave nothing of the panel.
pub const NO_USABLE_STOCK: Code = Code::new("E0703");
/// Parts would be cut into each other.
pub const SPACING_BELOW_KERF: Code = Code::new("E0704");
/// The beam is wider than an opening.
pub const KERF_CLOSES_OPENING: Code = Code::new("E0705");
/// A drawing has a coordinate that is no number.
pub const NOT_A_NUMBER: Code = Code::new("E0706");
/// No standard series for the bolt.
pub const UNKNOWN_BOLT: Code = Code::new("E0707");
/// No bolt of the series is long enough.
pub const BOLT_TOO_SHORT: Code = Code::new("E0708");
/// The shell does not go over the bolt.
pub const SHELL_TOO_NARROW: Code = Code::new("E0709");
/// Two openings overlap or nearly so.
pub const OPENINGS_MEET: Code = Code::new("E0710");
/// An opening takes the whole width.
pub const OPENING_TOO_WIDE: Code = Code::new("E0711");
/// An opening breaks through the end.
pub const OPENING_AT_END: Code = Code::new("E0712");
/// No place for a joint of a lamella.
pub const NO_PLACE_FOR_SPLICE: Code = Code::new("E0720");
/// There is no plan to compare with.
pub const PLAN_UNREADABLE: Code = Code::new("E0730");
/// A file of the plan is not there.
pub const FILE_MISSING: Code = Code::new("E0731");
/// A file is no drawing or table.
pub const FILE_UNREADABLE: Code = Code::new("E0732");
/// A cut file is of another plan.
pub const FILE_UNEXPECTED: Code = Code::new("E0733");
/// A part is not drawn as the plan has it.
pub const PART_DIFFERS: Code = Code::new("E0734");
/// DXF and SVG show different things.
pub const DRAWINGS_DIFFER: Code = Code::new("E0735");
/// A table says other things than the plan.
pub const TABLE_DIFFERS: Code = Code::new("E0736");
/// A sticker is larger than the sheet of foil.
pub const STICKER_TOO_LARGE: Code = Code::new("E0760");
/// No lamellae cross where a support is listed.
pub const SUPPORT_CARRIES_NOTHING: Code = Code::new("E0761");
/// A support is lower than its contact face needs.
pub const SUPPORT_TOO_LOW: Code = Code::new("E0762");
/// A label found no place.
pub const LABEL_OMITTED: Code = Code::new("W0720");
/// A label has characters without strokes.
pub const LABEL_CHARACTERS: Code = Code::new("W0721");
/// Little wood between two openings.
pub const NARROW_WEB: Code = Code::new("W0722");
/// Openings take more than half of the section.
pub const NET_SECTION: Code = Code::new("W0723");
/// An opening is small for the sheet.
pub const SMALL_HOLE: Code = Code::new("W0724");
/// An opening is close to the end.
pub const SHORT_END: Code = Code::new("W0725");
/// The washer does not bridge the notch.
pub const WASHER_NARROW: Code = Code::new("W0726");
/// The washer is wider than the lamella.
pub const WASHER_WIDE: Code = Code::new("W0727");
/// The grain runs across.
pub const GRAIN_ACROSS: Code = Code::new("W0728");
/// Parts lie close together.
pub const NARROW_SPACING: Code = Code::new("W0729");
/// A joint stands close to a crossing.
pub const SPLICE_NEAR_CROSSING: Code = Code::new("W0730");
/// No wood for the pins of a panel that is pushed on.
pub const NO_REGISTRATION: Code = Code::new("W0731");
/// A joint is bent further than it bears.
pub const SPLICE_OVERSTRESSED: Code = Code::new("W0732");

/// A sticker has no room for its slot.
pub const STICKER_CROWDED: Code = Code::new("W0760");
/// The foil is thick for its lamellae.
pub const FOIL_THICK: Code = Code::new("W0761");
/// The shell is loose on the bolt.
pub const SHELL_LOOSE: Code = Code::new("W0762");
/// Two listed supports stand at one place.
pub const SUPPORT_TWICE: Code = Code::new("W0763");
/// A contact face is too steep for a foot.
pub const SUPPORT_STEEP: Code = Code::new("W0764");
/// A printed support is larger than printers print.
pub const SUPPORT_LARGE: Code = Code::new("W0765");
/// A support is heavier than one person carries.
pub const SUPPORT_HEAVY: Code = Code::new("W0766");
/// The grid dips below the ground of its supports.
pub const GRID_BELOW_GROUND: Code = Code::new("W0767");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0701",
        name: "part-too-long",
        title: "a lamella is longer than the panel it is cut from",
        text: "A lamella must fit on a panel along its length: the panel's length less both \
margins, and, where the machine cannot push panels through, the bed's length.\n\n\
Choose longer stock, allow splices (`splice` in `[fabrication]`), divide the patch, or set \
`pass_through = true` if the machine's rear opens.",
    },
    CodeInfo {
        code: "E0702",
        name: "part-too-wide",
        title: "a lamella is wider than the panel it is cut from",
        text: "The width of a lamella must fit between the margins of the panel and of the \
machine's bed. A lamella that is this wide is probably given in the wrong unit.",
    },
    CodeInfo {
        code: "E0703",
        name: "no-usable-stock",
        title: "the margins leave nothing of the panel",
        text: "`[fabrication] margin` stays free along all four borders of a sheet. Twice the \
margin must be less than the length and width of the stock and of the bed.",
    },
    CodeInfo {
        code: "E0704",
        name: "spacing-below-kerf",
        title: "parts lie closer than the width of the cut",
        text: "Two neighbouring cuts each remove half a kerf of the strip between the parts. \
If `spacing` is not larger than `kerf`, the cuts run into each other. Half the thickness of the \
sheet plus the kerf, at least 2 mm, is a usual spacing.",
    },
    CodeInfo {
        code: "E0705",
        name: "kerf-closes-opening",
        title: "the kerf is wider than an opening",
        text: "Openings are drawn smaller by the kerf, so that they come out at their size. An \
opening that is narrower than the kerf cannot be cut. The kerf of a laser is 0.1 to 0.3 mm.",
    },
    CodeInfo {
        code: "E0706",
        name: "not-a-number",
        title: "a drawing has a coordinate that is no number",
        text: "A stage before the drawing produced an infinite or undefined number. No file is \
written, because no program could read it. This is a defect of the compiler: please report it \
with the project.",
    },
    CodeInfo {
        code: "E0707",
        name: "bolt-series",
        title: "no standard series for this bolt",
        text: "The bill of materials picks bolt lengths, nuts and washers from the metric \
series M2, M2.5, M3, M4, M5, M6, M8, M10, M12, M14, M16, M20, M24 and M30 (ISO 7380, above M12 ISO \
4014; DIN 985, ISO 7093). Choose one of them.",
    },
    CodeInfo {
        code: "E0708",
        name: "bolt-too-short",
        title: "no bolt of the series is long enough",
        text: "At a connection the bolt goes through every lamella that meets there, two washers \
and the nut. The longest bolt of the series is shorter than that. Choose thinner lamellae or a \
larger bolt; from M8 on, threaded rod is cut to length instead.",
    },
    CodeInfo {
        code: "E0709",
        name: "shell-too-narrow",
        title: "the shell does not go over the bolt",
        text: "The shell is a tube around the bolt that slides in the notch. Its bore, the outer \
diameter less twice the wall, must be larger than the bolt. For M4 a tube of 5 mm with a wall of \
0.45 mm fits, for M3 one of 4 mm with the same wall.",
    },
    CodeInfo {
        code: "E0710",
        name: "openings-meet",
        title: "two openings of a lamella run into each other",
        text: "A notch is as long as the slide of its crossing and the shell. Where the slide is \
longer than the distance to the next crossing, the two openings overlap, or leave less than a \
millimetre of wood that burns away. Two bolts in one opening would not hold their places, so \
openings are not merged.\n\nUse fewer members, a smaller patch, or a planar angle that is farther \
from the surface's.",
    },
    CodeInfo {
        code: "E0711",
        name: "opening-too-wide",
        title: "an opening takes the whole width of its lamella",
        text: "Less than a millimetre of wood stays beside the opening: the lamella falls apart \
when it is cut. Choose wider lamellae, or a thinner bolt and shell.",
    },
    CodeInfo {
        code: "E0712",
        name: "opening-at-end",
        title: "an opening breaks through the end of its lamella",
        text: "The opening reaches the end of the lamella or leaves less than a millimetre. \
`end_margin` in `[fabrication]` is the distance from the last bolt to the end; its default is the \
width of the lamella.",
    },
    CodeInfo {
        code: "E0720",
        name: "no-place-for-splice",
        title: "a lamella cannot be divided clear of its crossings",
        text: "A lamella that is longer than the stock is joined from pieces. A joint keeps one and \
a half bolt diameters from every opening, plates also keep clear of crossing lamellae, and every \
piece has to fit on a panel. Where crossings are so dense that no stretch between them takes a \
joint, the lamella cannot be spliced.\n\nChoose a shorter joint (fingers are the shortest), fewer \
members of the other family, or longer stock; for plates also a planar angle (`alpha`) nearer to 90 \
degrees or narrower lamellae: the flatter lamellae cross, the longer they lie on each other.",
    },
    CodeInfo {
        code: "E0730",
        name: "plan-unreadable",
        title: "there is no plan to compare files with",
        text: "`egg verify` takes the output folder of a build and compares its files with \
`plan.ron` in it. The folder has none, or one that is damaged or of a newer program.",
    },
    CodeInfo {
        code: "E0731",
        name: "file-missing",
        title: "a file that belongs to the plan is not there",
        text: "A build writes a cut file for every sheet, or for every window of a sheet that is \
longer than the bed, a file for every part, and the tables. One of them is missing from the folder. \
Build the project again: files that are there already are left alone.",
    },
    CodeInfo {
        code: "E0732",
        name: "file-unreadable",
        title: "a drawing or table cannot be read",
        text: "The file is cut short, was converted by another program, or holds what cut files of \
egg never hold: splines, texts, blocks. Build the project again.",
    },
    CodeInfo {
        code: "E0733",
        name: "file-unexpected",
        title: "a cut file belongs to no sheet of the plan",
        text: "The folder holds a cut file that the plan does not have, most likely of an older \
build that was copied here. Whoever cuts everything in the folder would cut parts that fit nowhere. \
Remove it.",
    },
    CodeInfo {
        code: "E0734",
        name: "part-differs",
        title: "a part is not drawn as the plan has it",
        text: "An outline or an opening in the cut file is missing, too many, of another size or at \
another place than the plan says: the file was edited, scaled or belongs to another build. Parts \
that are cut from it will not fit. Build the project again; what shall differ belongs into the \
project file.",
    },
    CodeInfo {
        code: "E0735",
        name: "drawings-differ",
        title: "the DXF and the SVG of a drawing differ",
        text: "Both are written from one drawing and agree to a thousandth of a millimetre. One of \
them was changed since, or belongs to another build. Build the project again.",
    },
    CodeInfo {
        code: "E0736",
        name: "table-differs",
        title: "a table says other things than the plan",
        text: "A row of a CSV file is missing, too many, or has another number than the plan. \
Spreadsheets that store a table again may round numbers or turn ids into dates. Build the project \
again, and edit a copy.",
    },
    CodeInfo {
        code: "W0720",
        name: "label-omitted",
        title: "a label found no place on its lamella",
        text: "Labels are engraved clear of openings, with letters at least 2.5 mm high. Where \
crossings are dense or the lamella is narrow some labels do not fit and are left out; the layout \
drawing shows them all. A smaller `label_height` or wider lamellae make room.",
    },
    CodeInfo {
        code: "W0721",
        name: "label-characters",
        title: "an id has characters that cannot be engraved",
        text: "The single-stroke font draws Latin letters, digits and common signs; letters with \
marks lose them. A box is engraved for every other character. Name patches with letters that the \
font has, so that lamellae can be told apart.",
    },
    CodeInfo {
        code: "W0722",
        name: "narrow-web",
        title: "little wood stays between two openings",
        text: "Between two bolts the wood is sheared along the grain. One and a half bolt \
diameters of it are a usual least; less may split when the grid is deployed.",
    },
    CodeInfo {
        code: "W0723",
        name: "net-section",
        title: "openings take more than half of the section",
        text: "At an opening the whole bending moment goes through the wood on its two sides. \
The stress there is that of the full section times width over remaining width. Choose wider \
lamellae, or a thinner bolt and shell.",
    },
    CodeInfo {
        code: "W0724",
        name: "small-hole",
        title: "an opening is small for the thickness of the sheet",
        text: "Lasers cut openings below one and a half thicknesses conically and with charred \
edges; shells may stick in them. Thinner sheets or larger bolts avoid it. Cut the coupon first to \
see what your machine does.",
    },
    CodeInfo {
        code: "W0725",
        name: "short-end",
        title: "an opening is close to the end of its lamella",
        text: "The wood behind the last bolt splits along the grain if it is shorter than about \
two diameters of the opening. `end_margin` in `[fabrication]` sets it.",
    },
    CodeInfo {
        code: "W0726",
        name: "washer-narrow",
        title: "the washers hardly bridge the openings",
        text: "A washer should bear on two millimetres of wood on both sides of the notch, or it \
is drawn into it when the bolt is tightened. Large washers (ISO 7093) of the bolt's size are \
assumed.",
    },
    CodeInfo {
        code: "W0727",
        name: "washer-wide",
        title: "the washers stand over the edges of the lamella",
        text: "Large washers (ISO 7093) of the bolt's size are wider than the lamella. They \
catch, and crush the edges. A smaller bolt or a wider lamella avoids it.",
    },
    CodeInfo {
        code: "W0728",
        name: "grain-across",
        title: "the grain runs across the lamellae",
        text: "Across the grain wood has about a fifth of its stiffness. The first showcase model \
of the method collapsed under its own weight for this reason: the face plies of its plywood ran \
across the lamellae. Turn the panel so that the grain of the faces runs along the lamellae.",
    },
    CodeInfo {
        code: "W0729",
        name: "narrow-spacing",
        title: "parts lie close together on the sheet",
        text: "A thin strip of waste between two cuts chars, bends and may move the parts. Half \
the thickness of the sheet plus the kerf, at least 2 mm, is a usual `spacing`.",
    },
    CodeInfo {
        code: "W0730",
        name: "splice-near-crossing",
        title: "a joint stands close to an opening",
        text: "Openings and joints both weaken a lamella, and a joint beside a bolt takes the \
bolt's load. Twice the width of the lamella, and at least 30 mm, are a usual distance. The joints \
stand where the lamella bends and twists least and other joints are far; here no such place is \
farther from a crossing.",
    },
    CodeInfo {
        code: "W0731",
        name: "no-registration",
        title: "no wood for the pins of a panel that is pushed on",
        text: "A panel that is longer than the bed is cut in windows. Two holes in the border of \
the sheet, cut in one window, take pins that hold the panel in place for the next one. Where the \
margin is narrower than 5 mm there is no wood for them: align the panel by the marks on the guide \
layer, or widen `margin` in `[fabrication]`.",
    },
    CodeInfo {
        code: "W0732",
        name: "splice-overstressed",
        title: "a joint is bent further than it bears",
        text: "Bending a lamella into the surface takes a stress of E κ t / 2. In a joint less of \
the section carries it: half at the roots of fingers, what the holes leave of a plate, all of a scarf. \
Here that is more than the bending strength of the material, although the joint stands where the \
lamella bends least. Choose thinner lamellae, scarfs, or stock long enough to do without.",
    },
    CodeInfo {
        code: "E0760",
        name: "sticker-too-large",
        title: "a sticker is larger than the sheet of foil",
        text: "A sticker covers the whole area in which two lamellae touch while the grid \
unfolds: the wider the lamellae, the flatter the angle and the longer the slide, the larger. It is \
cut in one piece, on a card with its number.\n\nGive the size of the foil that you buy, \
`sticker = { thickness = 0.13, sheet = { length = 500, width = 300 } }` in `[hardware]`, or make \
its `margin` smaller.",
    },
    CodeInfo {
        code: "E0761",
        name: "support-carries-nothing",
        title: "no lamellae cross where a support is listed",
        text: "A support is bolted to the lamellae that cross at its point. Points that are no \
corner of a patch have none, unless a crossing happens to lie there. Name a corner, or a crossing \
by its id: `west.u01-v04`. The layout drawing and crossings.csv have all ids.",
    },
    CodeInfo {
        code: "E0762",
        name: "support-too-low",
        title: "a support is lower than its contact face needs",
        text: "The contact face of a support is inclined as the surface is. Its lower edge must \
stay above the ground, and the hole for the bolt inside the body, so the steeper the face, the \
higher the support. `height` in `[supports]` is the height of the lowest contact face above the \
ground; leave it out, and the supports are as low as they can be.",
    },
    CodeInfo {
        code: "W0760",
        name: "sticker-crowded",
        title: "a sticker has no room for its slot",
        text: "Where crossings are close together, stickers are cut back half way between them. \
What is left here is too narrow for the slot, and no sticker is made: wood slides on wood, with \
three times the friction. Wider lamellae, fewer members, a planar angle farther from 0 and 180 \
degrees, or a thinner bolt and shell make room.",
    },
    CodeInfo {
        code: "W0761",
        name: "foil-thick",
        title: "the foil is thick for its lamellae",
        text: "Two foils lie between the lamellae of every crossing that slides, and none at the \
boundary. If together they are thicker than three tenths of a lamella, the inner members stand off \
the surface visibly and bolts get longer. Foils for this purpose are 0.1 to 0.25 mm thick; perhaps \
the thickness is in the wrong unit.",
    },
    CodeInfo {
        code: "W0762",
        name: "shell-loose",
        title: "the shell is loose on the bolt",
        text: "The bolt clamps the shell between its washers. If the bore is wider than the bolt \
by more than half a millimetre, the shell stands askew and its edge bites into the notch. Take a \
tube with a bore 0.1 to 0.2 mm wider than the bolt: 4 x 0.45 for M3, 5 x 0.45 for M4.",
    },
    CodeInfo {
        code: "W0763",
        name: "support-twice",
        title: "two listed supports stand at one place",
        text: "A corner and the crossing of the two boundary members there are the same point, \
and crossings of neighbouring patches are where the patches meet. One support is made for all.",
    },
    CodeInfo {
        code: "W0764",
        name: "support-steep",
        title: "a contact face is too steep for a foot",
        text: "The tangent plane of the surface stands steeper than 70 degrees there. A foot \
below such a face would have to be cut nearly to a blade; the structure wants to be held from the \
side. No body is made: bolt it to a wall, a post or a frame. The plan and supports.csv have its \
place and its normal.",
    },
    CodeInfo {
        code: "W0765",
        name: "support-large",
        title: "a printed support is larger than printers print",
        text: "Common printers print 220 to 250 mm in each direction. A foot grows with its \
height, so that it does not tip. Choose blocks (`kind = \"wedge-on-block\"`), support the \
structure where it is lower, or build a post and print only its head.",
    },
    CodeInfo {
        code: "W0766",
        name: "support-heavy",
        title: "a support is heavier than one person carries",
        text: "The paper's supports are stable under their own weight and light enough to be \
carried. A block grows with the square of its height, because a tall one must be broad. Cast it on \
the spot, stack it from pieces, or support the structure where it is lower.",
    },
    CodeInfo {
        code: "W0767",
        name: "grid-below-ground",
        title: "the grid dips below the ground of its supports",
        text: "The ground is taken as level, `height` below the lowest contact face. Between the \
supports the surface hangs lower than that. Raise the supports with `height` in `[supports]`, or \
leave it out: then the ground is below the lowest member. Or support the structure where it is \
lowest.",
    },
];
