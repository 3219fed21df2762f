//! The index of all diagnostics, from their registry.

use crate::current;
use egg::diagnostics::codes::{CodeInfo, all};
use std::fmt::Write;

/// The rooms of the pipeline, by the first digits of their codes.
const ROOMS: [(&str, &str); 9] = [
    ("01", "Project file: reading"),
    ("02", "Project file: meaning"),
    ("03", "Surface"),
    ("04", "Layout"),
    ("05", "Cladding"),
    ("06", "Members and grid"),
    ("07", "Fabrication"),
    ("08", "Build, cache, revisions and differences"),
    ("09", "Plan, export, files"),
];

#[test]
fn the_index_of_diagnostics_is_the_registry() {
    current::whole("docs/errors.md", &index());
}

fn index() -> String {
    let mut text = String::from(
        "# Diagnostics\n\n\
         What `egg` says has a code. `E` codes stop what they are about; `W` codes are lints, which \
         a project can allow by name:\n\n\
         ```toml\n[lints]\nallow = [\"thick-lamella\"]\n```\n\n\
         `egg explain E0204` prints the text of one in the terminal. Codes are never reused. This \
         page is written from the registry in `src/diagnostics/codes`.\n",
    );
    let mut codes: Vec<&CodeInfo> = all().collect();
    codes.sort_by_key(|info| (&info.code[1..3], info.is_lint(), info.code));
    for (digits, room) in ROOMS {
        let of_room = || codes.iter().filter(|info| &info.code[1..3] == digits);
        if of_room().next().is_none() {
            continue;
        }
        let _ = write!(text, "\n## {room}\n\n| code | name | |\n|---|---|---|\n");
        for info in of_room() {
            let anchor = anchor(info);
            let _ = writeln!(
                text,
                "| [{}](#{anchor}) | `{}` | {} |",
                info.code, info.name, info.title
            );
        }
        for info in of_room() {
            let _ = write!(
                text,
                "\n### {} {}\n\n*{}*\n\n{}\n",
                info.code, info.name, info.title, info.text
            );
        }
    }
    let known = |info: &&CodeInfo| ROOMS.iter().any(|(digits, _)| &info.code[1..3] == *digits);
    assert!(codes.iter().all(known), "a code of no room");
    text
}

/// The fragment that a heading gets.
fn anchor(info: &CodeInfo) -> String {
    format!("{} {}", info.code, info.name)
        .to_lowercase()
        .replace(' ', "-")
}
