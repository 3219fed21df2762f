//! The words of RON: white space, comments, identifiers, strings and numbers with their bytes.

use super::{Number, SyntaxError};
use std::ops::Range;

/// A position in a RON text.
pub(super) struct Scanner<'t> {
    pub(super) text: &'t str,
    pub(super) at: usize,
}

type Scanned<T> = Result<T, SyntaxError>;

impl<'t> Scanner<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    pub(super) fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    pub(super) fn starts_with(&self, prefix: &str) -> bool {
        self.rest().starts_with(prefix)
    }

    /// Takes a prefix if it stands here.
    pub(super) fn eat(&mut self, prefix: &str) -> bool {
        let found = self.starts_with(prefix);
        if found {
            self.at += prefix.len();
        }
        found
    }

    /// The next character as a range, empty at the end of the text.
    pub(super) fn here(&self) -> Range<usize> {
        self.at..self.at + self.peek().map_or(0, char::len_utf8)
    }

    /// What stands here, for a message.
    pub(super) fn found(&self) -> String {
        match self.peek() {
            None => "the end of the file".to_owned(),
            Some(char) => format!("`{}`", char.escape_debug()),
        }
    }

    pub(super) fn expected(&self, what: &str) -> SyntaxError {
        SyntaxError::syntax(
            self.here(),
            format!("RON syntax: found {}", self.found()),
            format!("expected {what}"),
        )
    }

    fn take_while(&mut self, keep: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let length = rest.find(|char| !keep(char)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Skips white space and comments.
    pub(super) fn skip_blank(&mut self) -> Scanned<()> {
        loop {
            self.take_while(is_blank);
            if self.starts_with("//") {
                self.take_while(|char| char != '\n');
            } else if self.starts_with("/*") {
                self.skip_block_comment()?;
            } else {
                return Ok(());
            }
        }
    }

    fn skip_block_comment(&mut self) -> Scanned<()> {
        let open = self.at..self.at + 2;
        let mut level = 0_usize;
        loop {
            if self.eat("/*") {
                level += 1;
            } else if self.eat("*/") {
                level -= 1;
                if level == 0 {
                    return Ok(());
                }
            } else if let Some(char) = self.peek() {
                self.at += char.len_utf8();
            } else {
                self.at = self.text.len();
                return Err(SyntaxError::syntax(
                    open,
                    "RON syntax: the comment has no end",
                    "opened here, `*/` is missing",
                ));
            }
        }
    }

    /// `name`, `r#raw-name`; `None` where no identifier stands.
    pub(super) fn identifier(&mut self) -> Option<&'t str> {
        let strings = ["b\"", "b'", "br#", "br\"", "r\"", "r#\"", "r##"];
        if strings.iter().any(|string| self.starts_with(string)) {
            return None;
        }
        if self.starts_with("r#") {
            let start = self.at;
            self.at += 2;
            let name = self.take_while(is_raw_name);
            if name.is_empty() {
                self.at = start;
                return None;
            }
            return Some(name);
        }
        let first = self.peek()?;
        if first == '_' || first.is_ascii_alphabetic() {
            Some(self.take_while(|char| char == '_' || char.is_ascii_alphanumeric()))
        } else {
            None
        }
    }

    /// The error for `concrete-block` without quotes, if the identifier that has just been read
    /// from `start` goes on in such a way.
    pub(super) fn overlong_identifier(&mut self, start: usize) -> Option<SyntaxError> {
        if !self.peek().is_some_and(is_raw_name) {
            return None;
        }
        self.take_while(is_raw_name);
        let word = &self.text[start..self.at];
        let word = word.strip_prefix("r#").unwrap_or(word);
        Some(SyntaxError::syntax(
            start..self.at,
            format!("RON syntax: `{word}` is no plain identifier"),
            format!("write `\"{word}\"`, or `r#{word}` for the field of a struct"),
        ))
    }

    /// `"text"` with escapes, or `r#"text"#`; `None` where no string stands.
    pub(super) fn string(&mut self) -> Option<Scanned<String>> {
        if self.starts_with("r\"") || self.starts_with("r#\"") || self.starts_with("r##") {
            Some(self.raw_string())
        } else if self.starts_with("\"") {
            Some(self.escaped_string())
        } else {
            None
        }
    }

    fn raw_string(&mut self) -> Scanned<String> {
        let start = self.at;
        self.at += 1;
        let hashes = self.take_while(|char| char == '#');
        if !self.eat("\"") {
            return Err(self.expected("a raw string's `\"`"));
        }
        let end = format!("\"{hashes}");
        let rest = self.rest();
        let Some(length) = rest.find(&end) else {
            let opening = start..self.at;
            self.at = self.text.len();
            return Err(open_string(opening));
        };
        self.at += length + end.len();
        Ok(rest[..length].to_owned())
    }

    fn escaped_string(&mut self) -> Scanned<String> {
        let start = self.at;
        self.at += 1;
        let mut text = String::new();
        // A bad escape is reported after the string's end is known, so that reading goes on.
        let mut bad = None;
        loop {
            text.push_str(self.take_while(|char| char != '"' && char != '\\'));
            if self.eat("\"") {
                return match bad {
                    Some(error) => Err(error),
                    None => Ok(text),
                };
            } else if self.starts_with("\\") {
                if let Err(error) = self.escape(&mut text) {
                    bad.get_or_insert(error);
                }
            } else {
                return Err(open_string(start..start + 1));
            }
        }
    }

    /// One escape after its backslash; always moves on.
    fn escape(&mut self, text: &mut String) -> Scanned<()> {
        let start = self.at;
        self.at += 1;
        let bad = |end: usize| {
            SyntaxError::syntax(
                start..end,
                "RON syntax: this escape means nothing",
                "use one of \\\\ \\\" \\' \\n \\r \\t \\0 \\x41 \\u{e9}",
            )
        };
        if self.eat("\n") || self.eat("\r\n") {
            self.take_while(|char| matches!(char, ' ' | '\t' | '\n' | '\r'));
            return Ok(());
        }
        let Some(char) = self.peek() else {
            return Err(bad(self.at));
        };
        self.at += char.len_utf8();
        let meant = match char {
            '\'' | '"' | '\\' => Some(char),
            'n' => Some('\n'),
            'r' => Some('\r'),
            't' => Some('\t'),
            '0' => Some('\0'),
            'x' => self.hex_digits(2, 2).and_then(ascii),
            'u' if self.eat("{") => {
                let code = self.hex_digits(1, 6);
                if self.eat("}") {
                    code.and_then(char::from_u32)
                } else {
                    None
                }
            }
            _ => None,
        };
        text.push(meant.ok_or_else(|| bad(self.at))?);
        Ok(())
    }

    fn hex_digits(&mut self, least: usize, most: usize) -> Option<u32> {
        let digits = self.rest().bytes().take(most);
        let count = digits.take_while(u8::is_ascii_hexdigit).count();
        let text = &self.rest()[..count];
        self.at += count;
        (count >= least).then(|| u32::from_str_radix(text, 16).ok())?
    }

    /// A number; `None` where none starts.
    pub(super) fn number(&mut self) -> Option<Scanned<Number>> {
        let start = self.at;
        let first = self.peek()?;
        let named = |rest: &str| {
            ["inf", "NaN"].into_iter().find(|name| {
                rest.strip_prefix(name)
                    .is_some_and(|after| !after.starts_with(is_name))
            })
        };
        let unsigned = self.rest().strip_prefix(['+', '-']).unwrap_or(self.rest());
        if let Some(name) = named(unsigned) {
            let sign = if first == '-' { "-" } else { "" };
            self.at += self.rest().len() - unsigned.len() + name.len();
            let text = format!("{sign}{}", name.to_ascii_lowercase());
            return Some(Ok(Number { text, whole: false }));
        }
        if !first.is_ascii_digit() && !matches!(first, '+' | '-' | '.') {
            return None;
        }
        // All that could belong to a number, so that a slip is marked as a whole.
        self.take_while(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.' | '_'));
        let written = &self.text[start..self.at];
        Some(read_number(written).ok_or_else(|| {
            SyntaxError::syntax(
                start..self.at,
                "RON syntax: this is no number",
                "expected a number such as `12`, `-0.5`, `1e3`, `0x1F`; with a unit it is a string, `\"3 mm\"`",
            )
        }))
    }
}

fn read_number(written: &str) -> Option<Number> {
    let unsigned = written.strip_prefix(['+', '-']).unwrap_or(written);
    let sign = if written.starts_with('-') { "-" } else { "" };
    for (prefix, radix) in [("0x", 16), ("0o", 8), ("0b", 2)] {
        if let Some(digits) = unsigned.strip_prefix(prefix) {
            if digits.starts_with(['+', '-', '_']) {
                return None;
            }
            let value = u64::from_str_radix(&digits.replace('_', ""), radix).ok()?;
            if sign == "-" && i64::try_from(value).is_err() {
                return None;
            }
            return Some(Number {
                text: format!("{sign}{value}"),
                whole: true,
            });
        }
    }
    // An underscore stands between digits, never first nor after the point.
    let odd = |text: &str| text.starts_with(['_', '+', '-']) || text.contains("._");
    if odd(unsigned) {
        return None;
    }
    let text = format!("{sign}{}", unsigned.replace('_', ""));
    crate::project::decimal::Decimal::parse(&text)?;
    let whole = !text.contains(['.', 'e', 'E']);
    Some(Number { text, whole })
}

fn is_blank(char: char) -> bool {
    matches!(
        char,
        ' ' | '\t'
            | '\n'
            | '\r'
            | '\x0B'
            | '\x0C'
            | '\u{85}'
            | '\u{200E}'
            | '\u{200F}'
            | '\u{2028}'
            | '\u{2029}'
    )
}

fn is_name(char: char) -> bool {
    char == '_' || char.is_alphanumeric()
}

fn is_raw_name(char: char) -> bool {
    char == '_' || char.is_ascii_alphanumeric() || matches!(char, '.' | '+' | '-')
}

fn ascii(code: u32) -> Option<char> {
    char::from_u32(code).filter(char::is_ascii)
}

fn open_string(opening: Range<usize>) -> SyntaxError {
    SyntaxError::syntax(
        opening,
        "RON syntax: the string has no end",
        "opened here, the closing `\"` is missing",
    )
}
