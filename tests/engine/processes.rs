//! Several processes on one cache: killed at any moment, working side by side.
//!
//! A child process is this test program itself, told by its environment to run one build.

use crate::project::Design;
use crate::workshop::{Workshop, clean, files};
use egg::build::{CancelToken, Engine, Event, How, MANIFEST, Request, Settings};
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const CACHE: &str = "EGG_TEST_CACHE";
const OUTPUT: &str = "EGG_TEST_OUTPUT";
const DESIGN: &str = "EGG_TEST_DESIGN";

/// What a child does: one build, with a line for every event that the tests want to know.
#[test]
fn the_child_process_builds_what_it_is_told() {
    let Some(cache) = std::env::var_os(CACHE) else {
        return;
    };
    let output = std::env::var_os(OUTPUT).expect("told");
    let design = std::env::var(DESIGN).expect("told");
    let design: Design = ron::from_str(&design).expect("a design");
    let mut settings = Settings::new(cache, output);
    settings.jobs = 2;
    let built = Engine::open(settings).build(
        &Request::default(),
        &|g| design.declare(g),
        &CancelToken::default(),
        &mut |event| match event {
            Event::Started { instance, .. } => println!("\nstarted {instance}"),
            Event::Finished {
                instance,
                how: How::Ran,
                ..
            } => println!("\nran {instance}"),
            Event::Waiting {
                instance,
                process: Some(process),
                ..
            } => println!("\nwaiting {process} {instance}"),
            _ => {}
        },
    );
    for told in &built.diagnostics {
        println!("\ntold {}", told.code);
    }
    println!("\nsucceeded {}", built.succeeded());
}

fn child(cache: &Path, output: &Path, design: &Design) -> Command {
    let program = std::env::current_exe().expect("this program");
    let mut command = Command::new(program);
    command
        .args(["--exact", "--nocapture"])
        .arg("processes::the_child_process_builds_what_it_is_told")
        .env(CACHE, cache)
        .env(OUTPUT, output)
        .env(DESIGN, ron::to_string(design).expect("plain data"))
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    command
}

fn start(cache: &Path, output: &Path, design: &Design) -> Child {
    child(cache, output, design).spawn().expect("started")
}

/// Reads what a child says until it has said `count` lines that begin with `word`.
fn await_lines(child: &mut Child, word: &str, count: usize) -> String {
    let mut heard = String::new();
    let mut said = 0;
    let mut stdout = child.stdout.take().expect("piped");
    let mut byte = [0];
    // Byte by byte: what comes after is left for whoever reads on.
    while said < count && stdout.read(&mut byte).expect("readable") == 1 {
        heard.push(char::from(byte[0]));
        if byte == *b"\n" {
            said = heard.lines().filter(|line| line.starts_with(word)).count();
        }
    }
    assert_eq!(said, count, "{heard}");
    child.stdout = Some(stdout);
    heard
}

/// The lines of a finished child that begin with `word`, without it.
fn lines(output: &Output, word: &str) -> Vec<String> {
    let text = String::from_utf8_lossy(&output.stdout);
    let lines = text.lines().filter_map(|line| line.strip_prefix(word));
    lines.map(|line| line.trim().to_owned()).collect()
}

/// A number that looks random and is the same in every run.
fn scattered(seed: u64) -> u64 {
    seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 33
}

#[test]
fn killed_at_any_moment_nothing_is_lost_and_nothing_lies() {
    let workshop = Workshop::new();
    let settings = &workshop.settings;
    let mut designs = [Design::with_patches(4), Design::with_patches(4)];
    designs[0].millis = 2;
    designs[1].millis = 2;
    designs[1].mesh[5] = 77.0;
    designs[1].patches.remove(2);
    designs[1].width = 0.05;
    let expected = designs.clone().map(|design| clean(&design));

    // How long a whole build takes, process and all.
    let begin = Instant::now();
    let whole = start(&settings.cache, &settings.output, &designs[0]);
    assert_eq!(
        lines(&whole.wait_with_output().expect("ran"), "succeeded"),
        ["true"]
    );
    let mut span = begin.elapsed().as_micros().min(2_000_000) as u64;

    let mut unharmed = 0;
    for round in 0..200 {
        if round % 20 == 0 {
            // From nothing again, so that every moment of a cold build is met as well.
            std::fs::remove_dir_all(&settings.cache).ok();
        }
        let which = round as usize % 2;
        let mut child = start(&settings.cache, &settings.output, &designs[which]);
        std::thread::sleep(Duration::from_micros(scattered(round) % span));
        child.kill().expect("killed");
        let end = child.wait_with_output().expect("ended");
        // The machine may have more or less to do by now: three of four are to be hit.
        if end.status.success() {
            unharmed += 1;
            span -= span / 10;
        } else {
            span += span / 30;
        }
        // No published file is ever half written: each has the bytes of one design or the other.
        for (name, bytes) in files(&settings.output) {
            let whole = expected.iter().any(|all| all.get(&name) == Some(&bytes));
            let ours = name == MANIFEST || name.contains(".egg-tmp-");
            assert!(whole || ours, "round {round}: {name}");
        }
        if round % 10 == 9 {
            let built = workshop.build(&designs[which]);
            assert!(built.succeeded(), "round {round}: {:?}", built.diagnostics);
            assert!(built.diagnostics.is_empty(), "{:?}", built.diagnostics);
            assert_eq!(workshop.outputs(), expected[which], "round {round}");
            let verified = workshop.engine().store().verify(egg::build::Mode::DryRun);
            assert!(verified.damaged.is_empty(), "{:?}", verified.damaged);
        }
    }
    assert!(
        unharmed < 150,
        "most were killed while they worked: {unharmed}"
    );
    for (design, expected) in designs.iter().zip(&expected) {
        assert!(workshop.build(design).succeeded());
        if design.patches.len() == 3 {
            assert_eq!(&workshop.outputs(), expected, "nothing temporary is left");
        }
    }
}

