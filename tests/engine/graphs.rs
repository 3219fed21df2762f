//! Random graphs whose results are lost and damaged between builds: every value is what a direct
//! evaluation gives, and no build gets stuck.

use crate::workshop::Workshop;
use egg::build::{
    CancelToken, Digest, Graph, How, Limits, Mode, Node, Numerics, Reason, Request, Settings, Stage,
};
use egg::diagnostics::Warned;
use proptest::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicUsize, Ordering};

type Bytes = Vec<u8>;

/// Mixes its input with its dependencies; long enough for a blob of its own.
const MIX: Stage<(u8, bool), Vec<Node<Bytes>>, Bytes> = Stage {
    name: "mix",
    version: 1,
    numerics: Numerics::Portable,
    run: |&(input, long), needs, _| {
        Ok(Warned {
            value: mix(input, long, needs.into_iter()),
            warnings: vec![],
        })
    },
};

fn mix<'a>(input: u8, long: bool, needs: impl Iterator<Item = &'a Bytes>) -> Bytes {
    let mut all = vec![input];
    for need in needs {
        all.extend(need);
    }
    Digest::of(&all)
        .as_bytes()
        .repeat(if long { 64 } else { 1 })
}

/// One node: input, whether its result is long, and earlier nodes that it needs.
#[derive(Debug, Clone)]
struct Vertex {
    input: u8,
    long: bool,
    needs: Vec<usize>,
}

#[derive(Debug, Clone)]
enum Step {
    Set(usize, u8),
    /// Lose, truncate or scribble over a file of the cache.
    Harm(usize, u8),
    /// Lose all results, all records of runs, or the record of the last build.
    Lose(u8),
    Collect,
}

fn vertices() -> impl Strategy<Value = Vec<Vertex>> {
    let one = (
        any::<u8>(),
        any::<bool>(),
        prop::collection::vec(any::<prop::sample::Index>(), 0..4),
    );
    prop::collection::vec(one, 1..24).prop_map(|raw| {
        let vertex = |(index, (input, long, needs)): (usize, (_, _, Vec<prop::sample::Index>))| {
            let earlier = needs.iter().filter(|_| index > 0);
            Vertex {
                input,
                long,
                needs: earlier.map(|need| need.index(index.max(1))).collect(),
            }
        };
        raw.into_iter().enumerate().map(vertex).collect()
    })
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let step = prop_oneof![
        3 => (any::<usize>(), 0..3_u8).prop_map(|(index, value)| Step::Set(index, value)),
        4 => (any::<usize>(), 0..3_u8).prop_map(|(index, way)| Step::Harm(index, way)),
        1 => (0..3_u8).prop_map(Step::Lose),
        1 => Just(Step::Collect),
    ];
    prop::collection::vec(step, 1..16)
}

