//! Key paths: how a diagnostic names a place of the project file without knowing bytes.
//!
//! The text form is TOML's dotted key with list indices: `patches.west.corners[2]`,
//! `points."a b"`. It survives caching and edits elsewhere in the file, and it is the same for
//! both notations of the language.

use std::fmt;

/// A path of keys and list indices from the root of a project.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct KeyPath(String);

impl KeyPath {
    /// The whole document.
    pub const fn root() -> Self {
        Self(String::new())
    }

    /// A path of names, each quoted where it is not a bare key:
    /// `KeyPath::of(["patches", name, "alpha"])`.
    pub fn of<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        names
            .into_iter()
            .fold(Self::root(), |path, name| path.key(name))
    }

    /// The path of a key below this one.
    #[must_use]
    pub fn key(&self, name: &str) -> Self {
        let mut text = self.0.clone();
        if !text.is_empty() {
            text.push('.');
        }
        push_key(&mut text, name);
        Self(text)
    }

    /// The path of a list item below this one, counted from 0.
    #[must_use]
    pub fn index(&self, index: usize) -> Self {
        Self(format!("{}[{index}]", self.0))
    }

    /// The text form.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl From<KeyPath> for String {
    fn from(path: KeyPath) -> Self {
        path.0
    }
}

/// The path one segment shorter, `None` for the root. Quoted keys may hold dots and brackets.
pub(crate) fn parent(path: &str) -> Option<&str> {
    if path.is_empty() {
        return None;
    }
    let mut cut = 0;
    let mut quoted = false;
    let mut escaped = false;
    for (at, byte) in path.bytes().enumerate() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if quoted => escaped = true,
            b'"' => quoted = !quoted,
            b'.' | b'[' if !quoted => cut = at,
            _ => {}
        }
    }
    Some(&path[..cut])
}

fn push_key(text: &mut String, name: &str) {
    let bare = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    if !name.is_empty() && name.bytes().all(bare) {
        text.push_str(name);
        return;
    }
    text.push('"');
    for char in name.chars() {
        match char {
            '"' | '\\' => {
                text.push('\\');
                text.push(char);
            }
            _ if char.is_control() => text.extend(char.escape_unicode()),
            _ => text.push(char),
        }
    }
    text.push('"');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_not_bare_keys_are_quoted() {
        let path = KeyPath::of(["points", "a b"]).index(1);
        assert_eq!(path.as_str(), r#"points."a b"[1]"#);
        assert_eq!(KeyPath::of(["", "x\"y"]).as_str(), r#"""."x\"y""#);
    }

    #[test]
    fn a_parent_is_one_segment_shorter_even_with_dots_inside_quotes() {
        let path = KeyPath::of(["points", "a.b[0]\""]).index(2).key("c");
        let mut seen = vec![path.as_str()];
        while let Some(up) = parent(seen[seen.len() - 1]) {
            seen.push(up);
        }
        assert_eq!(
            seen,
            [
                r#"points."a.b[0]\""[2].c"#,
                r#"points."a.b[0]\""[2]"#,
                r#"points."a.b[0]\"""#,
                "points",
                ""
            ]
        );
    }
}
