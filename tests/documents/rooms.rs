//! The rooms of the house stand in the order in which data passes them, and each does only what it
//! is for.

use crate::current;
use std::fs;
use std::path::PathBuf;

/// Rooms in the order of the data. `build` and `cli` come last: they know everything before them.
const ROOMS: [&str; 14] = [
    "diagnostics",
    "project",
    "surface",
    "geodesic",
    "layout",
    "cladding",
    "splitting",
    "members",
    "grid",
    "plan",
    "fabrication",
    "diff",
    "build",
    "cli",
];

/// Source files of a room without their tests, with their paths.
fn sources(room: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![current::path("src").join(room)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a room") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let text = fs::read_to_string(&path).expect("a source file");
                let code = text.split("#[cfg(test)]").next().unwrap_or("").to_owned();
                found.push((path, code));
            }
        }
    }
    found.sort();
    found
}

/// Lines of code, comments left out.
fn lines(code: &str) -> impl Iterator<Item = &str> {
    code.lines()
        .filter(|line| !line.trim_start().starts_with("//"))
}

fn rooms_on_disk() -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(current::path("src"))
        .expect("the sources")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_dir())
        .filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}

#[test]
fn a_room_knows_the_rooms_before_it_and_none_after() {
    let mut told = rooms_on_disk();
    let mut known = ROOMS.map(str::to_owned).to_vec();
    told.sort();
    known.sort();
    assert_eq!(told, known, "every room has its place in the order");
    let mut wrong = Vec::new();
    for (place, room) in ROOMS.iter().enumerate() {
        for (path, code) in sources(room) {
            for line in lines(&code) {
                for (later, _) in ROOMS.iter().enumerate().skip(place + 1) {
                    if line.contains(&format!("crate::{}::", ROOMS[later])) {
                        wrong.push(format!("{}: {}", path.display(), line.trim()));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn only_the_engine_and_the_command_line_touch_files_clocks_and_environment() {
    let mut wrong = Vec::new();
    for room in ROOMS {
        let forbidden: &[&str] = match room {
            "cli" => &[],
            "build" => &["env::var", "current_dir"],
            _ => &[
                "std::fs",
                "fs::read",
                "fs::write",
                "File::open",
                "File::create",
                "env::var",
                "current_dir",
                "SystemTime",
                "Instant::",
                "thread::current",
            ],
        };
        for (path, code) in sources(room) {
            for line in lines(&code) {
                if forbidden.iter().any(|word| line.contains(word)) {
                    wrong.push(format!("{}: {}", path.display(), line.trim()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn no_stage_is_given_the_whole_project() {
    for (path, code) in sources("build") {
        let is_stage = path.components().any(|part| part.as_os_str() == "stages");
        let sees = lines(&code).any(|line| {
            line.split(|c: char| !c.is_alphanumeric() && c != '_')
                .any(|word| word == "Project")
        });
        assert!(!(is_stage && sees), "{}", path.display());
    }
}

#[test]
fn the_page_on_the_architecture_has_every_room_and_every_stage() {
    let page = current::read("docs/architecture.md");
    for room in ROOMS {
        assert!(page.contains(&format!("`src/{room}/`")), "{room}");
    }
    let graph = current::read("src/build/graph/mod.rs");
    let mut stages = Vec::new();
    for (path, code) in sources("build") {
        if !path.components().any(|part| part.as_os_str() == "stages") {
            continue;
        }
        for line in lines(&code) {
            if let Some(name) = line.trim().strip_prefix("name: \"") {
                stages.push(name.trim_end_matches("\",").to_owned());
            }
        }
    }
    assert!(stages.len() > 15, "{stages:?}");
    for stage in stages {
        let row = format!("//! | `{stage}` |");
        let listed = graph.contains(&row) || stage.ends_with("-files") || stage == "plan-file";
        assert!(
            listed,
            "the table in src/build/graph/mod.rs lacks `{stage}`"
        );
    }
}
