//! Stages that misbehave, and builds that are stopped.

use crate::project::Design;
use crate::workshop::{Workshop, ran};
use egg::build::{
    Attempt, Built, CancelToken, Event, Failure, Graph, How, Node, Numerics, Request, Stage, canon,
};
use egg::diagnostics::{Code, Diagnostic, Warned};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::time::Duration;

fn build(workshop: &Workshop, declare: &dyn Fn(&mut Graph<'_>)) -> Built {
    let request = Request::default();
    workshop
        .engine()
        .build(&request, declare, &CancelToken::default(), &mut |_| {})
}

fn how(built: &Built) -> Vec<How> {
    built.stages.iter().map(|stage| stage.how).collect()
}

#[allow(clippy::unnecessary_wraps, reason = "it ends stages, which can fail")]
fn plain<T>(value: T) -> Result<Warned<T>, Failure> {
    Ok(Warned {
        value,
        warnings: vec![],
    })
}

const DOUBLE: Stage<(), Node<u32>, u32> = Stage {
    name: "double",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), value, _| plain(2 * value),
};

const TRY: Stage<(), Attempt<u32>, String> = Stage {
    name: "try",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), value, _| plain(format!("{value:?}")),
};

const FAIL: Stage<u32, (), u32> = Stage {
    name: "fail",
    version: 1,
    numerics: Numerics::Portable,
    run: |value, (), _| match value {
        0 => plain(7),
        1 => Err(Diagnostic::error(Code::new("E0999"), "for good").into()),
        2 => Err(Failure::Passing(vec![Diagnostic::error(
            Code::new("E0999"),
            "for now",
        )])),
        3 => panic!("on purpose"),
        4 => Err(Failure::Cancelled),
        _ => Err(Failure::Errors(vec![])),
    },
};

#[test]
fn every_way_to_fail_skips_what_depends_on_it_and_nothing_else() {
    let expected = [
        (
            0,
            [How::Ran, How::Ran, How::Ran],
            [How::Cached, How::Cached, How::Cached],
        ),
        (
            1,
            [How::Failed, How::Skipped, How::Ran],
            [How::FailedCached, How::Skipped, How::Cached],
        ),
        (
            2,
            [How::Failed, How::Skipped, How::Skipped],
            [How::Failed, How::Skipped, How::Skipped],
        ),
        (
            3,
            [How::Failed, How::Skipped, How::Skipped],
            [How::Failed, How::Skipped, How::Skipped],
        ),
        (
            4,
            [How::Failed, How::Skipped, How::Skipped],
            [How::Failed, How::Skipped, How::Skipped],
        ),
        (
            5,
            [How::Failed, How::Skipped, How::Ran],
            [How::FailedCached, How::Skipped, How::Cached],
        ),
    ];
    for (way, first, second) in expected {
        let workshop = Workshop::new();
        let declare = |g: &mut Graph<'_>| {
            let value = g.add(&FAIL, "", way, ());
            g.add(&DOUBLE, "", (), value);
            g.add(&TRY, "", (), value.attempt());
        };
        let built = build(&workshop, &declare);
        assert_eq!(how(&built), first, "{way}");
        assert_eq!(
            built.diagnostics.is_empty(),
            way == 0,
            "no failure is silent"
        );
        assert_eq!(how(&build(&workshop, &declare)), second, "{way}");
    }
}

#[test]
fn a_panic_is_told_as_a_defect_with_the_stage() {
    let workshop = Workshop::new();
    let built = build(&workshop, &|g| {
        g.add(&FAIL, "west", 3, ());
    });
    let told = &built.diagnostics[0];
    assert_eq!(told.code.as_str(), "E0801");
    assert_eq!(told.message, "`fail west` broke down: on purpose");
}

#[test]
fn an_attempt_sees_the_value_or_nothing() {
    let workshop = Workshop::new();
    for (way, text) in [(0, "Some(7)"), (1, "None")] {
        let built = build(&workshop, &|g| {
            let value = g.add(&FAIL, "", way, ());
            g.add(&TRY, "", (), value.attempt());
        });
        assert_eq!(*built.output(&TRY, "").expect("tried"), text);
    }
}

