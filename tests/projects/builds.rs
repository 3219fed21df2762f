//! Builds of the projects: they succeed, and always write the same.

use crate::conditions;
use crate::program::{Workshop, files};
use crate::{PROJECTS, root};
use egg::plan::{from_ron, to_json};
use egg::project::{Notation, load};
use std::fs;

/// Builds a project with a fresh cache; gives the files that were written.
fn built(shop: &Workshop, project: &str, name: &str, jobs: &str) -> Vec<(String, Vec<u8>)> {
    let project = root(project);
    let (cache, out) = (format!("{name}-cache"), format!("{name}-out"));
    let ran = shop
        .egg(&[
            "build",
            &project.to_string_lossy(),
            "--cache-dir",
            &cache,
            "--out",
            &out,
            "--jobs",
            jobs,
        ])
        .expect(0);
    assert_eq!(ran.out, "");
    assert!(ran.err.trim_start().starts_with("Finished "), "{}", ran.err);
    assert_eq!(ran.err.lines().count(), 1, "nothing else is said");
    files(&shop.path(&out)).into_iter().collect()
}
