//! What integration tests share.

#![allow(dead_code, reason = "each test binary uses a part of it")]

pub(crate) mod job;
pub(crate) mod python;
pub(crate) mod synthetic;
