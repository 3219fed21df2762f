//! What integration tests share.

pub(crate) mod python;
pub(crate) mod synthetic;
