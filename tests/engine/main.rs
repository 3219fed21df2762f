//! The incremental engine, on made-up stages: what runs, what is published, what survives.

mod cache;
mod explaining;
mod faults;
mod graphs;
mod incremental;
mod processes;
mod project;
mod properties;
mod publishing;
mod sources;
mod trouble;
mod workshop;
