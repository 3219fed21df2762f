//! The language: what a project file may say, in both notations, and what is told about one
//! that is wrong.

mod corpus;
mod files;
mod mutations;
mod notations;
#[path = "../common/python.rs"]
mod python;
mod rendering;
mod schema;
