//! Sides that were written: plans and locks.

use super::{Held, Loaded};
use crate::cli::console::Console;
use crate::cli::exit::Exit;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::diff as codes;
use crate::diff::{Lock, LockError};
use crate::plan::{ReadError, from_ron};
use std::path::Path;
use std::sync::Arc;

/// Whether a file is a plan and not a project in the same notation: a plan begins with its format.
pub(super) fn is_plan(path: &Path) -> bool {
    use std::io::Read;
    let mut head = String::new();
    let file = std::fs::File::open(path);
    let read = file.and_then(|file| file.take(200).read_to_string(&mut head));
    let begin = head.trim_start().trim_start_matches('(').trim_start();
    read.is_ok() && begin.starts_with("format")
}

/// A plan that was written.
pub(super) fn plan_file(console: Console, path: &Path) -> Result<Loaded, Exit> {
    let shown = path.display().to_string();
    let text = read(console, path)?;
    match from_ron(&text) {
        Ok(plan) => Ok(Loaded::new(shown, Held::Plan(Arc::new(plan)))),
        Err(error) => {
            console.tell_plainly(&[bad_plan(&shown, &error)]);
            Err(Exit::Usage)
        }
    }
}

/// Why a plan cannot be read.
pub(in crate::cli) fn bad_plan(shown: &str, error: &ReadError) -> Diagnostic {
    match error {
        ReadError::UnknownFormat(format) => other_format(shown, u64::from(*format)),
        ReadError::Malformed {
            message,
            at: (line, column),
        } => Diagnostic::error(
            codes::BAD_PLAN,
            format!("`{shown}` is no plan: {message} (line {line}, column {column})"),
        )
        .help("build it again; plans are results and are not edited"),
    }
}

/// A file of a newer program.
pub(in crate::cli::commands::diff) fn other_format(shown: &str, format: u64) -> Diagnostic {
    let message = format!("`{shown}` has format {format}, which this egg does not know");
    Diagnostic::error(codes::OTHER_FORMAT, message)
        .help("use the egg that wrote it, or write it again with this one")
}

/// A lock that was written.
pub(super) fn lock_file(console: Console, path: &Path) -> Result<Loaded, Exit> {
    let shown = path.display().to_string();
    let text = read(console, path)?;
    match Lock::read(&text) {
        Ok(lock) => Ok(Loaded::new(shown, Held::Lock(lock))),
        Err(error) => {
            console.tell_plainly(&[bad_lock(&shown, &error)]);
            Err(Exit::Usage)
        }
    }
}

/// Why a lock cannot be read.
pub(in crate::cli) fn bad_lock(shown: &str, error: &LockError) -> Diagnostic {
    match error {
        LockError::UnknownFormat(format) => other_format(shown, u64::from(*format)),
        LockError::Malformed(line, message) => {
            let message = format!("`{shown}` cannot be read in line {line}: {message}");
            Diagnostic::error(codes::BAD_LOCK, message).help("write it anew: `egg lock`")
        }
    }
}

fn read(console: Console, path: &Path) -> Result<String, Exit> {
    std::fs::read_to_string(path).map_err(|error| {
        console.complain(&format!("cannot read `{}`: {error}", path.display()), None);
        Exit::Usage
    })
}
