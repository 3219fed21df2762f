//! A single-stroke font: letters as a tool draws them, one line a stroke.
//!
//! Engraved labels must not depend on fonts of the machine, and outlines of letters would double
//! every stroke. The glyphs are the project's own, drawn on the grid of technical lettering
//! (ISO 3098: capitals ten units high, small letters seven, three below the baseline) with true
//! arcs, so that a controller runs them smoothly.
//!
//! A glyph is written as strokes separated by `|`, a stroke as points `x,y`. A point may end in
//! the shape of the line that leaves it: `)` a quarter circle counter-clockwise, `]` an eighth;
//! `(` and `[` the same clockwise; doubled, twice that.

use super::drawing::{Closure, Path, Vertex};
use std::sync::LazyLock;

/// Units from the baseline to the top of a capital.
const CAP: f64 = 10.0;
/// Units between two glyphs.
const GAP: f64 = 2.2;

/// Height of a capital letter is 1 in the frame of [`strokes`]; the part below the baseline.
pub const DESCENT: f64 = 0.3;

/// (character, width in units, strokes).
const GLYPHS: &[(char, f64, &str)] = &[
    (' ', 3.2, ""),
    ('A', 6.4, "0,0 3.2,10 6.4,0|0.96,3 5.44,3"),
    ('B', 6.0, "0,5.4 3.3,5.4(( 3.3,0 0,0 0,10 3,10(( 3,5.4"),
    ('C', 5.6, "5.12,9.12] 3,10) 0,7 0,3) 3,0] 5.12,0.88"),
    ('D', 6.0, "0,0 0,10 3,10( 6,7 6,3( 3,0 0,0"),
    ('E', 5.0, "5,10 0,10 0,0 5,0|0,5.2 4.2,5.2"),
    ('F', 5.0, "5,10 0,10 0,0|0,5.2 4.2,5.2"),
    ('G', 6.0, "5.12,9.12] 3,10) 0,7 0,3) 3,0) 6,3 6,4.8 3.4,4.8"),
    ('H', 6.0, "0,0 0,10|6,0 6,10|0,5.2 6,5.2"),
    ('I', 2.8, "0,0 2.8,0|1.4,0 1.4,10|0,10 2.8,10"),
    ('J', 5.0, "5,10 5,2.5(( 0,2.5"),
    ('K', 5.8, "0,0 0,10|5.4,10 0,4|1.98,6.2 5.8,0"),
    ('L', 4.8, "0,10 0,0 4.8,0"),
    ('M', 7.0, "0,0 0,10 3.5,3 7,10 7,0"),
    ('N', 6.0, "0,0 0,10 6,0 6,10"),
    ('O', 6.0, "6,7)) 0,7 0,3)) 6,3 6,7"),
    ('P', 5.7, "0,0 0,10 3,10(( 3,4.6 0,4.6"),
    ('Q', 6.4, "6,7)) 0,7 0,3)) 6,3 6,7|3.8,2.2 6.4,-0.6"),
    ('R', 5.9, "0,0 0,10 3,10(( 3,4.6 0,4.6|3,4.6 5.9,0"),
    (
        'S',
        5.8,
        "5.4,7.8) 3.2,10 2.4,10)) 2.4,5.2 3.2,5.2(( 3.2,0 2.2,0( 0,2.2",
    ),
    ('T', 6.0, "0,10 6,10|3,10 3,0"),
    ('U', 6.0, "0,10 0,3)) 6,3 6,10"),
    ('V', 6.4, "0,10 3.2,0 6.4,10"),
    ('W', 8.4, "0,10 2,0 4.2,8 6.4,0 8.4,10"),
    ('X', 6.0, "0,0 6,10|0,10 6,0"),
    ('Y', 6.0, "0,10 3,4.8 6,10|3,4.8 3,0"),
    ('Z', 6.0, "0,10 6,10 0,0 6,0"),
    ('a', 5.0, "5,4.5)) 0,4.5 0,2.5)) 5,2.5|5,7 5,0"),
    ('b', 5.0, "0,10 0,0|0,4.5(( 5,4.5 5,2.5(( 0,2.5"),
    ('c', 4.5, "4.27,6.27] 2.5,7) 0,4.5 0,2.5) 2.5,0] 4.27,0.73"),
    ('d', 5.0, "5,4.5)) 0,4.5 0,2.5)) 5,2.5|5,10 5,0"),
    (
        'e',
        5.0,
        "0,3.6 5,3.6 5,4.5)) 0,4.5 0,2.5) 2.5,0] 4.27,0.73",
    ),
    ('f', 3.4, "3.2,10) 1.2,8 1.2,0|0,7 3,7"),
    ('g', 5.0, "5,4.5)) 0,4.5 0,2.5)) 5,2.5|5,7 5,-0.5(( 0,-0.5"),
    ('h', 5.0, "0,10 0,0|0,4.5(( 5,4.5 5,0"),
    ('i', 0.0, "0,7 0,0|0,9.2 0,10"),
    ('j', 2.0, "2,7 2,-1( 0,-3|2,9.2 2,10"),
    ('k', 4.8, "0,10 0,0|4.4,7 0,2.6|1.7,4.3 4.8,0"),
    ('l', 1.5, "0,10 0,1.5) 1.5,0"),
    ('m', 8.0, "0,7 0,0|0,5(( 4,5 4,0|4,5(( 8,5 8,0"),
    ('n', 5.0, "0,7 0,0|0,4.5(( 5,4.5 5,0"),
    ('o', 5.0, "5,4.5)) 0,4.5 0,2.5)) 5,2.5 5,4.5"),
    ('p', 5.0, "0,7 0,-3|0,4.5(( 5,4.5 5,2.5(( 0,2.5"),
    ('q', 5.0, "5,7 5,-3|5,4.5)) 0,4.5 0,2.5)) 5,2.5"),
    ('r', 3.2, "0,7 0,0|0,4.5( 2.5,7 3.2,7"),
    (
        's',
        4.4,
        "4,5.6) 2.6,7 1.7,7)) 1.7,3.6 2.6,3.6(( 2.6,0 1.6,0( 0,1.6",
    ),
    ('t', 3.4, "1.4,9.4 1.4,2) 3.4,0|0,7 3.2,7"),
    ('u', 5.0, "0,7 0,2.5)) 5,2.5|5,7 5,0"),
    ('v', 5.0, "0,7 2.5,0 5,7"),
    ('w', 7.2, "0,7 1.8,0 3.6,6 5.4,0 7.2,7"),
    ('x', 4.6, "0,0 4.6,7|0,7 4.6,0"),
    ('y', 5.2, "0,7 2.6,0|5.2,7 1.486,-3"),
    ('z', 4.6, "0,7 4.6,7 0,0 4.6,0"),
    ('0', 5.6, "5.6,7.2)) 0,7.2 0,2.8)) 5.6,2.8 5.6,7.2"),
    ('1', 2.4, "0,7.8 2.4,10 2.4,0"),
    ('2', 5.4, "0,7.3(( 5.4,7.3[ 4.609,5.391 0,0 5.4,0"),
    (
        '3',
        5.0,
        "0.703,9.297[ 2.4,10(( 2.4,5.2 1.6,5.2|2.4,5.2(( 2.4,0[ 0.562,0.762",
    ),
    ('4', 5.8, "4.2,0 4.2,10 0,3 5.8,3"),
    ('5', 5.4, "4.8,10 0.4,10 0.4,6 2.4,6(( 2.4,0 2,0( 0,2"),
    ('6', 5.6, "4.6,10 4,10) 0,6 0,2.8)) 5.6,2.8)) 0,2.8"),
    ('7', 5.6, "0,10 5.6,10 1.8,0"),
    ('8', 5.4, "2.7,5.4)) 2.7,10)) 2.7,5.4(( 2.7,0(( 2.7,5.4"),
    ('9', 5.6, "1,0 1.6,0) 5.6,4 5.6,7.2)) 0,7.2)) 5.6,7.2"),
    ('-', 3.6, "0,4.5 3.6,4.5"),
    ('_', 5.0, "0,-1 5,-1"),
    ('.', 0.0, "0,0 0,0.9"),
    (',', 0.8, "0.8,0.9 0.8,0 0,-1.6"),
    (':', 0.0, "0,0.9 0,1.8|0,5.2 0,6.1"),
    ('/', 4.4, "0,-1 4.4,11"),
    ('+', 5.0, "0,4.5 5,4.5|2.5,2 2.5,7"),
    ('=', 4.6, "0,3.2 4.6,3.2|0,5.8 4.6,5.8"),
    (
        '#',
        6.0,
        "1.2,1 2.2,9|3.8,1 4.8,9|0.2,3.4 5.4,3.4|0.6,6.6 5.8,6.6",
    ),
    ('(', 2.5, "2.5,11) 2.5,-1"),
    (')', 2.5, "0,11( 0,-1"),
    (
        '%',
        6.4,
        "0,0 6.4,10|2.6,8.4)) 0,8.4)) 2.6,8.4|6.4,1.6)) 3.8,1.6)) 6.4,1.6",
    ),
    ('°', 2.2, "2.2,8.9)) 0,8.9)) 2.2,8.9"),
    ('→', 7.0, "0,4.5 7,4.5|4.8,6.7 7,4.5 4.8,2.3"),
    ('←', 7.0, "7,4.5 0,4.5|2.2,6.7 0,4.5 2.2,2.3"),
    ('↑', 4.4, "2.2,0 2.2,9|0,6.8 2.2,9 4.4,6.8"),
    ('↓', 4.4, "2.2,9 2.2,0|0,2.2 2.2,0 4.4,2.2"),
];

