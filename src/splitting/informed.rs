//! Workflow 2 (paper, Algorithm 2).

use super::split::{NoSplit, Workshop};

pub(super) fn run(_workshop: &mut Workshop<'_>) -> Result<(), NoSplit> {
    Ok(())
}
