//! Sections that are mostly defaults: splitting, supports, simulation, studies, lints.

use super::counts::Counts;
use super::materials::undefined_material;
use super::patches::Patches;
use super::points::Points;
use super::section;
use crate::diagnostics::codes::{self, Code};
use crate::diagnostics::{Diagnostic, KeyPath};
use crate::project::file::ProjectFile;
use crate::project::file::anchors::SupportPlacesFile;
use crate::project::file::choices::Pick;
use crate::project::file::collections::OneOrMany;
use crate::project::file::quantity::{Length, Quantity, out_of_range};
use crate::project::file::reader::{Defaulted, Field, Sink, shortened};
use crate::project::file::words::Reference;
use crate::project::materials;
use crate::project::model::{
    Simulation, Split, Study, SupportKind, SupportPlaces, Supports, Workflow,
};
use crate::project::suggest;

/// The paper's bound of eta.
const ETA_MAX: f64 = 1.0015;

/// Slopes of cladding functions within which members stay evenly spaced enough to build.
const SLOPE: [f64; 2] = [0.5, 2.0];

pub(super) fn split(file: &ProjectFile, sink: &mut Sink) -> Option<Split> {
    let Some(said) = section(file.split.as_ref())? else {
        return Some(Split {
            workflow: Workflow::Off,
            eta_max: ETA_MAX,
            slope: SLOPE,
            min_side: None,
            max_patches: None,
            max_side: None,
        });
    };
    let slope = match &said.slope {
        None => Some(SLOPE),
        Some(slope) => slope.good().and_then(|slope| {
            let slope: Vec<f64> = slope.all()?.iter().map(|q| q.si).collect();
            slope.try_into().ok()
        }),
    };
    if let Some([low, high]) = slope
        && !(low < 1.0 && 1.0 < high)
    {
        sink.error(|| {
            out_of_range(
                &KeyPath::of(["split", "slope"]),
                &format!("[{low}, {high}]"),
                "a bound below 1 and a bound above 1",
                Some("a cladding function runs from corner to corner, so its mean slope is 1"),
            )
        });
        return None;
    }
    Some(Split {
        workflow: said.workflow.said_or(Pick(Workflow::Off))?.0,
        eta_max: said.eta_max.said_or(Quantity::new(ETA_MAX))?.si,
        slope: slope?,
        min_side: said.min_side.said()?.map(|length| length.si),
        max_patches: said.max_patches.said()?.map(|count| count.0),
        max_side: said.max_side.said()?.map(|length| length.si),
    })
}

pub(super) fn supports(
    file: &ProjectFile,
    points: &Points<'_>,
    patches: &Patches<'_>,
    counts: &Counts,
    sink: &mut Sink,
) -> Option<Supports> {
    let Some(said) = section(file.supports.as_ref())? else {
        return Some(Supports {
            at: SupportPlaces::Corners,
            kind: SupportKind::Printed,
            height: 0.0,
        });
    };
    let at = match &said.at {
        None => SupportPlaces::Corners,
        Some(at) => match at.good()? {
            SupportPlacesFile::Corners => SupportPlaces::Corners,
            SupportPlacesFile::EveryBoundaryCrossing => SupportPlaces::EveryBoundaryCrossing,
            SupportPlacesFile::Listed(ids) => {
                let mut listed = Some(Vec::with_capacity(ids.len()));
                for (index, id) in ids.iter().enumerate() {
                    let path = KeyPath::of(["supports", "at"]).index(index);
                    let good = id
                        .good()
                        .filter(|id| support_place(&id.0, &path, points, patches, counts, sink));
                    listed = listed.zip(good).map(|(mut listed, id)| {
                        listed.push(id.0.clone());
                        listed
                    });
                }
                SupportPlaces::Listed(listed?)
            }
        },
    };
    Some(Supports {
        at,
        kind: said.kind.said_or(Pick(SupportKind::Printed))?.0,
        height: said.height.said_or(Length::new(0.0))?.si,
    })
}

/// Whether the id names a point or a crossing; reports it if not.
fn support_place(
    id: &str,
    at: &KeyPath,
    points: &Points<'_>,
    patches: &Patches<'_>,
    counts: &Counts,
    sink: &mut Sink,
) -> bool {
    let (Some(names), true) = (&points.names, patches.readable) else {
        return false;
    };
    if names.binary_search(&id).is_ok() {
        return true;
    }
    let fault = match crossing(id) {
        None => {
            sink.error(|| {
                let diagnostic = Diagnostic::error(
                    Code::new("E0213"),
                    format!("`{}` is neither a point nor a crossing", shortened(id)),
                )
                .at_key(at.as_str(), "unknown id");
                diagnostic.help(match suggest::help(id, "point", names.iter().copied()) {
                    Some(help) => help,
                    None => {
                        "a crossing is written by its members, such as `west.u03-v05`".to_owned()
                    }
                })
            });
            return false;
        }
        Some((patch, u, v)) => {
            let Some(index) = patches.names().position(|name| name == patch) else {
                let names: Vec<&str> = patches.names().collect();
                super::distribution::undefined_patch(at, patch, &names, sink);
                return false;
            };
            let beyond = |number: u32, count: Option<u32>| {
                number == 0 || count.is_some_and(|count| number > count)
            };
            let member = |letter, number: u32, count: Option<u32>| match count {
                Some(last) => format!(
                    "`{patch}` has no member {letter}{number:02}: they are {letter}01 to {letter}{last:02}"
                ),
                None => format!("`{patch}` has no member {letter}{number:02}"),
            };
            if beyond(u, counts.u(index)) {
                member("u", u, counts.u(index))
            } else if beyond(v, counts.v(index)) {
                member("v", v, counts.v(index))
            } else {
                return true;
            }
        }
    };
    sink.error(|| {
        Diagnostic::error(Code::new("E0213"), fault)
            .at_key(at.as_str(), "no such member")
            .help("members are counted from 01 at the first corner, boundary members included")
    });
    false
}

