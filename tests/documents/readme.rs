//! The README tells every command, and links of documents lead somewhere.

use crate::current;
use egg::project::{Notation, load};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// All Markdown files that belong to the project.
fn documents() -> Vec<PathBuf> {
    let mut found = vec![current::path("README.md"), current::path("CONTRIBUTING.md")];
    let mut folders = vec![
        current::path("docs"),
        current::path("projects"),
        current::path("fuzz"),
    ];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let built = path.ends_with("build") || path.ends_with("target");
            if path.is_dir() && !built {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

#[test]
fn links_of_documents_lead_somewhere() {
    let mut broken = Vec::new();
    for document in documents() {
        let text = fs::read_to_string(&document).expect("a document");
        let home = document.parent().expect("a folder");
        for target in targets(&text) {
            let (file, fragment) = target.split_once('#').unwrap_or((target, ""));
            let page = if file.is_empty() {
                document.clone()
            } else {
                home.join(file)
            };
            let stands = page.exists()
                && (fragment.is_empty() || fragments(&page).iter().any(|f| f == fragment));
            if !stands {
                broken.push(format!("{}: {target}", document.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn the_readme_has_every_command() {
    let help = Command::new(env!("CARGO_BIN_EXE_egg"))
        .arg("--help")
        .output()
        .expect("egg runs");
    let help = String::from_utf8(help.stdout).expect("help is text");
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.strip_prefix("  "))
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect();
    assert!(commands.contains(&"build"), "{help}");
    let readme = current::read("README.md");
    for name in commands {
        assert!(readme.contains(&format!("| `egg {name}")), "egg {name}");
    }
}

#[test]
fn the_example_of_the_readme_is_a_project() {
    let readme = current::read("README.md");
    let (_, after) = readme.split_once("```toml\n").expect("an example");
    let (example, _) = after.split_once("```").expect("an example ends");
    let loaded = load(example, Notation::Toml, "example");
    assert!(
        loaded.project.is_some() && loaded.diagnostics.is_empty(),
        "{:#?}",
        loaded.diagnostics
    );
}

/// Targets of links and pictures inside the checkout.
fn targets(text: &str) -> Vec<&str> {
    let starts = text.match_indices("](").map(|(at, mark)| at + mark.len());
    starts
        .filter_map(|start| text[start..].split_once(')'))
        .map(|(target, _)| target)
        .filter(|target| !target.contains("://") && !target.contains(char::is_whitespace))
        .collect()
}

/// Fragments of the headings of a page.
fn fragments(page: &Path) -> Vec<String> {
    let text = fs::read_to_string(page).unwrap_or_default();
    text.lines()
        .filter(|line| line.starts_with('#'))
        .map(|line| {
            line.trim_start_matches('#')
                .trim()
                .to_lowercase()
                .replace(' ', "-")
                .chars()
                .filter(|c| c.is_alphanumeric() || *c == '-' || *c == '_')
                .collect()
        })
        .collect()
}
