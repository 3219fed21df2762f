//! The incremental engine, on made-up stages: what runs, what is published, what survives.

mod faults;
mod incremental;
mod processes;
mod project;
mod properties;
mod publishing;
mod trouble;
mod workshop;
