//! Commands, streams and exit codes.

use crate::program::{Workshop, files};
use crate::{JUNCTION, read, with_junction};
use std::process::Stdio;

fn records(text: &str) -> Vec<serde_json::Value> {
    let parsed = text.lines().map(serde_json::from_str);
    parsed.collect::<Result<_, _>>().expect("a record a line")
}

#[test]
fn a_new_project_checks_builds_and_exports_as_it_is() {
    let shop = Workshop::new();
    let made = shop.egg(&["init", "mydome"]).expect(0);
    assert_eq!(made.out, "");
    let text = std::fs::read_to_string(shop.path("mydome/mydome.toml")).expect("a project");
    assert!(text.lines().filter(|line| line.contains('#')).count() > 10);
    let again = shop.egg(&["init", "mydome"]).expect(2);
    assert!(again.err.starts_with("error: "), "{}", again.err);

    let inside = |arguments: &[&str]| {
        let mut command = shop.command(arguments);
        command.current_dir(shop.path("mydome"));
        crate::program::Ran::of(&command.output().expect("the program runs"))
    };
    inside(&["check", "--quiet"]).expect(0);
    let built = inside(&["build"]).expect(0);
    assert!(built.err.contains("Finished mydome"), "{}", built.err);
    let made = files(&shop.path("mydome/build/mydome"));
    for name in [
        "plan.ron",
        "bom.csv",
        "cutlist.csv",
        "crossings.csv",
        "layout/from-above.svg",
    ] {
        assert!(made.contains_key(name), "{name} in {:?}", made.keys());
    }
    for (folder, extension) in [
        ("cladding/", ".ron"),
        ("cladding/", ".svg"),
        ("layout/", ".dxf"),
        ("fabrication/", ".dxf"),
        ("fabrication/", ".svg"),
    ] {
        let is_one = |name: &&String| name.starts_with(folder) && name.ends_with(extension);
        assert!(
            made.keys().any(|name| is_one(&name)),
            "{folder}*{extension}"
        );
    }
    let exported = inside(&["export", "--format", "json"]).expect(0);
    let plan: serde_json::Value = serde_json::from_str(&exported.out).expect("JSON");
    assert_eq!(plan["name"], "mydome");
}

#[test]
fn exit_codes_tell_a_wrong_project_from_wrong_usage() {
    let shop = with_junction();
    shop.egg(&["check", "junction.toml", "--quiet"]).expect(0);
    shop.write("wrong.toml", read(JUNCTION).replace("limewood", "limwood"));
    let wrong = shop.egg(&["check", "wrong.toml"]).expect(1);
    assert!(wrong.err.contains("limewood"), "{}", wrong.err);
    for usage in [
        &["check", "nowhere.toml"][..],
        &["check", "vault.obj"],
        &["check", "."],
        &["bild"],
        &["build", "--jobs", "0"],
        &["explain", "E9999"],
        &["build", "junction.toml", "--only", "nobody"],
        &["build", "junction.toml", "--stage", "nothing"],
        &["explain", "junction.toml", "nothing.dxf"],
        &["schema", "everything"],
        // Two project files, and none is named.
        &["build"],
    ] {
        let ran = shop.egg(usage).expect(2);
        assert_eq!(ran.out, "", "{usage:?}");
        assert!(ran.err.contains("error"), "{usage:?}: {}", ran.err);
    }
}

#[test]
fn results_go_to_one_stream_and_messages_to_the_other() {
    let shop = with_junction();
    let exported = shop.egg(&["export", "junction.toml"]).expect(0);
    serde_json::from_str::<serde_json::Value>(&exported.out).expect("JSON alone");
    let built = shop.egg(&["build", "junction.toml"]).expect(0);
    assert_eq!(built.out, "");
    let told: Vec<&str> = built.err.lines().map(str::trim_start).collect();
    let [nested, finished] = told[..] else {
        panic!("{}", built.err);
    };
    assert!(nested.starts_with("Nested ") && finished.starts_with("Finished "));
    let quiet = shop.egg(&["build", "junction.toml", "--quiet"]).expect(0);
    assert_eq!((quiet.out, quiet.err), (String::new(), String::new()));
    for always in ["materials", "help"] {
        assert_eq!(shop.egg(&[always]).expect(0).err, "");
    }
    for of in ["project", "plan"] {
        let schema = shop.egg(&["schema", of]).expect(0).out;
        let schema: serde_json::Value = serde_json::from_str(&schema).expect("JSON");
        assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let completions = shop.egg(&["completions", shell]).expect(0).out;
        assert!(completions.contains("materials"), "{shell}");
    }
}