#[test]
fn builds_at_once_share_the_work_and_agree() {
    for count in [2, 4] {
        let workshop = Workshop::new();
        let mut design = Design::with_patches(3);
        design.millis = 1000;
        let outputs: Vec<_> = (0..count)
            .map(|index| workshop.path().join(format!("out{index}")))
            .collect();
        let begin = |output| start(&workshop.settings.cache, output, &design);
        let mut first = begin(&outputs[0]);
        await_lines(&mut first, "started maps", 1);
        let mut children = vec![first];
        children.extend(outputs[1..].iter().map(|output| begin(output)));
        let ids: Vec<String> = children
            .iter()
            .map(|child| child.id().to_string())
            .collect();
        let ended: Vec<Output> = children
            .into_iter()
            .map(|child| child.wait_with_output().expect("ran"))
            .collect();
        let mut heavy: Vec<String> = Vec::new();
        let mut waited = Vec::new();
        for end in &ended {
            assert_eq!(lines(end, "succeeded"), ["true"]);
            assert!(lines(end, "told").is_empty());
            heavy.extend(
                lines(end, "ran")
                    .into_iter()
                    .filter(|name| name.starts_with("maps")),
            );
            waited.extend(lines(end, "waiting"));
        }
        heavy.sort();
        assert_eq!(
            heavy,
            ["maps p0", "maps p1", "maps p2"],
            "each once among {count}"
        );
        assert!(!waited.is_empty(), "somebody waited");
        for line in waited {
            let process = line.split(' ').next().unwrap_or_default().to_owned();
            assert!(ids.contains(&process), "{line} is none of {ids:?}");
        }
        let expected = clean(&design);
        for output in outputs {
            assert_eq!(files(&output), expected);
        }
    }
}

#[test]
fn builds_at_once_in_one_directory_leave_one_state() {
    let workshop = Workshop::new();
    let mut one = Design::with_patches(6);
    one.millis = 5;
    let mut two = one.clone();
    two.patches.truncate(3);
    two.mesh[0] = 8.0;
    let settings = &workshop.settings;
    for _ in 0..5 {
        let children =
            [&one, &two, &one, &two].map(|design| start(&settings.cache, &settings.output, design));
        for child in children {
            let end = child.wait_with_output().expect("ran");
            assert_eq!(lines(&end, "succeeded"), ["true"]);
        }
        let built = workshop.build(&two);
        assert!(built.succeeded(), "{:?}", built.diagnostics);
        assert_eq!(workshop.outputs(), clean(&two));
    }
}

#[test]
fn when_the_one_that_computes_is_killed_the_one_that_waits_goes_on() {
    let workshop = Workshop::new();
    let mut design = Design::with_patches(2);
    design.millis = 1500;
    let cache = &workshop.settings.cache;
    let mut first = start(cache, &workshop.path().join("first"), &design);
    await_lines(&mut first, "started maps", 2);
    let mut second = start(cache, &workshop.path().join("second"), &design);
    await_lines(&mut second, "waiting", 2);
    first.kill().expect("killed");
    first.wait().expect("ended");
    let end = second.wait_with_output().expect("ran");
    assert_eq!(lines(&end, "succeeded"), ["true"]);
    assert_eq!(files(&workshop.path().join("second")), clean(&design));
}

