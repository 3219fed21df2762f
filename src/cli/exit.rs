//! How a command ends.

use std::process::ExitCode;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Exit {
    /// Done.
    Done,
    /// The project has errors.
    Errors,
    /// Wrong usage, or something that is not the project's fault.
    Usage,
    /// There are differences, and the user asked to be told so.
    Differences,
    /// The user stopped it.
    Interrupted,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::Errors => 1,
            Exit::Usage => 2,
            Exit::Differences => 3,
            Exit::Interrupted => 130,
        })
    }
}
