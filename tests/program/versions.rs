//! Results change only with their keys: who changes what a stage gives raises its version, or
//! users keep results of old code in their caches.
//!
//! The digests of all results of one project stand in a golden file beside their keys, which hold
//! input, dependencies and version.

use crate::{JUNCTION, VAULT, read, root, with_junction};
use egg::build::graph::{Design, Extent, declare};
use egg::build::{CancelToken, Digest, Engine, Graph, Request, Settings};
use egg::project::{Notation, load};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

const GOLDEN: &str = "tests/golden/program/results.txt";

/// Key and result of every instance, by its name.
type Results = BTreeMap<String, [String; 2]>;

fn whole<'p>(design: Design<'p>) -> impl Fn(&mut Graph<'p>) {
    move |graph| declare(graph, design, Extent::Files)
}

fn results() -> Results {
    let shop = with_junction();
    let loaded = load(&read(JUNCTION), Notation::Toml, "junction");
    let project = loaded.project.expect("no errors");
    // No build id: keys as those of a release.
    let settings = Settings::new(shop.path("cache"), shop.path("out"));
    let mut engine = Engine::open(settings);
    let mesh = engine.source(&root(VAULT)).expect("a mesh");
    let design = Design {
        project: &project,
        spans: &loaded.spans,
        mesh: &mesh,
    };
    let graph = whole(design);
    let request = Request::default();
    let built = engine.build(&request, &graph, &CancelToken::default(), &mut |_| {});
    assert!(built.succeeded(), "{:#?}", built.diagnostics);
    let short = |digest: Option<Digest>| digest.expect("it is built").to_hex()[..16].to_owned();
    let plan = engine.plan(&request, &graph);
    let stages = plan.stages.into_iter();
    stages
        .map(|stage| {
            let name = stage.instance.to_string();
            (name, [short(stage.key), short(stage.result)])
        })
        .collect()
}

fn parse(text: &str) -> Results {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines
        .filter_map(|line| {
            let (name, digests) = line.split_once(": ")?;
            let (key, result) = digests.split_once(' ')?;
            Some((name.to_owned(), [key.to_owned(), result.to_owned()]))
        })
        .collect()
}

#[test]
fn a_stage_whose_results_change_has_another_version() {
    let golden = fs::read_to_string(root(GOLDEN)).unwrap_or_default();
    let (before, now) = (parse(&golden), results());
    let unversioned: Vec<&String> = now
        .iter()
        .filter(|(name, [key, result])| {
            let old = before.get(*name);
            old.is_some_and(|[old_key, old]| old_key == key && old != result)
        })
        .map(|(name, _)| name)
        .collect();
    assert!(
        unversioned.is_empty(),
        "these give other results for the same key; raise the `version` of their stages: \
         {unversioned:#?}"
    );
    let mut text = String::from("# instance: key result. Written by EGG_BLESS=1.\n");
    for (name, [key, result]) in &now {
        let _ = writeln!(text, "{name}: {key} {result}");
    }
    if golden.replace("\r\n", "\n") != text {
        assert!(
            std::env::var_os("EGG_BLESS").is_some_and(|value| !value.is_empty()),
            "{GOLDEN} is out of date; `EGG_BLESS=1 cargo test --test program versions` writes it"
        );
        fs::write(root(GOLDEN), text).expect("a golden file");
    }
}
