//! An edit runs what it touches and nothing else.

use crate::project::Design;
use crate::workshop::Workshop;
use egg::build::How;

#[test]
fn a_second_build_runs_nothing_and_writes_nothing() {
    let workshop = Workshop::new();
    let design = Design::default();
    let first = workshop.build(&design);
    assert!(first.succeeded(), "{:?}", first.diagnostics);
    assert_eq!(first.count(How::Ran), 21);
    assert_eq!(
        first.publication.written,
        [
            "bom.csv",
            "drawings/p0.svg",
            "drawings/p1.svg",
            "drawings/p2.svg",
            "fabrication/sheet-00.dxf",
            "fabrication/sheet-01.dxf",
            "fabrication/sheet-02.dxf",
            "plan.txt",
        ]
    );
    let second = workshop.build(&design);
    assert_eq!(second.count(How::Cached), 21);
    assert!(second.publication.written.is_empty());
    assert_eq!(second.publication.unchanged, 8);
    assert!(workshop.plan(&design).is_idle());
}
