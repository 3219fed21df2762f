//! `[lamella]` and `[materials]`: overrides by patch, materials by name, and the lints on both.

use super::distribution::undefined_patch;
use super::patches::Patches;
use super::section;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::anchors::{LamellaFile, OverrideFile};
use crate::project::file::quantity::readable;
use crate::project::file::reader::{Defaulted, Field, Sink, shortened};
use crate::project::file::words::{Pick, Reference};
use crate::project::file::{MaterialFile, ProjectFile};
use crate::project::materials;
use crate::project::model::{Grain, Lamella, Material, Patch, Study};
use crate::project::suggest;
use std::collections::{BTreeMap, BTreeSet};

/// Lamellae as far as they are good.
pub(super) struct Lamellae<'f> {
    /// Of all patches without an override.
    pub(super) base: Option<Lamella>,
    overrides: BTreeMap<&'f str, Option<Lamella>>,
    patches: Vec<&'f str>,
}

impl Lamellae<'_> {
    /// The lamella of a patch.
    pub(super) fn of(&self, patch: &str) -> Option<Lamella> {
        let lamella = self.overrides.get(patch).unwrap_or(&self.base);
        lamella.clone()
    }

    /// Lamellae of all patches; `None` unless every one is good.
    pub(super) fn all(&self) -> Option<Vec<Lamella>> {
        self.patches.iter().map(|patch| self.of(patch)).collect()
    }
}

/// The user's materials and the built-in ones.
pub(super) struct Materials<'f> {
    own: BTreeMap<&'f str, Option<Material>>,
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

    fn find(&self, name: &str) -> Option<Material> {
        match self.own.get(name) {
            Some(own) => own.clone(),
            None => materials::find(name),
        }
    }
}

pub(super) fn check<'f>(
    file: &'f ProjectFile,
    patches: &Patches<'f>,
    sink: &mut Sink,
) -> (Lamellae<'f>, Materials<'f>) {
    let materials = own_materials(file, sink);
    let mut lamellae = Lamellae {
        base: None,
        overrides: BTreeMap::new(),
        patches: patches.names().collect(),
    };
    let Some(lamella) = file.lamella.good() else {
        return (lamellae, materials);
    };
    let path = KeyPath::of(["lamella"]);
    lamellae.base = base(lamella, &path, &materials, sink);
    for (name, own) in &lamella.overrides.entries {
        let path = path.key(name);
        if patches.readable && !lamellae.patches.contains(&name.as_str()) {
            undefined_patch(&path, name, &lamellae.patches, sink);
            continue;
        }
        let own = own
            .good()
            .and_then(|own| overridden(own, &path, lamella, &materials, sink));
        lamellae.overrides.insert(name, own);
    }
    (lamellae, materials)
}

fn base(
    lamella: &LamellaFile,
    path: &KeyPath,
    materials: &Materials<'_>,
    sink: &mut Sink,
) -> Option<Lamella> {
    let material = material(&lamella.material, &path.key("material"), materials, sink);
    let base = Lamella {
        width: lamella.width.good()?.si,
        thickness: lamella.thickness.good()?.si,
        material: material.unwrap_or_default(),
    };
    thick(&base, path, path, sink);
    lamella.material.good().map(|_| base)
}

fn overridden(
    own: &OverrideFile,
    path: &KeyPath,
    base: &LamellaFile,
    materials: &Materials<'_>,
    sink: &mut Sink,
) -> Option<Lamella> {
    let material = match &own.material {
        Some(own) => material(own, &path.key("material"), materials, sink),
        None => base.material.good().map(|material| material.0.clone()),
    };
    let lamella = Lamella {
        width: own.width.unwrap_or(base.width).good()?.si,
        thickness: own.thickness.unwrap_or(base.thickness).good()?.si,
        material: material?,
    };
    if own.width.is_some() || own.thickness.is_some() {
        let shared = KeyPath::of(["lamella"]);
        let place = |said: bool| if said { path } else { &shared };
        thick(
            &lamella,
            place(own.width.is_some()),
            place(own.thickness.is_some()),
            sink,
        );
    }
    Some(lamella)
}

/// Resolves the name of a material; `None` after reporting.
fn material(
    field: &Field<Reference>,
    at: &KeyPath,
    materials: &Materials<'_>,
    sink: &mut Sink,
) -> Option<String> {
    let name = &field.good()?.0;
    if is_material(name, materials) {
        return Some(name.clone());
    }
    undefined_material(at, name, materials.own.keys().copied(), sink);
    None
}

fn is_material(name: &str, materials: &Materials<'_>) -> bool {
    !materials.readable || materials.own.contains_key(name) || materials::find(name).is_some()
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

/// The paper's rule of thumb: a lamella is at least five times as wide as thick, or it twists
/// instead of staying upright on its geodesic.
fn thick(lamella: &Lamella, width: &KeyPath, thickness: &KeyPath, sink: &mut Sink) {
    if lamella.thickness < lamella.width / 5.0 {
        return;
    }
    sink.warning(|| {
        let millimetres = |metres: f64| readable(metres * 1000.0);
        Diagnostic::warning(
            Code::new("W0201"),
            format!(
                "a lamella of {} mm is thick for a width of {} mm",
                millimetres(lamella.thickness),
                millimetres(lamella.width)
            ),
        )
        .at_key(
            thickness.key("thickness").as_str(),
            format!(
                "a fifth of the width is {} mm",
                millimetres(lamella.width / 5.0)
            ),
        )
        .at_key(width.key("width").as_str(), "the width")
        .help("make the lamella thinner or wider")
    });
}

fn own_materials<'f>(file: &'f ProjectFile, sink: &mut Sink) -> Materials<'f> {
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

/// Warns of the user's materials that nothing names.
pub(super) fn unused(
    file: &ProjectFile,
    lamellae: &Lamellae<'_>,
    studies: Option<&[Study]>,
    sink: &mut Sink,
) {
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
