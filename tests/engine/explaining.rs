//! Why something is as it is.

use crate::project::Design;
use crate::workshop::Workshop;
use egg::build::{Explanation, State, dot, json};

fn explain(workshop: &Workshop, design: &Design, subject: &str) -> Option<Explanation> {
    workshop.engine().explain(subject, &|g| design.declare(g))
}

fn told(explanation: &Explanation) -> Vec<String> {
    explanation
        .causes
        .iter()
        .map(|cause| {
            let path: Vec<_> = cause.path.iter().map(ToString::to_string).collect();
            format!("{} | {}", cause.reason, path.join(" > "))
        })
        .collect()
}

#[test]
fn a_file_leads_back_to_the_key_that_changed_it() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    design.patches[1].members = 9;
    workshop.build(&design);
    // Another edit, after which the sheets stay as they are.
    design.price = 20.0;
    workshop.build(&design);
    let found = explain(&workshop, &design, "fabrication/sheet-01.dxf").expect("published");
    assert_eq!(found.instance.to_string(), "sheets");
    assert!(!found.pending);
    assert_eq!(
        told(&found),
        ["patches.p1.members 6 -> 9 | members p1 > plan > sheets"]
    );
    let bom = explain(&workshop, &design, "bom").expect("an instance");
    assert_eq!(told(&bom), ["materials.ash.price 12.5 -> 20.0 | bom"]);
}

#[test]
fn what_is_due_leads_back_to_the_edit() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    design.patches[2].corner = 2.5;
    let path = workshop.settings.output.join("drawings/p2.svg");
    let found = explain(&workshop, &design, &path.to_string_lossy()).expect("published");
    assert!(found.pending);
    assert!(matches!(found.state, State::Maybe { .. }));
    assert_eq!(
        told(&found),
        ["patches.p2.corners 2.0 -> 2.5 | maps p2 > members p2 > drawing p2"]
    );
    let other = explain(&workshop, &design, "drawings/p1.svg").expect("published");
    assert!(!other.pending);
    assert_eq!(told(&other), ["not built here before | drawing p1"]);
}

#[test]
fn everything_that_a_file_is_made_from_is_listed_with_its_place() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    let found = explain(&workshop, &design, "bom.csv").expect("published");
    let keys: Vec<_> = found
        .influences
        .iter()
        .filter_map(|one| Some(format!("{} = {}", one.key.as_ref()?, one.value)))
        .collect();
    assert!(
        keys[0].starts_with("surface.mesh = 64 values #"),
        "{}",
        keys[0]
    );
    assert!(keys.contains(&"patches.p1.members = 6".to_owned()));
    assert!(keys.contains(&"materials.ash.price = 12.5".to_owned()));
    assert!(!keys.iter().any(|key| key.starts_with("fabrication.kerf")));
}

#[test]
fn what_does_not_exist_has_no_explanation() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    assert!(explain(&workshop, &design, "drawings/p9.svg").is_none());
    assert!(explain(&workshop, &design, "maps p9").is_none());
}

#[test]
fn going_back_by_way_of_the_cache_is_explained_as_well() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    design.kerf = 1.0;
    workshop.build(&design);
    design.kerf = 0.000_15;
    workshop.build(&design);
    let found = explain(&workshop, &design, "fabrication/sheet-00.dxf").expect("published");
    assert_eq!(told(&found), ["fabrication.kerf 1.0 -> 0.00015 | sheets"]);
}

#[test]
fn the_graph_can_be_drawn_and_read_by_programs() {
    let workshop = Workshop::new();
    let design = Design::with_patches(1);
    workshop.build(&design);
    let plan = workshop.plan(&design);
    let drawn = dot(&plan);
    assert!(drawn.starts_with("digraph egg {\n"));
    assert!(
        drawn.contains("n2 [label=\"maps\\np0\", fillcolor=\"#e8f1e4\"];"),
        "{drawn}"
    );
    assert!(drawn.contains("  n0 -> n2;\n"));
    let read: serde_json::Value = serde_json::from_str(&json(&plan)).expect("JSON");
    assert_eq!(read["format"], 1);
    assert_eq!(read["stages"][3]["name"], "members p0");
    assert_eq!(read["stages"][3]["needs"][0], "maps p0");
    assert_eq!(read["stages"][3]["state"], "cached");
    assert!(read["stages"][3]["seconds"].is_f64());
}