#[test]
fn patience_has_an_end() {
    let mut workshop = Workshop::new();
    let mut design = Design::with_patches(1);
    design.millis = 2000;
    let mut first = start(
        &workshop.settings.cache,
        &workshop.path().join("first"),
        &design,
    );
    await_lines(&mut first, "started maps", 1);
    workshop.settings.patience = Duration::from_millis(100);
    let mut waited = 0;
    let built = workshop.engine().build(
        &Request::default(),
        &|g| design.declare(g),
        &CancelToken::default(),
        &mut |event| waited += usize::from(matches!(event, Event::Waiting { .. })),
    );
    assert_eq!(waited, 1);
    assert!(built.succeeded());
    let maps = built
        .stages
        .iter()
        .find(|stage| stage.instance.stage == "maps");
    assert_eq!(maps.map(|stage| stage.how), Some(How::Ran));
    let end = first.wait_with_output().expect("ran");
    assert_eq!(lines(&end, "succeeded"), ["true"]);
}

#[test]
fn a_full_disk_stops_neither_the_build_nor_the_cache() {
    if !namespaces() {
        return;
    }
    let workshop = Workshop::new();
    let mut design = Design::with_patches(6);
    design.size = 20_000;
    let cache = workshop.path().join("small");
    let output = workshop.path().join("out");
    std::fs::create_dir(&cache).expect("made");
    // 400 kB for the cache, of 1.1 MB that the results take.
    let script = "mount -t tmpfs -o size=400k tmpfs \"$EGG_TEST_CACHE\" && \"$@\" && \"$@\"";
    let mut command = confined(script, &child(&cache, &output, &design));
    let end = command.output().expect("ran");
    assert_eq!(lines(&end, "succeeded"), ["true", "true"], "{end:?}");
    assert!(lines(&end, "told").iter().all(|code| code == "W0802"));
    assert!(!lines(&end, "told").is_empty());
    assert_eq!(files(&output), clean(&design));
}

#[test]
fn a_read_only_cache_is_read_and_left_alone() {
    if !namespaces() {
        return;
    }
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    design.patches[1].members = 9;
    let output = workshop.path().join("other");
    let cache = &workshop.settings.cache;
    let before = files(cache);
    let script = "mount --bind \"$EGG_TEST_CACHE\" \"$EGG_TEST_CACHE\" && \
                  mount -o remount,ro,bind \"$EGG_TEST_CACHE\" && \"$@\"";
    let mut command = confined(script, &child(cache, &output, &design));
    let end = command.output().expect("ran");
    assert_eq!(lines(&end, "succeeded"), ["true"], "{end:?}");
    assert_eq!(lines(&end, "told"), ["W0802"]);
    let ran = lines(&end, "ran");
    assert!(ran.contains(&"members p1".to_owned()));
    assert!(!ran.iter().any(|name| name.starts_with("maps")), "{ran:?}");
    assert_eq!(files(&output), clean(&design));
    assert_eq!(files(cache), before);
}

#[test]
fn a_full_output_directory_is_an_error_and_harms_no_file() {
    if !namespaces() {
        return;
    }
    let workshop = Workshop::new();
    let small = Design::with_patches(2);
    let mut large = Design::with_patches(2);
    large.mesh[1] = 7.0;
    large.patches[0].members = 2000;
    large.patches[1].members = 2000;
    let output = workshop.path().join("out");
    let kept = workshop.path().join("kept");
    std::fs::create_dir(&output).expect("made");
    let cache = &workshop.settings.cache;
    let first = child(cache, &output, &small);
    let script = "mount -t tmpfs -o size=64k tmpfs \"$EGG_TEST_OUTPUT\" && \"$@\" && \
                  EGG_TEST_DESIGN=\"$EGG_TEST_LARGE\" \"$@\" && \
                  cp -a \"$EGG_TEST_OUTPUT\" \"$EGG_TEST_KEPT\"";
    let mut command = confined(script, &first);
    command.env("EGG_TEST_KEPT", &kept);
    command.env(
        "EGG_TEST_LARGE",
        ron::to_string(&large).expect("plain data"),
    );
    let end = command.output().expect("ran");
    assert_eq!(lines(&end, "succeeded"), ["true", "false"], "{end:?}");
    assert!(lines(&end, "told").contains(&"E0814".to_owned()));
    let (small, large) = (clean(&small), clean(&large));
    for (name, bytes) in files(&kept) {
        let whole = small.get(&name) == Some(&bytes) || large.get(&name) == Some(&bytes);
        assert!(whole || name == MANIFEST, "{name} of {} bytes", bytes.len());
    }
}

/// A command in a mount namespace of its own, where `script` mounts what it likes and then runs
/// `"$@"`.
fn confined(script: &str, program: &Command) -> Command {
    let mut command = Command::new("unshare");
    command.args(["-rm", "sh", "-c", script, "sh"]);
    command.arg(program.get_program()).args(program.get_args());
    for (key, value) in program.get_envs() {
        command.env(key, value.expect("set"));
    }
    command
}

/// Whether this user can have a mount of its own. Where not, the tests above have nothing to
/// stand on; `faults` has their like with directories that cannot be written by anybody.
fn namespaces() -> bool {
    let tried = Command::new("unshare").args(["-rm", "true"]).output();
    tried.is_ok_and(|output| output.status.success())
}
