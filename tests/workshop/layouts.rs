//! The flat layout as people read it.

use crate::common::synthetic;
use egg::fabrication::drawing::{Layer, Shape, Text, Tile};
use egg::fabrication::index::PlanIndex;
use egg::fabrication::layout::{FlatPatch, draw};
use egg::plan::Plan;

/// The pavilion folded nearly shut: everything flat at a fraction of its height.
fn folded(share: f64) -> Plan {
    let mut plan = synthetic::pavilion();
    for member in &mut plan.members {
        let [a, b] = member.planar.map(|[x, y]| [x, share * y]);
        member.planar = [a, b];
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        let mut lamellae = plan.lamellae.iter_mut();
        let lamella = lamellae.find(|l| l.member == member.id).expect("a lamella");
        lamella.length = length + 2.0 * lamella.end_margin;
        lamella.openings.clear();
    }
    plan
}

#[test]
fn ids_stand_on_no_lamella_and_on_no_other_id_at_small_angles() {
    for share in [1.0, 0.4, 0.2] {
        let plan = folded(share);
        let index = PlanIndex::new(&plan);
        for patch in &plan.patches {
            let lamellae: Vec<_> = plan
                .members
                .iter()
                .filter(|member| member.patch == patch.id)
                .filter_map(|member| Some((member, index.lamella_of(&member.id)?)))
                .collect();
            let flat = FlatPatch {
                project: "folded",
                patch,
                lamellae: lamellae.clone(),
                crossings: Vec::new(),
                bolt: 0.004,
            };
            let drawing = draw(&flat);
            let names: Vec<&Text> = drawing
                .entities
                .iter()
                .filter(|entity| entity.layer == Layer::Label)
                .filter_map(|entity| match &entity.shape {
                    Shape::Text(text) => Some(text),
                    _ => None,
                })
                .collect();
            assert_eq!(names.len(), 2 * lamellae.len());
            // The outline of a lamella is two straight edges and two half circles.
            let strips: Vec<Tile> = drawing
                .entities
                .iter()
                .filter(|entity| matches!(entity.layer, Layer::LamellaU | Layer::LamellaV))
                .filter_map(|entity| match &entity.shape {
                    Shape::Path(path) => {
                        let [a, b, c, d] = path.vertices[..] else {
                            panic!("a slot");
                        };
                        let middle = |p: f64, q: f64| 0.5 * (p + q);
                        let ends = [
                            [middle(a.x, d.x), middle(a.y, d.y)],
                            [middle(b.x, c.x), middle(b.y, c.y)],
                        ];
                        Some(Tile::along(ends, libm::hypot(a.x - d.x, a.y - d.y)))
                    }
                    _ => None,
                })
                .collect();
            assert_eq!(strips.len(), lamellae.len());
            for (i, name) in names.iter().enumerate() {
                let tile = Tile::of_text(name);
                let other = names[i + 1..]
                    .iter()
                    .find(|o| Tile::of_text(o).overlaps(&tile));
                assert_eq!(other, None, "{share}: {name:?}");
                let covers = strips.iter().any(|strip| strip.overlaps(&tile));
                assert!(!covers, "{share}: {name:?} stands on a lamella");
            }
        }
    }
}
