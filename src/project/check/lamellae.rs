//! `[lamella]`: overrides by patch, the material by name, the lint on thickness.

use super::distribution::undefined_patch;
use super::materials::{self, Materials, undefined_material};
use super::patches::Patches;
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::ProjectFile;
use crate::project::file::anchors::{LamellaFile, OverrideFile};
use crate::project::file::quantity::readable;
use crate::project::file::reader::{Field, Sink};
use crate::project::file::words::Reference;
use crate::project::model::Lamella;
use std::collections::BTreeMap;

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

pub(super) fn check<'f>(
    file: &'f ProjectFile,
    patches: &Patches<'f>,
    sink: &mut Sink,
) -> (Lamellae<'f>, Materials<'f>) {
    let materials = materials::own(file, sink);
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
    let reference = lamella.material.good();
    material(&lamella.material, &path.key("material"), materials, sink);
    let base = Lamella {
        width: lamella.width.good()?.si,
        thickness: lamella.thickness.good()?.si,
        // Kept even if it is unknown: the checks of the section do not depend on it.
        material: reference?.0.clone(),
    };
    thick(&base, path, path, sink);
    Some(base)
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
    if materials.know(name) {
        return Some(name.clone());
    }
    undefined_material(at, name, materials.own.keys().copied(), sink);
    None
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
