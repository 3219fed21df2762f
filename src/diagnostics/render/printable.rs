//! Text of files as a terminal may see it.
//!
//! Project files, meshes and file names can hold control characters, by accident or on purpose:
//! they could move the cursor, change colours, or reverse the order in which a line is shown.

use std::borrow::Cow;

/// The text with each control character but line breaks and tabs replaced by one that is shown.
/// Every character keeps its length in bytes, so that places in the text stay right.
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_hidden) {
        return Cow::Borrowed(text);
    }
    let shown = |char: char| match (is_hidden(char), char.len_utf8()) {
        (false, _) => char,
        (true, 1) => '?',
        (true, 2) => '\u{bf}',
        (true, _) => char::REPLACEMENT_CHARACTER,
    };
    Cow::Owned(text.chars().map(shown).collect())
}

/// Control characters, and those that change the direction of writing.
fn is_hidden(char: char) -> bool {
    match char {
        '\n' | '\r' | '\t' => false,
        '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => true,
        _ => char.is_control(),
    }
}

#[cfg(test)]
mod tests {
    use super::printable;

    #[test]
    fn control_characters_are_shown_and_keep_their_length() {
        let text = "a\u{1b}[31mb\u{9b}c\u{202e}d\u{7f}\0\t\r\n\u{feff}e\u{e9}";
        let shown = printable(text);
        assert_eq!(shown, "a?[31mb\u{bf}c\u{fffd}d??\t\r\n\u{feff}e\u{e9}");
        assert_eq!(shown.len(), text.len());
    }
}
