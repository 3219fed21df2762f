//! Where labels go on a lamella.
//!
//! Every lamella says at both ends who it is, which way it runs and which face is up, and beside
//! each opening which lamella is bolted there. Labels are engraved along the middle of the strip,
//! clear of openings and, where the room allows, of the areas that crossing lamellae cover. A
//! crossing's label stands close to its crossing; an end's label takes the place nearest to the
//! end that holds it, on one line or two, at the wanted height or shrunk to [`LEAST_HEIGHT`].
//!
//! Frame: millimetres along the lamella from its start, across it from its right edge.

use super::drawing::Text;
use super::stroke_font;

/// Smallest legible height of engraved letters, millimetres.
pub const LEAST_HEIGHT: f64 = 2.5;
/// Clear distance of strokes from edges, openings and each other, millimetres.
pub const CLEAR: f64 = 1.0;
/// Distance between two labels in letter heights, so that they are not read as one.
const APART: f64 = 2.0;
/// Baseline to baseline in letter heights.
const PITCH: f64 = 1.6;

/// The strip that is labelled.
#[derive(Debug, Clone, PartialEq)]
pub struct Strip {
    /// Millimetres.
    pub length: f64,
    /// Millimetres.
    pub width: f64,
    /// At both ends, where the outline is rounded or a joint.
    pub ends: [f64; 2],
    /// Openings in order.
    pub openings: Vec<Place>,
}

/// An opening and what is said about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// First and last millimetre of the opening.
    pub opening: [f64; 2],
    /// First and last millimetre that the crossing lamella covers.
    pub contact: [f64; 2],
    /// Who crosses there; empty for screws.
    pub label: String,
    /// Arrow in the direction in which the bolt slides from its flat to its deployed place.
    pub slide: Option<&'static str>,
}

/// Labels on a strip.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Labels {
    /// What is engraved.
    pub texts: Vec<Text>,
    /// What found no place.
    pub omitted: Vec<String>,
}

/// Places the end label (two words that may stand on one line or two) twice, and every opening's.
pub fn place(strip: &Strip, end_label: [&str; 2], height: f64) -> Labels {
    let mut labels = Labels::default();
    let mut free = Free::new(strip);
    for place in strip
        .openings
        .iter()
        .filter(|place| !place.label.is_empty())
    {
        let whole = format!("{}{}", place.label, place.slide.unwrap_or_default());
        if let Some(text) = free.beside(strip, place, &whole, height) {
            labels.texts.push(text);
            continue;
        }
        // Better a name without an arrow than neither.
        if place.slide.is_some()
            && let Some(text) = free.beside(strip, place, &place.label, height)
        {
            labels.texts.push(text);
        }
        labels.omitted.push(whole);
    }
    for end in [End::Start, End::End] {
        match free.near(strip, end, end_label, height) {
            Some(texts) => labels.texts.extend(texts),
            None => labels.omitted.push(end_label.join(" ")),
        }
    }
    labels
}

/// One label in the longest free stretch of a strip, if one takes it.
pub fn single(strip: &Strip, label: &str, height: f64) -> Option<Text> {
    let free = Free::new(strip);
    let longest = free
        .open
        .into_iter()
        .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    let room = longest[1] - longest[0];
    let height = height.min(room / stroke_font::width(label));
    let fits = height >= LEAST_HEIGHT && fits_across(strip, 1, height);
    let x = 0.5 * (longest[0] + longest[1] - stroke_font::width(label) * height);
    fits.then(|| Text::new(label, [x, baseline(strip, 1, 0, height)], height))
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Start,
    End,
}

/// Stretches of the strip that may take a label, in order: those that nothing covers, and the
/// wider ones that are merely clear of openings.
struct Free {
    open: Vec<[f64; 2]>,
    uncovered: Vec<[f64; 2]>,
}

impl Free {
    fn new(strip: &Strip) -> Self {
        let [start, end] = strip.ends.map(|end| end.max(CLEAR));
        let whole = [start, strip.length - end];
        let mut free = Self {
            open: vec![whole],
            uncovered: vec![whole],
        };
        for place in &strip.openings {
            subtract(&mut free.open, place.opening);
            subtract(&mut free.uncovered, place.opening);
            subtract(&mut free.uncovered, place.contact);
        }
        free
    }

    fn take(&mut self, [from, to]: [f64; 2], height: f64) {
        let apart = APART * height - CLEAR;
        let used = [from - apart, to + apart];
        subtract(&mut self.open, used);
        subtract(&mut self.uncovered, used);
    }

