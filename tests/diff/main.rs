//! `egg diff`, `egg lock` and `egg git`: what a change of a design does to its parts.
//!
//! Edits are tried on a project of two patches (`tests/corpus/diff`), each with its golden text,
//! Markdown and JSON; revisions in repositories that the tests make; the page in a browser.

mod corpus;
mod edit;
mod formats;
mod install;
mod locks;
mod page;
#[path = "../common/program.rs"]
mod program;
#[path = "../common/python.rs"]
mod python;
mod repository;
mod reviewer;
mod revisions;