/// What is drawn for a character that the font does not have.
const UNKNOWN: (char, f64, &str) = ('\u{fffd}', 5.0, "0,0 0,10 5,10 5,0 0,0");

/// Letters with marks that lose them: enough for the names of Western Europe.
const BARE: &[(&str, char)] = &[
    ("ÀÁÂÃÄÅ", 'A'),
    ("Ç", 'C'),
    ("ÈÉÊË", 'E'),
    ("ÌÍÎÏ", 'I'),
    ("Ñ", 'N'),
    ("ÒÓÔÕÖØ", 'O'),
    ("ÙÚÛÜ", 'U'),
    ("Ý", 'Y'),
    ("àáâãäå", 'a'),
    ("ç", 'c'),
    ("èéêë", 'e'),
    ("ìíîï", 'i'),
    ("ñ", 'n'),
    ("òóôõöø", 'o'),
    ("ß", 's'),
    ("ùúûü", 'u'),
    ("ýÿ", 'y'),
];

struct Glyph {
    width: f64,
    strokes: Vec<Path>,
}

static FONT: LazyLock<Vec<(char, Glyph)>> = LazyLock::new(|| {
    let mut font: Vec<(char, Glyph)> = GLYPHS
        .iter()
        .chain([&UNKNOWN])
        .map(|&(character, width, strokes)| {
            let strokes = strokes
                .split('|')
                .filter(|stroke| !stroke.is_empty())
                .filter_map(read_stroke)
                .collect();
            (character, Glyph { width, strokes })
        })
        .collect();
    font.sort_by_key(|(character, _)| *character);
    font
});

