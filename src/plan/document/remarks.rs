//! The bill, and what the compiler had to say.

use crate::diagnostics::{Diagnostic, Severity};
use crate::plan::round;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One line of the shopping list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BomRow {
    /// Stable key: `bolt-m4x16`.
    pub id: String,
    /// `stock`, `lamella`, `plate`, `fastener`, `sleeve`, `friction`, `support`, `consumable`.
    pub category: String,
    /// What it is.
    pub description: String,
    /// Material, if that says something.
    pub material: String,
    /// Standard or dimensions.
    pub specification: String,
    /// How many are used.
    #[serde(serialize_with = "round::quantity")]
    pub quantity: f64,
    /// `pcs`, `m`, `m2`, `cm2`, `kg`.
    pub unit: String,
    /// How many more to buy.
    #[serde(serialize_with = "round::quantity")]
    pub spare: f64,
    /// Kilograms each, where known.
    #[serde(serialize_with = "round::kilograms")]
    pub unit_mass: Option<f64>,
    /// Price each, where given.
    #[serde(serialize_with = "round::quantity")]
    pub unit_cost: Option<f64>,
}

/// A diagnostic as the plan keeps it: without spans, which belong to one text of the file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiagnosticRecord {
    /// `W0602`.
    pub code: String,
    /// `note`, `warning` or `error`.
    pub severity: String,
    /// What is said.
    pub message: String,
    /// Id of the thing it is about.
    pub subject: Option<String>,
}

impl From<&Diagnostic> for DiagnosticRecord {
    fn from(diagnostic: &Diagnostic) -> Self {
        Self {
            code: diagnostic.code.to_string(),
            severity: match diagnostic.severity {
                Severity::Note => "note",
                Severity::Warning => "warning",
                Severity::Error => "error",
            }
            .to_owned(),
            message: diagnostic.message.clone(),
            subject: diagnostic.subject.clone(),
        }
    }
}
