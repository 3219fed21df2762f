//! The commands, one file each.

pub(super) mod build;
pub(super) mod check;
pub(super) mod explain;
pub(super) mod export;
pub(super) mod init;
pub(super) mod materials;
pub(super) mod schema;