#[test]
fn an_input_without_a_key_is_told_and_not_run() {
    const NAN: Stage<Vec<f64>, (), f64> = Stage {
        name: "nan",
        version: 1,
        numerics: Numerics::Portable,
        run: |_, (), _| plain(1.0),
    };
    let workshop = Workshop::new();
    let built = build(&workshop, &|g| {
        g.add(&NAN, "", vec![1.0, f64::NAN], ());
    });
    assert_eq!(
        built.diagnostics[0].message,
        "the input of `nan` has no key: `[1]`: not a number"
    );
    assert_eq!(how(&built), [How::Failed]);
}

#[test]
fn a_result_that_cannot_be_read_back_is_told_at_once() {
    #[derive(serde::Serialize, serde::Deserialize)]
    struct Gappy {
        #[serde(skip_serializing_if = "Option::is_none", default)]
        first: Option<u32>,
        second: u32,
    }
    const GAPPY: Stage<(), (), Gappy> = Stage {
        name: "gappy",
        version: 1,
        numerics: Numerics::Portable,
        run: |(), (), _| {
            plain(Gappy {
                first: None,
                second: 7,
            })
        },
    };
    let workshop = Workshop::new();
    let built = build(&workshop, &|g| {
        g.add(&GAPPY, "", (), ());
    });
    assert_eq!(built.diagnostics[0].code.as_str(), "E0804");
}

#[test]
fn a_name_that_is_declared_twice_is_told() {
    let workshop = Workshop::new();
    let built = build(&workshop, &|g| {
        g.add(&FAIL, "west", 0, ());
        g.add(&FAIL, "west", 1, ());
    });
    assert_eq!(built.diagnostics[0].code.as_str(), "E0803");
    assert_eq!(how(&built), [How::Ran, How::Failed]);
}

#[test]
fn instances_with_one_key_run_once() {
    static RUNS: AtomicU32 = AtomicU32::new(0);
    const COUNTED: Stage<u32, (), Vec<u32>> = Stage {
        name: "counted",
        version: 1,
        numerics: Numerics::Portable,
        run: |value, (), _| {
            RUNS.fetch_add(1, Ordering::SeqCst);
            std::thread::sleep(Duration::from_millis(20));
            plain(vec![*value; 1000])
        },
    };
    const LENGTH: Stage<(), Vec<Node<Vec<u32>>>, usize> = Stage {
        name: "length",
        version: 1,
        numerics: Numerics::Portable,
        run: |(), all, _| plain(all.iter().map(|one| one.len()).sum()),
    };
    let mut workshop = Workshop::new();
    // Without a cache the value of the one has to reach the others.
    workshop.settings.cache = "/proc/egg".into();
    let declare = |g: &mut Graph<'_>| {
        let twins = ["a", "b", "c"].map(|name| g.add(&COUNTED, name, 5, ()));
        g.add(&LENGTH, "", (), twins.to_vec());
    };
    let built = build(&workshop, &declare);
    assert_eq!(RUNS.load(Ordering::SeqCst), 1);
    assert_eq!(built.output(&LENGTH, "").as_deref(), Some(&3000));
    let codes: Vec<_> = built
        .diagnostics
        .iter()
        .map(|told| told.code.as_str())
        .collect();
    assert_eq!(codes, ["W0802"]);
}

#[test]
fn spreading_dependencies_differently_gives_another_key() {
    type Nodes = Vec<Node<u32>>;
    const SPREAD: Stage<(), (Nodes, Nodes), Vec<usize>> = Stage {
        name: "spread",
        version: 1,
        numerics: Numerics::Portable,
        run: |(), (one, two), _| plain(vec![one.len(), two.len()]),
    };
    let workshop = Workshop::new();
    for split in 0..=3 {
        let built = build(&workshop, &|g| {
            let nodes: Vec<_> = (0..3).map(|i| g.add(&FAIL, i.to_string(), 0, ())).collect();
            let (one, two) = nodes.split_at(split);
            g.add(&SPREAD, "", (), (one.to_vec(), two.to_vec()));
        });
        assert_eq!(
            *built.output(&SPREAD, "").expect("built"),
            [split, 3 - split]
        );
    }
}