/// Whether every character of a text can be drawn, marks of letters aside.
pub fn knows(text: &str) -> bool {
    text.chars().all(|c| find(bare(c)).is_some())
}

/// Width of a line of text whose capitals are 1 high.
pub fn width(text: &str) -> f64 {
    let mut units = 0.0;
    for (place, character) in text.chars().enumerate() {
        units += glyph(character).width + if place > 0 { GAP } else { 0.0 };
    }
    units / CAP
}

/// Strokes of a line of text whose capitals are 1 high, from (0, 0) along x.
pub fn strokes(text: &str) -> Vec<Path> {
    let mut strokes = Vec::new();
    let mut left = 0.0;
    for character in text.chars() {
        let glyph = glyph(character);
        strokes.extend(
            glyph
                .strokes
                .iter()
                .map(|stroke| stroke.mapped(|[x, y]| [(x + left) / CAP, y / CAP])),
        );
        left += glyph.width + GAP;
    }
    strokes
}

fn glyph(character: char) -> &'static Glyph {
    find(bare(character))
        .or_else(|| find(UNKNOWN.0))
        .expect("the font has the glyph for unknown characters")
}

fn find(character: char) -> Option<&'static Glyph> {
    let place = FONT.binary_search_by_key(&character, |(c, _)| *c).ok()?;
    FONT.get(place).map(|(_, glyph)| glyph)
}

