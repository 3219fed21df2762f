//! Comparing documents with what they should say, and writing them anew where that is wanted.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A file of the checkout.
pub(crate) fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// A document of the checkout, with line feeds at the ends of lines.
pub(crate) fn read(name: &str) -> String {
    fs::read_to_string(path(name))
        .unwrap_or_else(|error| panic!("{name}: {error}"))
        .replace("\r\n", "\n")
}

/// Holds that a whole file is `wanted`.
pub(crate) fn whole(name: &str, wanted: &str) {
    let same = path(name).exists() && read(name) == wanted;
    settle(name, wanted, same);
}

/// Holds that the part of a document between `<!-- BLOCK -->` and `<!-- end -->` is `wanted`.
pub(crate) fn block(name: &str, block: &str, wanted: &str) {
    // Tests run side by side, and several blocks of one page may be written.
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let text = read(name);
    let mark = format!("<!-- {block} -->\n");
    let start = text
        .find(&mark)
        .unwrap_or_else(|| panic!("{name} has no block `{block}`"))
        + mark.len();
    let end = start
        + text[start..]
            .find("<!-- end -->")
            .unwrap_or_else(|| panic!("block `{block}` of {name} does not end"));
    let same = &text[start..end] == wanted;
    settle(
        name,
        &format!("{}{wanted}{}", &text[..start], &text[end..]),
        same,
    );
}

/// Holds that a file of drawn numbers is `wanted` up to `tolerance` of each number: sums that are
/// ordered otherwise may move a last digit, and a picture does not change by that.
pub(crate) fn drawing(name: &str, wanted: &str, tolerance: f64) {
    let same = path(name).exists() && alike(&read(name), wanted, tolerance);
    settle(name, wanted, same);
}

fn settle(name: &str, wanted: &str, same: bool) {
    if same {
        return;
    }
    assert!(
        std::env::var_os("EGG_BLESS").is_some_and(|value| !value.is_empty()),
        "{name} is out of date; `EGG_BLESS=1 cargo test --test documents` writes it"
    );
    fs::write(path(name), wanted).unwrap_or_else(|error| panic!("{name}: {error}"));
}

fn alike(a: &str, b: &str, tolerance: f64) -> bool {
    let (a, b) = (tokens(a), tokens(b));
    a.len() == b.len()
        && a.iter()
            .zip(&b)
            .all(|(a, b)| match (a.parse::<f64>(), b.parse::<f64>()) {
                (Ok(a), Ok(b)) => (a - b).abs() <= tolerance,
                _ => a == b,
            })
}

/// Numbers and what stands between them.
fn tokens(text: &str) -> Vec<&str> {
    let numeric = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = rest
            .find(|c: char| numeric(c) != numeric(first))
            .unwrap_or(rest.len());
        tokens.push(&rest[..end]);
        rest = &rest[end..];
    }
    tokens
}

#[test]
fn drawings_are_compared_by_their_numbers() {
    assert!(alike("M1.25 -3Z", "M1.3 -3Z", 0.1));
    assert!(!alike("M1.25 -3Z", "M1.45 -3Z", 0.1));
    assert!(!alike("M1.25 -3Z", "L1.25 -3Z", 0.1));
    assert!(!alike("M1.25 -3Z", "M1.25 -3", 0.1));
}