#[test]
fn programs_get_a_record_a_line() {
    let shop = with_junction();
    let json = ["--message-format", "json"];
    let built = shop.egg(&[&["build", "junction.toml"], &json[..]].concat());
    let built = built.expect(0);
    assert_eq!(built.err, "");
    let told = records(&built.out);
    let last = told.last().expect("a summary");
    assert_eq!(last["reason"], "build-finished");
    assert_eq!(last["success"], true);
    let nested = told
        .iter()
        .filter(|told| told["reason"] == "nested")
        .count() as u64;
    assert_eq!(nested, 1, "one material and thickness");
    assert_eq!(
        told.len() as u64,
        last["stages"].as_u64().expect("a count") + nested + 1
    );

    shop.write(
        "wrong.toml",
        read(JUNCTION).replace("width = 10", "width = \"10 kg\""),
    );
    let wrong = shop.egg(&[&["check", "wrong.toml"], &json[..]].concat());
    let told = records(&wrong.expect(1).out);
    assert_eq!(told[0]["reason"], "diagnostic");
    let text = told[0].to_string();
    assert!(text.contains("10 kg") || text.contains("kg"), "{text}");
}

#[test]
fn colour_comes_when_it_is_asked_for() {
    let shop = with_junction();
    let coloured = |arguments: &[&str], set: Option<&str>| {
        let mut command = shop.command(arguments);
        if let Some(name) = set {
            command.env(name, "1");
        }
        let output = command.output().expect("the program runs");
        crate::program::Ran::of(&output)
            .expect(0)
            .err
            .contains('\u{1b}')
    };
    let check = ["check", "junction.toml"];
    assert!(!coloured(&check, None), "no terminal");
    assert!(coloured(&check, Some("FORCE_COLOR")));
    assert!(coloured(
        &[&check[..], &["--color", "always"]].concat(),
        Some("NO_COLOR")
    ));
    assert!(!coloured(
        &[&check[..], &["--color", "never"]].concat(),
        Some("FORCE_COLOR")
    ));
}