fn bare(character: char) -> char {
    BARE.iter()
        .find(|(marked, _)| marked.contains(character))
        .map_or(character, |&(_, bare)| bare)
}

fn read_stroke(text: &str) -> Option<Path> {
    let vertices = text.split(' ').map(read_vertex).collect::<Option<_>>()?;
    Some(Path {
        vertices,
        closed: Closure::Open,
    })
}

fn read_vertex(text: &str) -> Option<Vertex> {
    let point = text.trim_end_matches(['(', ')', '[', ']']);
    let eighths: f64 = text[point.len()..]
        .chars()
        .map(|turn| match turn {
            ')' => 2.0,
            ']' => 1.0,
            '(' => -2.0,
            _ => -1.0,
        })
        .sum();
    let (x, y) = point.split_once(',')?;
    Some(Vertex {
        x: x.parse().ok()?,
        y: y.parse().ok()?,
        bulge: libm::tan(eighths * core::f64::consts::PI / 16.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_is_read_as_written_and_stays_in_its_box() {
        for &(character, width, text) in GLYPHS {
            let glyph = find(character).expect("listed");
            let written = text.split('|').filter(|s| !s.is_empty()).count();
            assert_eq!(glyph.strokes.len(), written, "{character}");
            for stroke in &glyph.strokes {
                assert!(stroke.vertices.len() >= 2, "{character}");
                let bounds = stroke.bounds();
                assert!(bounds.min[0] > -1e-3, "{character}: {bounds:?}");
                assert!(bounds.max[0] < width + 1e-3, "{character}: {bounds:?}");
                assert!(
                    bounds.min[1] > -3.0 - 1e-3 && bounds.max[1] < 11.0 + 1e-3,
                    "{character}"
                );
            }
        }
    }

    #[test]
    fn smooth_joints_of_arcs_are_smooth() {
        // A quarter or half circle was meant to be a tangent continuation: where two curved
        // segments meet the kink is below two degrees, or it is a corner above twenty.
        for &(character, _, _) in GLYPHS {
            for stroke in &find(character).expect("listed").strokes {
                let segments: Vec<_> = stroke.segments().collect();
                for pair in segments.windows(2) {
                    if pair[0].bulge == 0.0 && pair[1].bulge == 0.0 {
                        continue;
                    }
                    let out = heading(&pair[0], 1.0);
                    let into = heading(&pair[1], -1.0);
                    let kink = libm::remainder(into - out, core::f64::consts::TAU)
                        .abs()
                        .to_degrees();
                    assert!(!(5.0..20.0).contains(&kink), "{character}: {kink}");
                }
            }
        }
    }

    /// Direction of travel at the end (1) or start (-1) of a segment.
    fn heading(segment: &super::super::drawing::Segment, end: f64) -> f64 {
        let chord = libm::atan2(
            segment.to[1] - segment.from[1],
            segment.to[0] - segment.from[0],
        );
        chord + end * 2.0 * libm::atan(segment.bulge)
    }

    #[test]
    fn the_font_has_what_ids_are_made_of() {
        let ids = ('a'..='z').chain('A'..='Z').chain('0'..='9');
        let text: String = ids.chain("-_./:+#() →←".chars()).collect();
        assert!(knows(&text));
        assert!(knows("Größe"));
        assert!(!knows("東"));
    }

    #[test]
    fn width_is_that_of_the_strokes() {
        let text = "HOUSE";
        let right = strokes(text)
            .iter()
            .map(|s| s.bounds().max[0])
            .fold(0.0, f64::max);
        assert!((right - width(text)).abs() < 1e-9);
    }
}
