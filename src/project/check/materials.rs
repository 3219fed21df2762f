//! `[materials]`: values of the user's own, and the lints on them.

use super::lamellae::Lamellae;
use super::section;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::choices::Pick;
use crate::project::file::quantity::readable;
use crate::project::file::reader::{Defaulted, Sink, shortened};
use crate::project::file::{MaterialFile, ProjectFile};
use crate::project::materials;
use crate::project::model::{Grain, Material, Patch, Study};
use crate::project::suggest;
use std::collections::{BTreeMap, BTreeSet};

/// The user's materials and the built-in ones.
pub(super) struct Materials<'f> {
    pub(super) own: BTreeMap<&'f str, Option<Material>>,
    /// Whether the table could be read.
    readable: bool,
}

impl Materials<'_> {
    /// Materials that the patches and studies name, sorted by name.
    pub(super) fn used(&self, patches: &[Patch], studies: &[Study]) -> Option<Vec<Material>> {
        let names: BTreeSet<&str> = patches
            .iter()
            .map(|patch| patch.lamella.material.as_str())
            .chain(
                studies
                    .iter()
                    .flat_map(|study| &study.materials)
                    .map(String::as_str),
            )
            .collect();
        names.into_iter().map(|name| self.find(name)).collect()
    }

    /// Whether there is a material of that name, or nobody can say.
    pub(super) fn know(&self, name: &str) -> bool {
        !self.readable || self.own.contains_key(name) || materials::find(name).is_some()
    }

    fn find(&self, name: &str) -> Option<Material> {
        match self.own.get(name) {
            Some(own) => own.clone(),
            None => materials::find(name),
        }
    }
}

/// The user's materials.
pub(super) fn own<'f>(file: &'f ProjectFile, sink: &mut Sink) -> Materials<'f> {
    let Some(table) = section(file.materials.as_ref()) else {
        return Materials {
            own: BTreeMap::new(),
            readable: false,
        };
    };
    let entries = table
        .map(|table| table.entries.as_slice())
        .unwrap_or_default();
    let own = entries
        .iter()
        .map(|(name, material)| {
            let material = material
                .good()
                .and_then(|said| own_material(name, said, sink));
            (name.as_str(), material)
        })
        .collect();
    Materials {
        own,
        readable: true,
    }
}

fn own_material(name: &str, said: &MaterialFile, sink: &mut Sink) -> Option<Material> {
    let path = KeyPath::of(["materials", name]);
    if materials::find(name).is_some() {
        sink.warning(|| {
            Diagnostic::warning(
                Code::new("W0207"),
                format!("the material `{name}` hides the built-in one"),
            )
            .at_name(path.as_str(), "also a built-in name")
            .about(name)
            .help("give your material a name of its own, so that readers know whose values count")
        });
    }
    if said.grain.is_none() {
        sink.warning(|| {
            Diagnostic::warning(
                Code::new("W0202"),
                format!("the material `{name}` does not say how its grain runs"),
            )
            .at_name(path.as_str(), "`grain` belongs here; taken as \"along\"")
            .about(name)
            .help("add grain = \"along\" (or \"across\", or \"none\" for metals and plastics)")
        });
    }
    let price = said.price.said()?.map(|price| price.si);
    let grain = said.grain.said_or(Pick(Grain::Along))?.0;
    let material = Material {
        name: name.to_owned(),
        elastic_modulus: said.elastic_modulus.good()?.si,
        shear_modulus: said.shear_modulus.good()?.si,
        density: said.density.good()?.si,
        bending_strength: said.bending_strength.good()?.si,
        price,
        grain,
    };
    implausible(&material, sink);
    Some(material)
}

/// Slips of the unit: values that no solid has.
fn implausible(material: &Material, sink: &mut Sink) {
    let bounds = [
        (
            "elastic_modulus",
            material.elastic_modulus,
            1e8,
            1e12,
            1e9,
            "GPa",
        ),
        (
            "shear_modulus",
            material.shear_modulus,
            1e7,
            5e11,
            1e9,
            "GPa",
        ),
        ("density", material.density, 20.0, 22_600.0, 1.0, "kg/m^3"),
        (
            "bending_strength",
            material.bending_strength,
            1e6,
            1e10,
            1e6,
            "MPa",
        ),
    ];
    for (key, value, least, most, unit, symbol) in bounds {
        if (least..=most).contains(&value) {
            continue;
        }
        sink.warning(|| {
            let name = &material.name;
            let show = |value: f64| format!("{} {symbol}", readable(value / unit));
            Diagnostic::warning(
                Code::new("W0208"),
                format!(
                    "the {} of `{name}` is {}",
                    key.replace('_', " "),
                    show(value)
                ),
            )
            .at_key(
                KeyPath::of(["materials", name, key]).as_str(),
                format!("sheet materials have {} to {}", show(least), show(most)),
            )
            .about(name)
            .help(format!(
                "check the unit; with its unit the value is a string, such as \"{}\"",
                show(most)
            ))
        });
    }
}

/// Reports a name that is no material.
pub(super) fn undefined_material<'a>(
    at: &KeyPath,
    name: &str,
    own: impl Iterator<Item = &'a str>,
    sink: &mut Sink,
) {
    sink.error(|| {
        let shown = shortened(name);
        let diagnostic = Diagnostic::error(
            Code::new("E0203"),
            format!("there is no material `{shown}`"),
        )
        .at_key(at.as_str(), "neither built in nor in `materials`");
        let built_in = materials::names().map(|name| -> &str { name });
        let all: Vec<&str> = own.chain(built_in).collect();
        let list = "`egg materials` lists the built-in ones; others go into `[materials]`";
        diagnostic.help(match suggest::help(name, "material", all) {
            Some(close) => format!("{close}\n{list}"),
            None => list.to_owned(),
        })
    });
}

/// Warns of the user's materials that nothing names.
pub(super) fn unused(
    file: &ProjectFile,
    lamellae: &Lamellae<'_>,
    studies: Option<&[Study]>,
    sink: &mut Sink,
) {
    // A misspelt name is reported as such, and would leave its material unused.
    if sink.failed() {
        return;
    }
    let (Some(Some(table)), Some(all), Some(studies)) =
        (section(file.materials.as_ref()), lamellae.all(), studies)
    else {
        return;
    };
    let mut used: BTreeSet<&str> = all
        .iter()
        .map(|lamella| lamella.material.as_str())
        .collect();
    used.extend(
        lamellae
            .base
            .iter()
            .map(|lamella| lamella.material.as_str()),
    );
    used.extend(
        studies
            .iter()
            .flat_map(|study| &study.materials)
            .map(String::as_str),
    );
    let unused = table.entries.iter().map(|(name, _)| name.as_str());
    for name in unused.filter(|name| !used.contains(name)) {
        sink.warning(|| {
            Diagnostic::warning(
                Code::new("W0206"),
                format!("the material `{name}` is never used"),
            )
            .at_name(
                KeyPath::of(["materials", name]).as_str(),
                "no lamella or study names it",
            )
            .about(name)
        });
    }
}
