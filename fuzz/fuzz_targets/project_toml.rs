//! Any text as a project file in TOML: a model or reasons, and a report that can be drawn.

#![no_main]

use egg::diagnostics::render::{Source, Sources, Style, human, json_lines};
use egg::project::{Notation, decode, load};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = decode(bytes) else { return };
    let loaded = load(text, Notation::Toml, "fuzzed");
    assert!(loaded.project.is_some() || !loaded.diagnostics.is_empty());
    let sources = Sources {
        project: Source {
            name: "fuzzed",
            text,
        },
        spans: &loaded.spans,
        mesh: None,
    };
    for style in [Style::Plain, Style::Colour, Style::Narrated] {
        let _ = human(&loaded.diagnostics, &sources, style);
    }
    let _ = json_lines(&loaded.diagnostics, &sources);
});
