//! What a workshop gets beyond plain sheets: pieces with joints, panels that are pushed through,
//! test pieces, and a program that reads files back.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/program.rs"]
mod program;

mod boundaries;
mod coupons;
mod damage;
mod layouts;
mod projects;
mod splices;
mod windows;

use std::path::PathBuf;

/// Independent readers of drawings.
fn readers() -> PathBuf {
    common::python::venv(&[
        "ezdxf==1.4.*",
        "shapely==2.*",
        "svgelements==1.9.*",
        "resvg_py==0.5.*",
        "pillow",
    ])
}

/// Holds a text to the one that was reviewed.
fn golden(name: &str, text: &str) {
    insta::with_settings!({
        snapshot_path => "../golden/workshop",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, { insta::assert_snapshot!(name, text) });
}
