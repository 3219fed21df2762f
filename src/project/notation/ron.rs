//! RON into the tree.
//!
//! The `ron` crate reads into types or values and keeps no positions of what it has read, so
//! the language reads RON's values itself: a small recursive descent that keeps bytes and goes
//! on after an error. It accepts no more than RON does (a test asks the crate about every text
//! that passes) and leaves out what no project uses: ranges, characters, byte strings, suffixes
//! of numbers, escapes of single bytes above ASCII.

use super::ron_scan::Scanner;
use super::{DEEPEST, Entry, Node, SyntaxError, SyntaxKind, Value};
use std::collections::BTreeSet;

pub(super) fn parse(text: &str) -> (Node, Vec<SyntaxError>) {
    let mut parser = Parser {
        scanner: Scanner::new(text),
        errors: Vec::new(),
    };
    let root = parser.document().unwrap_or(Node {
        span: 0..text.len(),
        value: Value::Table(Vec::new()),
    });
    (root, parser.errors)
}

struct Parser<'t> {
    scanner: Scanner<'t>,
    errors: Vec<SyntaxError>,
}

/// A failed read has left its error in the list.
struct Failed;

type Read<T> = Result<T, Failed>;

impl<'t> Parser<'t> {
    fn document(&mut self) -> Read<Node> {
        self.blank()?;
        while self.scanner.eat("#") {
            self.attribute()?;
            self.blank()?;
        }
        let root = self.value(1)?;
        self.blank()?;
        if self.scanner.peek().is_some() {
            return Err(self.fail(self.scanner.expected("the end of the file")));
        }
        Ok(root.unwrap_or(Node {
            span: 0..0,
            value: Value::Table(Vec::new()),
        }))
    }

    /// `#![enable(...)]`, `#![schema = "..."]`: hints to tools, without meaning here.
    fn attribute(&mut self) -> Read<()> {
        self.blank()?;
        self.expect("!")?;
        self.blank()?;
        self.expect("[")?;
        self.blank()?;
        let name = self.plain_word();
        self.blank()?;
        match name {
            Some("enable") => {
                self.expect("(")?;
                loop {
                    self.blank()?;
                    let known = [
                        "unwrap_newtypes",
                        "implicit_some",
                        "unwrap_variant_newtypes",
                        "explicit_struct_names",
                    ];
                    let here = self.scanner.at;
                    match self.plain_word() {
                        Some(name) if known.contains(&name) => {}
                        _ => {
                            self.scanner.at = here;
                            let error = self.scanner.expected("the name of a RON extension");
                            return Err(self.fail(error));
                        }
                    }
                    self.blank()?;
                    if self.scanner.eat(",") {
                        self.blank()?;
                    }
                    if self.scanner.eat(")") {
                        break;
                    }
                }
            }
            Some("schema" | "type") => {
                self.expect("=")?;
                self.blank()?;
                match self.scanner.string() {
                    Some(Ok(_)) => {}
                    Some(Err(error)) => return Err(self.fail(error)),
                    None => return Err(self.fail(self.scanner.expected("a string"))),
                }
            }
            _ => return Err(self.fail(self.scanner.expected("`enable`, `schema` or `type`"))),
        }
        self.blank()?;
        self.expect("]")
    }