#[test]
fn a_graph_unfolds_in_several_steps() {
    const LIST: Stage<u32, (), Vec<u32>> = Stage {
        name: "list",
        version: 1,
        numerics: Numerics::Portable,
        // The longer list is known first.
        run: |count, (), _| {
            while *count == 1 && !LONGER.load(Ordering::SeqCst) {
                std::thread::yield_now();
            }
            std::thread::sleep(Duration::from_millis(if *count == 1 { 50 } else { 0 }));
            LONGER.fetch_or(*count == 2, Ordering::SeqCst);
            plain((0..*count).collect())
        },
    };
    static LONGER: AtomicBool = AtomicBool::new(false);
    let workshop = Workshop::new();
    let declare = |g: &mut Graph<'_>| {
        let outer = g.add(&LIST, "outer", 3, ());
        g.unfold(outer, |g, outer: &Vec<u32>| {
            for &count in outer {
                let inner = g.add(&LIST, format!("inner.{count}"), count, ());
                g.unfold(inner, move |g, inner: &Vec<u32>| {
                    for value in inner {
                        g.add(&FAIL, format!("{count}.{value}"), 0, ());
                    }
                });
            }
        });
    };
    let built = build(&workshop, &declare);
    let names: Vec<_> = built
        .stages
        .iter()
        .map(|one| one.instance.to_string())
        .collect();
    assert_eq!(
        names,
        [
            "list outer",
            "list inner.0",
            "list inner.1",
            "list inner.2",
            "fail 1.0",
            "fail 2.0",
            "fail 2.1"
        ]
    );
    assert_eq!(build(&workshop, &declare).count(How::Cached), 7);
}

#[test]
fn a_result_that_cannot_be_repeated_is_told_and_what_depends_on_it_follows() {
    static CALLS: AtomicU32 = AtomicU32::new(0);
    /// Gives 1 in the first call, 2 ever after.
    const MOODY: Stage<(), (), Vec<u32>> = Stage {
        name: "moody",
        version: 1,
        numerics: Numerics::Portable,
        run: |(), (), _| {
            let call = CALLS.fetch_add(1, Ordering::SeqCst);
            plain(vec![call.min(1) + 1; 5000])
        },
    };
    const FIRST: Stage<u32, Node<Vec<u32>>, u32> = Stage {
        name: "first",
        version: 1,
        numerics: Numerics::Portable,
        run: |_, values, _| plain(values[0]),
    };
    let workshop = Workshop::new();
    let declare = |g: &mut Graph<'_>, input: u32| {
        let moody = g.add(&MOODY, "", (), ());
        g.add(&FIRST, "kept", 0, moody);
        g.add(&FIRST, "edited", input, moody);
    };
    let built = build(&workshop, &|g| declare(g, 0));
    assert_eq!(built.output(&FIRST, "kept").as_deref(), Some(&1));
    // The value is lost, and the edited instance needs it.
    std::fs::remove_dir_all(workshop.settings.cache.join("v1/blobs")).expect("removed");
    let built = build(&workshop, &|g| declare(g, 1));
    assert_eq!(built.output(&FIRST, "edited").as_deref(), Some(&2));
    assert_eq!(
        built.output(&FIRST, "kept").as_deref(),
        Some(&2),
        "no two results of one input in one build"
    );
    let codes: Vec<_> = built
        .diagnostics
        .iter()
        .map(|told| told.code.as_str())
        .collect();
    assert_eq!(codes, ["W0803"]);
}

#[test]
fn a_result_that_never_repeats_ends_the_build() {
    static CALLS: AtomicU32 = AtomicU32::new(0);
    const COUNTER: Stage<(), (), Vec<u32>> = Stage {
        name: "counter",
        version: 1,
        numerics: Numerics::Portable,
        run: |(), (), _| plain(vec![CALLS.fetch_add(1, Ordering::SeqCst); 5000]),
    };
    const LENGTH: Stage<u32, Node<Vec<u32>>, usize> = Stage {
        name: "length",
        version: 1,
        numerics: Numerics::Portable,
        run: |_, values, _| plain(values.len()),
    };
    let workshop = Workshop::new();
    let declare = |g: &mut Graph<'_>, input: u32| {
        let counter = g.add(&COUNTER, "", (), ());
        g.add(&LENGTH, "", input, counter);
    };
    build(&workshop, &|g| declare(g, 0));
    let blobs = workshop.settings.cache.join("v1/blobs");
    for input in 1..4 {
        std::fs::remove_dir_all(&blobs).expect("removed");
        let built = build(&workshop, &|g| declare(g, input));
        assert!(
            built
                .diagnostics
                .iter()
                .any(|told| told.code.as_str() == "W0803")
        );
        assert_eq!(built.output(&LENGTH, "").as_deref(), Some(&5000));
    }
}

