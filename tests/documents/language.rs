//! The reference of the language.

use crate::current;
use crate::tables::{Schema, fields};
use egg::project::materials;
use egg::project::{Notation, load};
use std::fmt::Write;

const PAGE: &str = "docs/project-file.md";

#[test]
fn the_page_on_the_language_has_every_key() {
    let schema = Schema::new(&egg::project::schema());
    let page = current::read(PAGE);
    for section in fields(schema.root()) {
        let heading = format!("\n## {}", section.name);
        assert!(page.contains(&heading), "no section `{}`", section.name);
    }
    for name in schema.definitions() {
        current::block(
            PAGE,
            &format!("keys of {name}"),
            &schema.settings(schema.definition(name)),
        );
    }
}

#[test]
fn the_page_on_the_language_has_every_material() {
    let mut text = String::from(
        "| name | E, GPa | G, GPa | kg/m³ | bending strength, MPa | |\n|---|---|---|---|---|---|\n",
    );
    for built_in in materials::built_in() {
        let m = &built_in.material;
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {:.0} | {:.0} | {}; {} |",
            m.name,
            round(m.elastic_modulus / 1e9),
            round(m.shear_modulus / 1e9),
            m.density,
            m.bending_strength / 1e6,
            built_in.about,
            built_in.source
        );
    }
    current::block(PAGE, "materials", &text);
}

fn round(value: f64) -> f64 {
    libm::round(100.0 * value) / 100.0
}

#[test]
fn the_examples_of_the_page_make_one_project() {
    let page = current::read(PAGE);
    let mut text = String::new();
    let mut rest = page.as_str();
    while let Some((_, after)) = rest.split_once("```toml\n") {
        let (example, after) = after.split_once("```").expect("an example ends");
        text.push_str(example);
        rest = after;
    }
    let loaded = load(&text, Notation::Toml, "example");
    assert!(
        loaded.project.is_some() && loaded.diagnostics.is_empty(),
        "{:#?}",
        loaded.diagnostics
    );
}
