//! The `egg` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    egg::cli::main()
}
