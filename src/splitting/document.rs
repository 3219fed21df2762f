//! What `egg check --format json` prints.

use super::PatchCheck;
use schemars::JsonSchema;
use serde::Serialize;

/// How the patches of a project stand. Lengths are in metres, angles in degrees, curvature in 1/m².
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "Check")]
pub struct CheckDocument<'a> {
    /// `egg-check`.
    format: &'static str,
    /// Raised when a field changes its meaning or goes; further fields may come any time.
    version: u32,
    /// Name of the project.
    project: &'a str,
    /// Whether all patches are feasible and nothing else is wrong.
    feasible: bool,
    /// Its patches by name; none where the surface or the project is at fault.
    patches: &'a [PatchCheck],
}

impl<'a> CheckDocument<'a> {
    /// `sound` tells that nothing beside the patches is wrong.
    pub fn new(project: &'a str, sound: bool, patches: &'a [PatchCheck]) -> Self {
        Self {
            format: "egg-check",
            version: 1,
            project,
            feasible: sound && patches.iter().all(|patch| patch.feasible),
            patches,
        }
    }
}

/// The JSON schema of the document, draft-07.
///
/// # Panics
/// Never: a schema is JSON.
pub fn schema() -> String {
    let settings = schemars::generate::SchemaSettings::draft07().for_serialize();
    let schema = settings
        .into_generator()
        .into_root_schema_for::<CheckDocument<'_>>();
    let mut text = serde_json::to_string_pretty(&schema).expect("a schema is JSON");
    text.push('\n');
    text
}