fn harm(workshop: &Workshop, index: usize, way: u8) {
    let mut files = workshop.cache();
    files.retain(|path| {
        path.components().any(|part| {
            ["traces", "blobs", "worktrees"]
                .iter()
                .any(|kind| part.as_os_str() == *kind)
        })
    });
    files.sort();
    if files.is_empty() {
        return;
    }
    let path = &files[index % files.len()];
    let bytes = std::fs::read(path).expect("read");
    match way {
        0 => std::fs::remove_file(path).expect("removed"),
        1 => std::fs::write(path, &bytes[..bytes.len() / 2]).expect("written"),
        _ => {
            let mut bytes = bytes;
            let middle = bytes.len() / 2;
            bytes[middle] ^= 0x10;
            std::fs::write(path, bytes).expect("written");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn values_are_right_whatever_was_lost(
        mut vertices in vertices(),
        steps in steps(),
        jobs in 1..4_usize,
    ) {
        let mut workshop = Workshop::new();
        workshop.settings.jobs = jobs;
        for step in steps {
            match step {
                Step::Set(index, value) => {
                    let index = index % vertices.len();
                    vertices[index].input = value;
                }
                Step::Harm(index, way) => harm(&workshop, index, way),
                Step::Lose(kind) => {
                    let kind = ["traces", "blobs", "worktrees"][usize::from(kind)];
                    let path = workshop.settings.cache.join("v1").join(kind);
                    std::fs::remove_dir_all(path).ok();
                }
                Step::Collect => {
                    let limits = Limits { size: 10_000, age: std::time::Duration::ZERO };
                    let later = std::time::SystemTime::now() + std::time::Duration::from_secs(7200);
                    workshop.engine().store().collect(&limits, later, Mode::Apply);
                }
            }
            let declare = |g: &mut Graph<'_>| {
                let mut nodes: Vec<Node<Bytes>> = Vec::new();
                for (index, vertex) in vertices.iter().enumerate() {
                    let needs = vertex.needs.iter().map(|&need| nodes[need]).collect();
                    let input = (vertex.input, vertex.long);
                    nodes.push(g.add(&MIX, index.to_string(), input, needs));
                }
            };
            let request = Request::default();
            let built = workshop
                .engine()
                .build(&request, &declare, &CancelToken::default(), &mut |_| {});
            prop_assert!(built.succeeded(), "{:?}", built.diagnostics);
            let mut values: Vec<Bytes> = Vec::new();
            for (index, vertex) in vertices.iter().enumerate() {
                let needs = vertex.needs.iter().map(|&need| &values[need]);
                values.push(mix(vertex.input, vertex.long, needs));
                let name = index.to_string();
                if let Some(found) = built.output(&MIX, &name) {
                    prop_assert_eq!(&*found, &values[index], "{}", name);
                } else {
                    // Nobody needed it, and its result is lost: the next build would say so.
                    let stage = &built.stages[index];
                    prop_assert_eq!(stage.how, How::Cached);
                }
            }
            for stage in &built.stages {
                let ran = stage.how == How::Ran;
                let cached = stage.how == How::Cached;
                prop_assert!(ran || cached);
                prop_assert!(!ran || !stage.reasons.is_empty(), "no run without a reason");
                prop_assert!(!stage.reasons.contains(&Reason::Forced));
            }
        }
    }
}

/// A result that counts how many of its kind are in memory.
struct Heavy(u32);

static LIVE: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

impl Heavy {
    fn new(value: u32) -> Self {
        let live = LIVE.fetch_add(1, Ordering::SeqCst) + 1;
        MOST.fetch_max(live, Ordering::SeqCst);
        Self(value)
    }
}

impl Drop for Heavy {
    fn drop(&mut self) {
        LIVE.fetch_sub(1, Ordering::SeqCst);
    }
}

impl Serialize for Heavy {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Heavy {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        u32::deserialize(deserializer).map(Self::new)
    }
}

#[test]
fn values_are_forgotten_when_nobody_needs_them_any_more() {
    const FIRST: Stage<u32, (), Heavy> = Stage {
        name: "first",
        version: 1,
        numerics: Numerics::Portable,
        run: |value, (), _| {
            Ok(Warned {
                value: Heavy::new(*value),
                warnings: vec![],
            })
        },
    };
    const NEXT: Stage<(), Node<Heavy>, Heavy> = Stage {
        name: "next",
        version: 1,
        numerics: Numerics::Portable,
        run: |(), before, _| {
            Ok(Warned {
                value: Heavy::new(before.0 + 1),
                warnings: vec![],
            })
        },
    };
    let workshop = Workshop::new();
    let built = workshop.engine().build(
        &Request::default(),
        &|g| {
            for chain in 0..4 {
                let mut node = g.add(&FIRST, chain.to_string(), chain * 1000, ());
                for step in 0..25 {
                    node = g.add(&NEXT, format!("{chain}.{step}"), (), node);
                }
            }
        },
        &CancelToken::default(),
        &mut |_| {},
    );
    assert_eq!(built.count(How::Ran), 104);
    assert_eq!(built.output(&NEXT, "3.24").map(|last| last.0), Some(3025));
    let most = MOST.load(Ordering::SeqCst);
    assert!(most <= 8, "two in each of four chains, not {most}");
}

#[test]
fn two_engines_of_one_process_share_the_work() {
    static RUNS: AtomicUsize = AtomicUsize::new(0);
    const SLOW: Stage<u32, (), Bytes> = Stage {
        name: "slow",
        version: 1,
        numerics: Numerics::Portable,
        run: |value, (), _| {
            RUNS.fetch_add(1, Ordering::SeqCst);
            std::thread::sleep(std::time::Duration::from_millis(300));
            Ok(Warned {
                value: vec![*value as u8; 5000],
                warnings: vec![],
            })
        },
    };
    let workshop = Workshop::new();
    let build = |name: &str| {
        let output = workshop.path().join(name);
        let settings = Settings::new(&workshop.settings.cache, output);
        egg::build::Engine::open(settings).build(
            &Request::default(),
            &|g| {
                for value in 0..3 {
                    g.add(&SLOW, value.to_string(), value, ());
                }
            },
            &CancelToken::default(),
            &mut |_| {},
        )
    };
    std::thread::scope(|scope| {
        let builds = ["a", "b", "c"].map(|name| scope.spawn(move || build(name)));
        for build in builds {
            let built = build.join().expect("no panic");
            assert!(built.succeeded());
            assert_eq!(built.output(&SLOW, "2").expect("built").len(), 5000);
        }
    });
    assert_eq!(RUNS.load(Ordering::SeqCst), 3);
}
