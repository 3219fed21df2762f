//! Publishing: bringing the output directory in line with the results.
//!
//! - A file is replaced only if its bytes differ, as a whole, by rename within its folder.
//! - Files that egg wrote and no longer makes are removed; folders that become empty as well.
//! - What egg did not write is never touched: the [manifest] tells. A file that
//!   is in the way is an error, unless it has the right contents already.
//! - A file that was edited by hand is replaced with a warning while its instance exists, and
//!   left (and forgotten) when it would have been removed.
//! - An instance that failed publishes nothing, and its earlier files stay.
//! - Builds that publish to one directory take turns.
//! - Names and contents depend on nothing but the results: no times, no order of events.

mod claim;
mod files;
mod manifest;
mod path;
mod replace;
mod stale;

pub(super) use claim::{Claim, Claimed};
pub use files::{Files, OutputFile};
pub use manifest::MANIFEST;
pub(super) use manifest::owner_name;
pub(super) use replace::Publishing;
pub(super) use stale::is_swept;

use super::key::Digest;
use super::reason::Reason;
use super::request::OutputCheck;
use super::stamp::Stamp;
use super::store::worktree::{Outputs, PublicationRecord};
use crate::diagnostics::Diagnostic;
use serde::Serialize;
use std::fs;
use std::path::Path;

/// What publishing did.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Publication {
    /// Files that were written, sorted.
    pub written: Vec<String>,
    /// Files that were removed, sorted.
    pub removed: Vec<String>,
    /// Number of files that were right already.
    pub unchanged: usize,
    /// Errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
}

/// How the files of a publication differ from what was written.
pub(super) fn inspect(
    directory: &Path,
    record: &PublicationRecord,
    check: OutputCheck,
) -> Vec<Reason> {
    let mut reasons = Vec::new();
    for file in &record.files {
        let path = directory.join(&file.path);
        let stamp = fs::metadata(&path).map(|metadata| Stamp::of(&metadata));
        if check == OutputCheck::Stamps && stamp.as_ref().is_ok_and(|stamp| *stamp == file.stamp) {
            continue;
        }
        match fs::read(&path) {
            Ok(bytes) if Digest::of(&bytes) == file.content => {}
            Ok(_) => reasons.push(Reason::OutputEdited {
                path: file.path.clone(),
            }),
            Err(_) => reasons.push(Reason::OutputMissing {
                path: file.path.clone(),
            }),
        }
    }
    reasons
}

/// The same for files that nobody has a record of.
pub(super) fn compare(directory: &Path, files: &Files) -> Vec<Reason> {
    let mut reasons = Vec::new();
    for file in files {
        match fs::read(directory.join(&file.path)) {
            Ok(bytes) if bytes == file.bytes => {}
            Ok(_) => reasons.push(Reason::OutputEdited {
                path: file.path.clone(),
            }),
            Err(_) => reasons.push(Reason::OutputMissing {
                path: file.path.clone(),
            }),
        }
    }
    reasons
}

/// Whether the manifest is the one that was written last.
pub(super) fn manifest_stands(directory: &Path, outputs: &Outputs) -> bool {
    let stamp = fs::metadata(directory.join(MANIFEST))
        .ok()
        .map(|metadata| Stamp::of(&metadata));
    stamp == outputs.manifest
}
