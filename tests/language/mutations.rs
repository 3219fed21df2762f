//! Damaged files: no panic, no hang, no stack overflow, and always an answer.

use crate::files::cases;
use egg::diagnostics::Severity;
use egg::diagnostics::render::{Source, Sources, Style, human, json_lines};
use egg::project::{Notation, load};
use proptest::prelude::*;
use std::time::{Duration, Instant};

/// One damage to a text. Positions are shares, so that they fit every text.
#[derive(Debug, Clone)]
enum Damage {
    Flip(f64, u8),
    Cut(f64, f64),
    Truncate(f64),
    Insert(f64, &'static str),
    Repeat(f64, f64, usize),
    Swap(f64, f64),
}

const TOKENS: &[&str] = &[
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    "=",
    ":",
    ",",
    ".",
    "\"",
    "'",
    "#",
    "//",
    "/*",
    "\\",
    "\n",
    "\r\n",
    "\0",
    "é",
    "\u{feff}",
    "-1",
    "0",
    "1e999",
    "-1e-999",
    "nan",
    "inf",
    "NaN",
    "99999999999999999999999999",
    "0xFF",
    "1_0",
    "true",
    "None",
    "Some(",
    "[[studies]]\n",
    "\"30 mm\"",
    "\"-3 kg\"",
    "\"a\"",
    "{ on = [\"a\", \"t\"], at = 0.5 }",
    "u = 3\n",
    "width",
    "corners",
    "2026-11-23",
];

fn damage() -> impl Strategy<Value = Damage> {
    let share = || 0.0..1.0_f64;
    prop_oneof![
        (share(), any::<u8>()).prop_map(|(at, byte)| Damage::Flip(at, byte)),
        (share(), 0.0..0.05_f64).prop_map(|(at, length)| Damage::Cut(at, length)),
        share().prop_map(Damage::Truncate),
        (share(), proptest::sample::select(TOKENS))
            .prop_map(|(at, token)| Damage::Insert(at, token)),
        (share(), 0.0..0.02_f64, 2..60_usize)
            .prop_map(|(at, length, n)| Damage::Repeat(at, length, n)),
        (share(), share()).prop_map(|(a, b)| Damage::Swap(a, b)),
    ]
}

fn position(share: f64, text: &str) -> usize {
    let mut at = (share * text.len() as f64) as usize;
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn damaged(text: &str, damage: &Damage) -> String {
    match *damage {
        Damage::Flip(at, byte) => {
            let mut bytes = text.as_bytes().to_vec();
            if let Some(old) = bytes.get_mut((at * text.len() as f64) as usize) {
                *old ^= byte;
            }
            String::from_utf8_lossy(&bytes).into_owned()
        }
        Damage::Cut(at, length) => {
            let (from, to) = (position(at, text), position((at + length).min(1.0), text));
            format!("{}{}", &text[..from], &text[to..])
        }
        Damage::Truncate(at) => text[..position(at, text)].to_owned(),
        Damage::Insert(at, token) => {
            let at = position(at, text);
            format!("{}{token}{}", &text[..at], &text[at..])
        }
        Damage::Repeat(at, length, count) => {
            let (from, to) = (position(at, text), position((at + length).min(1.0), text));
            format!(
                "{}{}{}",
                &text[..from],
                text[from..to].repeat(count),
                &text[to..]
            )
        }
        Damage::Swap(a, b) => {
            let mut tokens: Vec<&str> = text.split_inclusive([' ', ',', '\n']).collect();
            if !tokens.is_empty() {
                let index =
                    |share: f64| ((share * tokens.len() as f64) as usize).min(tokens.len() - 1);
                let (a, b) = (index(a), index(b));
                tokens.swap(a, b);
            }
            tokens.concat()
        }
    }
}

/// Loads and renders; checks what holds for every text.
fn survive(text: &str, notation: Notation) {
    let loaded = load(text, notation, "x");
    let errors = loaded
        .diagnostics
        .iter()
        .any(|d| d.severity == Severity::Error);
    assert_eq!(errors, loaded.project.is_none());
    assert!(loaded.diagnostics.len() <= 100);
    let sources = Sources {
        project: Source { name: "x", text },
        spans: &loaded.spans,
        mesh: None,
    };
    for style in [Style::Plain, Style::Narrated] {
        human(&loaded.diagnostics, &sources, style);
    }
    for line in json_lines(&loaded.diagnostics, &sources).lines() {
        let json: serde_json::Value = serde_json::from_str(line).expect("JSON");
        for label in json["labels"].as_array().expect("a list") {
            let at = |end: &str| label[end]["byte"].as_u64().expect("a number") as usize;
            assert!(text.get(at("start")..at("end")).is_some(), "{label}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_project_is_answered(
        which in any::<prop::sample::Index>(),
        damages in prop::collection::vec(damage(), 1..6),
    ) {
        let cases = GOOD.get_or_init(|| {
            cases("good").into_iter().map(|case| (case.notation, case.text)).collect()
        });
        let (notation, text) = which.get(cases);
        let text = damages.iter().fold(text.clone(), |text, damage| damaged(&text, damage));
        survive(&text, *notation);
    }

    #[test]
    fn any_text_is_answered(text in "[\\PC\n\\[\\]{}()=:,\"'.#]{0,200}") {
        survive(&text, Notation::Toml);
        survive(&text, Notation::Ron);
    }
}

static GOOD: std::sync::OnceLock<Vec<(Notation, String)>> = std::sync::OnceLock::new();

/// A bound far above what the work takes (tens of milliseconds), for a machine that is busy.
const PATIENCE: Duration = Duration::from_secs(20);

fn survive_soon(what: &str, text: &str, notation: Notation) {
    let start = Instant::now();
    survive(text, notation);
    let took = start.elapsed();
    assert!(took < PATIENCE, "{what} took {took:?}");
}

#[test]
fn deep_nesting_ends_in_a_diagnostic_and_not_on_the_stack() {
    for depth in [33, 81, 1000, 100_000] {
        for (open, close) in [("[", "]"), ("{a=", "}"), ("{ a.b.c = ", "}")] {
            let text = format!("x = {}1{}", open.repeat(depth), close.repeat(depth));
            survive_soon("nesting", &text, Notation::Toml);
            survive_soon("open nesting", &text[..text.len() / 2], Notation::Toml);
        }
        for (open, close) in [
            ("[", "]"),
            ("(", ")"),
            ("(a:", ")"),
            ("{\"a\":", "}"),
            ("Some(", ")"),
            ("/*", "*/"),
            ("A(", ")"),
        ] {
            let text = format!("(x: {}1{})", open.repeat(depth), close.repeat(depth));
            survive_soon("nesting", &text, Notation::Ron);
            survive_soon("open nesting", &text[..text.len() / 2], Notation::Ron);
        }
        let dotted = vec!["a"; depth].join(".");
        survive_soon(
            "dotted",
            &format!("{dotted} = 1\n[{dotted}]\n[[{dotted}]]\n"),
            Notation::Toml,
        );
    }
    // Dotted keys of 79 parts in 79 inline tables: thousands of levels within TOML's own limits.
    let dotted = vec!["a"; 79].join(".");
    let text = format!(
        "x = {}1{}",
        format!("{{ {dotted} = ").repeat(79),
        "}".repeat(79)
    );
    survive_soon("dotted nesting", &text, Notation::Toml);
}

#[test]
fn huge_files_are_answered_soon() {
    let many = |n: usize, line: &dyn Fn(usize) -> String| -> String {
        (0..n).map(line).collect::<Vec<_>>().concat()
    };
    let points = many(40_000, &|i| format!("p{i} = [{i}, 0]\n"));
    survive_soon("points", &format!("[points]\n{points}"), Notation::Toml);
    let corners = r#"corners = ["a", "b", "c", "d"]"#;
    let patches = many(20_000, &|i| format!("[patches.q{i}]\n{corners}\n"));
    survive_soon("patches", &patches, Notation::Toml);
    let unknown = many(1_900, &|i| {
        format!("[patches.q{i}]\ncorners = [\"x{i}\", \"y{i}\", \"z{i}\", \"w{i}\"]\n")
    });
    let points = many(4_900, &|i| format!("p{i} = [{i}, 0]\n"));
    survive_soon(
        "unknown points",
        &format!("[points]\n{points}{unknown}"),
        Notation::Toml,
    );
    let on = many(4_900, &|i| {
        format!("p{i} = {{ on = [\"a\", \"b\"], at = 0.{i:04}1 }}\n")
    });
    let line = format!(
        "[points]\na = [0, 0]\nb = [1, 0]\n{on}[patches.q]\ncorners = [\"a\", \"b\", \"p1\", \"p2\"]\n"
    );
    survive_soon("anchors on one line", &line, Notation::Toml);
    let chain = many(4_900, &|i| {
        format!("p{i} = {{ on = [\"p{}\", \"b\"], at = 0.5 }}\n", i + 1)
    });
    survive_soon(
        "a chain of anchors",
        &format!("[points]\nb = [1, 0]\np4900 = [0, 0]\n{chain}"),
        Notation::Toml,
    );
    let list = format!("(x: [{}])", "1,".repeat(2_000_000));
    survive_soon("list", &list, Notation::Ron);
    let digits = "7".repeat(2_000_000);
    for written in [
        digits.clone(),
        format!("0.{digits}"),
        format!("\"{digits} ft\""),
        format!("1e{digits}"),
    ] {
        survive_soon(
            "digits",
            &format!("[lamella]\nwidth = {written}\n"),
            Notation::Toml,
        );
        survive_soon(
            "digits",
            &format!("(lamella: (width: {written}))"),
            Notation::Ron,
        );
    }
    let name = "n".repeat(2_000_000);
    survive_soon(
        "name",
        &format!("[lamella]\nmaterial = \"{name}\"\n{name} = 1\n"),
        Notation::Toml,
    );
    survive_soon("errors", &"[[[\n= = =\n".repeat(100_000), Notation::Toml);
    survive_soon(
        "errors",
        &format!("({}", "a: ?, ".repeat(300_000)),
        Notation::Ron,
    );
    survive_soon("comments", &"/*".repeat(1_000_000), Notation::Ron);
    survive_soon("raw strings", &"r#\"".repeat(300_000), Notation::Ron);
}
