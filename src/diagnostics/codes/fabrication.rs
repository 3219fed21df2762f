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
];
