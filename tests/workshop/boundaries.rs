//! Patches that share a side: each has a boundary lamella of its own on it, and one bolt goes
//! through both.

use crate::program::Workshop;
use egg::plan::{LamellaRecord, MemberRecord, OpeningRecord, Plan};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Positions of the openings of a boundary lamella on its side, from one end of the member.
fn holes(lamella: &LamellaRecord) -> Vec<f64> {
    let at = |opening: &OpeningRecord| match opening {
        OpeningRecord::Hole { at, .. } => *at,
        OpeningRecord::Notch { .. } => panic!("boundary members have no notches"),
    };
    lamella.openings.iter().map(at).collect()
}

/// Two patches of the desktop model side by side, with as many members across.
fn halves(shop: &Workshop) -> Plan {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/desktop");
    let mesh = fs::read(folder.join("desktop.obj")).expect("a mesh");
    shop.write("desktop.obj", mesh);
    let text = fs::read_to_string(folder.join("desktop.toml")).expect("a project");
    let text = text.replace(
        "a = [-200, -270]",
        "a = [-200, -270]\nm = [0, -270]\nn = [0, 270]",
    );
    let patches = "[patches.east]\ncorners = [\"m\", \"b\", \"c\", \"n\"]\nmembers = { u = 5 }\n\n\
                   [patches.west]\ncorners = [\"a\", \"m\", \"n\", \"d\"]\nmembers = { u = 5, v = 9 }\n";
    let start = text.find("[patches.hills]").expect("a patch");
    let end = text.find("[lamella]").expect("a section");
    let text = format!("{}{patches}\n{}", &text[..start], &text[end..]);
    shop.write("halves.toml", text);
    shop.egg(&["build", "halves.toml", "--out", "out"])
        .expect(0);
    let text = fs::read_to_string(shop.path("out/plan.ron")).expect("a plan");
    egg::plan::from_ron(&text).expect("a plan")
}

#[test]
fn boundary_lamellae_of_both_patches_have_their_holes_at_the_same_places() {
    let shop = Workshop::new();
    let plan = halves(&shop);
    let members: BTreeMap<&str, &MemberRecord> =
        plan.members.iter().map(|m| (m.id.as_str(), m)).collect();
    let ends = |m: &MemberRecord| [m.polyline[0], m.polyline[m.polyline.len() - 1]];
    let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    let boundary = |l: &&LamellaRecord| members[l.member.as_str()].boundary;
    let lamellae: Vec<&LamellaRecord> = plan.lamellae.iter().filter(boundary).collect();
    let mut shared = 0;
    for (i, one) in lamellae.iter().enumerate() {
        for two in &lamellae[i + 1..] {
            let [a, b] = [one, two].map(|l| members[l.member.as_str()]);
            let [[a0, a1], [b0, b1]] = [ends(a), ends(b)];
            let forwards = apart(a0, b0) < 1e-6 && apart(a1, b1) < 1e-6;
            let backwards = apart(a0, b1) < 1e-6 && apart(a1, b0) < 1e-6;
            if a.patch == b.patch || !(forwards || backwards) {
                continue;
            }
            shared += 1;
            assert_ne!(one.id, two.id);
            assert!((one.length - two.length).abs() < 1e-9);
            let [mine, mut others] = [one, two].map(|l| holes(l));
            if backwards {
                others = others.iter().rev().map(|s| b.length_surface - s).collect();
            }
            assert_eq!(mine.len(), others.len());
            assert!(mine.len() >= 5);
            for (x, y) in mine.iter().zip(&others) {
                // Holes are 3.2 mm wide; a micrometre of a side of half a metre is 1e-6 of it.
                assert!((x - y).abs() < 1e-6, "{} {} {x} {y}", one.id, two.id);
            }
        }
    }
    assert_eq!(shared, 1, "the side between the patches");
}
