//! The example projects from end to end: what the program writes, whether it always writes the
//! same, and whether what it writes is true.

mod builds;
mod conditions;
mod evenness;
mod geometry;
#[path = "../common/program.rs"]
mod program;
#[path = "../common/python.rs"]
mod python;
mod readers;

use std::path::{Path, PathBuf};

/// The projects of the repository, and one of several patches.
const PROJECTS: [&str; 4] = [
    "projects/desktop/desktop.toml",
    "projects/saddle/saddle.toml",
    "projects/sphere-cap/sphere-cap.toml",
    "tests/corpus/designs/junction.toml",
];

/// Structures of several patches: all shapes of networks.
const STRUCTURES: [&str; 11] = [
    "projects/pavilion/pavilion.toml",
    "projects/prototype/prototype.toml",
    "projects/great-court/great-court.toml",
    "projects/lilium-tower/lilium-tower.toml",
    "projects/yas-hotel/yas-hotel.toml",
    "tests/corpus/designs/ring-closed.toml",
    "projects/peak/by-hand.toml",
    "projects/peak/automatic.toml",
    "projects/peak/informed.toml",
    "tests/corpus/designs/ring-turned.toml",
    "projects/rotunda/rotunda.toml",
];

/// A file of the repository.
fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}
