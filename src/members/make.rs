//! All members of a family of a patch.

use super::{Between, Given, Member, RefineError, boundary_member, refine};
use crate::cladding::Clad;
use crate::geodesic::Geodesics;
use crate::layout::Domain;
use crate::project::model::Family;
use rayon::prelude::*;

/// A member that could not be made.
#[derive(Debug, Clone, PartialEq)]
pub struct MakeError {
    /// Its index.
    pub index: u32,
    /// Why.
    pub why: RefineError,
}

/// Makes the members that start at the given shares; the first and the last are the sides of the
/// patch.
///
/// # Errors
/// The first member, in order, that could not be made.
pub fn make_members(
    domain: &Domain,
    clad: &Clad,
    family: Family,
    shares: &[f64],
) -> Result<Vec<Member>, MakeError> {
    let geodesics = Geodesics::new(&domain.mesh);
    let between = Between {
        family,
        start: domain.start(family),
        end: domain.end(family),
        quad: &clad.quad,
    };
    let last = shares.len() - 1;
    let [first_side, last_side] = domain.boundary_members(family);
    (0..shares.len())
        .into_par_iter()
        .map(|i| {
            let index = i as u32;
            if i == 0 {
                return Ok(boundary_member(
                    &between,
                    index,
                    0.0,
                    first_side.path().clone(),
                ));
            }
            if i == last {
                return Ok(boundary_member(
                    &between,
                    index,
                    1.0,
                    last_side.path().clone(),
                ));
            }
            let guess = clad.function(family).at(shares[i]).0;
            refine(&geodesics, &between, index, Given::Start, shares[i], guess)
                .map_err(|why| MakeError { index, why })
        })
        .collect()
}