#[test]
fn a_reader_that_stops_reading_is_no_error() {
    let shop = with_junction();
    let mut child = shop
        .command(&["schema", "plan"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success());
    assert_eq!(output.stderr, b"");
}

#[test]
fn the_cache_lies_where_it_is_told() {
    let shop = with_junction();
    let build = |arguments: &[&str], variable: Option<&str>, config: &str| {
        let config = if config.is_empty() {
            String::new()
        } else {
            format!("[cache]\ndirectory = {:?}\n", shop.path(config))
        };
        shop.write("config/egg/config.toml", config);
        let mut command = shop.command(&[&["cache", "status"], arguments].concat());
        command
            .env_remove("EGG_CACHE_DIR")
            .env("XDG_CONFIG_HOME", shop.path("config"))
            .env("XDG_CACHE_HOME", shop.path("habit"))
            .env("HOME", shop.path("home"));
        if let Some(name) = variable {
            command.env("EGG_CACHE_DIR", shop.path(name));
        }
        let output = command.output().expect("the program runs");
        let text = crate::program::Ran::of(&output).expect(0).out;
        text.lines().next().unwrap_or_default().to_owned()
    };
    let is_in = |line: String, name: &str| {
        let wanted = shop.path(name);
        assert!(
            line.starts_with(&*wanted.to_string_lossy()),
            "{line}, not {name}"
        );
    };
    let option = shop.path("option");
    let option = ["--cache-dir", &option.to_string_lossy()];
    is_in(build(&option, Some("variable"), "configured"), "option");
    is_in(build(&[], Some("variable"), "configured"), "variable");
    is_in(build(&[], None, "configured"), "configured");
    if cfg!(target_os = "linux") {
        is_in(build(&[], None, ""), "habit");
    }
}

#[test]
fn a_configuration_that_is_not_understood_is_wrong_usage() {
    let shop = with_junction();
    shop.write(
        "config/egg/config.toml",
        "[cache]\nmax_size = 100\nmax_sise = 10\n",
    );
    let mut command = shop.command(&["check", "junction.toml"]);
    for (name, place) in [
        ("XDG_CONFIG_HOME", "config"),
        ("APPDATA", "config"),
        ("HOME", "home"),
    ] {
        command.env(name, shop.path(place));
    }
    let output = command.output().expect("the program runs");
    if cfg!(target_os = "linux") {
        let ran = crate::program::Ran::of(&output).expect(2);
        assert!(ran.err.contains("config.toml:3"), "{}", ran.err);
        assert!(ran.err.contains("max_sise"), "{}", ran.err);
    }
}

#[test]
fn an_output_leads_back_to_the_lines_it_is_made_from() {
    let shop = with_junction();
    shop.egg(&["build", "junction.toml"]).expect(0);
    shop.write(
        "junction.toml",
        read(JUNCTION).replace("e = [-300", "e = [-290"),
    );
    let explain = ["explain", "junction.toml", "cladding/north-west.svg"];
    let told = shop.egg(&explain).expect(0).out;
    assert!(told.contains("it will be made again because"), "{told}");
    let line = read(JUNCTION).lines().position(|l| l.starts_with("e = "));
    let place = format!("junction.toml:{}", line.expect("a point") + 1);
    let (causes, made_from) = told.split_once("it is made from").expect("both");
    assert!(causes.contains(&place), "{told}");
    assert!(
        made_from.contains(&format!("{place}  e = [-290, 350]")),
        "{told}"
    );
    // The size of sheets has no part in it.
    assert!(!made_from.contains("stock"), "{told}");
}

#[test]
fn what_the_cache_has_from_elsewhere_is_not_said_to_be_made_again() {
    let shop = with_junction();
    shop.egg(&["build", "junction.toml"]).expect(0);
    for name in ["junction.toml", "vault.obj"] {
        let bytes = std::fs::read(shop.path(name)).expect("a file");
        shop.write(&format!("elsewhere/{name}"), bytes);
    }
    let explain = ["explain", "elsewhere/junction.toml", "cladding south"];
    let told = shop.egg(&explain).expect(0).out;
    assert!(told.starts_with("cladding south is cached\n"), "{told}");
    assert!(
        told.contains("the next build takes it from the cache because"),
        "{told}"
    );
}

#[test]
fn splitting_keeps_the_words_of_what_it_does_not_change() {
    let shop = with_junction();
    let text = read(JUNCTION);
    let point = text.lines().find(|line| line.starts_with("e = [-300, "));
    let (_, y) = point
        .expect("a point")
        .split_once(", ")
        .expect("two numbers");
    let said = format!("e = [\"-30 cm\", {y}");
    shop.write(
        "junction.toml",
        text.replace(point.expect("a point"), &said),
    );
    let split = shop.egg(&["split", "junction.toml"]).expect(0);
    assert!(split.out.contains(&format!("{said}\n")), "{}", split.out);
    assert!(
        split.err.contains("no patch has to be split"),
        "{}",
        split.err
    );
}

#[test]
fn a_part_of_the_graph_is_built_alone() {
    let shop = with_junction();
    let build = [
        "build",
        "junction.toml",
        "--only",
        "south",
        "--stage",
        "cladding",
    ];
    let told = shop
        .egg(&[&build[..], &["--message-format", "json"]].concat())
        .expect(0);
    let told = records(&told.out);
    let ran: Vec<&str> = told
        .iter()
        .filter(|record| record["stage"] == "cladding")
        .filter_map(|record| record["target"].as_str())
        .collect();
    assert_eq!(ran, ["south"]);
    assert!(told.iter().all(|record| record["stage"] != "members"));
}