#[test]
fn stopping_keeps_what_is_finished_and_publishes_nothing() {
    let workshop = Workshop::new();
    let mut design = Design::with_patches(6);
    workshop.build(&design);
    let before = workshop.outputs();
    design.mesh[0] = 3.0;
    design.millis = 40;
    let cancel = CancelToken::default();
    let stop = cancel.clone();
    let mut finished = 0;
    let built = workshop.engine().build(
        &Request::default(),
        &|g| design.declare(g),
        &cancel,
        &mut |event| {
            if let Event::Finished { instance, .. } = event
                && instance.stage == "maps"
            {
                finished += 1;
                if finished == 2 {
                    stop.cancel();
                }
            }
        },
    );
    assert!(built.cancelled);
    assert!(!built.succeeded());
    assert!(built.count(How::Stopped) > 0);
    assert_eq!(workshop.outputs(), before);
    let kept = ran(&built);
    assert!(kept.len() >= 4, "{kept:?}");
    let again = workshop.build(&design);
    assert!(again.succeeded());
    assert!(
        ran(&again).iter().all(|stage| !kept.contains(stage)),
        "nothing finished is lost"
    );
}

#[test]
fn events_tell_every_run_with_its_progress_and_the_time_left() {
    let workshop = Workshop::new();
    let mut design = Design {
        millis: 150,
        ..Design::default()
    };
    workshop.build(&design);
    design.mesh[0] = 9.0;
    let (mut started, mut ended, mut progress, mut times) = (0, 0, 0, Vec::new());
    workshop.engine().build(
        &Request::default(),
        &|g| design.declare(g),
        &CancelToken::default(),
        &mut |event| match event {
            Event::Planned { tally } => times.push(tally.remaining),
            Event::Started { .. } => started += 1,
            Event::Progress { done, total, .. } => {
                assert!(done < total);
                progress += 1;
            }
            Event::Finished { tally, how, .. } => {
                assert_ne!(how, How::Stopped);
                times.push(tally.remaining);
                ended += 1;
            }
            Event::Waiting { .. } => panic!("there is nobody to wait for"),
        },
    );
    assert_eq!(
        started, 20,
        "all but the bill of materials, whose numbers round to the same"
    );
    assert_eq!(ended, 21);
    assert!(progress > 2, "{progress}");
    let seconds = |index: usize| {
        times[index]
            .expect("known from the first build")
            .as_secs_f64()
    };
    assert!(
        seconds(0) > 0.2,
        "three times 150 ms by two: {}",
        seconds(0)
    );
    assert_eq!(
        times.last().copied().flatten().map(|left| left.as_secs()),
        Some(0)
    );
}

#[test]
fn hash_maps_have_no_key() {
    let map: std::collections::HashMap<u32, u32> = (0..64).map(|i| (i, i)).collect();
    assert!(canon::encode(&map, &mut Vec::new()).is_err());
}

#[test]
fn parallel_loops_inside_stages_share_the_threads_of_the_build() {
    use rayon::prelude::*;
    const LOOP: Stage<u32, (), Vec<u64>> = Stage {
        name: "loop",
        version: 1,
        numerics: Numerics::Portable,
        run: |seed, (), _| {
            assert_eq!(rayon::current_num_threads(), 2);
            let inner = |i: u64| (0..200_u64).into_par_iter().map(|j| i ^ j).sum::<u64>();
            plain(
                (0..200)
                    .into_par_iter()
                    .map(|i| inner(i + u64::from(*seed)))
                    .collect(),
            )
        },
    };
    let workshop = Workshop::new();
    let built = build(&workshop, &|g| {
        for seed in 0..40 {
            g.add(&LOOP, seed.to_string(), seed, ());
        }
    });
    assert_eq!(built.count(How::Ran), 40, "{:?}", built.diagnostics);
}
