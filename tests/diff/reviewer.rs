//! Tried as a reviewer would: a repository with five commits, and for each of them what to cut,
//! in one screen, for somebody who has not seen the change.

use crate::edit::{EDITS, Project};
use crate::program::Workshop;
use crate::repository::Repository;

/// A commit: its message, the edit that it adds to those before, and what its text has to say.
type Step = (&'static str, &'static str, &'static [&'static str]);

const STEPS: [Step; 5] = [
    (
        "Add a member to the west",
        "member-count",
        &[
            "to cut: ",
            "1 new",
            "patches.west.members.u 5 -> 6",
            "(bays.toml:",
            "lamellae",
            "18 -> ",
            "To cut (",
        ],
    ),
    (
        "Move the first point by 1 mm",
        "point-moved",
        &[
            "to cut: ",
            "points.a [150, 150] -> [151, 150]",
            "length ",
            "point a ",
            "position moved 1 mm",
        ],
    ),
    (
        "Take birch",
        "material",
        &[
            "19 of 19 lamellae anew",
            "material poplar-plywood -> birch-plywood",
        ],
    ),
    (
        "Call the west the shore",
        "patch-renamed",
        &["nothing to cut", "patch west -> shore"],
    ),
    (
        "Write centimetres",
        "units",
        &["no part changes", "lamella.width 20 -> \"20 mm\""],
    ),
];

#[test]
fn a_reviewer_sees_what_each_of_five_commits_does() {
    let workshop = Workshop::new();
    let repository = Repository::with_bays(&workshop);
    let mut project = Project::bays();
    for (message, name, _) in STEPS {
        let edit = EDITS
            .iter()
            .find(|(edit, _)| *edit == name)
            .expect("an edit");
        if name == "units" {
            // The point that was moved is written in centimetres too.
            project = project.with("[151, 150]", "[150, 150]");
            project = (edit.1)(project).with("a = [15, 15]", "a = [15.1, 15]");
        } else {
            project = (edit.1)(project);
        }
        repository.commit(&project, message);
    }
    for (i, (message, name, said)) in STEPS.into_iter().enumerate() {
        let before = format!("HEAD~{}", STEPS.len() - i);
        let after = format!("HEAD~{}", STEPS.len() - i - 1);
        let text = repository.egg(&["diff", &before, &after]).expect(0).out;
        for words in said {
            let found = text.to_lowercase().contains(&words.to_lowercase());
            assert!(found, "{name}: `{words}` is not in\n{text}");
        }
        assert!(text.contains(message), "{text}");
        assert!(text.lines().count() <= 50, "{text}");
        assert!(
            text.lines().all(|line| line.chars().count() < 400),
            "{text}"
        );

        let markdown = ["diff", &before, &after, "--format", "markdown"];
        let markdown = repository.egg(&markdown).expect(0).out;
        assert!(
            markdown.starts_with("<!-- egg diff: bays -->\n### bays: "),
            "{markdown}"
        );
        assert!(markdown.len() < 60_000);
        let folder = format!("pictures-{name}");
        let pictures = ["diff", &before, &after, "--format", "svg", "--to", &folder];
        repository.egg(&pictures).expect(0);
        let above = workshop.path(&format!("repo/{folder}/above.svg"));
        let changes_shape = !matches!(name, "patch-renamed" | "units");
        if changes_shape {
            let svg = std::fs::read_to_string(above).expect("a picture from above");
            assert!(svg.contains("class=\"before\"") || svg.contains("class=\"after\""));
            assert!(svg.contains("unchanged") && svg.contains(" mm"), "a legend");
        }
    }
}
