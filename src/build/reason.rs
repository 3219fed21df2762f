//! Why an instance has to run, or has changed: a closed list, so that there is no "unknown".

use super::declare::Instance;
use super::key::Digest;
use serde::{Deserialize, Serialize};
use std::fmt;

/// One reason.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// This output directory has no record of it.
    FirstBuild,
    /// A field of its input has another value.
    InputChanged {
        /// Field of the stage's input.
        field: String,
        /// Key of the project that the field comes from, where the graph says so.
        key: Option<String>,
        /// Short text of the old value; none if the field is new.
        old: Option<String>,
        /// Short text of the new value; none if the field is gone.
        new: Option<String>,
    },
    /// A dependency gave another result.
    DependencyChanged {
        /// The dependency.
        instance: Instance,
        /// Digest of what it gave before; none if it is a new dependency.
        old: Option<Digest>,
        /// Digest of what it gives now; none if it is no dependency any more.
        new: Option<Digest>,
    },
    /// Its code is another.
    StageVersionChanged {
        /// Version before.
        old: String,
        /// Version now.
        new: String,
    },
    /// Its results depend on the processor, and this is another one.
    NumericsChanged {
        /// Class before.
        old: String,
        /// Class now.
        new: String,
    },
    /// The cache has lost the result.
    EntryMissing,
    /// The result in the cache is damaged.
    EntryDamaged,
    /// A published file is gone; it is written again without running anything.
    OutputMissing {
        /// The file, relative to the output directory.
        path: String,
    },
    /// A published file is not what was written; it is written again without running anything.
    OutputEdited {
        /// The file, relative to the output directory.
        path: String,
    },
    /// The user asked for it.
    Forced,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FirstBuild => f.write_str("not built here before"),
            Self::InputChanged {
                field,
                key,
                old,
                new,
            } => {
                f.write_str(key.as_ref().unwrap_or(field))?;
                match (old, new) {
                    (Some(old), Some(new)) => write!(f, " {old} -> {new}"),
                    (None, Some(new)) => write!(f, " is now {new}"),
                    (Some(old), None) => write!(f, " was {old}"),
                    (None, None) => f.write_str(" changed"),
                }
            }
            Self::DependencyChanged { instance, old, new } => match (old, new) {
                (None, Some(_)) => write!(f, "`{instance}` is a new dependency"),
                (Some(_), None) => write!(f, "`{instance}` is no dependency any more"),
                _ => write!(f, "`{instance}` gave another result"),
            },
            Self::StageVersionChanged { old, new } => {
                write!(f, "version of the stage {old} -> {new}")
            }
            Self::NumericsChanged { old, new } => write!(f, "kind of processor {old} -> {new}"),
            Self::EntryMissing => f.write_str("its result is no longer in the cache"),
            Self::EntryDamaged => f.write_str("its result in the cache is damaged"),
            Self::OutputMissing { path } => write!(f, "`{path}` is missing"),
            Self::OutputEdited { path } => write!(f, "`{path}` was edited"),
            Self::Forced => f.write_str("asked for"),
        }
    }
}

impl Reason {
    /// Whether it is about published files, not about the result.
    pub fn is_about_outputs(&self) -> bool {
        matches!(self, Self::OutputMissing { .. } | Self::OutputEdited { .. })
    }
}
