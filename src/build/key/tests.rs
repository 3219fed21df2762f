use super::canon::encode;
use super::recipe::fields;
use super::{Digest, KeyParts, PortKind};
use proptest::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize, Clone, Debug)]
struct Sample {
    name: &'static str,
    counts: Vec<u32>,
    corner: [f64; 2],
    offset: Option<i8>,
    kind: Kind,
    layers: BTreeMap<&'static str, Layer>,
    letter: char,
    unit: (),
    wide: u128,
    single: f32,
    flag: bool,
}

#[derive(Serialize, Clone, Debug)]
enum Kind {
    Plain,
    Wrapped(u16),
    Pair(u8, u8),
    Named { at: f64 },
}

#[derive(Serialize, Clone, Debug)]
struct Layer {
    depth: i64,
}

fn sample() -> Sample {
    Sample {
        name: "west",
        counts: vec![9, 7],
        corner: [0.5, -0.0],
        offset: None,
        kind: Kind::Named { at: 1.25 },
        layers: BTreeMap::from([("cut", Layer { depth: -3 }), ("mark", Layer { depth: 4 })]),
        letter: 'é',
        unit: (),
        wide: 1,
        single: 2.5,
        flag: true,
    }
}

/// A map whose order is an accident.
struct Unordered;

impl Serialize for Unordered {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map([("b", 1), ("a", 2)])
    }
}

fn encoded<T: Serialize + ?Sized>(value: &T) -> Vec<u8> {
    let mut out = Vec::new();
    encode(value, &mut out).expect("an encoding");
    out
}

fn error<T: Serialize + ?Sized>(value: &T) -> String {
    encode(value, &mut Vec::new())
        .expect_err("no encoding")
        .to_string()
}

#[test]
fn the_encoding_is_the_one_that_the_table_says() {
    #[derive(Serialize)]
    struct Small {
        a: u8,
        b: Vec<bool>,
    }
    let small = Small {
        a: 3,
        b: vec![true, false],
    };
    let mut expected = b"{.\x01\0\0\0\0\0\0\0au\x03\0\0\0\0\0\0\0".to_vec();
    expected.extend(b".\x01\0\0\0\0\0\0\0b[TF]}");
    assert_eq!(encoded(&small), expected);
    assert_eq!(encoded("ab"), b"s\x02\0\0\0\0\0\0\0ab");
    assert_eq!(encoded(&1.0), b"d\0\0\0\0\0\0\xf0\x3f");
    assert_eq!(encoded(&Some(())), b"SU");
    assert_eq!(encoded(&Kind::Plain), b"V\x05\0\0\0\0\0\0\0PlainU");
}

/// Keys that have been given out stay: a refactoring that moves one of these digests throws
/// every cache away.
#[test]
fn keys_are_the_same_for_ever() {
    let input = encoded(&sample());
    assert_eq!(
        Digest::of(&input).to_hex(),
        "f0104055bf29bf41586b1052cf1dff44526c49610fbf1b6753d181b7ba39fe2a"
    );
    let parts = KeyParts {
        stage: "cladding",
        version: 3,
        numerics: "portable",
        build_id: None,
        input: &input,
        shape: &[2],
        needs: &[
            (PortKind::Value, Digest::of(b"one")),
            (PortKind::Warnings, Digest::of(b"two")),
            (PortKind::Attempt, Digest::of(b"three")),
        ],
    };
    assert_eq!(
        parts.digest().to_hex(),
        "a88584b2074ede34b435759c07b8a7f6800f7a23f45b168469d0579a27dc4345"
    );
}

