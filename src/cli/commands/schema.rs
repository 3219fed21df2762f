//! `egg schema`: JSON schemas.

use crate::cli::args::SchemaOf;
use crate::cli::console::out;

pub(in crate::cli) fn run(of: SchemaOf) {
    out(&match of {
        SchemaOf::Project => crate::project::schema(),
        SchemaOf::Plan => crate::plan::schema(),
        SchemaOf::Check => crate::splitting::schema(),
        SchemaOf::Difference => crate::diff::schema(),
    });
}
