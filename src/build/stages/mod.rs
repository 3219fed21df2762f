//! The stages: thin adaptors between the graph and the rooms of the pipeline.
//!
//! Each is a [`Stage`](super::Stage) with a name, a version and a function pointer; what it may
//! use stands in its types. Its version is raised whenever the same input may give other bytes.
//! Messages name fields of the stage's input by keys that begin with a dot; the graph says where
//! in the project these come from.

pub(super) mod cladding;
pub(super) mod closing;
pub(super) mod fabrication;
pub(super) mod layout;
pub(super) mod members;
pub(super) mod plan;
pub(super) mod splitting;
pub(super) mod surface;

use super::Failure;
use crate::diagnostics::{Checked, Diagnostic, Severity, Warned};

/// A result of a room as a stage returns it.
fn outcome<T>(checked: Checked<T>) -> Result<Warned<T>, Failure> {
    checked.map_err(Failure::Errors)
}

/// A value with what was found about it: refused if there is an error among it.
fn judged<T>(value: T, found: Vec<Diagnostic>) -> Result<Warned<T>, Failure> {
    if found.iter().any(|d| d.severity == Severity::Error) {
        Err(Failure::Errors(found))
    } else {
        Ok(Warned {
            value,
            warnings: found,
        })
    }
}

/// A value about which there is nothing to say.
#[expect(clippy::unnecessary_wraps, reason = "it is what a stage returns")]
fn plain<T>(value: T) -> Result<Warned<T>, Failure> {
    Ok(Warned {
        value,
        warnings: Vec::new(),
    })
}
