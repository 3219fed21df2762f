//! The documents say what the program does: what can be made from it is made from it, and what is
//! written by hand mentions everything that there is.
//!
//! `EGG_BLESS=1 cargo test --test documents` writes what is out of date; then look at the changes.

mod current;
mod errors;
mod figures;
mod language;
mod picture;
mod plan;
mod projects;
mod readme;
mod rooms;
mod tables;