    /// The label of an opening, after it if possible, before it otherwise, never beyond the next
    /// opening; uncovered places before covered ones, full height before shrunk.
    fn beside(&mut self, strip: &Strip, place: &Place, label: &str, height: f64) -> Option<Text> {
        let heights = [height, LEAST_HEIGHT.min(height)];
        let choices = heights
            .iter()
            .map(|&h| (&self.uncovered, place.contact, h))
            .chain(heights.iter().map(|&h| (&self.open, place.opening, h)));
        for (free, around, h) in choices {
            let length = stroke_font::width(label) * h;
            if !fits_across(strip, 1, h) {
                continue;
            }
            let after = free
                .iter()
                .find(|[start, end]| touches(*start, around[1]) && end - start >= length)
                .map(|[start, _]| *start);
            let before = free
                .iter()
                .find(|[start, end]| touches(*end, around[0]) && end - start >= length)
                .map(|[_, end]| end - length);
            if let Some(x) = after.or(before) {
                let text = Text::new(label, [x, baseline(strip, 1, 0, h)], h);
                self.take([x, x + length], h);
                return Some(text);
            }
        }
        None
    }

    /// The two words of an end as near to the end as they fit.
    fn near(
        &mut self,
        strip: &Strip,
        end: End,
        words: [&str; 2],
        height: f64,
    ) -> Option<Vec<Text>> {
        let one_line = [words.join(" ")];
        let two_lines = words.map(str::to_owned);
        let arrangements = [one_line.as_slice(), two_lines.as_slice()];
        for free in [Room::Uncovered, Room::Open] {
            for h in [height, LEAST_HEIGHT.min(height)] {
                for lines in arrangements {
                    let length = lines
                        .iter()
                        .map(|line| stroke_font::width(line) * h)
                        .fold(0.0, f64::max);
                    let place = self.stretch(free, end, length);
                    if let Some(x) = place.filter(|_| fits_across(strip, lines.len(), h)) {
                        self.take([x, x + length], h);
                        let text = |(row, line)| {
                            Text::new(line, [x, baseline(strip, lines.len(), row, h)], h)
                        };
                        return Some(lines.iter().enumerate().map(text).collect());
                    }
                }
            }
        }
        None
    }

    /// Start of the stretch of a length that is nearest to an end.
    fn stretch(&self, room: Room, end: End, length: f64) -> Option<f64> {
        let free = match room {
            Room::Uncovered => &self.uncovered,
            Room::Open => &self.open,
        };
        let fits = |[start, end]: &&[f64; 2]| end - start >= length;
        match end {
            End::Start => free.iter().find(fits).map(|[start, _]| *start),
            End::End => free.iter().rev().find(fits).map(|[_, end]| end - length),
        }
    }
}

/// Which stretches are searched.
#[derive(Clone, Copy)]
enum Room {
    Uncovered,
    Open,
}

/// Whether a free stretch begins where an obstacle ends: one clear distance away.
fn touches(free: f64, obstacle: f64) -> bool {
    (free - obstacle).abs() <= CLEAR + 1e-9
}

/// Takes an obstacle with its clear distance out of free stretches.
fn subtract(free: &mut Vec<[f64; 2]>, [from, to]: [f64; 2]) {
    let [from, to] = [from - CLEAR, to + CLEAR];
    *free = free
        .iter()
        .flat_map(|&[start, end]| [[start, end.min(from)], [start.max(to), end]])
        .filter(|[start, end]| end > start)
        .collect();
}

fn fits_across(strip: &Strip, lines: usize, height: f64) -> bool {
    baseline(strip, lines, lines - 1, height) - stroke_font::DESCENT * height >= CLEAR
}