#[test]
fn every_part_of_a_key_counts() {
    let needs = [(PortKind::Value, Digest::of(b"one"))];
    let parts = || KeyParts {
        stage: "s",
        version: 1,
        numerics: "portable",
        build_id: None,
        input: b"i",
        shape: &[],
        needs: &needs,
    };
    let warned = [(PortKind::Warnings, Digest::of(b"one"))];
    let other = [(PortKind::Value, Digest::of(b"two"))];
    let keys = [
        parts(),
        KeyParts {
            stage: "t",
            ..parts()
        },
        KeyParts {
            version: 2,
            ..parts()
        },
        KeyParts {
            numerics: "x86",
            ..parts()
        },
        KeyParts {
            build_id: Some("b"),
            ..parts()
        },
        KeyParts {
            input: b"j",
            ..parts()
        },
        KeyParts {
            shape: &[1],
            ..parts()
        },
        KeyParts {
            needs: &warned,
            ..parts()
        },
        KeyParts {
            needs: &other,
            ..parts()
        },
        KeyParts {
            needs: &[],
            ..parts()
        },
    ]
    .map(|parts| parts.digest());
    let distinct: std::collections::BTreeSet<_> = keys.iter().collect();
    assert_eq!(distinct.len(), keys.len());
}

#[test]
fn what_means_the_same_has_the_same_encoding() {
    #[derive(Serialize)]
    struct Metres(f64);
    assert_eq!(encoded(&-0.0_f64), encoded(&0.0_f64));
    assert_eq!(encoded(&7_u8), encoded(&7_u64));
    assert_eq!(encoded(&-7_i8), encoded(&-7_i64));
    assert_eq!(encoded(&Metres(0.5)), encoded(&0.5));
    assert_eq!(encoded(&vec![1.0, 2.0]), encoded(&[1.0, 2.0]));
    assert_eq!(encoded(&String::from("a")), encoded(&Box::new("a")));
}

#[test]
fn what_differs_has_another_encoding() {
    let values: Vec<Vec<u8>> = vec![
        encoded(&0_u32),
        encoded(&0_i32),
        encoded(&0.0_f64),
        encoded(&0.0_f32),
        encoded(&false),
        encoded(&'\0'),
        encoded(""),
        encoded(&()),
        encoded(&None::<()>),
        encoded(&Some(())),
        encoded(&Some(Some(()))),
        encoded(&[0_u32; 0]),
        encoded(&[[0_u32; 0]]),
        encoded(&(0_u32, 0_u32)),
        encoded(&BTreeMap::<u32, u32>::new()),
        encoded(&vec!["ab", "c"]),
        encoded(&vec!["a", "bc"]),
        encoded(&Kind::Plain),
        encoded(&Kind::Wrapped(0)),
        encoded(&Kind::Pair(0, 0)),
        encoded(&Kind::Named { at: 0.0 }),
        encoded(&f64::INFINITY),
        encoded(&f64::MIN_POSITIVE),
    ];
    let distinct: std::collections::BTreeSet<_> = values.iter().collect();
    assert_eq!(distinct.len(), values.len());
}

#[test]
fn values_without_one_encoding_are_refused_with_their_place() {
    let mut broken = sample();
    broken.corner[1] = f64::NAN;
    assert_eq!(error(&broken), "`corner.[1]`: not a number");
    assert_eq!(error(&f32::NAN), "not a number");
    assert_eq!(
        error(&BTreeMap::from([([1_u8, 2], 3)])),
        "a map key that is neither string nor integer"
    );
    assert_eq!(error(&Unordered), "map keys are not in ascending order");
    let numbers: BTreeMap<u64, u8> = [(2, 0), (300, 1)].into();
    encoded(&numbers);
    let numbers: BTreeMap<i64, u8> = [(-2, 0), (1, 1)].into();
    encoded(&numbers);
}

