//! The commands, one file each.

pub(super) mod build;
pub(super) mod cache;
pub(super) mod check;
pub(super) mod diff;
pub(super) mod explain;
pub(super) mod export;
pub(super) mod git;
pub(super) mod graph;
pub(super) mod init;
pub(super) mod lock;
pub(super) mod materials;
pub(super) mod schema;
pub(super) mod split;
pub(super) mod verify;
pub(super) mod watch;
