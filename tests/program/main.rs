//! The `egg` program as its users meet it: commands, streams, exit codes, and what an edit of a
//! project makes run again.

mod commands;
mod edits;
#[path = "../common/program.rs"]
mod program;
mod versions;
mod watching;

use program::Workshop;
use std::fs;
use std::path::{Path, PathBuf};

/// The project of several patches that is cheap to build.
const JUNCTION: &str = "tests/corpus/designs/junction.toml";
const VAULT: &str = "tests/corpus/designs/vault.obj";

/// A file of the repository.
fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn read(path: &str) -> String {
    fs::read_to_string(root(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A workshop with the project in it, as `junction.toml` and `vault.obj`.
fn with_junction() -> Workshop {
    let shop = Workshop::new();
    shop.write("junction.toml", read(JUNCTION));
    shop.write("vault.obj", read(VAULT));
    shop
}
