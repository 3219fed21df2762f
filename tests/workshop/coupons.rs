//! Test pieces.

use crate::common::job::Job;
use crate::common::python;
use crate::program::{Workshop, files};
use crate::readers;
use std::path::Path;

#[test]
fn a_coupon_is_nominal_whatever_the_kerf_of_the_project_is() {
    let bytes = |kerf: f64| {
        let mut job = Job::pavilion();
        job.fabrication.kerf = kerf;
        let files = job.files();
        let coupon = files.iter().find(|f| f.path.starts_with("coupon/"));
        coupon.expect("a coupon").clone()
    };
    assert_eq!(bytes(0.0).path, "coupon/poplar-plywood-3mm.dxf");
    assert_eq!(bytes(0.0), bytes(0.2e-3));
}

#[test]
fn the_command_writes_coupons_and_nothing_else() {
    let shop = Workshop::new();
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/saddle/saddle.toml");
    let project = project.to_string_lossy();
    shop.egg(&["coupon", &project, "--out", "out"]).expect(0);
    let names: Vec<String> = files(&shop.path("out")).into_keys().collect();
    assert_eq!(
        names,
        [
            ".egg-manifest",
            "coupon/poplar-plywood-3mm.dxf",
            "coupon/poplar-plywood-3mm.svg"
        ]
    );
    let counts = python::read(
        &readers(),
        "coupon.py",
        &[&shop.path("out/coupon/poplar-plywood-3mm.dxf")],
    );
    // Bars, holes for the bolt, notches.
    assert_eq!(counts.trim(), "10 9 9");
}