#[test]
fn a_recipe_names_every_field() {
    let text: Vec<String> = fields(&encoded(&sample()))
        .into_iter()
        .map(|field| format!("{} = {}", field.path, field.value))
        .collect();
    assert_eq!(
        text,
        [
            "name = \"west\"",
            "counts = [9, 7]",
            "corner = [0.5, 0.0]",
            "offset = none",
            "kind.Named.at = 1.25",
            "layers[\"cut\"].depth = -3",
            "layers[\"mark\"].depth = 4",
            "letter = 'é'",
            "unit = ()",
            "wide = 1",
            "single = 2.5",
            "flag = true",
        ]
    );
    assert_eq!(fields(&encoded(&Some(None::<u8>)))[0].value, "some none");
    let value = |kind: Kind| fields(&encoded(&kind))[0].value.clone();
    assert_eq!(value(Kind::Plain), "Plain");
    assert_eq!(value(Kind::Wrapped(5)), "Wrapped(5)");
    assert_eq!(value(Kind::Pair(1, 2)), "Pair([1, 2])");
}

#[test]
fn recipes_are_short_and_still_tell_long_values_apart() {
    let long = |last: f64| {
        let mut values = vec![0.5; 100_000];
        values[99_999] = last;
        let found = fields(&encoded(&values));
        assert_eq!(found.len(), 1);
        found[0].value.clone()
    };
    assert!(long(1.0).starts_with("100000 values #"), "{}", long(1.0));
    assert_ne!(long(1.0), long(2.0));

    let text = |last: char| {
        let text: String = "w".repeat(500) + &last.to_string();
        fields(&encoded(&text))[0].value.clone()
    };
    assert!(text('a').chars().count() < 70);
    assert_ne!(text('a'), text('b'));

    let layers = |last: i64| {
        let mut layers = vec![Layer { depth: 0 }; 5000];
        layers[4999].depth = last;
        fields(&encoded(&layers))
    };
    assert_eq!(layers(1).len(), 1);
    assert_ne!(layers(1), layers(2));

    let many: Vec<Vec<Layer>> = vec![vec![Layer { depth: 1 }; 60]; 60];
    assert!(fields(&encoded(&many)).len() < 500);
    let bytes = fields(&encoded(&Digest::of(b"mesh")));
    assert_eq!(bytes[0].value, format!("#{}", Digest::of(b"mesh").short()));
}

/// Any value that serde can describe, as a tree.
#[derive(Debug, Clone, PartialEq, Serialize)]
enum Tree {
    Number(f64),
    Count(u64),
    Text(String),
    Flag(Option<bool>),
    List(Vec<Tree>),
    Pair(Box<Tree>, Box<Tree>),
    Named { left: Box<Tree>, right: Vec<Tree> },
    Map(BTreeMap<String, Tree>),
}

fn trees() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (-3..3_i32).prop_map(|n| Tree::Number(f64::from(n) * 0.5)),
        (0..4_u64).prop_map(Tree::Count),
        "[a-c\\[\\]{}.]{0,3}".prop_map(Tree::Text),
        any::<Option<bool>>().prop_map(Tree::Flag),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let several = prop::collection::vec(inner.clone(), 0..3);
        let map = prop::collection::btree_map("[a-c]{0,2}", inner.clone(), 0..3);
        prop_oneof![
            several.clone().prop_map(Tree::List),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| Tree::Pair(a.into(), b.into())),
            (inner, several).prop_map(|(left, right)| Tree::Named {
                left: left.into(),
                right
            }),
            map.prop_map(Tree::Map),
        ]
    })
}

proptest! {
    #[test]
    fn encodings_and_recipes_are_equal_if_and_only_if_values_are(a in trees(), b in trees()) {
        let (one, two) = (encoded(&a), encoded(&b));
        prop_assert_eq!(a == b, one == two);
        prop_assert_eq!(a == b, fields(&one) == fields(&two), "{:?}", fields(&one));
        // Prefix-free: no encoding goes on where another ends.
        prop_assert!(a == b || (!one.starts_with(&two) && !two.starts_with(&one)));
    }

    #[test]
    fn reading_a_broken_encoding_ends_without_harm(
        tree in trees(),
        cut in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        byte in any::<u8>(),
    ) {
        let mut bytes = encoded(&tree);
        let place = at.index(bytes.len());
        bytes[place] = byte;
        bytes.truncate(cut.index(bytes.len()) + 1);
        fields(&bytes);
    }
}
