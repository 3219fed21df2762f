//! The `egg` command.

fn main() {}
