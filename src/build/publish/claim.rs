//! What instances want in the output directory, and which of that cannot be.

use super::super::declare::Instance;
use super::super::key::Digest;
use super::super::store::worktree::PublicationRecord;
use super::path::{collisions, fault};
use super::{Files, Publication};
use crate::diagnostics::{Code, Diagnostic};
use std::collections::BTreeSet;
use std::sync::Arc;

/// What one instance has in the output directory, or wants there.
pub(in crate::build) struct Claim {
    pub(in crate::build) owner: Arc<Instance>,
    pub(in crate::build) output: Digest,
    pub(in crate::build) files: Claimed,
}

pub(in crate::build) enum Claimed {
    /// They stand there already.
    Standing(PublicationRecord),
    /// To be written where they differ.
    Wanted(Arc<Files>),
}

impl Claim {
    pub(super) fn is_empty(&self) -> bool {
        self.paths().next().is_none()
    }

    pub(super) fn paths(&self) -> Box<dyn Iterator<Item = &str> + '_> {
        match &self.files {
            Claimed::Standing(record) => Box::new(record.files.iter().map(|f| f.path.as_str())),
            Claimed::Wanted(files) => Box::new(files.iter().map(|file| file.path.as_str())),
        }
    }
}

/// Claims with paths that cannot be: none of their files is touched.
pub(super) fn refuse(claims: &[Claim], publication: &mut Publication) -> BTreeSet<usize> {
    let mut refused = BTreeSet::new();
    for (index, claim) in claims.iter().enumerate() {
        for path in claim.paths() {
            if let Some(fault) = fault(path) {
                refused.insert(index);
                publication.diagnostics.push(
                    Diagnostic::error(Code::new("E0811"), format!("output path `{path}` {fault}"))
                        .note(format!("it is made by `{}`", claim.owner)),
                );
            }
        }
    }
    let paths = claims
        .iter()
        .enumerate()
        .flat_map(|(index, claim)| claim.paths().map(move |path| (path, index)));
    for (path, owner, other, other_owner) in collisions(paths) {
        refused.extend([owner, other_owner]);
        let owner = &claims[owner].owner;
        let other_owner = &claims[other_owner].owner;
        publication.diagnostics.push(
            Diagnostic::error(
                Code::new("E0812"),
                format!("outputs `{path}` and `{other}` exclude each other"),
            )
            .note(format!("they are made by `{owner}` and `{other_owner}`"))
            .help("names that differ only in case need different names"),
        );
    }
    refused
}
