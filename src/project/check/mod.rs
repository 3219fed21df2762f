//! From the file's terms to the model: names are resolved, defaults filled in, rules that span
//! several keys are checked.
//!
//! One mistake is one error: whatever depends on a value that is already reported as wrong keeps
//! silent. So each check takes only values that are good, and a project comes out only if
//! nothing at all was wrong.

mod counts;
mod distribution;
mod fabrication;
mod lamellae;
mod materials;
mod patches;
mod points;
mod rest;

use super::file::ProjectFile;
use super::file::anchors::Alpha;
use super::file::choices::{LengthUnit, Pick};
use super::file::reader::{Defaulted, Field, Sink};
use super::file::words::name_fault;
use super::model::{Patch, Project, Surface};
use super::strips::{Network, OnEdge};
use super::units::{self, Unit};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::Code;

/// Checks a file; `file_name` without its extension names a project that does not name itself.
/// A model exists if and only if the sink holds no error.
pub(crate) fn check(file: &ProjectFile, file_name: &str, sink: &mut Sink) -> Option<Project> {
    let name = name(file, file_name, sink);
    let surface = surface(file);
    let points = points::check(file, sink);
    let patches = patches::check(file, points.names.as_deref(), sink);
    let network = network(&points, &patches);
    let strips = network.strips();
    let counts = counts::check(file, &patches, &network, &strips, sink);
    let distribution = distribution::check(file, &points, &patches, &network, &strips, sink);
    let (lamellae, materials) = lamellae::check(file, &patches, sink);
    let hardware = fabrication::hardware(file, &lamellae, sink);
    let fabrication = fabrication::fabrication(file, &lamellae, sink);
    let supports = rest::supports(file, &points, &patches, &counts, sink);
    let studies = rest::studies(file, sink);
    let split = rest::split(file, sink);
    let simulation = rest::simulation(file);
    let allowed_lints = rest::allowed_lints(file, sink);
    points::unused(file, &points, &patches, supports.as_ref(), sink);
    materials::unused(file, &lamellae, studies.as_deref(), sink);
    if sink.failed() {
        return None;
    }
    let checked_patches = patches
        .all
        .iter()
        .enumerate()
        .map(|(index, patch)| {
            Some(Patch {
                name: patch.name.to_owned(),
                corners: patch.corners?.map(str::to_owned),
                u: counts.u(index),
                v: counts.v(index),
                alpha: match patch.alpha? {
                    Alpha::Auto => None,
                    Alpha::Angle(angle) => Some(angle.si),
                },
                lamella: lamellae.of(patch.name)?,
            })
        })
        .collect::<Option<Vec<_>>>()?;
    let studies = studies?;
    let materials = materials.used(&checked_patches, &studies)?;
    Some(Project {
        name: name?,
        surface: surface?,
        points: points.model()?,
        patches: checked_patches,
        distribution: distribution?,
        materials,
        split: split?,
        supports: supports?,
        hardware: hardware?,
        fabrication: fabrication?,
        simulation: simulation?,
        studies,
        allowed_lints: allowed_lints?,
    })
}

/// The section if the file has it and it is readable; `Some(None)` if the file leaves it out.
#[expect(
    clippy::option_option,
    reason = "wrong, left out and said are three things"
)]
fn section<T>(field: Option<&Field<T>>) -> Option<Option<&T>> {
    match field {
        None => Some(None),
        Some(Field::Good(section)) => Some(Some(section)),
        Some(Field::Bad) => None,
    }
}

fn name(file: &ProjectFile, file_name: &str, sink: &mut Sink) -> Option<String> {
    match section(file.project.as_ref())?.and_then(|section| section.name.as_ref()) {
        Some(name) => name.good().map(|name| name.0.clone()),
        None if name_fault(file_name).is_none() => Some(file_name.to_owned()),
        None => {
            sink.error(|| {
                let shown = super::file::reader::shortened(file_name);
                Diagnostic::error(Code::new("E0111"), "`project.name` is missing")
                    .at_key("project.name", "`name` belongs here")
                    .note(format!(
                        "the name of the file, `{shown}`, cannot be used instead"
                    ))
                    .help("for example: name = \"pavilion\"")
            });
            None
        }
    }
}

fn surface(file: &ProjectFile) -> Option<Surface> {
    let project = section(file.project.as_ref())?;
    let project_units = project
        .and_then(|project| project.units)
        .said_or(Pick(LengthUnit::Mm))?;
    let surface = file.surface.good()?;
    let Pick(units) = surface.units.said_or(project_units)?;
    let scale = surface
        .scale
        .map_or(Some(1.0), |field| field.good().map(|q| q.si))?;
    Some(Surface {
        mesh: surface.mesh.good()?.0.clone(),
        metres_per_unit: unit_of(units).size() * scale,
        up: surface.up.said_or(Pick(super::model::Axis::Z))?.0,
        flip: surface.flip.said_or(false)?,
    })
}

/// The unit that the word means.
pub(crate) fn unit_of(word: LengthUnit) -> Unit {
    match word {
        LengthUnit::Mm => units::MILLIMETRE,
        LengthUnit::Cm => units::CENTIMETRE,
        LengthUnit::M => units::METRE,
        LengthUnit::In => units::INCH,
        LengthUnit::Ft => units::FOOT,
    }
}

/// The network of the patches whose corners are good. Its indices count those only.
fn network<'f>(points: &points::Points<'f>, patches: &patches::Patches<'f>) -> Network<'f> {
    Network {
        patches: patches.good().map(|(_, corners)| corners).collect(),
        on_edges: points
            .on_edges()
            .map(|(point, edge, at)| OnEdge { point, edge, at })
            .collect(),
    }
}