/// `west.u03-v05` as patch and member numbers.
fn crossing(id: &str) -> Option<(&str, u32, u32)> {
    let (patch, members) = id.rsplit_once('.')?;
    let (u, v) = members.split_once('-')?;
    let number = |text: &str| {
        let digits = text.len() >= 2 && text.bytes().all(|byte| byte.is_ascii_digit());
        digits.then(|| text.parse().ok())?
    };
    Some((
        patch,
        number(u.strip_prefix('u')?)?,
        number(v.strip_prefix('v')?)?,
    ))
}

pub(super) fn simulation(file: &ProjectFile) -> Option<Simulation> {
    let said = section(file.simulation.as_ref())?;
    let gravity = match said.and_then(|said| said.gravity.as_ref()) {
        None => [0.0, 0.0, -9.81],
        Some(gravity) => {
            let values: Vec<f64> = gravity.good()?.all()?.iter().map(|q| q.si).collect();
            values.try_into().ok()?
        }
    };
    let connect_patches = said.map_or(Some(true), |said| said.connect_patches.said_or(true))?;
    Some(Simulation {
        gravity,
        connect_patches,
    })
}

pub(super) fn studies(file: &ProjectFile, sink: &mut Sink) -> Option<Vec<Study>> {
    let Some(said) = section(file.studies.as_ref())? else {
        return Some(Vec::new());
    };
    let own: Option<Vec<&str>> = section(file.materials.as_ref()).map(|table| {
        let entries = table
            .map(|table| table.entries.as_slice())
            .unwrap_or_default();
        entries.iter().map(|(name, _)| name.as_str()).collect()
    });
    let mut studies = Some(Vec::new());
    for (index, study) in said.0.iter().enumerate() {
        let Some(study) = study.good() else {
            studies = None;
            continue;
        };
        let scale = match &study.scale {
            None => Some(vec![1.0]),
            Some(scale) => scale
                .good()
                .and_then(OneOrMany::all)
                .map(|all| all.iter().map(|q| q.si).collect()),
        };
        let mut names = Some(Vec::new());
        if let Some(materials) = &study.materials {
            let path = KeyPath::of(["studies"]).index(index).key("materials");
            let items = materials.good().map(|materials| materials.0.as_slice());
            names = items.and_then(|items| material_names(items, &path, own.as_deref(), sink));
        }
        studies = studies
            .zip(scale.zip(names))
            .map(|(mut studies, (scale, materials))| {
                studies.push(Study { scale, materials });
                studies
            });
    }
    studies
}

/// The names of a study if all are materials; nothing is judged if the user's own are unknown.
fn material_names(
    items: &[Field<Reference>],
    path: &KeyPath,
    own: Option<&[&str]>,
    sink: &mut Sink,
) -> Option<Vec<String>> {
    let mut names = Some(Vec::with_capacity(items.len()));
    for (index, item) in items.iter().enumerate() {
        let good = item.good().map(|item| item.0.as_str()).filter(|name| {
            let known = materials::find(name).is_some();
            match own {
                _ if known => true,
                None => false,
                Some(own) if own.contains(name) => true,
                Some(own) => {
                    undefined_material(&path.index(index), name, own.iter().copied(), sink);
                    false
                }
            }
        });
        names = names.zip(good).map(|(mut names, name)| {
            names.push(name.to_owned());
            names
        });
    }
    names
}

pub(super) fn allowed_lints(file: &ProjectFile, sink: &mut Sink) -> Option<Vec<String>> {
    let said = section(file.lints.as_ref())?;
    let Some(list) = section(said.and_then(|said| said.allow.as_ref()))? else {
        return Some(Vec::new());
    };
    let mut allowed = Some(Vec::new());
    for (index, item) in list.0.iter().enumerate() {
        let good = item.good().map(|item| item.0.as_str()).filter(|name| {
            let known = codes::lints().any(|lint| lint.name == *name);
            if !known {
                let path = KeyPath::of(["lints", "allow"]).index(index);
                sink.error(|| undefined_lint(&path, name));
            }
            known
        });
        allowed = allowed.zip(good).map(|(mut allowed, name)| {
            allowed.push(name.to_owned());
            allowed
        });
    }
    allowed.map(|mut allowed| {
        allowed.sort();
        allowed.dedup();
        allowed
    })
}

fn undefined_lint(at: &KeyPath, name: &str) -> Diagnostic {
    let shown = shortened(name);
    let diagnostic = Diagnostic::error(Code::new("E0204"), format!("there is no lint `{shown}`"))
        .at_key(at.as_str(), "unknown lint");
    if let Some(info) = codes::find(name) {
        let help = if info.is_lint() {
            format!("lints are named, not numbered: write \"{}\"", info.name)
        } else {
            "only warnings can be allowed; an error has no result to go on with".to_owned()
        };
        return diagnostic.help(help);
    }
    let names: Vec<&str> = codes::lints().map(|lint| lint.name).collect();
    match suggest::help(name, "lint", names.iter().copied()) {
        Some(help) => diagnostic.help(help),
        None => diagnostic.help("every warning shows its name beside its code"),
    }
}
