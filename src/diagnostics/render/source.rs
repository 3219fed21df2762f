//! The texts that diagnostics point into, and positions in them.

use crate::diagnostics::{File, Place, SpanTable};
use std::ops::Range;

/// A file as the user knows it.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// Its path as given, with `/` between the parts.
    pub name: &'a str,
    /// Its whole text, a byte order mark included.
    pub text: &'a str,
}

/// All files that diagnostics of a project point into.
#[derive(Debug, Clone, Copy)]
pub struct Sources<'a> {
    /// The project file.
    pub project: Source<'a>,
    /// Where its keys stand.
    pub spans: &'a SpanTable,
    /// The mesh, where it is text and was read.
    pub mesh: Option<Source<'a>>,
}

/// A place that has been found: bytes that hold at least one character, if the text has any.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Found {
    pub(super) file: File,
    pub(super) range: Range<usize>,
}

impl<'a> Sources<'a> {
    pub(super) fn source(&self, file: File) -> Option<Source<'a>> {
        match file {
            File::Project => Some(self.project),
            File::Mesh => self.mesh,
        }
    }

    /// Finds a place; `None` if its file is not here.
    pub(super) fn find(&self, place: &Place) -> Option<Found> {
        let (file, range) = match place {
            Place::Key(path) => (File::Project, self.spans.value(path)),
            Place::Name(path) => (File::Project, self.spans.name(path)),
            Place::Bytes { file, range } => (*file, range.clone()),
        };
        let source = self.source(file)?;
        Some(Found {
            file,
            range: visible(&range, source.text),
        })
    }
}

/// Moves a range to characters that can be marked. An empty range covers the character behind
/// it; at the end of the text or of a line, the last one before it: a mark under a line break
/// would not be shown.
fn visible(range: &Range<usize>, text: &str) -> Range<usize> {
    let (start, end) = (boundary(text, range.start), boundary(text, range.end));
    let is_break = |char: char| matches!(char, '\n' | '\r');
    if start < end && !text[start..end].chars().all(is_break) {
        return start..end;
    }
    match text[start..].chars().next() {
        Some(char) if !is_break(char) => start..start + char.len_utf8(),
        _ => {
            let mut before = text[..start].char_indices().rev();
            let last = before.find(|(_, char)| !char.is_whitespace());
            last.map_or(start..start, |(at, char)| at..at + char.len_utf8())
        }
    }
}

/// The last boundary of characters that is not behind the byte.
fn boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Length of the byte order mark at the start of a text.
pub(super) fn mark_length(text: &str) -> usize {
    let mark = '\u{feff}';
    if text.starts_with(mark) {
        mark.len_utf8()
    } else {
        0
    }
}

/// Line and column of a byte, both from 1, the column in characters; a byte order mark is none.
pub(super) fn line_column(text: &str, at: usize) -> (usize, usize) {
    let at = boundary(text, at);
    let before = &text[mark_length(text).min(at)..at];
    let line = 1 + before.bytes().filter(|byte| *byte == b'\n').count();
    let column = 1 + before
        .rsplit('\n')
        .next()
        .map_or(0, |line| line.chars().count());
    (line, column)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_ranges_and_the_end_of_the_text_move_to_a_character_that_can_be_marked() {
        assert_eq!(visible(&(2..2), "abc"), 2..3);
        assert_eq!(visible(&(3..3), "abc"), 2..3);
        assert_eq!(visible(&(9..99), "abc\r\n"), 2..3);
        assert_eq!(visible(&(3..5), "abc\r\n"), 2..3);
        assert_eq!(visible(&(2..3), "é\nb"), 0..2);
        assert_eq!(visible(&(1..2), "é"), 0..2);
        assert_eq!(visible(&(0..0), ""), 0..0);
        assert_eq!(visible(&(1..1), "\n\n"), 1..1);
    }

    #[test]
    fn columns_count_characters_and_skip_a_byte_order_mark() {
        let text = "\u{feff}äb\r\ncd";
        assert_eq!(line_column(text, 3), (1, 1));
        assert_eq!(line_column(text, 5), (1, 2));
        assert_eq!(line_column(text, 8), (2, 1));
        assert_eq!(line_column(text, 99), (2, 3));
        assert_eq!(line_column(text, 0), (1, 1));
    }
}
