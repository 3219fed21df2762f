//! From the records of a plan to parts: one function a record.
//!
//! A new record of the plan gets a function in [`RECORDS`] (and a [`Kind`](super::Kind), if it is
//! something new): what is compared, counted, locked and shown follows from what it gives.

mod bill;
mod cut;
mod layout;
mod sheets;
mod strips;

use super::part::{Part, by_number};
use crate::plan::Plan;

/// Every function that makes parts of a plan's records.
const RECORDS: [fn(&Plan) -> Vec<Part>; 11] = [
    cut::lamellae,
    cut::stickers,
    cut::supports,
    layout::patches,
    layout::members,
    strips::strips,
    layout::points,
    layout::structure,
    sheets::sheets,
    sheets::nestings,
    bill::rows,
];

/// All parts of a plan, by kind and id.
pub(super) fn parts(plan: &Plan) -> Vec<Part> {
    let mut parts: Vec<Part> = RECORDS.iter().flat_map(|record| record(plan)).collect();
    parts.sort_by(|a, b| a.kind.cmp(&b.kind).then_with(|| by_number(&a.id, &b.id)));
    parts
}
