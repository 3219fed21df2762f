//! Lines and words of an OBJ file with their places.
//!
//! Works on bytes, since comments and names may be in any encoding. A line ends at LF, CR LF or a
//! lone CR; a backslash at its very end joins the next one, except in a comment (a path that ends
//! in a backslash is common there).

use std::ops::Range;

/// Where a record stands in the file. Files stay below 4 GiB ([`super::MAX_BYTES`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Span {
    start: u32,
    end: u32,
    /// Number of the first physical line, from 1.
    pub(super) line: u32,
}

impl Span {
    pub(super) fn bytes(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A logical line: physical lines joined by backslashes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'a> {
    bytes: &'a [u8],
    start: usize,
    number: u32,
}

impl<'a> Line<'a> {
    /// The words up to a comment.
    pub(super) fn words(self) -> impl Iterator<Item = Word<'a>> {
        let mut at = 0;
        std::iter::from_fn(move || {
            while at < self.bytes.len() && self.is_space(at) {
                at += 1;
            }
            let start = at;
            while at < self.bytes.len() && !self.is_space(at) {
                at += 1;
            }
            let word = Word {
                bytes: &self.bytes[start..at],
                start: self.start + start,
            };
            (!word.bytes.is_empty() && word.bytes[0] != b'#').then_some(word)
        })
    }

    /// The whole line without the space around it.
    pub(super) fn span(self) -> Span {
        let trimmed = self.bytes.trim_ascii();
        let indent = self.bytes.len() - self.bytes.trim_ascii_start().len();
        let start = self.start + indent;
        Span {
            start: start as u32,
            end: (start + trimmed.len()) as u32,
            line: self.number,
        }
    }

    /// White space, or the backslash of a continuation.
    fn is_space(self, at: usize) -> bool {
        let byte = self.bytes[at];
        byte.is_ascii_whitespace()
            || byte == b'\\' && matches!(self.bytes.get(at + 1), None | Some(b'\n' | b'\r'))
    }
}

/// A word and its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word<'a> {
    pub(super) bytes: &'a [u8],
    start: usize,
}

impl Word<'_> {
    /// Its bytes in the file.
    pub(super) fn range(self) -> Range<usize> {
        self.start..self.start + self.bytes.len()
    }

    /// The word as it is shown to the user: at most 40 characters of it.
    pub(super) fn shown(self) -> String {
        let mut text = String::from_utf8_lossy(self.bytes);
        if let Some((cut, _)) = text.char_indices().nth(40) {
            text = format!("{}...", &text[..cut]).into();
        }
        text.chars()
            .map(|c| if c.is_control() { '?' } else { c })
            .collect()
    }
}

/// The logical lines of a file.
#[derive(Debug)]
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    number: u32,
}

impl<'a> Lines<'a> {
    /// The lines from byte `at` on.
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self {
            bytes,
            at,
            number: 1,
        }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let start = self.at;
        if start >= self.bytes.len() {
            return None;
        }
        let number = self.number;
        loop {
            let physical = self.at;
            let rest = &self.bytes[physical..];
            let length = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
            let end = self.at + length.unwrap_or(rest.len());
            self.at = match self.bytes[end..] {
                [] => end,
                [b'\r', b'\n', ..] => end + 2,
                _ => end + 1,
            };
            self.number += 1;
            let text = &self.bytes[physical..end];
            let joins = text.ends_with(b"\\") && !has_comment(text);
            if !joins || self.at >= self.bytes.len() {
                return Some(Line {
                    bytes: &self.bytes[start..end],
                    start,
                    number,
                });
            }
        }
    }
}

/// Whether a word of a physical line begins with `#`.
fn has_comment(text: &[u8]) -> bool {
    text.split(u8::is_ascii_whitespace)
        .any(|word| word.starts_with(b"#"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &[u8]) -> Vec<(u32, Vec<String>)> {
        Lines::new(text, 0)
            .map(|line| {
                let words = line.words().map(Word::shown).collect();
                (line.span().line, words)
            })
            .collect()
    }

    fn line(number: u32, words: &[&str]) -> (u32, Vec<String>) {
        (number, words.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn every_line_end_counts_once() {
        assert_eq!(
            words(b"a\r\nb\rc\n\nd"),
            [
                line(1, &["a"]),
                line(2, &["b"]),
                line(3, &["c"]),
                line(4, &[]),
                line(5, &["d"])
            ]
        );
    }

    #[test]
    fn a_backslash_joins_lines_but_not_out_of_a_comment() {
        assert_eq!(
            words(b"f 1 \\\r\n 2\\\n3\n# C:\\\nv 1 # D:\\\nf 4 \\"),
            [
                line(1, &["f", "1", "2", "3"]),
                line(4, &[]),
                line(5, &["v", "1"]),
                line(6, &["f", "4"])
            ]
        );
    }

    #[test]
    fn places_are_bytes_of_the_file() {
        let text = b"# \xe9\n  v 1.5\t2 \n";
        let line = Lines::new(text, 0).nth(1).unwrap();
        assert_eq!(&text[line.span().bytes()], b"v 1.5\t2");
        let second = line.words().nth(1).unwrap();
        assert_eq!(&text[second.range()], b"1.5");
    }
}
