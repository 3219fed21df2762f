//! The RON reader against the `ron` crate: it accepts nothing that the crate refuses, reads the
//! same values, and reads whatever the crate writes.

use super::{Node, Notation, Value, parse};
use proptest::prelude::*;

const GOOD: [&str; 3] = [
    include_str!("../../../tests/corpus/projects/good/full.ron"),
    include_str!("../../../tests/corpus/projects/good/ring.ron"),
    r###"#![enable(unwrap_newtypes, implicit_some)] #![schema = "x"]
    A(a: 1., b: -.5e-3, c: +7, d: 0b1_01, e: -0x7F, f: 1_000.000_1E+2, g: inf, h: -NaN,
      i: Some(Some(true)), j: None, k: (), l: ((), (1,), [[]], {}), m: B(1, C(x: D)),
      n: "a\
          b\u{e9}\x41\n", o: r##"c"#d"##, p: { "q r": { s: /* /* */ */ t } }, // end
    )"###,
];

/// Whether a node is what the crate reads. The crate's values forget bare words and names.
fn same(node: &Node, value: &ron::Value) -> bool {
    use ron::Value as R;
    match (&node.value, value) {
        (_, R::Option(Some(inner))) => same(node, inner),
        (Value::Bool(a), R::Bool(b)) => a == b,
        (Value::Text(a), R::String(b)) => a == b,
        (Value::Text(_), R::Unit) => true,
        // A file that is `None` is a project that says nothing.
        (Value::Table(entries), R::Unit | R::Option(None)) => entries.is_empty(),
        // `Name()` is no list here.
        (Value::Table(entries), R::Seq(values)) => entries.is_empty() && values.is_empty(),
        (Value::Number(number), R::Number(other)) => {
            let read: f64 = number
                .text
                .parse()
                .expect("a number's text is a float literal");
            let other = other.into_f64();
            read == other || read.is_nan() && other.is_nan()
        }
        (Value::List(items), R::Seq(values)) => {
            let values: Vec<&R> = values.iter().filter(|value| !is_none(value)).collect();
            items.len() == values.len() && items.iter().zip(values).all(|(a, b)| same(a, b))
        }
        (Value::Table(entries), R::Map(map)) => {
            let values: Vec<_> = map.iter().filter(|(_, value)| !is_none(value)).collect();
            let key = |key: &R| match key {
                R::String(key) => Some(key.clone()),
                // A bare word as the key of a map, which to the crate may also mean a value.
                _ => None,
            };
            entries.len() >= values.len()
                && values.iter().all(|(name, value)| match key(name) {
                    None => true,
                    Some(name) => entries
                        .iter()
                        .any(|entry| entry.key == name && same(&entry.node, value)),
                })
        }
        _ => false,
    }
}

fn is_none(value: &ron::Value) -> bool {
    match value {
        ron::Value::Option(None) => true,
        ron::Value::Option(Some(inner)) => is_none(inner),
        _ => false,
    }
}

fn sound(text: &str) -> bool {
    let Ok(node) = parse(text, Notation::Ron) else {
        return false;
    };
    match ron::from_str::<ron::Value>(text) {
        Ok(value) => assert!(same(&node, &value), "{text}\n{node:?}\n{value:?}"),
        Err(error) => panic!("the crate refuses what was read: {error}\n{text}"),
    }
    true
}

#[test]
fn the_corpus_is_read_as_the_crate_reads_it() {
    for text in GOOD {
        assert!(sound(text), "{text}");
    }
}

const TOKENS: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "\"",
    "\\",
    "/",
    "//",
    "/*",
    "*/",
    "#",
    "!",
    "r",
    "r#",
    "b\"",
    "'a'",
    "-",
    "+",
    ".",
    "..",
    "_",
    "e",
    "E5",
    "0x",
    "0b2",
    "inf",
    "NaN",
    "None",
    "Some(",
    "true",
    "1u8",
    "1.5f64",
    "1__0",
    "._5",
    "é",
    "²",
    "\u{2028}",
    "\0",
    "\\u{110000}",
    "\\x80",
    "9e999",
    "18446744073709551616",
    "-9223372036854775809",
    "0xFFFFFFFFFFFFFFFFF",
    "a-b",
    " ",
    "\n",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_text_that_is_read_is_read_as_the_crate_reads_it(
        which in 0..GOOD.len(),
        damages in prop::collection::vec((any::<prop::sample::Index>(), 0..6_usize, prop::sample::select(TOKENS)), 1..4),
    ) {
        let mut text: Vec<char> = GOOD[which].chars().collect();
        for (at, cut, token) in damages {
            let at = at.index(text.len());
            let end = (at + cut).min(text.len());
            text.splice(at..end, token.chars());
        }
        sound(&text.into_iter().collect::<String>());
    }

    #[test]
    fn any_sequence_of_tokens_that_is_read_is_read_as_the_crate_reads_it(
        tokens in prop::collection::vec(prop::sample::select(TOKENS), 1..8),
    ) {
        sound(&tokens.concat());
        sound(&format!("(a: {})", tokens.concat()));
    }

    #[test]
    fn what_the_crate_writes_is_read(value in tree()) {
        let text = ron::ser::to_string_pretty(&value, ron::ser::PrettyConfig::new())
            .expect("every value has a text");
        prop_assert!(sound(&text), "{}", text);
    }
}

/// Values as a program would write them.
fn tree() -> impl Strategy<Value = serde_json::Value> {
    use serde_json::Value as J;
    let leaf = prop_oneof![
        any::<bool>().prop_map(J::from),
        any::<i64>().prop_map(J::from),
        any::<u64>().prop_map(J::from),
        any::<f64>()
            .prop_map(J::from)
            .prop_filter("JSON has finite numbers", |v| !v.is_null()),
        any::<String>().prop_map(J::from),
    ];
    leaf.prop_recursive(5, 40, 6, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..6).prop_map(J::from),
            prop::collection::btree_map(any::<String>(), inner, 0..6)
                .prop_map(|map| J::Object(map.into_iter().collect())),
        ]
    })
}
