//! Members: where the curves of the grid begin, and the exact geodesics that they are.
//!
//! | step | in |
//! |---|---|
//! | members that are given by corners, followed through all patches; lanes between them | [`threads`] |
//! | free members of a lane, evenly over all sides that it crosses | [`distribution`] |
//! | both together: the schedule of a strip | [`schedule`] |
//! | angles and members of rings that shall close | [`closing`] |
//! | one member made exact: as long on the surface as in the plane | [`refine`] |
//! | all members of a strip, each starting where the one before it ends | [`weave`] |

pub mod closing;
pub mod distribution;
mod member;
mod refine;
pub mod schedule;
pub mod threads;
mod walk;
mod weave;

pub use member::{Member, crossing_label, id_in, member_label};
pub use refine::{Between, Given, RefineError, boundary_member, refine};
pub use weave::{Drift, Ground, WeaveError, Woven, come_back, weave};
