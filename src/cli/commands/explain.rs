//! `egg explain`: what a diagnostic code means.

use crate::cli::console::{Console, out};
use crate::cli::exit::Exit;
use crate::diagnostics::codes;

pub(in crate::cli) fn run(console: Console, code: &str) -> Exit {
    let Some(info) = codes::find(code) else {
        console.complain(
            &format!("there is no diagnostic `{code}`"),
            Some("codes look like E0503 or W0601"),
        );
        return Exit::Usage;
    };
    out(&format!(
        "{} {}: {}\n\n{}\n",
        info.code, info.name, info.title, info.text
    ));
    Exit::Done
}
