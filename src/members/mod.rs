//! Members: even distribution over the sides that a family crosses, exact refinement.

pub mod distribution;
