//! `egg materials`: the built-in materials.

use crate::cli::console::{Console, out};
use crate::project::materials;
use serde::Serialize;
use std::fmt::Write;

pub(in crate::cli) fn run(console: Console) {
    if console.is_json() {
        for built_in in materials::built_in() {
            console.record(&Record {
                reason: "material",
                material: &built_in.material,
                about: built_in.about,
                source: built_in.source,
            });
        }
        return;
    }
    let mut text = String::new();
    for built_in in materials::built_in() {
        let m = &built_in.material;
        let _ = writeln!(
            text,
            "{}: {}\n  E {:.1} GPa, G {:.2} GPa, density {:.0} kg/m^3, bending strength {:.0} MPa\n  \
             source: {}",
            m.name,
            built_in.about,
            m.elastic_modulus / 1e9,
            m.shear_modulus / 1e9,
            m.density,
            m.bending_strength / 1e6,
            built_in.source
        );
    }
    out(&text);
}

#[derive(Serialize)]
struct Record<'a> {
    reason: &'static str,
    #[serde(flatten)]
    material: &'a crate::project::model::Material,
    about: &'a str,
    source: &'a str,
}