    /// A word of an attribute, which is never written raw.
    fn plain_word(&mut self) -> Option<&'t str> {
        if self.scanner.starts_with("r#") {
            return None;
        }
        self.scanner.identifier()
    }

    /// One value; `None` for RON's `None`.
    fn value(&mut self, depth: usize) -> Read<Option<Node>> {
        let start = self.scanner.at;
        if depth > DEEPEST
            && self
                .scanner
                .peek()
                .is_some_and(|c| matches!(c, '(' | '[' | '{'))
        {
            let error = SyntaxError {
                span: self.scanner.here(),
                kind: SyntaxKind::TooDeep,
            };
            return Err(self.fail(error));
        }
        let value = if let Some(number) = self.scanner.number() {
            match number {
                Ok(number) => Value::Number(number),
                Err(error) => return Err(self.fail(error)),
            }
        } else if let Some(string) = self.scanner.string() {
            match string {
                Ok(text) => Value::Text(text),
                Err(error) => return Err(self.fail(error)),
            }
        } else if self.scanner.starts_with("[") {
            Value::List(self.list("]", depth)?)
        } else if self.scanner.starts_with("{") {
            Value::Table(self.entries("}", depth)?)
        } else if self.scanner.starts_with("(") {
            self.parentheses(depth)?
        } else if let Some(name) = self.scanner.identifier() {
            return self.named(name, start, depth);
        } else {
            return Err(self.fail(self.scanner.expected("a value")));
        };
        Ok(Some(Node {
            span: start..self.scanner.at,
            value,
        }))
    }

    /// What starts with an identifier: a boolean, an option, a named struct or a bare word.
    fn named(&mut self, name: &str, start: usize, depth: usize) -> Read<Option<Node>> {
        let end = self.scanner.at;
        // `r#None` is a name like any other.
        let value = match &self.scanner.text[start..end] {
            "true" => Value::Bool(true),
            "false" => Value::Bool(false),
            "None" => return Ok(None),
            _ => {
                self.blank()?;
                if !self.scanner.starts_with("(") {
                    self.scanner.at = end;
                    self.whole_word(start)?;
                    Value::Text(name.to_owned())
                } else if self.scanner.text[start..end] == *"Some" {
                    return self.some(depth);
                } else if depth > DEEPEST {
                    return self.value(depth);
                } else {
                    self.parentheses(depth)?
                }
            }
        };
        Ok(Some(Node {
            span: start..self.scanner.at,
            value,
        }))
    }

    fn some(&mut self, depth: usize) -> Read<Option<Node>> {
        if depth > DEEPEST {
            return self.value(depth);
        }
        self.expect("(")?;
        self.blank()?;
        let inner = self.value(depth + 1)?;
        self.blank()?;
        if self.scanner.eat(",") {
            self.blank()?;
        }
        self.expect(")")?;
        Ok(inner)
    }

    /// A struct `(key: value)`, a tuple `(1, 2)`, or `()`, which is a table without keys.
    fn parentheses(&mut self, depth: usize) -> Read<Value> {
        let open = self.scanner.at;
        self.scanner.at += 1;
        self.blank()?;
        let first = self.scanner.at;
        let named = self.scanner.starts_with(")") || {
            self.scanner.identifier().is_some() && {
                self.blank()?;
                self.scanner.starts_with(":")
            }
        };
        self.scanner.at = if named { open } else { first };
        if named {
            Ok(Value::Table(self.entries(")", depth)?))
        } else {
            self.scanner.at = open;
            Ok(Value::List(self.list(")", depth)?))
        }
    }

    fn list(&mut self, close: &str, depth: usize) -> Read<Vec<Node>> {
        let mut items = Vec::new();
        self.separated(close, |parser| {
            items.extend(parser.value(depth + 1)?);
            Ok(())
        })?;
        Ok(items)
    }

    fn entries(&mut self, close: &str, depth: usize) -> Read<Vec<Entry>> {
        let mut entries = Vec::new();
        let mut keys = BTreeSet::new();
        self.separated(close, |parser| {
            let start = parser.scanner.at;
            let key = parser.key(close)?;
            let key_span = start..parser.scanner.at;
            parser.blank()?;
            parser.expect(":")?;
            parser.blank()?;
            let node = parser.value(depth + 1)?;
            if !keys.insert(key.clone()) {
                parser.errors.push(SyntaxError {
                    span: key_span,
                    kind: SyntaxKind::DuplicateKey,
                });
            } else if let Some(node) = node {
                entries.push(Entry {
                    key,
                    key_span,
                    node,
                });
            }
            Ok(())
        })?;
        Ok(entries)
    }

    /// A struct's field is an identifier, a map's key is an identifier or a string.
    fn key(&mut self, close: &str) -> Read<String> {
        if close == "}"
            && let Some(string) = self.scanner.string()
        {
            return string.map_err(|error| self.fail(error));
        }
        let start = self.scanner.at;
        let Some(name) = self.scanner.identifier() else {
            return Err(self.fail(self.scanner.expected("a key")));
        };
        self.whole_word(start)?;
        Ok(name.to_owned())
    }

    /// A word with a hyphen or a point in it is a slip that deserves its own advice.
    fn whole_word(&mut self, start: usize) -> Read<()> {
        match self.scanner.overlong_identifier(start) {
            Some(error) => Err(self.fail(error)),
            None => Ok(()),
        }
    }

    /// Elements between commas up to the closing bracket. After a failed element reading goes
    /// on behind the next comma of this level, so that several slips are reported at once.
    fn separated(
        &mut self,
        close: &str,
        mut element: impl FnMut(&mut Self) -> Read<()>,
    ) -> Read<()> {
        let open = self.scanner.here();
        self.scanner.at = open.end;
        loop {
            self.blank()?;
            if self.scanner.eat(close) {
                return Ok(());
            }
            if self.scanner.peek().is_none() {
                return Err(self.fail(SyntaxError::syntax(
                    open,
                    format!("RON syntax: `{close}` is missing"),
                    "this bracket is never closed",
                )));
            }
            let mut read = element(self);
            if read.is_ok() {
                read = self.blank();
            }
            if read.is_ok() && !self.scanner.starts_with(",") && !self.scanner.starts_with(close) {
                let error = self.scanner.expected(&format!("`,` or `{close}`"));
                read = Err(self.fail(error));
            }
            if read.is_err() && !self.skip_element(close) {
                return Err(Failed);
            }
            self.scanner.eat(",");
        }
    }

    /// Moves to the next comma or to the closing bracket of the current level; false if the
    /// text ends or another bracket closes first.
    fn skip_element(&mut self, close: &str) -> bool {
        let mut open: Vec<char> = Vec::new();
        loop {
            if self.scanner.skip_blank().is_err() {
                return false;
            }
            if let Some(string) = self.scanner.string() {
                if string.is_err() && self.scanner.peek().is_none() {
                    return false;
                }
                continue;
            }
            let Some(char) = self.scanner.peek() else {
                return false;
            };
            if open.is_empty() && (char == ',' || self.scanner.starts_with(close)) {
                return true;
            }
            match char {
                '(' => open.push(')'),
                '[' => open.push(']'),
                '{' => open.push('}'),
                ')' | ']' | '}' if open.pop() != Some(char) => return false,
                _ => {}
            }
            self.scanner.at += char.len_utf8();
        }
    }

    fn blank(&mut self) -> Read<()> {
        self.scanner.skip_blank().map_err(|error| self.fail(error))
    }

    fn expect(&mut self, text: &str) -> Read<()> {
        if self.scanner.eat(text) {
            Ok(())
        } else {
            Err(self.fail(self.scanner.expected(&format!("`{text}`"))))
        }
    }

    fn fail(&mut self, error: SyntaxError) -> Failed {
        self.errors.push(error);
        Failed
    }
}
