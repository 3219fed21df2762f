//! What a project asks for and a build does not do.
//!
//! The language is larger than any one pipeline. A section that no stage reads must be said out
//! loud: a designer who wrote `splice = "finger"` would otherwise cut lamellae without joints.

use super::Loaded;
use super::model::{Project, Workflow};
use crate::diagnostics::codes::Code;
use crate::diagnostics::{Diagnostic, Severity};

/// Something that a pipeline can do beyond cutting lamellae from patches that stand as they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Capability {
    /// Members that run on over several patches.
    SeveralPatches,
    /// Rings of members that close (`distribution.closed`).
    ClosedStrips,
    /// Splitting of patches (`split.workflow` other than off).
    Splitting,
    /// Supports (`[supports]`).
    Supports,
    /// Stickers at notches (`hardware.sticker`).
    Stickers,
    /// Tubes in notches (`hardware.shell`).
    Shells,
    /// Sheets cut in windows of a bed smaller than the stock (`fabrication.bed`).
    BedWindows,
    /// Outlines moved by half the kerf (`fabrication.kerf`).
    KerfCompensation,
    /// Joints of lamellae longer than the stock (`fabrication.splice`).
    Splices,
    /// Costs (`price` of materials and stock).
    Costs,
    /// The mechanical simulation (`[simulation]`).
    Simulation,
    /// Studies of size and material (`[[studies]]`).
    Studies,
}

impl Capability {
    /// All of them, in the order of the file's sections.
    pub const ALL: [Self; 12] = [
        Self::SeveralPatches,
        Self::ClosedStrips,
        Self::Splitting,
        Self::Supports,
        Self::Stickers,
        Self::Shells,
        Self::BedWindows,
        Self::KerfCompensation,
        Self::Splices,
        Self::Costs,
        Self::Simulation,
        Self::Studies,
    ];

    /// Where the project asks for it, if it does.
    fn asked(self, project: &Project, loaded: &Loaded) -> Option<String> {
        let key = |asked: bool, path: &str| asked.then(|| path.to_owned());
        let section = |path: &str| key(loaded.spans.contains(path), path);
        match self {
            Self::SeveralPatches => key(project.patches.len() > 1, "patches"),
            Self::ClosedStrips => key(
                !project.distribution.closed.is_empty(),
                "distribution.closed",
            ),
            Self::Splitting => key(project.split.workflow != Workflow::Off, "split.workflow"),
            Self::Supports => section("supports"),
            Self::Stickers => key(project.hardware.sticker.is_some(), "hardware.sticker"),
            Self::Shells => key(project.hardware.shell.is_some(), "hardware.shell"),
            Self::BedWindows => project.fabrication.bed.as_ref().and_then(|bed| {
                let stock = &project.fabrication.stock;
                let smaller = bed.length < stock.length || bed.width < stock.width;
                key(smaller, "fabrication.bed")
            }),
            Self::KerfCompensation => key(project.fabrication.kerf > 0.0, "fabrication.kerf"),
            Self::Splices => key(project.fabrication.splice.is_some(), "fabrication.splice"),
            Self::Costs => {
                let stock = project.fabrication.stock.price.is_some();
                let material = project.materials.iter().find(|m| m.price.is_some());
                key(stock, "fabrication.stock.price").or_else(|| {
                    let names = ["materials", &material?.name, "price"];
                    Some(crate::diagnostics::KeyPath::of(names).into())
                })
            }
            Self::Simulation => section("simulation"),
            Self::Studies => key(!project.studies.is_empty(), "studies"),
        }
    }

    /// What happens instead, and whether the cut parts depend on it.
    fn consequence(self) -> (Severity, &'static str, &'static str) {
        use Severity::{Note, Warning};
        match self {
            Self::SeveralPatches => (
                Warning,
                "members that run on over several patches",
                "every patch is built by itself, so members of neighbours need not meet",
            ),
            Self::ClosedStrips => (
                Warning,
                "rings of members that close",
                "members of the ring end where they end",
            ),
            Self::Splitting => (
                Warning,
                "splitting of patches",
                "patches are taken as they are and checked",
            ),
            Self::Supports => (Warning, "supports", "no support is drawn or counted"),
            Self::Stickers => (Warning, "stickers", "no sticker is drawn or counted"),
            Self::Shells => (
                Warning,
                "tubes in notches",
                "openings are as wide as the bolt and its clearance",
            ),
            Self::BedWindows => (
                Warning,
                "sheets cut in windows of the bed",
                "every sheet is one drawing of the size of the stock",
            ),
            Self::KerfCompensation => (
                Warning,
                "kerf compensation",
                "drawings have nominal geometry; compensate in the machine's driver",
            ),
            Self::Splices => (
                Warning,
                "splices",
                "a lamella longer than the stock is drawn in one piece",
            ),
            Self::Costs => (Note, "costs", "lists have no prices"),
            Self::Simulation => (Note, "the mechanical simulation", "nothing is simulated"),
            Self::Studies => (Note, "studies", "no study is run"),
        }
    }
}

/// What the project asks for and a pipeline with these capabilities does not do: warnings where
/// the parts to be cut depend on it, notes where only reports do. Lints that the project allows
/// are left out.
pub fn unbuilt(loaded: &Loaded, capabilities: &[Capability]) -> Vec<Diagnostic> {
    let Some(project) = &loaded.project else {
        return Vec::new();
    };
    let diagnostics = Capability::ALL
        .into_iter()
        .filter(|capability| !capabilities.contains(capability))
        .filter_map(|capability| {
            let place = capability.asked(project, loaded)?;
            let (severity, what, instead) = capability.consequence();
            let message = format!("this `egg` does not build {what}");
            let code = Code::new("W0290");
            let diagnostic = match severity {
                Severity::Note => Diagnostic::note_only(code, message),
                _ => Diagnostic::warning(code, message),
            };
            Some(diagnostic.at_key(place, "asked for here").note(instead))
        })
        .collect();
    crate::diagnostics::without_allowed(diagnostics, &project.allowed_lints)
}