/// Baseline of a row (0 on top) of a block of lines whose capitals are centred across the strip.
fn baseline(strip: &Strip, lines: usize, row: usize, height: f64) -> f64 {
    let block = height * (1.0 + PITCH * (lines - 1) as f64);
    0.5 * (strip.width - block) + PITCH * height * (lines - 1 - row) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn hole(at: f64, label: &str) -> Place {
        Place {
            opening: [at - 2.0, at + 2.0],
            contact: [at - 6.0, at + 6.0],
            label: label.to_owned(),
            slide: None,
        }
    }

    fn strip(length: f64, width: f64, holes: &[f64]) -> Strip {
        Strip {
            length,
            width,
            ends: [width / 2.0; 2],
            openings: holes.iter().map(|&at| hole(at, "v05")).collect(),
        }
    }

    #[test]
    fn a_roomy_strip_takes_every_label_in_full() {
        let labels = place(
            &strip(300.0, 12.0, &[12.0, 100.0, 288.0]),
            ["west.u03", "→ TOP"],
            3.0,
        );
        assert!(labels.omitted.is_empty());
        assert_eq!(labels.texts.len(), 5);
        assert!(labels.texts.iter().all(|t| t.height == 3.0));
        // Nothing covers them: no sticker is glued over a label.
        for text in &labels.texts {
            let bounds = text.bounds();
            let covered = |&at: &f64| bounds.max[0] > at - 6.0 && bounds.min[0] < at + 6.0;
            assert!(![12.0, 100.0, 288.0].iter().any(covered), "{text:?}");
        }
    }

    #[test]
    fn a_tight_strip_shrinks_its_labels_and_a_crowded_one_omits_them() {
        let tight = place(
            &strip(84.0, 12.0, &[12.0, 72.0]),
            ["west.u03", "→ TOP"],
            4.0,
        );
        assert!(tight.texts.iter().any(|t| t.height == LEAST_HEIGHT));
        let crowded = place(
            &strip(30.0, 12.0, &[6.0, 15.0, 24.0]),
            ["west.u03", "→ TOP"],
            3.0,
        );
        assert!(!crowded.omitted.is_empty());
        let narrow = place(&strip(300.0, 4.0, &[12.0]), ["west.u03", "→ TOP"], 3.0);
        assert_eq!(narrow.omitted.len(), 3);
    }

    #[test]
    fn a_notch_is_labelled_with_an_arrow_or_at_least_with_a_name() {
        let notched = |length: f64| {
            let mut strip = strip(length, 12.0, &[0.5 * length]);
            strip.openings[0].slide = Some("←");
            place(&strip, ["west.u03", "→ TOP"], 3.0)
        };
        let roomy = notched(200.0);
        assert!(roomy.texts.iter().any(|t| t.content == "v05←"));
        assert!(roomy.omitted.is_empty());
        // Between the notch and the rounding: room for the name alone.
        let name = stroke_font::width("v05") * LEAST_HEIGHT;
        let arrow = stroke_font::width("v05←") * LEAST_HEIGHT;
        // Round ends, the notch, and what labels keep from both.
        let taken = 12.0 + 4.0 + 2.0 * CLEAR;
        let tight = notched(taken + name + arrow);
        assert!(tight.texts.iter().any(|t| t.content == "v05"), "{tight:?}");
        assert!(tight.omitted.contains(&"v05←".to_owned()));
    }

    #[test]
    fn a_single_label_stands_in_the_longest_free_stretch() {
        let text = single(&strip(80.0, 12.0, &[20.0]), "w.u03a-b", 3.0).expect("room");
        let bounds = text.bounds();
        assert!(bounds.min[0] > 22.0 + CLEAR && bounds.max[0] < 74.0);
        assert_eq!(single(&strip(30.0, 12.0, &[15.0]), "w.u03a-b", 3.0), None);
    }

    proptest! {
        #[test]
        fn labels_keep_clear_of_openings_edges_and_each_other(
            length in 40.0..400.0,
            width in 5.0..40.0,
            shares in prop::collection::vec(0.02f64..0.98, 0..8),
            height in 2.5..6.0,
        ) {
            let holes: Vec<f64> = shares.iter().map(|s| s * length).collect();
            let mut holes = holes;
            holes.sort_by(f64::total_cmp);
            let strip = strip(length, width, &holes);
            let labels = place(&strip, ["west.u03", "→ TOP"], height);
            let boxes: Vec<_> = labels.texts.iter().map(Text::bounds).collect();
            for (i, b) in boxes.iter().enumerate() {
                prop_assert!(b.min[0] >= CLEAR - 1e-6 && b.max[0] <= length - CLEAR + 1e-6);
                prop_assert!(b.min[1] >= CLEAR - 1e-6 && b.max[1] <= width - CLEAR + 1e-6);
                for place in &strip.openings {
                    let [from, to] = place.opening;
                    prop_assert!(b.max[0] <= from - CLEAR + 1e-6 || b.min[0] >= to + CLEAR - 1e-6);
                }
                for other in &boxes[i + 1..] {
                    prop_assert!(!b.overlaps(other));
                }
            }
        }
    }
}
