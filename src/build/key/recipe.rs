//! Recipes: what a key was made of, in a form that people can compare.
//!
//! A digest says that something changed, a recipe says what: the fields of the input with short
//! texts of their values, and the digest of every dependency. It is read back from the canonical
//! encoding itself, so it cannot miss anything that the key contains.
//!
//! Recipes are bounded: a sequence of plain values is one field; a text longer than
//! [`TEXT_LIMIT`] ends in a digest of the whole; long sequences, and past [`FIELD_LIMIT`] fields
//! every branch, become one field with a digest. Two inputs that differ have recipes that differ.

use super::super::declare::Instance;
use super::{Digest, PortKind};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

/// Longest text of a value, in characters.
pub const TEXT_LIMIT: usize = 60;
/// Number of fields from which on branches are summarised.
pub const FIELD_LIMIT: usize = 400;
/// Sequences and maps with more elements are summarised.
const ELEMENT_LIMIT: usize = 64;
/// Deeper nesting is summarised.
const DEPTH_LIMIT: usize = 24;

/// What a key was made of.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Recipe {
    /// Version of the stage, with the build id of a developer's build.
    pub version: String,
    /// Numerics class.
    pub numerics: String,
    /// Fields of the input, in the order of their declaration.
    pub fields: Vec<Field>,
    /// Dependencies, in the order of their declaration.
    pub ingredients: Vec<Ingredient>,
}

/// One field of an input.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Field {
    /// `lamella.width`, `corners[2]`; empty for an input that is no structure.
    pub path: String,
    /// A short text of the value, ending in a digest where it had to be shortened.
    pub value: String,
}

/// One dependency.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ingredient {
    /// The instance it came from, as it was called where the recipe was written.
    pub from: Instance,
    /// What it handed over.
    pub port: PortKind,
    /// Digest of that.
    pub digest: Digest,
}

/// The fields of a canonical encoding.
///
/// `encoded` comes from [`encode`](super::canon::encode); anything else yields fewer fields.
pub fn fields(encoded: &[u8]) -> Vec<Field> {
    let mut reader = Reader { rest: encoded };
    let mut fields = Vec::new();
    if let Some(tree) = reader.tree(0) {
        tree.flatten(&mut String::new(), &mut fields);
    }
    fields
}

/// A value of a canonical encoding, as far as it is kept apart.
enum Tree<'a> {
    Leaf(String),
    /// Named or numbered parts, and the whole branch's bytes.
    Branch(Vec<(Segment<'a>, Tree<'a>)>, &'a [u8]),
}

enum Segment<'a> {
    Name(&'a str),
    Index(usize),
    Key(String),
}

impl Tree<'_> {
    fn flatten(self, path: &mut String, fields: &mut Vec<Field>) {
        match self {
            Self::Leaf(value) => fields.push(Field {
                path: path.clone(),
                value,
            }),
            Self::Branch(parts, _) if parts.is_empty() => fields.push(Field {
                path: path.clone(),
                value: "empty".to_owned(),
            }),
            Self::Branch(parts, bytes) if fields.len() >= FIELD_LIMIT => fields.push(Field {
                path: path.clone(),
                value: summary(parts.len(), bytes),
            }),
            Self::Branch(parts, _) => {
                let length = path.len();
                for (segment, part) in parts {
                    match segment {
                        Segment::Name(name) if path.is_empty() => path.push_str(name),
                        Segment::Name(name) => {
                            path.push('.');
                            path.push_str(name);
                        }
                        Segment::Index(index) => {
                            write!(path, "[{index}]").expect("a string takes all text");
                        }
                        Segment::Key(key) => {
                            write!(path, "[{key}]").expect("a string takes all text");
                        }
                    }
                    part.flatten(path, fields);
                    path.truncate(length);
                }
            }
        }
    }
}

struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*first)
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (head, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(head)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn counted(&mut self) -> Option<&'a [u8]> {
        let length = u64::from_le_bytes(self.array()?);
        self.take(usize::try_from(length).ok()?)
    }

    fn name(&mut self) -> Option<&'a str> {
        std::str::from_utf8(self.counted()?).ok()
    }

    /// Reads one value.
    fn tree(&mut self, depth: usize) -> Option<Tree<'a>> {
        let start = self.rest;
        let tag = self.byte()?;
        let leaf = match tag {
            b'F' => "false".to_owned(),
            b'T' => "true".to_owned(),
            b'N' => "none".to_owned(),
            b'U' => "()".to_owned(),
            b'u' => u64::from_le_bytes(self.array()?).to_string(),
            b'i' => i64::from_le_bytes(self.array()?).to_string(),
            b'v' => u128::from_le_bytes(self.array()?).to_string(),
            b'j' => i128::from_le_bytes(self.array()?).to_string(),
            b'd' => format!("{:?}", f64::from_le_bytes(self.array()?)),
            b'f' => format!("{:?}", f32::from_le_bytes(self.array()?)),
            b'c' => format!("{:?}", char::from_u32(u32::from_le_bytes(self.array()?))?),
            b's' => shortened(&format!("{:?}", self.name()?)),
            b'b' => {
                let bytes = self.counted()?;
                match <[u8; 32]>::try_from(bytes) {
                    Ok(digest) => format!("#{}", Digest::from_bytes(digest).short()),
                    Err(_) => format!("{} bytes #{}", bytes.len(), Digest::of(bytes).short()),
                }
            }
            b'S' => match self.tree(depth)? {
                Tree::Leaf(text) if text == "none" => "some none".to_owned(),
                tree => return Some(tree),
            },
            b'V' => {
                let name = self.name()?;
                return Some(match self.tree(depth)? {
                    Tree::Leaf(text) if text == "()" => Tree::Leaf(name.to_owned()),
                    Tree::Leaf(text) => Tree::Leaf(shortened(&format!("{name}({text})"))),
                    branch @ Tree::Branch(..) => {
                        Tree::Branch(vec![(Segment::Name(name), branch)], self.since(start))
                    }
                });
            }
            b'[' | b'{' | b'(' => return self.branch(tag, start, depth),
            _ => return None,
        };
        Some(Tree::Leaf(leaf))
    }

    /// Reads the rest of a bracketed value that begins at `start`.
    fn branch(&mut self, open: u8, start: &'a [u8], depth: usize) -> Option<Tree<'a>> {
        let mut parts = Vec::new();
        let mut count = 0;
        while !matches!(self.rest.first()?, b']' | b'}' | b')') {
            count += 1;
            if open != b'{' && count > ELEMENT_LIMIT {
                for _ in 0..if open == b'(' { 2 } else { 1 } {
                    self.skip()?;
                }
                continue;
            }
            let segment = match open {
                b'{' => {
                    self.byte()?;
                    Segment::Name(self.name()?)
                }
                b'(' => match self.tree(depth + 1)? {
                    Tree::Leaf(key) => Segment::Key(key),
                    Tree::Branch(..) => return None,
                },
                _ => Segment::Index(parts.len()),
            };
            parts.push((segment, self.tree(depth + 1)?));
        }
        self.byte()?;
        let bytes = self.since(start);
        if depth >= DEPTH_LIMIT || (open != b'{' && count > ELEMENT_LIMIT) {
            return Some(Tree::Leaf(summary(count, bytes)));
        }
        let plain = open == b'[' && parts.iter().all(|(_, part)| matches!(part, Tree::Leaf(_)));
        if plain && !parts.is_empty() {
            return Some(Tree::Leaf(list(&parts, bytes)));
        }
        Some(Tree::Branch(parts, bytes))
    }

    /// Passes over one value.
    fn skip(&mut self) -> Option<()> {
        let mut open = 0_usize;
        loop {
            match self.byte()? {
                b'F' | b'T' | b'N' | b'U' => {}
                b'u' | b'i' | b'd' => {
                    self.take(8)?;
                }
                b'v' | b'j' => {
                    self.take(16)?;
                }
                b'f' | b'c' => {
                    self.take(4)?;
                }
                b's' | b'b' => {
                    self.counted()?;
                }
                // What follows belongs to the same value.
                b'S' => continue,
                b'V' | b'.' => {
                    self.counted()?;
                    continue;
                }
                b'[' | b'{' | b'(' => {
                    open += 1;
                }
                b']' | b'}' | b')' => open = open.checked_sub(1)?,
                _ => return None,
            }
            if open == 0 {
                return Some(());
            }
        }
    }

    fn since(&self, start: &'a [u8]) -> &'a [u8] {
        &start[..start.len() - self.rest.len()]
    }
}

/// The text of a sequence of plain values.
fn list(parts: &[(Segment<'_>, Tree<'_>)], bytes: &[u8]) -> String {
    let mut text = String::from("[");
    for (index, (_, part)) in parts.iter().enumerate() {
        if let Tree::Leaf(value) = part {
            if index > 0 {
                text.push_str(", ");
            }
            text.push_str(value);
        }
        if text.chars().count() > TEXT_LIMIT {
            return summary(parts.len(), bytes);
        }
    }
    text.push(']');
    text
}

fn summary(count: usize, bytes: &[u8]) -> String {
    format!("{count} values #{}", Digest::of(bytes).short())
}

fn shortened(text: &str) -> String {
    if text.chars().count() <= TEXT_LIMIT {
        return text.to_owned();
    }
    let start: String = text.chars().take(TEXT_LIMIT - 20).collect();
    format!("{start}… #{}", Digest::of(text.as_bytes()).short())
}
